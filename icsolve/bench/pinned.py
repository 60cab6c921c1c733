"""Random pinned linkages: graphs, chains, near toggles and parallels, from coordinates and from lengths."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from decimal import Decimal
from itertools import combinations
from random import Random

from icsolve.bench.sheet import Sheet, Spot, torques

Draw = Callable[[Random], str]
"""One scene of a family."""


def linkage(edges: str, places: Iterable[Spot] | None = None) -> Draw:
    """Links pinned in the pattern of a graph, numbered from 0 there and from 1 in the case."""

    def draw(rng: Random) -> str:
        sheet = Sheet(rng)
        given = iter(places) if places is not None else None
        pairs = [(int(edge[0], 36) + 1, int(edge[1], 36) + 1) for edge in edges.split()]
        for i, j in pairs:
            sheet.pin(i, j, next(given) if given is not None else None)
        return sheet.text(torques(max(max(pair) for pair in pairs), 2))

    return draw


FOUR_BAR = "01 12 23 03"
WATT = "01 12 23 03 34 45 05"
STEPHENSON = "01 12 23 03 24 45 05"
BUTTERFLY = "01 04 05 16 17 23 24 26 35 37"


def chain(loops: int) -> Draw:
    """Four-bars in series: the rocker of one is the crank of the next."""

    def draw(rng: Random) -> str:
        sheet = Sheet(rng)
        sheet.pin(1, 2, (0.0, 0.0))
        end = (round(rng.uniform(-0.5, 0.5), 4), round(rng.uniform(0.8, 1.6), 4))
        for k in range(1, loops + 1):
            crank, rod, rocker = 2 * k, 2 * k + 1, 2 * k + 2
            sheet.pin(crank, rod, end)
            end = (3.0 * k + round(rng.uniform(-0.6, 0.6), 4), round(rng.uniform(1.0, 2.0), 4))
            sheet.pin(rod, rocker, end)
            sheet.pin(
                rocker, 1, (3.0 * k + round(rng.uniform(-0.4, 0.4), 4), round(rng.uniform(-0.4, 0.4), 4))
            )
        return sheet.text(torques(2 * loops + 2, 2))

    return draw


def near_toggle(delta: float) -> Draw:
    """Coupler and rocker within delta of one line: the crank near its limit."""

    def draw(rng: Random) -> str:
        sheet = Sheet(rng)
        direction = rng.uniform(0.0, math.tau)
        c, s = math.cos(direction), math.sin(direction)
        one, two = rng.uniform(1.0, 3.0), rng.uniform(1.0, 3.0)
        ground, a = sheet.spot(), sheet.spot()
        b = (a[0] + one * c - delta * s, a[1] + one * s + delta * c)
        for pair, at in zip(((1, 2), (2, 3), (3, 4)), (ground, a, b), strict=True):
            sheet.pin(*pair, at)
        sheet.pin(4, 1, (a[0] + (one + two) * c, a[1] + (one + two) * s))
        return sheet.text(torques(4, 2))

    return draw


def nearly_parallel(delta: float) -> Draw:
    """Crank and rocker parallel but for an angle delta: the coupler's centre is far away."""

    def draw(rng: Random) -> str:
        sheet = Sheet(rng)
        direction = rng.uniform(0.0, math.pi)
        ground, far = sheet.spot(), sheet.spot()
        one, two = rng.uniform(1.0, 3.0), rng.uniform(1.0, 3.0)
        other = direction + delta
        a = (ground[0] + one * math.cos(direction), ground[1] + one * math.sin(direction))
        b = (far[0] + two * math.cos(other), far[1] + two * math.sin(other))
        for pair, at in zip(((1, 2), (2, 3), (3, 4), (4, 1)), (ground, a, b, far), strict=True):
            sheet.pin(*pair, at)
        return sheet.text(torques(4, 2))

    return draw


