"""The worked solution of a case, as a textbook has it: given and asked, the centres, the ratios of speeds,
the equation of power, the answer, its check by free bodies. As text, Markdown, HTML or LaTeX."""

from __future__ import annotations

from icsolve.case import Case
from icsolve.draw.figure import Drawing, draw, drawn
from icsolve.explain.document import AsHtml, AsMarkdown, AsTex, AsText
from icsolve.explain.solution import solution
from icsolve.report.derivation.known import Known, known_of


def explain(
    case: Case, form: str = "text", digits: int = 6, *, bodies: bool = False, known: Known | None = None
) -> str:
    """The worked solution of a case; one without an answer is explained as far as it goes, with the reason.

    Parameters
    ----------
    form : ``text``, ``md``, ``html`` or ``tex``
    digits : significant digits of the numbers shown
    bodies : the three equations of every link, and the reactions, too
    known : what is known of the case, where that was found before (with reactions, for the check)
    """
    known = known or known_of(case, reactions=True)
    document = solution(known, digits, bodies=bodies)
    if form == "text":
        return AsText().whole(document)
    if form == "md":
        return AsMarkdown().whole(document)
    drawing = Drawing(bodies=bodies, captions=False)
    if form == "tex":
        return AsTex(drawn(known, drawing)).whole(document)
    return AsHtml(draw(case, drawing, known)).whole(document)


__all__ = ["explain"]
