"""Errors carried forward: a final answer that follows by the right method from a wrong intermediate one.

An unknown is a sum of shares, one a load, each a product of velocity ratios and distances; a wrong
ratio or distance scales the shares in which it stands, as a factor or as a divisor. Of several unknowns one
may follow from other wrong ones by a sum of power that has them all.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import combinations
from operator import mul

from icsolve.answer import Answer
from icsolve.case.expected import CentreIs, DistanceIs, RateIs, RatioIs, SpeedIs, Target
from icsolve.grade.case_store import CaseStore
from icsolve.grade.judge import WRONG, codes, feedback, share_of
from icsolve.grade.keys import NumberKey, PlaceKey
from icsolve.grade.mistakes.engine import WrongAnswers, centres_of, quotient
from icsolve.grade.mistakes.lookup import Wrong
from icsolve.grade.results import Marked
from icsolve.grade.solved import SolvedCase, final_questions
from icsolve.grade.tables.columns import StoredAnswer
from icsolve.grade.tolerance import NoKeyError
from icsolve.grade.written.two_numbers import WrittenPlace
from icsolve.scene.parts import scene_of
from icsolve.screws import Triple
from icsolve.tuples import NamedTuple

_NOTHING = 1e-9
"""Less than this is rounding."""
Scales = Mapping[str, float]
"""By what each load's share is multiplied."""


class Intermediate(NamedTuple):
    """A wrong intermediate answer: what was asked, the right value, the student's (places: two)."""

    what: str
    target: Target
    right: tuple[float, ...]
    given: tuple[float, ...]


def carried(wrongs: WrongAnswers, unknown: str, wrong: list[Intermediate]) -> list[Wrong]:
    """The values of the unknown that follow from the wrong intermediate answers, alone and together."""
    answer = wrongs.answer
    parts = wrongs.shares(unknown) if unknown in answer.answers else {}
    own = next((load for load in answer.case.loads if load.name == unknown), None)
    if not parts or own is None:
        return []
    links = dict.fromkeys(parts, "") | {
        load.name: load.link for load in answer.case.loads if load.name in parts
    }
    ways = [(i, list(_scales(answer, i, own.link, links))) for i in wrong]
    found = [Wrong("carried", _total(parts, scales), i.what) for i, choices in ways for scales in choices]
    together = [choices[0] for _, choices in ways if choices]
    if len(together) > 1:
        product = {name: math.prod(scales[name] for scales in together) for name in parts}
        found.append(Wrong("carried", _total(parts, product), ", ".join(i.what for i in wrong)))
    return [w for w in found if math.isfinite(w.value)]


def coupled(answer: Answer, off: Mapping[str, float], last: str) -> Iterator[float]:
    """How far an unknown is off that follows from others which are ``off``, in each sum of power that a
    student may write: for the motion that the case gives, and for those in which, of a mechanism of two or
    three freedoms, links move as one (one of them the frame, or a part that goes round as a whole)."""
    freedoms, scene = answer.mobility, scene_of(answer)
    if scene is None or answer.friction is not None or freedoms not in (2, 3):
        return
    outcome = scene.outcome

    def powers(unknown: str) -> list[float]:
        """The power of a unit of an unknown in each of the motions."""
        own = [(n, w) for n, w in enumerate(outcome.balance.wrenches) if w.root == unknown]
        return [float(sum(row[n] * w.measure * w.ratio for n, w in own)) for row in outcome.balance.factors]

    names = (*off, last)
    units = {name: powers(name) for name in names}
    sums = [
        {name: sum(map(mul, units[name], motion)) for name in names}
        for motion in _locked(outcome.motions.twists, freedoms)
    ]
    if answer.case.motion:
        factors = {term.load: term.factor for term in answer.terms}
        sums.append({name: factors[name] for name in names})
    most = max(abs(power) for row in units.values() for power in row)
    for power in sums:
        if abs(power[last]) > _NOTHING * most and any(abs(power[name]) > _NOTHING * most for name in off):
            yield -sum(power[name] * by for name, by in off.items()) / power[last]


