"""What a problem gives, and what it asks; names and digits as the whole solution shows them."""

from __future__ import annotations

import math
from collections.abc import Container

from icsolve.answer import Centre
from icsolve.case import (
    AlongRope,
    Area,
    Case,
    Centroid,
    Coordinates,
    Force,
    ForceVector,
    Inertia,
    Joint,
    Like,
    Load,
    Motion,
    Number,
    Rope,
    Slope,
    Spring,
    Stretch,
    Torque,
    TorsionSpring,
    Toward,
    Units,
    Weight,
)
from icsolve.case.figure import Corner
from icsolve.case.names import pair_name
from icsolve.case.profiles import Arc, Arcs, Circle, Flat, Follower, Knife, Polygon, Radii, Roller, Shape
from icsolve.draw.words import name_runs
from icsolve.explain.document import Block, Inline, Items, Section, ShownTable, words
from icsolve.explain.formula import Name, Num, Quantity
from icsolve.report.derivation import Known
from icsolve.statics.power import is_unknown, reacting
from icsolve.tuples import NamedTuple
from icsolve.wording.joints import joint_words
from icsolve.wording.senses import SPELT, unit_of
from icsolve.wording.sentences import link_words, listed


class Figures(NamedTuple):
    """``digits`` significant digits; lengths to the same place, that of the figure's size."""

    digits: int
    size: float
    units: Units

    def number(self, value: float) -> Num:
        """A number to its significant digits."""
        rounded = float(format(value, f".{self.digits}g")) + 0.0
        return Num(format(rounded, f".{max(self.digits, 12)}g"))

    def length(self, value: float) -> Num:
        """A coordinate or distance to the figure's last place."""
        places = self.digits - 1 - math.floor(math.log10(self.size)) if self.size > 0.0 else 0
        if not 0 <= places <= 12 or abs(value) >= 10.0 ** (15 - places):
            return self.number(value)
        text = f"{value:.{places}f}"
        text = text.rstrip("0").rstrip(".") if "." in text else text
        return Num("0" if text == "-0" else text)

    def distance(self, value: float) -> Quantity:
        """A length with its unit."""
        return Quantity(self.number(value), self.units.length)

    def quantity(self, value: float, unit: str) -> Quantity:
        """A number with a unit."""
        return Quantity(self.number(value), unit)


def figures_of(known: Known, digits: int) -> Figures:
    """The digits of a scene."""
    size = known.size
    if known.case.space is not None:
        from icsolve.report.derivation.spatial import in_space

        places = in_space(known).places.values()
        size = max((abs(c) for place in places for c in place), default=0.0)
    return Figures(digits, size, known.case.units)


def centre_name(known: Known, pair: tuple[str, str]) -> Name:
    """I with the links of the pair low: ``I24``, ``I_2-14``."""
    name = pair_name(known.case, pair)
    short = name.replace("-", "")
    return Name("I", short if len(short) == 2 else name)


def load_name(name: str) -> Name:
    """A load as a symbol: ``T12`` as T with 12 low, an inertia force as F with i and the link low, others
    whole."""
    if name.startswith("inertia "):
        return Name(*(run.text for run in name_runs(name)))
    letters = name.rstrip("0123456789")
    return Name(letters, name[len(letters) :]) if len(letters) == 1 else Name(name)


def rate_name(link: str) -> Name:
    """The angular velocity of a link, or of a screw."""
    return Name("w", link.removeprefix("@").replace(" ", "_"))


def speed_name(link: str) -> Name:
    """The speed of a link that slides, or of the free end of a rope."""
    return Name("v", link.rpartition("-")[2] if link.startswith("@") else link)


def place_words(figures: Figures, centre: Centre) -> str:
    """Where a centre is: coordinates, or the direction in which it is at infinity."""
    if centre.kind == "at":
        return point_words(figures, (centre.place[0], centre.place[1]))
    if centre.kind == "toward":
        return f"at infinity, toward {figures.number(centre.place[0]).digits} deg"
    return centre.why


def point_words(figures: Figures, p: tuple[float, float]) -> str:
    """A point by its coordinates."""
    return f"({figures.length(p[0]).digits}, {figures.length(p[1]).digits})"


