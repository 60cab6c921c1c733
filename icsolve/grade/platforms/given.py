"""What a case gives, in words: the rows that stand under the figure of a question."""

from __future__ import annotations

from collections.abc import Iterator

from icsolve.case import (
    AlongRope,
    Area,
    Case,
    Coordinates,
    Corner,
    Direction,
    Force,
    ForceVector,
    Guide,
    Joint,
    Like,
    Load,
    Motion,
    Number,
    Slope,
    Spring,
    Stretch,
    Torque,
    TorsionSpring,
    Toward,
    Weight,
)
from icsolve.case.bodies import Inertia, Rope
from icsolve.case.joints import Guided, Mesh, Rolling
from icsolve.case.profiles import Arc, Arcs, Circle, Flat, Follower, Knife, Polygon, Radii, Roller, Shape
from icsolve.wording.joints import thread_words

_TURNS = {"cw": "clockwise", "ccw": "counterclockwise"}


def outlines(case: Case) -> Iterator[tuple[str, str]]:
    """A row for each link with a profile."""
    if case.profiles is None:
        return
    for link, shape in case.profiles.shapes.items():
        yield f"profile of link {link}", _in_words(shape, case.units.length)
    for touch in case.profiles.touches:
        if touch.friction is not None:
            yield f"friction {'-'.join(touch.links)}", f"mu = {touch.friction.mu.digits}"


def _in_words(shape: Shape | Follower, unit: str) -> str:
    match shape:
        case Polygon(corners):
            return f"polygon {'-'.join(corners)}"
        case Circle(centre, radius):
            return f"circle about {centre}, radius {_shown(radius)} {unit}"
        case Arcs(arcs):
            return "; ".join(_arc(arc, unit) for arc in arcs)
        case Radii():
            return _table(shape, unit)
        case Flat(at, along):
            return f"flat face through {at}, along {_line(along)}"
        case Roller(at, radius):
            return f"roller about {at}, radius {_shown(radius)} {unit}"
        case Knife(at):
            return f"knife edge at {at}"


def _arc(arc: Arc, unit: str) -> str:
    radius = f", radius {_shown(arc.radius)} {unit}" if arc.radius is not None else ""
    return f"arc about {arc.centre}{radius}, from {_way(arc.start)} to {_way(arc.stop)} {_TURNS[arc.turns]}"


def _table(shape: Radii, unit: str) -> str:
    rows = ", ".join(f"{_shown(angle)} deg: {_shown(radius)}" for angle, radius in shape.table)
    return f"radii about {shape.about} in {unit}, {_TURNS[shape.turns]} from {_line(shape.zero)}: {rows}"


def _line(line: Number | tuple[str, str]) -> str:
    return f"{_shown(line)} deg" if isinstance(line, Number) else "-".join(line)


def _way(direction: Number | str) -> str:
    return f"{_shown(direction)} deg" if isinstance(direction, Number) else direction


def given(case: Case) -> list[tuple[str, str]]:
    """What the figure, its joints, loads and motion give, as pairs of a name and a value."""
    units = case.units
    rows = [(name, f"({_coordinate(p.x)}, {_coordinate(p.y)}) {units.length}") for name, p in _places(case)]
    rows += [(length.a + length.b, _datum(length.value, units.length, case)) for length in case.lengths]
    rows += [_angle(angle, case) for angle in case.angles]
    rows += [row for joint in case.joints for row in _joint(joint, case)]
    if case.profiles is not None:
        rows += outlines(case)
    rows += [row for rope in case.ropes for row in _rope(rope, case)]
    rows += [_inertia(link, inertia) for link, inertia in case.inertia.items()]
    rows += [_directed(load, case) or (load.name, _load(load, case)) for load in case.loads
             if load.name.removesuffix(".y") not in case.directed]  # fmt: skip
    rows += [_motion(given, case) for given in case.motion]
    if any(isinstance(load, Weight) and load.mass for load in case.loads):
        rows.append(("gravity", f"{_shown(case.gravity)} m/s^2"))
    return rows


def _angle(angle: Direction | Corner, case: Case) -> tuple[str, str]:
    if isinstance(angle, Corner):
        return f"angle {angle.a}{angle.at}{angle.b}", _datum(angle.value, "deg, counterclockwise", case)
    return f"direction {angle.a}{angle.b}", _datum(angle.value, "deg from +x", case)


def _datum(number: Number, unit: str, case: Case) -> str:
    """A number of the figure; of one that is asked the range."""
    asked = next((one for one in case.unknowns if one.path == number.path), None)
    if asked is None:
        return f"{_shown(number)} {unit}"
    if asked.low is None or asked.high is None:
        return "unknown"
    return f"unknown, between {_shown(asked.low)} and {_shown(asked.high)} {unit}"


