"""The worked solution of a case, in the textbook's order."""

from __future__ import annotations

from collections.abc import Iterable

from icsolve.construction import Known, Step, acting_loads, all_steps, answer_ratios, needed_steps
from icsolve.errors import SceneError
from icsolve.explain.document import Document, Section, words
from icsolve.explain.finding import centre_sections
from icsolve.explain.given import asked_section, given_section
from icsolve.explain.motions import motions_section
from icsolve.explain.numbers import Figures, figures_of
from icsolve.explain.outcome import answer_section, check_section, left_out, remarks_section, sentence
from icsolve.explain.power import power_section
from icsolve.explain.speeds import ratio_section
from icsolve.statics.power import is_unknown

AT_REST = (
    "Nothing moves and no motion is given, so friction may act either way within its limits: the unknown "
    "load holds over a range. Its ends are where the mechanism is about to move, by the equilibrium of all "
    "links with full friction."
)


def solution(known: Known, digits: int = 6, *, bodies: bool = False) -> Document:
    """The worked solution; ``bodies`` adds the equations of every link."""
    figures = figures_of(known, digits)
    case = known.case
    lead = [f"Source: {case.source}"] if case.source else []
    lead += [f"Reconstructed: {case.reconstructed}"] if case.reconstructed else []
    return Document(known.title, tuple(lead), tuple(_sections(known, figures, bodies)))


def _sections(known: Known, figures: Figures, bodies: bool) -> Iterable[Section]:
    if known.case.space is not None:
        yield from _in_space(known, figures)
        return
    yield given_section(known, figures)
    yield asked_section(known, figures)
    steps = _steps(known)
    yield from centre_sections(known, figures, steps)
    if known.refusal is not None:
        yield _refused(known.refusal)
        return
    yield from _by_power(known, figures)
    yield from answer_section(known, figures)
    yield from left_out(known, steps, bodies=bodies)
    yield from check_section(known, figures)
    if bodies:
        from icsolve.explain.equilibrium import bodies_sections

        yield from bodies_sections(known, figures)
    yield from remarks_section(known, figures)


def _refused(refusal: SceneError) -> Section:
    said = f"{sentence(refusal.message)} (Status: {refusal.status}.)"
    return Section("No answer", (words(said),))


def _in_space(known: Known, figures: Figures) -> Iterable[Section]:
    """A case in space: statics, with the reactions always."""
    from icsolve.explain.space import asked_in_space, given_in_space, sections_in_space

    yield given_in_space(known, figures)
    yield asked_in_space(known, figures)
    if known.refusal is not None:
        yield _refused(known.refusal)
        return
    yield from sections_in_space(known, figures)
    yield from answer_section(known, figures)
    yield from left_out(known, (), bodies=True)
    yield from check_section(known, figures)
    yield from remarks_section(known, figures)


def _steps(known: Known) -> tuple[Step, ...]:
    """The centres that the answer needs; all where nothing else is asked."""
    asked = any(is_unknown(load) for load in known.case.loads)
    return needed_steps(known) if asked else all_steps(known)


def _by_power(known: Known, figures: Figures) -> Iterable[Section]:
    """Ratios of speeds and the equation of power; by motions where the centres do not give them."""
    loads = acting_loads(known)
    if not any(load.unknown for load in loads):
        return
    if any(load.holds is not None for load in loads):
        yield Section("Power", (words(AT_REST),))
        return
    ratios = answer_ratios(known)
    several = known.answer is not None and (known.answer.mobility or 0) > 1
    section = None if ratios is None or several else power_section(known, figures, ratios, loads)
    if ratios is None or section is None:
        section = motions_section(known, figures, loads)
        yield from () if section is None else (section,)
        return
    speeds = ratio_section(known, figures, ratios)
    yield from () if speeds is None else (speeds,)
    yield section