# --- what a problem gives and asks -----------------------------------------------------------------------


def given_section(known: Known, figures: Figures) -> Section:
    """Links and joints, the points, the loads, and the question."""
    case = known.case
    others = [link for link in case.links if link != case.ground]
    blocks: list[Block] = [
        words(f"The frame is link {case.ground}; link{_s(others)} {listed(others)} move{_verb(others)}.")
    ]
    said = [joint_words(joint, case.units.length) + _rubbing(figures, joint) for joint in case.joints]
    said += [_rope_words(figures, rope) for rope in case.ropes]
    said += [_mass_words(figures, link, inertia) for link, inertia in case.inertia.items()]
    blocks.append(Items(tuple((one,) for one in said)))
    profiles = case.profiles.shapes if case.profiles is not None else {}
    if profiles:
        blocks.append(words("Profiles:"))
        blocks.append(Items(tuple((profile_words(figures, *one),) for one in profiles.items())))
    blocks += _points(known, figures)
    known_loads = [
        load for load in case.loads if not is_unknown(load) and not load.name.startswith("inertia ")
    ]
    if known_loads:
        blocks.append(words("Loads:"))
        blocks.append(Items(tuple(_load(known, figures, load) for load in known_loads)))
    blocks += [words(_motion(figures, motion)) for motion in case.motion]
    return Section("Given", tuple(blocks))


def asked_section(known: Known, figures: Figures) -> Section:
    """What is to be found."""
    case = known.case
    unknown = [load for load in case.loads if is_unknown(load)]
    if known.posed:
        return Section("Asked", (words(position_asked(known)),))
    if not unknown:
        what = "instant centres, and how fast the links move"
        what = "forces and couples in the joints" if known.structure else what
        return Section("Asked", (words(f"The {what}."),))
    entries = tuple(_load(known, figures, load) for load in unknown)
    count = "is the load that holds" if len(unknown) == 1 else "are the loads that hold"
    return Section(
        "Asked", (words(f"What {count} the mechanism in equilibrium in this position?"), Items(entries))
    )


def position_asked(known: Known) -> str:
    """The question of a case that asks for a position."""
    said = []
    for one in known.posed:
        kind, _, name = one.path.partition(".")
        point, _, axis = name.partition(".")
        plain = {"angles": f"angle {name}", "lengths": f"length {name}"}
        what = plain.get(kind, f"{axis} of {point}")
        if one.low is not None and one.high is not None:
            unit = "deg" if kind == "angles" else known.case.units.length
            what += f" from {one.low.digits} to {one.high.digits} {unit}"
        said.append(what)
    return f"For which {listed(said)} do the loads balance?"


def _s(items: list[str]) -> str:
    return "" if len(items) == 1 else "s"


def _verb(items: list[str]) -> str:
    return "s" if len(items) == 1 else ""


def _rope_words(figures: Figures, rope: Rope) -> str:
    """The way of a rope."""
    said = []
    last = len(rope.points) - 1
    for k, (p, link) in enumerate(zip(rope.points, (*rope.links, ""), strict=False)):
        radius, mu, unit = rope.radii[k], rope.mu[k], figures.units.length
        more = [] if radius is None else [f"radius {figures.number(radius.value).digits} {unit}"]
        more += [] if mu is None else [f"mu = {figures.number(mu.value).digits}"]
        turns = rope.whole_turns(k)
        more += (
            [f"{turns:g} whole turn{'s' if turns != 1.0 else ''} more than the figure shows"] if turns else []
        )
        held = f" of link {link}" if link else ""
        inner = 0 < k < last
        what = "the pulley " if inner and mu is None else "the drum " if radius is not None else ""
        said.append(f"{what}{p}{held}" + (f" ({', '.join(more)})" if more else ""))
    over = f" over {listed(said[1:-1])}" if said[1:-1] else ""
    return f"a rope runs from {said[0]}{over} to {'its free end ' if rope.is_free else ''}{said[-1]}"


def _mass_words(figures: Figures, link: str, inertia: Inertia) -> str:
    """The mass of a link."""
    parts = []
    if inertia.mass is not None:
        parts.append(
            f"mass {figures.number(inertia.mass.value).digits} kg with its centre at {inertia.centre}"
        )
    if inertia.moment is not None:
        parts.append(f"moment of inertia {figures.number(inertia.moment.value).digits} kg*m^2")
    return f"link {link} has {listed(parts)}"