def _locked(twists: Mapping[str, Sequence[Triple]], freedoms: int) -> Iterator[tuple[float, ...]]:
    """The motions, as parts of those of the freedoms, in which two links (or two pairs) are as one: one does
    not turn on the other, nor move on it where it can't turn."""
    rates = []
    for one, other in combinations(twists.values(), 2):
        for k in (2, 0, 1):
            rate = tuple(float(one[m][k] - other[m][k]) for m in range(freedoms))
            if max(map(abs, rate)) > _NOTHING:
                rates.append(rate)
                break
    if freedoms == 2:
        yield from ((q, -p) for p, q in rates)
        return
    for (a, b, c), (d, e, f) in combinations(rates, 2):
        across = (b * f - c * e, c * d - a * f, a * e - b * d)
        if max(map(abs, across)) > _NOTHING:
            yield across


def _total(parts: Mapping[str, float], scales: Scales) -> float:
    return sum(part * scales[name] for name, part in parts.items())


def _scales(answer: Answer, i: Intermediate, own: str, links: Mapping[str, str]) -> Iterator[Scales]:
    """How the shares change, the likeliest way first, by the link of the unknown and the links of the shares
    ('' of one that is no load's, as of friction)."""
    if isinstance(i.target, CentreIs):
        yield from _by_place(answer, i, own, links)
        return
    if not i.right[0] or not i.given[0]:
        return
    rho = i.given[0] / i.right[0]
    over, under = _links(answer, i.target)
    some = {name: rho if link in over else 1.0 for name, link in links.items()}
    if own in over or any(link in under for link in links.values() if link not in over):
        yield dict.fromkeys(links, 1.0 / rho)
        yield dict.fromkeys(links, rho)
    else:
        if any(scale != 1.0 for scale in some.values()):
            yield some
        yield dict.fromkeys(links, rho)
        if not any(link in over for link in links.values()):
            yield dict.fromkeys(links, 1.0 / rho)


def _links(answer: Answer, target: Target) -> tuple[set[str], set[str]]:
    """Links whose rates a quantity multiplies, and those whose rates it divides."""
    match target:
        case RatioIs(over, under):
            return {over}, {under}
        case RateIs(link) | SpeedIs(_, link):
            return {link}, set()
        case DistanceIs(a, b):
            return _of_distance(answer, a, b)
    return set(), set()


def _of_distance(
    answer: Answer, a: tuple[str, str] | str, b: tuple[str, str] | str
) -> tuple[set[str], set[str]]:
    """A distance from a link's centre with the frame: it divides that link's rate, if it ends at another
    centre; it multiplies the power of a force, if it ends at a point."""
    ground = answer.case.ground
    ends = [end for end in (a, b) if not isinstance(end, str) and ground in end]
    link = next((name for end in ends for name in end if name != ground), "")
    to_point = isinstance(a, str) or isinstance(b, str)
    return ({link}, set()) if to_point else (set(), {link})


def _by_place(answer: Answer, i: Intermediate, own: str, links: Mapping[str, str]) -> Iterator[Scales]:
    """A common centre in the wrong place gives the two links' ratio of rates by its distances from theirs;
    of a link that only slides, the distance from the other's is the ratio."""
    assert isinstance(i.target, CentreIs)
    ground = answer.case.ground
    first, second = i.target.pair
    mine, its = centres_of(answer, first).get(ground), centres_of(answer, second).get(ground)
    if (mine is None and its is None) or ground in i.target.pair:
        return
    right, wrong = (quotient((at[0], at[1]), mine, its) for at in (i.right, i.given))
    if not right or not wrong:
        return
    rho = wrong / right
    forward = {name: rho if link == second else 1.0 for name, link in links.items()}
    if own == second:
        yield dict.fromkeys(links, 1.0 / rho)
    elif any(scale != 1.0 for scale in forward.values()):
        yield forward
    yield dict.fromkeys(links, rho)


Found = tuple[StoredAnswer, Marked]


