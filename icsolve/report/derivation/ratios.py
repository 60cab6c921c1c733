"""The order in which a student finds centres, and how fast one link moves beside another.

Centres by inspection come first, then each by the lines of earlier ones. Three centres lie on one line: for a
link r that turns about its centre with the frame, a link j, and their common centre I_rj, whose velocity is
the same on both, ``w_j |I_rj I_gj| = w_r |I_rj I_gr|``. Where a link slides, its velocity is that of the
common centre. Where the three centres coincide (two gears on one axle) another link stands between.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterable, Mapping, Sequence
from itertools import combinations

import numpy as np
import numpy.typing as npt

from icsolve.answer import Centre
from icsolve.case import Case, Pair, Rope, Screw, is_link, link_order
from icsolve.report.derivation.known import Known, moving_names
from icsolve.scene.parts import wanted_pairs
from icsolve.scene.program import Want
from icsolve.screws import Triple
from icsolve.statics.load_wrenches import reacting
from icsolve.statics.power import is_unknown
from icsolve.tuples import NamedTuple
from icsolve.wording import degrees_of, link_words


class Step(NamedTuple):
    """One centre as it is found; ``number`` is 0 for those by inspection, else 1, 2, ... in order."""

    number: int
    centre: Centre


def steps_of(known: Known, wanted: Iterable[Pair]) -> tuple[Step, ...]:
    """The steps to the wanted centres, and to those that their lines go through, and no others."""
    needed: dict[Pair, Centre] = {}
    for pair in wanted:
        _need(known, pair, needed)
    first = [c for c in needed.values() if not c.lines and c.by != "loop equations"]
    later = [c for c in needed.values() if c.lines or c.by == "loop equations"]
    numbered = (Step(number, centre) for number, centre in enumerate(later, 1))
    first.sort(key=lambda centre: [link_order(known.case, link) for link in centre.pair])
    return (*(Step(0, centre) for centre in first), *numbered)


def _need(known: Known, wanted: Pair, needed: dict[Pair, Centre]) -> None:
    """Put a centre after all those that its lines go through (a loop, so that long chains are fine)."""
    stack = [wanted]
    opened: set[Pair] = set()
    while stack:
        pair = stack[-1]
        centre = known.centre(*pair)
        if pair in needed or centre is None or centre.kind not in ("at", "toward"):
            stack.pop()
            continue
        before = [end for line in centre.lines if len(line) == 2 for end in line if end not in needed]
        before = [end for end in before if end not in opened and _is_placed(known.centre(*end))]
        if before:
            opened.add(pair)
            stack.extend(reversed(before))
            continue
        needed[pair] = centre
        stack.pop()


def _is_placed(centre: Centre | None) -> bool:
    return centre is not None and centre.kind in ("at", "toward")


# --- ratios of speeds ------------------------------------------------------------------------------------


APART = 1e-6
"""Two centres nearer than this, of the figure's size, give no ratio."""


class Ratio(NamedTuple):
    """The motion of ``link`` from that of ``of``.

    ``kind``: ``turns`` (both turn: ``value`` is w / w), ``alike`` (their centre is at infinity: one rate),
    ``slides`` (speed of the link's translation over the other's rate), ``drives`` (rate over the speed of
    a translation), ``glides`` (two translations: speed over speed), ``one`` (welded: they move as one),
    ``rope`` (by the length of ``rope``), ``screw`` (by the lead of ``screw``).
    A speed is positive as the link moves when the reference does at +1. ``pairs`` are the centres that
    it reads: of the other with the frame, of the link with the frame, and (not by rope or screw) of the two.
    """

    link: str
    of: str
    kind: str
    pairs: tuple[Pair, ...]
    value: float
    rope: Rope | None = None
    screw: Screw | None = None


class Ratios(NamedTuple):
    """``reference`` is the link from which all the others follow, in order.

    ``rates`` has for each link its rate, or its speed along ``headings`` (degrees) where it slides, when
    the reference has 1.
    """

    reference: str
    ratios: tuple[Ratio, ...]
    rates: dict[str, float]
    headings: dict[str, float]

    @property
    def pairs(self) -> list[Pair]:
        """The centres that they read."""
        return list(dict.fromkeys(pair for ratio in self.ratios for pair in ratio.pairs))


def ratios_of(known: Known, links: Sequence[str]) -> Ratios | None:
    """The motion of all ``links`` from that of one; None where a link's centres do not give it.

    ``links`` in order of preference for the reference. One that turns is preferred, also another than
    these.
    """
    moving = [link for link in links if not known.rests(link)]
    if not moving:
        return None
    turning = [link for link in (*moving, *moving_names(known.case)) if known.turns(link)]
    best: tuple[float, Ratios] | None = None
    for reference in dict.fromkeys((*turning, *moving)):
        found = _reach(known, reference, moving)
        preferred = (0.0 if known.turns(reference) else 2.0) if reference in moving else 1.5
        if found is not None and (best is None or found[0] + preferred < best[0]):
            best = (found[0] + preferred, _gathered(known, reference, found[1]))
    return None if best is None else best[1]


