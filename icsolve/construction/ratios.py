"""How fast one link moves beside another, by the distances between three centres that lie on one line.

For a link r that turns about its centre with the frame, a link j, and their common centre I_rj, whose
velocity is the same on both: ``w_j |I_rj I_gj| = w_r |I_rj I_gr|``. Where a link slides, its velocity is that
of the common centre. Where the three centres coincide (two gears on one axle) another link stands between.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from icsolve.answer import Centre
from icsolve.case import Pair
from icsolve.construction.known import Known

APART = 1e-6
"""Two centres nearer than this, of the figure's size, give no ratio."""


class Ratio(NamedTuple):
    """The motion of ``link`` from that of ``of``.

    ``kind``: ``turns`` (both turn: ``value`` is w / w), ``alike`` (their centre is at infinity: one rate),
    ``slides`` (speed of the link's translation over the other's rate), ``drives`` (rate over the speed of
    a translation), ``glides`` (two translations: speed over speed), ``one`` (welded: they move as one).
    A speed is positive as the link moves when the reference does at +1. ``pairs`` are the centres that
    it reads: of the other with the frame, of the link with the frame, and of the two.
    """

    link: str
    of: str
    kind: str
    pairs: tuple[Pair, Pair, Pair]
    value: float


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
    turning = [link for link in (*moving, *known.case.links) if known.turns(link)]
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
            headings[link] = math.degrees(math.atan2(-sign * x, sign * y)) % 360.0
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
        for other in known.case.links:
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
    made = sum(1 for pair in ratio.pairs if (c := known.centre(*pair)) is not None and c.lines)
    small = min(abs(ratio.value), 1.0 / abs(ratio.value)) if ratio.kind == "turns" else 1.0
    return 1.0 + 0.25 * made - 0.05 * math.log10(max(small, 1e-12))


def ratio_between(known: Known, of: str, link: str, sign: float = 1.0) -> Ratio | None:
    """The motion of ``link`` from that of ``of``, where their three centres are apart.

    ``sign`` is that of the reference's rate in the motion that is meant.
    """
    ground = known.case.ground
    if link in (of, ground) or not {of, link} <= set(known.twists) or known.rests(of) or known.rests(link):
        return None
    pairs = (known.pair(of, ground), known.pair(link, ground), known.pair(of, link))
    if known.twists[of] == known.twists[link]:
        return Ratio(link, of, "one", pairs, 1.0)
    centres = [known.centre(*pair) for pair in pairs]
    if any(centre is None or centre.kind not in ("at", "toward") for centre in centres):
        return None
    first, second, common = (centre for centre in centres if centre is not None)
    found = _kind_and_value(known, of, link, (first, second, common), sign)
    return None if found is None else Ratio(link, of, found[0], pairs, found[1])


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
