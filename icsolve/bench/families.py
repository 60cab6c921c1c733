"""Families of random mechanisms, as the benchmark and the tests draw them."""

from __future__ import annotations

import math
from collections.abc import Callable
from decimal import Context, Decimal
from itertools import combinations
from random import Random

from icsolve.case import Case, Centroid, Coordinates, Force, Joint, Load, Number, Torque
from icsolve.case.joints import Mesh
from icsolve.tuples import NamedTuple, replace

REACH = 4.0
"""Points of a random figure lie in a square of twice this side."""
Spot = tuple[float, float]


class FamilySheet:
    """A case that is being written; links from 1, the frame."""

    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.points: list[str] = []
        self.joints: list[str] = []
        self.links = 1

    def link(self) -> int:
        """A new link."""
        self.links += 1
        return self.links

    def spot(self) -> Spot:
        """Anywhere, in four decimals."""
        return (round(self.rng.uniform(-REACH, REACH), 4), round(self.rng.uniform(-REACH, REACH), 4))

    def point(self, at: Spot | None = None) -> str:
        """A new point."""
        x, y = at or self.spot()
        self.points.append(f"  P{len(self.points) + 1}: [{x!r}, {y!r}]")
        return f"P{len(self.points)}"

    def pin(self, i: int, j: int, at: Spot | None = None) -> str:
        """A pin, anywhere if nothing is said."""
        point = self.point(at)
        self.joints.append(f"  - {{pin: [{i}, {j}], at: {point}}}")
        return point

    def four_bar(self, *places: Spot) -> None:
        """Links 1 to 4 in a ring, pinned at these places, or anywhere."""
        for n in range(4):
            self.pin(n + 1, (n + 1) % 4 + 1, places[n] if places else None)

    def angle(self) -> float:
        """A direction in whole or decimal degrees."""
        return self.rng.choice([float(self.rng.randrange(0, 180, 5)), round(self.rng.uniform(0, 180), 3)])

    def text(self, loads: str) -> str:
        """The case."""
        points, joints = "\n".join(self.points), "\n".join(self.joints)
        return f"icsolve: 1\npoints:\n{points}\njoints:\n{joints}\nloads: {{{loads}}}\n"


def torques(on: int, to_find: int) -> str:
    """A known torque and the one to find."""
    return f"K: {{torque: 7.5, link: {on}}}, U: {{torque: unknown, link: {to_find}}}"


def scaled(case: Case, lengths: int, loads: int) -> Case:
    """A case with its lengths times 2**lengths and its known loads times 2**loads.

    Made for the families of the benchmark, whose known and unknown load are both torques or both
    forces: the unknown is then times 2**loads.
    """
    size, load = 2.0**lengths, 2.0**loads
    return replace(
        case,
        points={name: _place(place, size) for name, place in case.points.items()},
        lengths=tuple(side._replace(value=_times(side.value, size)) for side in case.lengths),
        near={name: (x * size, y * size) for name, (x, y) in case.near.items()},
        joints=tuple(_joint(joint, size) for joint in case.joints),
        loads=tuple(_load(given, load) for given in case.loads),
    )


def _times(number: Number, factor: float) -> Number:
    value = number.value * factor
    digits = str(Context(prec=400).multiply(Decimal(number.digits), Decimal(factor)))  # all of them
    return number._replace(value=value, half=number.half * factor, digits=digits)


def _place(place: Coordinates | Centroid, size: float) -> Coordinates | Centroid:
    if isinstance(place, Centroid):
        return place
    x, y = (None if number is None else _times(number, size) for number in place)
    return Coordinates(x, y)


def _joint(joint: Joint, size: float) -> Joint:
    if not isinstance(joint, Mesh) or not joint.pulls:
        return joint
    one, two = joint.sizes
    return joint.resized((_times(one, size), _times(two, size)))


def _load(load: Load, factor: float) -> Load:
    if isinstance(load, Torque | Force) and isinstance(load.value, Number):
        return load._replace(value=_times(load.value, factor))
    return load


Draw = Callable[[Random], str]
"""One scene of a family."""


def linkage(edges: str) -> Draw:
    """Links pinned in the pattern of a graph, numbered from 0 there and from 1 in the case."""

    def draw(rng: Random) -> str:
        sheet = FamilySheet(rng)
        pairs = [(int(edge[0], 36) + 1, int(edge[1], 36) + 1) for edge in edges.split()]
        for i, j in pairs:
            sheet.pin(i, j)
        return sheet.text(torques(max(max(pair) for pair in pairs), 2))

    return draw