def _rubbing(figures: Figures, joint: Joint) -> str:
    """What a joint says of its friction."""
    friction = joint.friction
    if friction is None:
        return ""
    parts = [f"mu = {figures.number(friction.mu.value).digits}"]
    for name, number in (("pin radius", friction.radius), ("block length", friction.length)):
        if number is not None:
            parts.append(f"{name} {figures.number(number.value).digits} {figures.units.length}")
    return f" ({', '.join(parts)})"


def profile_words(figures: Figures, link: str, shape: Shape | Follower) -> str:
    """The profile of a link."""
    match shape:
        case Circle(centre, radius) | Roller(centre, radius):
            kind = "circle" if isinstance(shape, Circle) else "roller"
            size = f"{figures.number(radius.value).digits} {figures.units.length}"
            return f"link {link}: a {kind} of radius {size} about {centre}"
        case Flat(at):
            return f"link {link}: a flat face through {at}"
        case Knife(at):
            return f"link {link}: a knife edge at {at}"
        case Polygon(corners):
            return f"link {link}: a polygon with the corners {listed(corners)}"
        case Radii(about, _, table):
            rows = "; ".join(f"{figures.number(a.value).digits} deg: {r.digits}" for a, r in table)
            return f"link {link}: radii about {about} by angle, in {figures.units.length}: {rows}"
        case Arcs(arcs):
            return f"link {link}: {'; '.join(_arc_words(figures, arc) for arc in arcs)}; joined by lines"


def _arc_words(figures: Figures, arc: Arc) -> str:
    """An arc of a profile."""
    size = (
        ""
        if arc.radius is None
        else f" of radius {figures.number(arc.radius.value).digits} {figures.units.length}"
    )
    ends = [
        end if isinstance(end, str) else f"{figures.number(end.value).digits} deg"
        for end in (arc.start, arc.stop)
    ]
    return f"an arc{size} about {arc.centre} from {ends[0]} to {ends[1]}"


def _points(known: Known, figures: Figures) -> list[Block]:
    """A table of the points: those that the case gives by coordinates, and those that follow."""
    rows = []
    asked = {one.path for one in known.posed}
    order = dict.fromkeys((*known.case.points, *known.points))
    for name in order:
        if name.startswith("@") or name not in known.points:
            continue
        place = known.points[name]
        data = known.case.points.get(name)
        given = isinstance(data, Coordinates) and not _open(data, asked)
        if known.posed and known.answer is None and not given:
            continue
        x, y = (figures.length(c).digits for c in place)
        rows.append(((name,), (x,), (y,), ("given" if given else "from the figure's data",)))
    unit = known.case.units.length
    table = [ShownTable(("point", f"x, {unit}", f"y, {unit}", "how"), tuple(rows))] if rows else []
    said = tuple((one,) for one in _data(known, figures, asked)) if known.posed else ()
    return [*table, words("Data of the figure:"), Items(said)] if said else [*table]


def _open(at: Coordinates, asked: Container[str]) -> list[str]:
    """The axes along which a point is open or asked for."""
    return [axis for axis, n in zip("xy", at, strict=True) if n is None or n.path in asked]


def _data(known: Known, figures: Figures, asked: Container[str]) -> list[str]:
    """What else places the figure: its lengths and angles, but those that are asked for."""
    said = [
        f"{one.a}{one.b} = {one.value.digits} {figures.units.length}"
        for one in known.case.lengths
        if one.value.path not in asked
    ]
    for one in known.case.angles:
        if one.value.path not in asked:
            what = f"the direction from {one.a} to {one.b}"
            what = f"the angle {one.a}{one.at}{one.b}" if isinstance(one, Corner) else what
            said.append(f"{what} is {one.value.digits} deg")
    for name, at in known.case.points.items():
        if isinstance(at, Centroid):
            said.append(f"{name} is the middle of {listed(at.of)}")
        elif open_axes := _open(at, asked):
            held = ((axis, n) for axis, n in zip("xy", at, strict=True) if axis not in open_axes)
            said += [f"{axis} of {name} is {n.digits} {figures.units.length}" for axis, n in held if n]
    return said


