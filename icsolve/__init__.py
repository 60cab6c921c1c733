"""icsolve: instant centres, and the force or torque that holds a planar mechanism in equilibrium.

``load`` a case, ``solve`` it, read the ``Answer``. Nothing is imported before it is asked for, so
that ``import icsolve`` costs next to nothing.
"""

from __future__ import annotations

import sys
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from icsolve.answer import Answer as Answer
    from icsolve.case import Case as Case
    from icsolve.errors import CaseError as CaseError
    from icsolve.errors import SceneError as SceneError
    from icsolve.read import load as load
    from icsolve.solve import solve as solve
    from icsolve.sweep import Sweep as Sweep
    from icsolve.sweep import sweep as sweep
    from icsolve.sweep.evaluator import evaluator as evaluator

__version__ = "0.1.0"
__all__ = [
    "Answer",
    "Case",
    "CaseError",
    "SceneError",
    "Sweep",
    "__version__",
    "evaluator",
    "load",
    "solve",
    "sweep",
]

_ROOMS = {
    "Answer": "answer",
    "Case": "case",
    "CaseError": "errors",
    "SceneError": "errors",
    "Sweep": "sweep",
    "evaluator": "sweep.evaluator",
    "load": "read",
    "solve": "solve",
    "sweep": "sweep",
}


class _Package(ModuleType):
    """The package as a module that keeps ``icsolve.solve`` and ``icsolve.sweep`` the functions.

    Python sets a submodule as an attribute of its package once it is imported; the rooms of these
    names would hide the functions.
    """

    def __setattr__(self, name: str, value: Any) -> None:
        if isinstance(value, ModuleType):
            if name in ("case", "answer", "sweep"):  # what they hold is shown in notebooks
                from icsolve.notebook import register

                register(value)
            if name in ("solve", "sweep"):
                value = getattr(value, name)
        super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package


def __getattr__(name: str) -> Any:
    """The public names, each from its room on first use."""
    if name not in _ROOMS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    value = getattr(import_module(f"{__name__}.{_ROOMS[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
