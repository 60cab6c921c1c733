"""What cases, answers and sweeps show in a notebook, which asks for `_repr_svg_` and `_repr_markdown_`.

A notebook prefers Markdown to SVG where a value has both: an answer shows its worked solution, a case its
figure, a sweep its curve. The values know nothing of it: they are given these methods from here.
"""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from icsolve.answer import Answer
    from icsolve.case import Case
    from icsolve.sweep import Sweep


def register(room: ModuleType) -> None:
    """Give the kinds of values of a room what notebooks ask for."""
    for (module, kind), methods in _SHOWN.items():
        if module == room.__name__:
            for name, method in methods.items():
                setattr(getattr(room, kind), name, method)


def case_figure(case: Case) -> str:
    """The figure of a case as far as it is known."""
    from icsolve.draw import draw

    return draw(case)


def answer_figure(answer: Answer) -> str:
    """The figure of an answer."""
    return case_figure(answer.case)


def worked_solution(answer: Answer) -> str:
    """The worked solution with LaTeX formulas."""
    from icsolve.explain import explain

    return explain(answer.case, "md")


def sweep_curve(found: Sweep) -> str | None:
    """The answers over the range; None where there is not one range to draw them over."""
    from icsolve.draw.plot import sweep_svg

    return sweep_svg(found) if len(found.vary) == 1 and len(found) else None


def sweep_table(found: Sweep) -> str | None:
    """A table of the answers' ranges; None where there is a picture."""
    from icsolve.draw.plot import sweep_markdown

    return sweep_markdown(found) if len(found.vary) != 1 or not len(found) else None


_SHOWN: dict[tuple[str, str], dict[str, Any]] = {
    ("icsolve.case", "Case"): {"_repr_svg_": case_figure},
    ("icsolve.answer", "Answer"): {"_repr_svg_": answer_figure, "_repr_markdown_": worked_solution},
    ("icsolve.sweep", "Sweep"): {"_repr_svg_": sweep_curve, "_repr_markdown_": sweep_table},
}