FOUR_BAR = "01 12 23 03"
WATT = "01 12 23 03 34 45 05"
STEPHENSON = "01 12 23 03 24 45 05"
BUTTERFLY = "01 04 05 16 17 23 24 26 35 37"
TEN_BAR = "01 06 09 17 23 25 29 37 45 46 48 78 89"
"""All ten links of which have to be found together."""
FOURTEEN_BAR = "01 0d 12 15 23 34 3a 45 48 4d 56 67 78 7b 89 9a ab bc cd"
"""Of which, with the crank in place, the twelve others have to be found together."""


def chain(loops: int) -> Draw:
    """Four-bars in series: the rocker of one is the crank of the next."""

    def draw(rng: Random) -> str:
        sheet = FamilySheet(rng)
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
        sheet = FamilySheet(rng)
        direction = rng.uniform(0.0, math.tau)
        c, s = math.cos(direction), math.sin(direction)
        one, two = rng.uniform(1.0, 3.0), rng.uniform(1.0, 3.0)
        ground, a = sheet.spot(), sheet.spot()
        b = (a[0] + one * c - delta * s, a[1] + one * s + delta * c)
        sheet.four_bar(ground, a, b, (a[0] + (one + two) * c, a[1] + (one + two) * s))
        return sheet.text(torques(4, 2))

    return draw


def nearly_parallel(delta: float) -> Draw:
    """Crank and rocker parallel but for an angle delta: the coupler's centre is far away."""

    def draw(rng: Random) -> str:
        sheet = FamilySheet(rng)
        direction = rng.uniform(0.0, math.pi)
        ground, far = sheet.spot(), sheet.spot()
        one, two = rng.uniform(1.0, 3.0), rng.uniform(1.0, 3.0)
        other = direction + delta
        a = (ground[0] + one * math.cos(direction), ground[1] + one * math.sin(direction))
        b = (far[0] + two * math.cos(other), far[1] + two * math.sin(other))
        sheet.four_bar(ground, a, b, far)
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


def by_sides(draw: Draw, angle: tuple[int, int]) -> Draw:
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
        still = carried.pop(1)
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


def all_joints(rng: Random) -> str:
    """A crank or a block, and two groups on it by joints of any kind: four to eight links."""
    sheet = FamilySheet(rng)
    if rng.random() < 0.7:
        sheet.pin(1, sheet.link())
    else:
        _slide(sheet, 1, sheet.link())
    for _ in range(2):
        rng.choice([_dyad, _dyad, _lever, _wheel])(sheet)
    return sheet.text(torques(sheet.links, 2) if rng.random() < 0.5 else _forces(sheet))


def _forces(sheet: FamilySheet) -> str:
    """A known force on the last link, a force to find on the first that moves."""
    at, to = sheet.spot(), sheet.spot()
    known = f"K: {{force: 7.5, link: {sheet.links}, at: [{at[0]}, {at[1]}], angle: {sheet.angle()}}}"
    return f"{known}, U: {{force: unknown, link: 2, at: [{to[0]}, {to[1]}], angle: {sheet.angle()}}}"


def _slide(sheet: FamilySheet, i: int, j: int) -> None:
    one, two = sheet.rng.sample((i, j), 2)
    at = sheet.point()
    sheet.joints.append(f"  - {{slide: [{one}, {two}], at: {at}, along: {sheet.angle()}}}")


def mixed(rng: Random) -> str:
    """Two or three groups of any kind, welds and pins of several links among them, loads between links."""
    sheet = FamilySheet(rng)
    first = sheet.pin(1, sheet.link())
    for _ in range(rng.randint(2, 3)):
        rng.choice([_dyad, _lever, _wheel, _weld])(sheet)
        if rng.random() < 0.4:
            _on_a_pin(sheet, first)
    others = list(range(2, sheet.links + 1))
    pairs = [(rng.choice(others), rng.choice([1, *others])) for _ in "KU"]
    return sheet.text(
        ", ".join(
            f"{name}: {{torque: {value}, link: {on}{'' if by in (1, on) else f', against: {by}'}}}"
            for (on, by), name, value in zip(pairs, "KU", ("7.5", "unknown"), strict=True)
        )
    )


def _weld(sheet: FamilySheet) -> None:
    """A link that moves as one with another."""
    i, a = sheet.rng.randint(2, sheet.links), sheet.link()
    sheet.joints.append(f"  - {{weld: [{i}, {a}]}}")