def carried_forward(store: CaseStore, found: list[Found]) -> list[Found]:
    """One student's answers, those that follow from a wrong intermediate one with that cause."""
    marked = {entry.item: (entry, m) for entry, m in found}
    wrong = [item for item, (_, m) in marked.items() if ":" in item and m.judged.verdict == WRONG]
    whose = {item: entry.student for item, (entry, _) in marked.items()}  # those of other numbers are apart
    for case, owner in dict.fromkeys((item.partition(":")[0], whose[item]) for item in wrong):
        try:
            finals = final_questions(store.read(case), case)
        except NoKeyError:
            continue
        own = {item: marked[item] for item in finals if whose.get(item) == owner}
        given = [item for item, (_, m) in own.items() if m.judged.value is not None]
        last = [item for item in given if marked[item][1].judged.verdict == WRONG]
        if not last:
            continue
        solved = store.solved(case, owner)
        steps = [
            marked[item]
            for item in wrong
            if item.startswith(f"{case}:") and item not in finals and whose[item] == owner
        ]
        for item in last:
            marked[item] = _again(solved, marked[item], _from_steps(solved, finals[item], steps))
        last.sort(key=lambda item: not marked[item][1].judged.mistakes)
        for n, item in enumerate(last[1:], 1):
            before = {finals[other]: marked[other] for other in last[:n]}
            marked[item] = _again(solved, marked[item], _from_others(solved, item, finals, before))
    return list(marked.values())


def _again(solved: SolvedCase, final: Found, causes: Iterable[Wrong]) -> Found:
    """The final answer with the first of these causes that it follows from."""
    entry, before = final
    key, value = solved.key(entry.item), before.judged.value
    if not isinstance(key, NumberKey) or value is None:
        return final
    for cause in causes:
        close = abs(value - cause.value) <= key.wrongs.width(cause.code) * abs(cause.value)
        if close and abs(cause.value - key.value) > key.half:
            others = (m for m in before.judged.mistakes if m.code != "near-miss")
            mistakes = (cause, *others)[:3]
            share = max(share_of(key, before.judged.parts, mistakes), before.judged.share)
            judged = before.judged._replace(mistakes=mistakes, code=codes(mistakes), share=share)
            told = feedback(key, judged, solved.course.reveal)
            return entry, Marked(before.item, before.raw, judged, before.points, told, before.read)
    return final


def _from_steps(solved: SolvedCase, unknown: str, wrong: list[Found]) -> Iterator[Wrong]:
    """What a final answer is by the right method from wrong steps."""
    if wrong:
        for cause in carried(solved.wrongs, unknown, list(_steps(solved, wrong))):
            yield cause._replace(value=cause.value * solved.scale)


def _from_others(
    solved: SolvedCase, item: str, finals: Mapping[str, str], before: Mapping[str, Found]
) -> Iterator[Wrong]:
    """What an unknown is by a sum of power with the student's wrong ones in it."""
    off = {}
    for unknown, (entry, marked) in before.items():
        key = solved.key(entry.item)
        if isinstance(key, NumberKey) and marked.judged.value is not None:
            off[unknown] = marked.judged.value - key.value
    key = solved.key(item)
    if off and isinstance(key, NumberKey):
        for by in coupled(solved.answer, off, finals[item]):
            yield Wrong("carried", key.value + by, ", ".join(off))


def _steps(solved: SolvedCase, wrong: list[Found]) -> Iterator[Intermediate]:
    """The wrong intermediate answers that have a value."""
    for entry, marked in wrong:
        try:
            key = solved.key(entry.item)
        except NoKeyError:
            continue
        what, target, read = entry.item.partition(":")[2], solved.target(entry.item), marked.read
        if isinstance(key, NumberKey) and marked.judged.value is not None:
            yield Intermediate(what, target, (key.value,), (marked.judged.value,))
        elif isinstance(key, PlaceKey) and isinstance(read, WrittenPlace):
            factor = key.factor(read.unit) or 1.0
            yield Intermediate(what, target, key.place, (read.x * factor, read.y * factor))