def _gathered(known: Known, reference: str, ratios: tuple[Ratio, ...]) -> Ratios:
    sign = _sign(known, reference)
    rates, headings = {reference: 1.0}, {}
    for ratio in ratios:
        rates[ratio.link] = rates[ratio.of] * ratio.value
    for link in rates:
        if not known.turns(link):
            x, y, _ = known.twists[link]
            headings[link] = degrees_of((sign * y, -sign * x))
    return Ratios(reference, ratios, rates, headings)


def _sign(known: Known, reference: str) -> float:
    """1 or -1: the sense in which the reference turns in the motion that is meant."""
    return math.copysign(1.0, known.twists[reference][2]) if known.turns(reference) else 1.0


def _reach(known: Known, start: str, targets: Sequence[str]) -> tuple[float, tuple[Ratio, ...]] | None:
    """The cheapest ratios from one link to all targets (Dijkstra over the links), and their cost."""
    costs: dict[str, float] = {}
    by: dict[str, Ratio] = {}
    heap: list[tuple[float, int, str, Ratio | None]] = [(0.0, 0, start, None)]
    missing = set(targets)
    sign = _sign(known, start)
    while heap and missing:
        cost, _, link, ratio = heapq.heappop(heap)
        if link in costs:
            continue
        costs[link] = cost
        missing.discard(link)
        if ratio is not None:
            by[link] = ratio
        for other in moving_names(known.case):
            step = None if other in costs else ratio_between(known, link, other, sign)
            if step is not None:
                heapq.heappush(heap, (cost + _cost(known, step), len(heap) + len(costs), other, step))
    if missing:
        return None
    return sum(costs[target] for target in targets), _chained(start, targets, by)


def _chained(start: str, targets: Iterable[str], by: dict[str, Ratio]) -> tuple[Ratio, ...]:
    """The ratios on the way to the targets, each after the one that it follows from."""
    chosen: dict[str, Ratio] = {}
    for target in targets:
        way = []
        link = target
        while link != start:
            way.append(by[link])
            link = by[link].of
        for ratio in reversed(way):
            chosen.setdefault(ratio.link, ratio)
    return tuple(chosen.values())


def _cost(known: Known, ratio: Ratio) -> float:
    """One for each ratio, more for centres that must be constructed and for short distances."""
    centres = [centre for pair in ratio.pairs if (centre := known.centre(*pair)) is not None]
    made = sum(40.0 if centre.by == "loop equations" else bool(centre.lines) for centre in centres)
    small = min(abs(ratio.value), 1.0 / abs(ratio.value)) if ratio.kind == "turns" else 1.0
    return 1.0 + 0.25 * made - 0.05 * math.log10(max(small, 1e-12))


def ratio_between(known: Known, of: str, link: str, sign: float) -> Ratio | None:
    """The motion of ``link`` from that of ``of``, where their three centres are apart.

    ``sign`` is that of the reference's rate in the motion that is meant.
    """
    ground = known.case.ground
    if link in (of, ground) or not {of, link} <= set(known.twists) or known.rests(of) or known.rests(link):
        return None
    pairs = (known.pair(of, ground), known.pair(link, ground), known.pair(of, link))
    if known.twists[of] == known.twists[link]:
        return Ratio(link, of, "one", pairs, 1.0)
    tied = _tied(known, of, link, sign)
    centres = [known.centre(*pair) for pair in pairs]
    if tied is not None and (centres[2] is None or centres[2].by == "loop equations"):
        return tied
    if any(centre is None or centre.kind not in ("at", "toward") for centre in centres):
        return None
    first, second, common = (centre for centre in centres if centre is not None)
    found = _kind_and_value(known, of, link, (first, second, common), sign)
    return None if found is None else Ratio(link, of, found[0], pairs, found[1])


def _tied(known: Known, of: str, link: str, sign: float) -> Ratio | None:
    """A ratio by a rope that ties these two alone, or by the screw that moves one along the frame."""
    case = known.case
    value = _speed(known, link, sign) / _speed(known, of, sign)
    own = tuple(known.pair(one, case.ground) for one in (of, link) if known.turns(one) and is_link(one))
    if any((centre := known.centre(*pair)) is None or centre.kind != "at" for pair in own):
        return None
    for screw in case.screws:
        moved = {one for one in screw.links if not known.rests(one)}
        if len(moved) == 1 and {of, link} == {*moved, screw.rotor} and not known.turns(*moved):
            return Ratio(link, of, "screw", own, value, screw=screw)
    for rope in case.ropes:
        ends = {*rope.links, *((rope.end,) if rope.is_free else ())}
        if {one for one in ends if not known.rests(one)} == {of, link}:
            return Ratio(link, of, "rope", own, value, rope=rope)
    return None