def _directed(load: Load, case: Case) -> tuple[str, str] | None:
    """A force of unknown direction, which stands among the loads as two; None of another load."""
    name = load.name.removesuffix(".x")
    if name not in case.directed or not isinstance(load, Force):
        return None
    return name, f"to be found in size and direction, on link {load.link} at {_place(load.at, case)}"


def _places(case: Case) -> list[tuple[str, Coordinates]]:
    return [(n, p) for n, p in case.points.items() if isinstance(p, Coordinates) and not n.startswith("@")]


def _coordinate(number: Number | None) -> str:
    return "unknown" if number is None else _shown(number)


def _shown(number: Number) -> str:
    """In case units, as it is written where it stands in them."""
    return number.digits if number.factor == 1.0 else f"{number.value:.10g}"


def _load(load: Load, case: Case) -> str:
    """A load in words: ``100 lbf on link 4 at E, at 180 deg``."""
    from icsolve.wording.senses import unit_of

    against = getattr(load, "against", None)
    on = f"on link {load.link}" + (f" against link {against}" if against else "")
    at = getattr(load, "at", "@")
    where = f"{on} at {_place(at, case)}" if at != "@" else on
    if isinstance(load, Force) and isinstance(load.over, Stretch):
        where = f"{on} from {load.over.a} to {load.over.b}"
        if load.over.end is not None:
            where += f", {_shown(load.over.end)} {unit_of(load, case)} there"
    if isinstance(load, ForceVector):
        return f"({_shown(load.x)}, {_shown(load.y)}) {case.units.force} {where}"
    if isinstance(load.value, Like):
        times = f"{_shown(load.value.times)} times " if load.value.times is not None else ""
        return f"{times}{load.value.load}, {where}"
    size = f"{_shown(load.value)} {unit_of(load, case)}" if load.value is not None else "to be found"
    match load:
        case Torque(value=None):
            return f"{size}, {on}"
        case Torque():
            return f"{size} {_TURNS[load.turns]} {on}"
        case Weight():
            return f"{size}, {'mass' if load.mass else 'weight'} {where}"
        case Spring():
            free = f"free length {_shown(load.free)} {case.units.length}"
            return f"stiffness {size}, {free}, {load.at} to {load.to}"
        case TorsionSpring():
            return f"stiffness {size}, free angle {_shown(load.free)} deg of {''.join(load.corner)}, {on}"
        case Force(value=None):
            return f"{size},{_area(load, case)} {where}, {_heading(load)}"
        case Force():
            return f"{size}{_area(load, case)} {where}, {_heading(load)}"


def _area(load: Force, case: Case) -> str:
    """Of a pressure what it acts on: `` on an area of 0.05 m^2``."""
    area, unit = load.over, case.units.length
    if not isinstance(area, Area):
        return ""
    if area.area is not None:
        return f" on an area of {_shown(area.area)} {unit}^2"
    bore = f" on a bore of {_shown(area.bore)} {unit}" if area.bore is not None else ""
    return bore + (f" less a rod of {_shown(area.rod)} {unit}" if area.rod is not None else "")


def _heading(load: Force) -> str:
    match load.heading:
        case Toward(point, away):
            return f"{'away from' if away else 'toward'} {point}"
        case Slope(run, rise):
            return f"along the slope {_shown(run)} : {_shown(rise)}"
        case AlongRope(rope):
            return f"along the rope {rope.name}"
        case Number():
            return f"at {_shown(load.heading)} deg"


def _place(name: str, case: Case) -> str:
    """A point by its name; one that is given by coordinates alone by those."""
    place = case.points.get(name)
    if not name.startswith("@") or not isinstance(place, Coordinates):
        return name
    return f"({_coordinate(place.x)}, {_coordinate(place.y)}) {case.units.length}"


# --- joints and motion ------------------------------------------------------------------------------