def from_lengths(delta: float | None = None) -> Draw:
    """A four-bar by its lengths and the crank's angle; with delta, coupler and rocker that much longer,
    as a fraction, than where they would be in line."""

    def draw(rng: Random) -> str:
        a, d, angle = rng.uniform(0.5, 1.5), rng.uniform(3.0, 4.0), round(rng.uniform(20.0, 160.0), 3)
        bx, by = a * math.cos(math.radians(angle)), a * math.sin(math.radians(angle))
        apart = math.hypot(d - bx, by)
        share = rng.uniform(0.4, 0.6)
        reach = apart * (1.0 + (rng.uniform(0.05, 0.5) if delta is None else delta))
        b, c = share * reach, (1.0 - share) * reach
        h = math.sqrt((reach - apart) * (reach + apart)) * 0.6
        near = (bx + share * (d - bx) + h * by / apart, by * (1.0 - share) + h * (d - bx) / apart)
        return (
            f"icsolve: 1\npoints: {{A: [0, 0], D: [{d!r}, 0]}}\n"
            f"lengths: {{AB: {a!r}, BC: {b!r}, CD: {c!r}}}\n"
            f"angles: {{AB: {angle}}}\nnear: {{C: [{near[0]!r}, {near[1]!r}]}}\njoints:\n"
            "  - {pin: [1, 2], at: A}\n  - {pin: [2, 3], at: B}\n  - {pin: [3, 4], at: C}\n"
            f"  - {{pin: [4, 1], at: D}}\nloads: {{{torques(4, 2)}}}\n"
        )

    return draw


def moved(draw: Draw, offset: float = 0.0, scale: float = 1.0, exact: bool = False) -> Draw:
    """A family far from the origin, or of another size; ``exact`` writes all decimals of the doubles."""
    written = (lambda value: format(Decimal(value), "f")) if exact else repr

    def drawn(rng: Random) -> str:
        lines = draw(rng).splitlines()
        for n, line in enumerate(lines):
            if line.startswith("  P"):
                name, _, place = line.partition(": ")
                x, y = (float(text) for text in place.strip("[]").split(", "))
                lines[n] = f"{name}: [{written(x * scale + offset)}, {written(y * scale - offset)}]"
        return "\n".join(lines) + "\n"

    return drawn


def by_sides(draw: Draw, angle: tuple[int, int], ground: int = 1) -> Draw:
    """A pinned linkage by the sides of its links: the frame's pins stay, an angle poses the rest."""

    def drawn(rng: Random) -> str:
        lines = draw(rng).splitlines()
        at = {}
        for line in lines:
            if line.startswith("  P"):
                name, _, place = line.strip().partition(": ")
                x, y = place.strip("[]").split(", ")
                at[name] = (float(x), float(y))
        carried: dict[int, list[str]] = {}
        for line in lines:
            if line.startswith("  - {pin"):
                links, _, point = line.partition("], at: ")
                for link in links.partition("[")[2].split(", "):
                    carried.setdefault(int(link), []).append(point.strip("}"))
        still = carried.pop(ground)
        sides = [pair for pins in carried.values() for pair in combinations(pins, 2)]
        points = "\n".join(f"  {p}: [{at[p][0]!r}, {at[p][1]!r}]" for p in still)
        lengths = "\n".join(f"  {p}-{q}: {math.dist(at[p], at[q])!r}" for p, q in sides)
        near = "\n".join(f"  {p}: [{x!r}, {y!r}]" for p, (x, y) in at.items() if p not in still)
        p, q = (f"P{n}" for n in angle)
        turn = math.degrees(math.atan2(at[q][1] - at[p][1], at[q][0] - at[p][0]))
        tail = "\n".join(lines[lines.index("joints:") :])
        return (
            f"icsolve: 1\npoints:\n{points}\nlengths:\n{lengths}\n"
            f"angles: {{{p}-{q}: {turn!r}}}\nnear:\n{near}\n{tail}\n"
        )

    return drawn