def _kind_and_value(
    known: Known, of: str, link: str, centres: tuple[Centre, Centre, Centre], sign: float
) -> tuple[str, float] | None:
    first, second, common = centres
    least = APART * known.size
    speeds = [_speed(known, name, sign) for name in (of, link)]
    value = speeds[1] / speeds[0]
    if not known.turns(of) and not known.turns(link):
        return ("glides", value) if common.kind == "toward" and not _all_parallel(centres) else None
    if common.kind == "toward":
        return ("alike", 1.0) if known.turns(of) and known.turns(link) else None
    arms = [c for c in (first, second) if c.kind == "at"]
    if any(math.dist(c.place, common.place) <= least for c in arms):
        return None
    if known.turns(of):
        return ("turns" if known.turns(link) else "slides"), value
    return "drives", value


def _all_parallel(centres: tuple[Centre, Centre, Centre]) -> bool:
    """Whether three centres at infinity lie in one direction: two links that slide along one line."""
    first, _, common = (centre.place[0] for centre in centres)
    return abs(math.sin(math.radians(first - common))) < APART


def _speed(known: Known, link: str, sign: float) -> float:
    """Rate of a link that turns, speed of one that slides."""
    x, y, w = known.twists[link]
    return sign * w if w != 0.0 else math.hypot(x, y)


# --- what the answer needs -------------------------------------------------------------------------------


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
        return (
            [] if known.whole is None else [p for p in wanted_pairs(case, Want()) if p in known.whole.centres]
        )
    own = [known.pair(link, case.ground) for link in loaded_links(case) if not known.rests(link)]
    return list(dict.fromkeys((*own, *ratios.pairs)))


def needed_steps(known: Known) -> tuple[Step, ...]:
    """The steps to the centres that the answer needs."""
    return steps_of(known, needed_pairs(known))


def all_steps(known: Known) -> tuple[Step, ...]:
    """The steps to every centre, those that the answer needs first."""
    pairs = (known.pair(a, b) for a, b in combinations(known.case.links, 2))
    return steps_of(known, dict.fromkeys((*needed_pairs(known), *pairs)))


# --- the motions of several freedoms ---------------------------------------------------------------------


LEAST = 1e-9
"""A rate below this, of the largest of its motion, can't be the one that a motion is told by."""


class OneMotion(NamedTuple):
    """A motion: the twist of every link in case units. ``driver`` has 1 in it and 0 in the others."""

    driver: str
    turns: bool
    twists: Mapping[str, Triple]


def independent_motions(known: Known) -> tuple[OneMotion, ...]:
    """As many motions as there are freedoms; each is told by a link that none of the others moves."""
    scene = known.scene
    if scene is None:
        return ()
    motions = scene.outcome.motions.twists
    links = list(dict.fromkeys((*loaded_links(known.case), *known.case.links)))
    count = len(next(iter(motions.values()), ()))
    rows = np.array([[motions[link][m] for link in links] for m in range(count)], dtype=np.float64)
    drivers: list[tuple[int, int]] = []
    for n in range(count):
        driver = _driver(rows[n])
        if driver is None:
            return ()
        drivers.append(driver)
        own = rows[n] * (1.0 / rows[n][driver])
        part = rows[(slice(None), *driver)][:, None, None] * own
        sizes = np.abs(rows) + np.abs(part)
        rows = rows - part
        rows[np.abs(rows) <= 1e-13 * sizes] = 0.0  # what rounding leaves of a difference
        rows[n] = own
    frame, found = scene.figure.frame, []
    for (k, place), row in zip(drivers, rows.tolist(), strict=True):
        scale = 1.0 if place == 2 else 1.0 / frame.scale
        twists = {
            link: frame.twist_shown((x, y, w), scale) for link, (x, y, w) in zip(links, row, strict=True)
        }
        found.append(OneMotion(links[k], place == 2, twists))
    return tuple(found)


def _driver(row: npt.NDArray[np.float64]) -> tuple[int, int] | None:
    """The first link that clearly turns in a motion, else one that clearly moves, and by which number of its
    twist."""
    for places in ([2], [0, 1]):
        sizes = np.abs(row[:, places])
        if sizes.max() > LEAST * np.abs(row).max():
            k, place = np.argwhere(sizes > 0.1 * sizes.max())[0]
            return int(k), places[place]
    return None


def speed_words(motion: OneMotion) -> str:
    """The driver's motion in words."""
    x, y, w = motion.twists[motion.driver]
    if motion.turns and not is_link(motion.driver):
        return f"{link_words(motion.driver)} turns at 1 rad/s clockwise as one looks along its axis"
    if motion.turns:
        return f"link {motion.driver} turns at 1 rad/s counterclockwise"
    speed = math.hypot(x, y) if w == 0.0 else 1.0
    return f"{link_words(motion.driver)} moves at {speed:.6g} length units a second"