def _joint(joint: Joint, case: Case) -> Iterator[tuple[str, str]]:
    """What a joint gives beside its place; of a smooth pin nothing."""
    first, second = joint.links[:2]
    at = joint.at
    where = f" at {_place(at, case)}" if at else ""
    if isinstance(joint, Guided):
        kind, moves = "block" if joint.keeps_direction else "pin", f"slides in link {second}"
        if joint.thread is not None:
            kind, sizes = "thread", thread_words(joint.thread, case.units.length)
            moves = f"turns on link {second}, {sizes},"
        yield f"{kind} of link {first}{where}", f"{moves} {_along(joint.guide)}"
    elif isinstance(joint, Mesh) and joint.pulls:
        radii = " and ".join(_shown(radius) for radius in joint.sizes)
        kind = "open" if joint.turns_alike else "crossed"
        yield f"belt {first}-{second}", f"{kind}, on radii {radii} {case.units.length}"
    elif isinstance(joint, Mesh):
        yield f"gears {first}-{second}", _teeth(joint, case)
    elif isinstance(joint, Rolling):
        radii = " and ".join(_shown(radius) for radius in joint.radii or ())
        on = f", radii {radii} {case.units.length}" if radii else ""
        yield f"links {first} and {second}", f"roll without slip{where}{on}"
    elif joint.only_pushes and joint.direction is not None:
        yield f"contact {first}-{second}{where}", f"normal at {_shown(joint.direction)} deg"
    elif joint.stands_in:
        toward = f"at infinity at {_shown(joint.direction)} deg" if joint.direction is not None else ""
        yield f"centre {first}-{second}", toward or f"{_place(at or '', case)}"
    yield from _friction(joint, case, f"{first}-{second}{where}")


def _along(guide: Guide) -> str:
    by = f"at {_shown(guide.angle)} deg" if guide.angle is not None else ""
    through = f", through {guide.through}" if guide.through and not guide.through.startswith("@") else ""
    return (by or f"along {'-'.join(guide.ends or ())}") + through


def _teeth(joint: Mesh, case: Case) -> str:
    counts = [_shown(number).lstrip("-") for number in joint.sizes]
    inner = any(number.value < 0.0 for number in joint.sizes)
    parts = [f"{counts[0]} and {counts[1]} teeth" + (", one of them internal" if inner else "")]
    if joint.pressure_angle is not None:
        normal = "normal " if joint.helix is not None and joint.helix.normal else ""
        parts.append(f"{normal}pressure angle {_shown(joint.pressure_angle)} deg")
    if joint.diametral_pitch is not None:
        parts.append(f"diametral pitch {_shown(joint.diametral_pitch)} a {case.units.length}")
    if joint.module is not None:
        parts.append(f"module {_shown(joint.module)} {case.units.length}")
    return ", ".join(parts)


def _friction(joint: Joint, case: Case, where: str) -> Iterator[tuple[str, str]]:
    friction = joint.friction
    if friction is None:
        return
    parts = [f"mu = {_shown(friction.mu)}"]
    if friction.radius is not None:
        parts.append(f"pin radius {_shown(friction.radius)} {case.units.length}")
    if friction.length is not None:
        parts.append(f"length of the block {_shown(friction.length)} {case.units.length}")
    yield f"friction {where}", ", ".join(parts)


def _rope(rope: Rope, case: Case) -> Iterator[tuple[str, str]]:
    """Where a rope goes, and what it goes round."""
    length = f", length {_shown(rope.length)} {case.units.length}" if rope.length is not None else ""
    yield f"rope {rope.name}", f"on links {', '.join(rope.links)}{length}"
    places = zip(rope.points, rope.radii, rope.wraps, rope.mu, strict=False)
    for k, (point, radius, wraps, mu) in enumerate(places):
        parts = [f"radius {_shown(radius)} {case.units.length}"] if radius is not None else []
        parts += [f"wrapped {wraps}"] if wraps is not None else []
        turns = rope.whole_turns(k)
        parts += [f"{turns:g} whole turns beside those of the figure"] if turns else []
        parts += [f"mu = {_shown(mu)}"] if mu is not None else []
        if parts:
            yield f"rope {rope.name} at {point}", ", ".join(parts)


def _inertia(link: str, inertia: Inertia) -> tuple[str, str]:
    """A link's mass, its centre of mass and its moment of inertia."""
    parts = [f"mass {_shown(inertia.mass)} kg"] if inertia.mass is not None else []
    parts += [f"centre of mass {inertia.centre}"] if inertia.centre else []
    parts += [f"moment of inertia {_shown(inertia.moment)} kg*m^2"] if inertia.moment is not None else []
    return f"link {link}", ", ".join(parts)


def _motion(given: Motion, case: Case) -> tuple[str, str]:
    """Which way, and how fast."""
    unit = "rad" if given.point is None else case.units.length
    parts = [f"{_shown(given.speed)} {unit}/s"] if given.speed is not None else []
    parts += [_TURNS[given.turns]] if given.turns is not None else []
    parts += [f"at {_shown(given.angle)} deg"] if given.angle is not None else []
    parts += [f"{_shown(given.acceleration)} {unit}/s^2"] if given.acceleration is not None else []
    moves = f"link {given.link} turns" if given.point is None else f"{given.point} on link {given.link} moves"
    return moves, ", ".join(parts)