def _on_a_pin(sheet: FamilySheet, point: str) -> None:
    """A dyad whose first link hangs on a pin that is there."""
    j, a, b = sheet.rng.randint(2, sheet.links), sheet.link(), sheet.link()
    sheet.joints.append(f"  - {{pin: [2, {a}], at: {point}}}")
    sheet.pin(a, b)
    _full(sheet, b, j)


def _full(sheet: FamilySheet, i: int, j: int) -> None:
    """A joint that leaves one freedom."""
    kind = sheet.rng.choice(("pin", "pin", "slide", "roll", "centre"))
    if kind == "slide":
        _slide(sheet, i, j)
    elif kind == "pin":
        sheet.pin(i, j)
    else:
        sheet.joints.append(f"  - {{{kind}: [{i}, {j}], at: {sheet.point()}}}")


def _half(sheet: FamilySheet, i: int, j: int) -> None:
    """A joint that leaves two."""
    one, two = sheet.rng.sample((i, j), 2)
    at = sheet.point()
    if sheet.rng.random() < 0.5:
        sheet.joints.append(f"  - {{slot: [{one}, {two}], at: {at}, along: {sheet.angle()}}}")
    else:
        sheet.joints.append(f"  - {{contact: [{one}, {two}], at: {at}, normal: {sheet.angle()}}}")


def _two(sheet: FamilySheet) -> tuple[int, int]:
    i, j = sheet.rng.sample(range(1, sheet.links + 1), 2)
    return i, j


def _dyad(sheet: FamilySheet) -> None:
    """Two links by three full joints, the first of them a pin."""
    (i, j), a, b = _two(sheet), sheet.link(), sheet.link()
    sheet.pin(i, a)
    _full(sheet, a, b)
    _full(sheet, b, j)


def _lever(sheet: FamilySheet) -> None:
    """One link on another, driven by a third through a slot or a contact."""
    (i, j), a = _two(sheet), sheet.link()
    _full(sheet, i, a)
    _half(sheet, j, a)


def _wheel(sheet: FamilySheet) -> None:
    """Two wheels on the frame, the first driven by a link through a rod."""
    rng, a, rod, b = sheet.rng, sheet.link(), sheet.link(), sheet.link()
    sheet.pin(1, a)
    sheet.pin(rng.randrange(2, a), rod)
    sheet.pin(rod, a)
    sheet.pin(1, b)
    teeth = f"{rng.randrange(12, 40)}, {rng.choice((1, -1)) * rng.randrange(41, 90)}"
    if rng.random() < 0.6:
        sheet.joints.append(f"  - {{gears: [{a}, {b}], teeth: [{teeth}]}}")
    else:
        radii = f"{rng.uniform(0.2, 0.9):.3f}, {rng.uniform(0.2, 0.9):.3f}"
        sheet.joints.append(
            f"  - {{belt: [{a}, {b}], radii: [{radii}], crossed: {'true' if a % 2 else 'false'}}}"
        )


def geared_five_bar(rng: Random) -> str:
    """Two cranks that gears on the frame join, and two rods."""
    sheet = FamilySheet(rng)
    for i, j in ((1, 2), (2, 3), (3, 4), (4, 5), (5, 1)):
        sheet.pin(i, j)
    teeth = f"{rng.randrange(12, 60)}, {rng.choice((1, -1)) * rng.randrange(61, 120)}"
    sheet.joints.append(f"  - {{gears: [2, 5], teeth: [{teeth}], carrier: 1}}")
    return sheet.text(torques(4, 2))


def near(draw: Callable[[float], Draw]) -> Draw:
    """A family at 1e-12 to 1e-2 from its singular position."""
    return lambda rng: draw(10.0 ** rng.uniform(-12.0, -2.0))(rng)


def coupler_slot(rng: Random) -> str:
    """A four-bar with a slot in its coupler that drives a lever's pin."""
    sheet = FamilySheet(rng)
    sheet.four_bar()
    sheet.joints.append(f"  - {{slot: [5, 3], at: {sheet.point()}, along: {sheet.angle()}}}")
    sheet.pin(5, 1)
    return sheet.text(torques(5, 2))


