"""icsolve: instant centres, and the force or torque that holds a planar mechanism in equilibrium.

``load`` a case, ``solve`` it, read the ``Answer``; ``sweep`` solves it for arrays of its numbers,
``evaluator`` compiles it to a function of them. Numbers are in the units of the case, angles in degrees,
angular velocities in rad/s. What is wrong with a case is raised as ``CaseError``, a scene that has no answer
as ``SceneError`` (both are `icsolve.errors.IcsolveError`), arrays that do not fit as ValueError, arguments
of another kind as TypeError (`icsolve.errors.ArgumentError`). Nothing is imported before it is asked for,
so that ``import icsolve`` costs next to nothing. In a notebook a case shows its figure, an answer its worked
solution, a sweep its curve: the values know nothing of it, and are given these methods from here.
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
                _register(value)
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


# --- what notebooks ask for: `_repr_svg_` and `_repr_markdown_`, of which they prefer the second ---


def _register(room: ModuleType) -> None:
    """Give the kinds of values of a room what notebooks ask for."""
    for (module, kind), methods in _SHOWN.items():
        if module == room.__name__:
            for name, method in methods.items():
                setattr(getattr(room, kind), name, method)


def _case_figure(case: Case) -> str:
    """The figure of a case as far as it is known."""
    from icsolve.draw import draw

    return draw(case)


def _as_posed(answer: Answer) -> Case:
    """The case of an answer as it was asked: inertia forces among its loads were found, not given."""
    from icsolve.statics.load_wrenches import as_posed

    return as_posed(answer.case)


def _answer_figure(answer: Answer) -> str:
    """The figure of an answer."""
    return _case_figure(_as_posed(answer))


def _worked_solution(answer: Answer) -> str:
    """The worked solution with LaTeX formulas."""
    from icsolve.explain import explain

    return explain(_as_posed(answer), "md")


def _sweep_curve(found: Sweep) -> str | None:
    """The answers over the range; None where there is not one range to draw them over."""
    from icsolve.draw.plot import sweep_svg

    return sweep_svg(found) if len(found.vary) == 1 and len(found) else None


def _sweep_table(found: Sweep) -> str | None:
    """A table of the answers' ranges; None where there is a picture."""
    from icsolve.draw.plot import sweep_markdown

    return sweep_markdown(found) if len(found.vary) != 1 or not len(found) else None


_SHOWN: dict[tuple[str, str], dict[str, Any]] = {
    ("icsolve.case", "Case"): {"_repr_svg_": _case_figure},
    ("icsolve.answer", "Answer"): {"_repr_svg_": _answer_figure, "_repr_markdown_": _worked_solution},
    ("icsolve.sweep", "Sweep"): {"_repr_svg_": _sweep_curve, "_repr_markdown_": _sweep_table},
}