def _load(known: Known, figures: Figures, load: Load) -> tuple[Inline, ...]:
    """A load as a sentence."""
    case = known.case
    against = reacting(case, load)
    between = "" if against == case.ground else f", against link {against}"
    at = getattr(load, "at", "")
    where = f" at {at}" if at else ""
    if at.startswith("@"):
        where = f" at {point_words(figures, known.points[at])}" if at in known.points else ""
    return (
        load_name(load.name),
        f": {_kind(case, load)} on {link_words(load.link)}{where}{_heading(case, load)}{between}",
    )


def _kind(case: Case, load: Load) -> str:
    """What a load is, with its number where it has one."""
    if isinstance(load, ForceVector):
        return f"a force ({load.x.digits}, {load.y.digits}) {case.units.force}"
    unit, kind = unit_of(load, case), _KINDS[type(load)]
    if isinstance(load, Weight) and load.mass:
        kind = "mass"
    if isinstance(load, Force) and load.over is not None:
        kind = "pressure" if isinstance(load.over, Area) else "force per length"
        if isinstance(load.over, Stretch) and load.over.end is not None and isinstance(load.value, Number):
            over = load.over
            ends = f"{load.value.value:.6g} {unit} at {over.a} to {load.over.end.value:.6g} at {over.b}"
            return f"a force per length from {ends}"
    if load.value is None:
        return f"the stiffness of a {kind}" if isinstance(load, Spring | TorsionSpring) else f"the {kind}"
    if isinstance(load.value, Like):
        times = "" if load.value.times is None else f"{load.value.times.digits} times "
        return f"a {kind}, {times}as large as {load.value.load},"
    return f"a {kind} of {load.value.value:.6g} {unit}"


_KINDS: dict[type[Load], str] = {
    Force: "force",
    Torque: "torque",
    Spring: "spring",
    TorsionSpring: "torsion spring",
    Weight: "weight",
}


def _heading(case: Case, load: Load) -> str:
    if isinstance(load, Torque) and load.link.startswith("@"):
        return ", positive clockwise as one looks along its axis"
    if isinstance(load, Torque):
        return ", counterclockwise" if load.turns == "ccw" else ", clockwise"
    if isinstance(load, Spring):
        end = "a fixed point" if load.to.startswith("@") else load.to
        return f" to {end}, free length {load.free.value:.6g} {case.units.length}"
    if isinstance(load, TorsionSpring):
        return f" by the angle {''.join(load.corner)}, free at {load.free.digits} deg"
    if not isinstance(load, Force):
        return ""
    match load.heading:
        case Toward(point, away):
            return f", {'away from' if away else 'toward'} {point}"
        case Slope(run, rise):
            return f", with slope {run.digits} : {rise.digits}"
        case AlongRope(rope):
            return f", along the rope {rope.name}"
        case Number(digits=digits):
            return f", at {digits} deg"


def _motion(figures: Figures, motion: Motion) -> str:
    """A given motion as a sentence."""
    speed = None if motion.speed is None else motion.speed.value
    if motion.point is not None:
        size = "" if speed is None else f" at {figures.number(speed).digits} {figures.units.length}/s"
        way = "" if motion.angle is None else f", at {motion.angle.digits} deg"
        return f"Point {motion.point} of link {motion.link} moves{size}{way}{_gain(figures, motion)}."
    clockwise = (motion.turns == "cw") != (speed is not None and speed < 0.0)
    size = "" if speed is None else f" at {figures.number(abs(speed)).digits} rad/s"
    return f"Link {motion.link} turns{size}, {SPELT['cw' if clockwise else 'ccw']}{_gain(figures, motion)}."


def _gain(figures: Figures, motion: Motion) -> str:
    """Its acceleration, which counts in the sense of the speed."""
    gain = 0.0 if motion.acceleration is None else motion.acceleration.value
    unit = "rad" if motion.point is None else figures.units.length
    said = "speeds up" if gain > 0.0 else "slows down"
    return f", and {said} at {figures.number(abs(gain)).digits} {unit}/s^2" if gain else ""