def rubbing_slider_crank(rng: Random) -> str:
    """A slider-crank of which all joints rub, two in five of them beside a dead centre; nothing moves it."""
    crank, rod = round(rng.uniform(0.5, 2.0), 3), round(rng.uniform(3.0, 8.0), 3)
    offset, angle = round(rng.uniform(-0.4, 0.4), 3), round(rng.uniform(0.0, 360.0), 4)
    if rng.random() < 0.4:
        offset, angle = 0.0, rng.choice((0, 180)) + 10.0 ** rng.uniform(-12.0, -2.0)
    mu = [f"mu: {rng.uniform(0.01, 0.3):.3f}" for _ in range(4)]
    radii = [f"radius: {rng.uniform(0.02, 0.2):.3f}" for _ in range(3)]
    return f"""icsolve: 1
points: {{A: [0, 0], C: [unknown, {offset!r}]}}
lengths: {{AB: {crank!r}, BC: {rod!r}}}
angles: {{AB: {angle!r}}}
near: {{C: [{rod!r}, {offset!r}]}}
joints:
  - {{pin: [1, 2], at: A, {mu[0]}, {radii[0]}}}
  - {{pin: [2, 3], at: B, {mu[1]}, {radii[1]}}}
  - {{pin: [3, 4], at: C, {mu[2]}, {radii[2]}}}
  - {{slide: [4, 1], at: C, along: 0, {mu[3]}}}
loads: {{P: {{force: 100, link: 4, at: C, angle: 180}}, U: {{torque: unknown, link: 2}}}}
"""


class Family(NamedTuple):
    """Scenes of one kind: a name for tables, how one is drawn, how many of them count for one."""

    name: str
    draw: Draw
    weight: int = 1


ALL_JOINTS = Family("all joints", all_joints)
SIX_BARS = (Family("Watt", linkage(WATT)), Family("Stephenson", linkage(STEPHENSON)))
DELTAS = tuple(10.0**-k for k in range(1, 16))

FAMILIES: tuple[Family, ...] = (
    Family("four-bar", linkage(FOUR_BAR)),
    *SIX_BARS,
    ALL_JOINTS,
    Family("geared five-bar", geared_five_bar),
    Family("slot on a moving link", coupler_slot),
    Family("double butterfly", linkage(BUTTERFLY)),
    Family("from lengths", from_lengths()),
    *(Family(f"lengths, toggle {delta:.0e}", from_lengths(delta)) for delta in (1e-3, 1e-6, 1e-9, 1e-12)),
    *(Family(f"toggle {delta:.0e}", near_toggle(delta)) for delta in DELTAS[::2]),
    *(Family(f"parallel {delta:.0e}", nearly_parallel(delta)) for delta in DELTAS[2::4]),
    Family("parallel", nearly_parallel(0.0)),
    *(Family(f"offset {o:.0e}", moved(linkage(STEPHENSON), o, exact=True)) for o in (1e2, 1e6, 1e10)),
    *(Family(f"size {s:.0e}", moved(linkage(STEPHENSON), scale=s)) for s in (1e-290, 1e-12, 1e12, 1e300)),
    Family("chain of 12", chain(12), 4),
    Family("chain of 50", chain(50), 20),
)
"""In the order of the tables, from easy to hard within each kind."""

EXACT: tuple[Family, ...] = (
    Family("mixed", mixed),
    Family("all joints", all_joints, 2),
    Family("near a toggle", near(near_toggle), 3),
    Family("near a toggle, from lengths", near(from_lengths), 3),
    Family("nearly parallel", near(nearly_parallel), 3),
    Family("double butterfly from lengths", by_sides(linkage(BUTTERFLY), (1, 4)), 50),
    Family("ten links found together", by_sides(linkage(TEN_BAR), (1, 4)), 200),
    Family("twelve links found together", by_sides(linkage(FOURTEEN_BAR), (1, 3)), 400),
)
"""On which every number is held to its last digit, and rows of sweeps to their scenes."""

RUBBING = (Family("slider-crank with friction", rubbing_slider_crank, 2),)
"""Of which the ends of the range that holds are known in closed form."""

BOUNDED: tuple[Family, ...] = (
    ALL_JOINTS,
    Family("four-bar", linkage(FOUR_BAR)),
    Family("from lengths", from_lengths()),
    Family("chain of 12 from lengths", by_sides(chain(12), (1, 2)), 10),
    Family("double butterfly from lengths", by_sides(linkage(BUTTERFLY), (1, 4)), 50),
    Family("geared five-bar", geared_five_bar),
    Family("slot on a moving link", coupler_slot),
    Family("toggle 1e-06", near_toggle(1e-6)),
    Family("lengths, toggle 1e-06", from_lengths(1e-6)),
    Family("parallel 1e-07", nearly_parallel(1e-7)),
    Family("offset 1e+06", moved(linkage(STEPHENSON), offset=1e6)),
    Family("size 1e-12", moved(linkage(STEPHENSON), scale=1e-12)),
)
"""On which the error bound is held against sixty digits on the decimals."""
