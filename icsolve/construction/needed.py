"""The centres that the answer needs: those of the loaded links, and those that give the ratios of speeds."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations

from icsolve.case import Case, Pair
from icsolve.construction.known import Known
from icsolve.construction.order import Step, steps_of
from icsolve.construction.ratios import Ratios, ratios_of
from icsolve.statics.power import is_unknown, reacting


def loaded_links(case: Case) -> list[str]:
    """Links that carry loads, that of the unknown first; the frame is none of them."""
    loads = sorted(case.loads, key=lambda load: not is_unknown(load))
    found = [link for load in loads for link in (load.link, reacting(case, load))]
    return [link for link in dict.fromkeys(found) if link != case.ground]


def answer_ratios(known: Known) -> Ratios | None:
    """The ratios of speeds that the answer needs; None where there are none, or not by centres."""
    links = loaded_links(known.case)
    if not links or not set(links) <= set(known.twists):
        return None
    return ratios_of(known, links)


def needed_pairs(known: Known) -> list[Pair]:
    """The centres that the answer needs, without those on the way to them."""
    case = known.case
    ratios = answer_ratios(known)
    if ratios is None:
        shown = known.answer or known.whole
        return [] if shown is None else list(shown.centres)
    own = [known.pair(link, case.ground) for link in loaded_links(case) if not known.rests(link)]
    return list(dict.fromkeys((*own, *ratios.pairs)))


def needed_steps(known: Known) -> tuple[Step, ...]:
    """The steps to the centres that the answer needs."""
    return steps_of(known, needed_pairs(known))


def all_steps(known: Known) -> tuple[Step, ...]:
    """The steps to every centre, those that the answer needs first."""
    return steps_of(known, _all_pairs(known))


def _all_pairs(known: Known) -> Iterable[Pair]:
    pairs = (known.pair(a, b) for a, b in combinations(known.case.links, 2))
    return dict.fromkeys((*needed_pairs(known), *pairs))
