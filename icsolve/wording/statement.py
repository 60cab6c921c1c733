"""What a case gives, in words: the data of joints, profiles, ropes, masses, loads and motions, for the worked
solution, the rows under the figure of a question, and a student's sheet.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from icsolve.case import (
    AlongRope,
    Area,
    Case,
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
    Weight,
    is_link,
    is_named,
)
from icsolve.case.figure import Corner, Unknown
from icsolve.case.loads import name_of_inertia
from icsolve.case.profiles import Arc, Arcs, Circle, Flat, Follower, Knife, Polygon, Radii, Roller, Shape
from icsolve.numbers.units import nearest, parse_unit
from icsolve.tuples import NamedTuple
from icsolve.wording import SPELT, link_words, listed, unit_of
from icsolve.wording.joints import joint_data, joint_words
from icsolve.wording.sentences import RECONSTRUCTED

Row = tuple[str, str]
"""What something is called, and what is given of it."""


_RPM = nearest(parse_unit("rpm")[:3])
"""Radians a second of a revolution a minute."""


def as_written(number: Number) -> str:
    """In case units, with the digits of the file where it stands there in them."""
    return number.written("{:.10g}".format)


class Statement(NamedTuple):
    """The words of a case; ``show`` writes its numbers; ``asked`` has the data that it asks for, where it has
    them as they were found.
    """

    case: Case
    show: Callable[[Number], str] = as_written
    asked: tuple[Unknown, ...] = ()

    def rows(self) -> list[Row]:
        """All that it gives, but pins that only join."""
        case = self.case
        rows = [self.point(name) for name in case.points if is_named(name)]
        rows += self.figure()
        rows += [row for joint in case.joints if (row := self.joint(joint))[1]]
        rows += [row for row in self.profiles() if row[1]]
        rows += [self.rope(rope) for rope in case.ropes]
        rows += [(f"link {link}", self.mass(inertia)) for link, inertia in case.inertia.items()]
        rows += self.loads()
        rows += [(self.moving(motion), self.motion(motion)) for motion in case.motion]
        rows += self.gravity()
        if case.reconstructed:
            rows.append((RECONSTRUCTED, case.reconstructed))
        return rows

    # --- the figure -------------------------------------------------------------------------------

    def point(self, name: str) -> Row:
        """A point: its coordinates, or those of which it is the middle."""
        p = self.case.points[name]
        if isinstance(p, Coordinates):
            return name, f"{self._coordinates(p)} {self.case.units.length}"
        return name, f"the middle of {listed(p.of)}"

    def figure(self) -> Iterator[Row]:
        """The lengths and angles; those that are asked with their ranges."""
        for one in self.case.lengths:
            yield one.a + one.b, self._datum(one.value, self.case.units.length)
        for angle in self.case.angles:
            if isinstance(angle, Corner):
                yield (
                    f"angle {angle.a}{angle.at}{angle.b}",
                    self._datum(angle.value, "deg, counterclockwise"),
                )
            else:
                yield f"direction {angle.a}{angle.b}", self._datum(angle.value, "deg from +x")

    def _coordinates(self, p: Coordinates) -> str:
        asked = {one.path for one in self.asked}
        x, y = ("unknown" if n is None or n.path in asked else self.show(n) for n in p)
        return f"({x}, {y})"

    def place(self, name: str) -> str:
        """A point by its name; one that is given by coordinates alone by those."""
        p = self.case.points.get(name)
        if is_named(name) or not isinstance(p, Coordinates):
            return name
        return f"{self._coordinates(p)} {self.case.units.length}"

    def _datum(self, number: Number, unit: str) -> str:
        """A number of the figure; of one that is asked the range."""
        asked = next((one for one in self.asked or self.case.unknowns if one.path == number.path), None)
        if asked is None:
            return f"{self.show(number)} {unit}"
        if asked.low is None or asked.high is None:
            return "unknown"
        return f"unknown, between {self.show(asked.low)} and {self.show(asked.high)} {unit}"

    def joint(self, joint: Joint) -> Row:
        """A joint, and its numbers; of a smooth pin none."""
        data = [*joint_data(joint, self.case.units.length, self.show)]
        if joint.stands_in and joint.at and not is_named(joint.at):
            data.append(f"at {self.place(joint.at)}")
        return joint_words(joint), ", ".join(data)

    # --- profiles ---------------------------------------------------------------------------------

    def profiles(self) -> Iterator[Row]:
        """A row for each link with a profile, and for each contact that rubs."""
        if self.case.profiles is None:
            return
        for link, shape in self.case.profiles.shapes.items():
            yield f"profile of link {link}", self.profile(shape)
        for touch in self.case.profiles.touches:
            rubs = "" if touch.friction is None else f"mu = {self.show(touch.friction.mu)}"
            yield f"links {listed(touch.links)} touch by their profiles", rubs

    def profile(self, shape: Shape | Follower) -> str:
        """The profile of a link."""
        unit = self.case.units.length
        match shape:
            case Polygon(corners):
                return f"polygon {'-'.join(corners)}"
            case Circle(centre, radius):
                return f"circle about {centre}, radius {self.show(radius)} {unit}"
            case Arcs(arcs):
                return "; ".join(map(self._arc, arcs))
            case Radii(about, zero, table, turns):
                rows = ", ".join(f"{self.show(angle)} deg: {self.show(radius)}" for angle, radius in table)
                return f"radii about {about} in {unit}, {SPELT[turns]} from {self._line(zero)}: {rows}"
            case Flat(at, along):
                return f"flat face through {at}, along {self._line(along)}"
            case Roller(at, radius):
                return f"roller about {at}, radius {self.show(radius)} {unit}"
            case Knife(at):
                return f"knife edge at {at}"

    def _arc(self, arc: Arc) -> str:
        radius = (
            f", radius {self.show(arc.radius)} {self.case.units.length}" if arc.radius is not None else ""
        )
        start, stop = self._line(arc.start), self._line(arc.stop)
        return f"arc about {arc.centre}{radius}, from {start} to {stop} {SPELT[arc.turns]}"

    def _line(self, line: Number | tuple[str, str] | str) -> str:
        if isinstance(line, Number):
            return f"{self.show(line)} deg"
        return line if isinstance(line, str) else "-".join(line)

    # --- ropes and masses -------------------------------------------------------------------------

    def rope(self, rope: Rope) -> Row:
        """The way of a rope, and what it goes round."""
        unit = self.case.units.length
        ends, data = [], []
        last = len(rope.points) - 1
        for k, (point, link) in enumerate(zip(rope.points, (*rope.links, ""), strict=False)):
            radius, wraps, mu, turns = rope.radii[k], rope.wraps[k], rope.mu[k], rope.whole_turns(k)
            body = "drum " if radius is not None or mu is not None else ""
            body = "pulley " if 0 < k < last and mu is None else body
            ends.append(f"{f'the {body}' if body else ''}{point}" + (f" of link {link}" if link else ""))
            parts = [f"radius {self.show(radius)} {unit}"] if radius is not None else []
            parts += [f"wrapped {SPELT[wraps]}"] if wraps is not None else []
            parts += (
                [f"{turns:g} whole turn{'s' if turns != 1.0 else ''} more than the figure shows"]
                if turns
                else []
            )
            parts += [f"mu = {self.show(mu)}"] if mu is not None else []
            data += [f"at {point} {', '.join(parts)}"] if parts else []
        data += [f"length {self.show(rope.length)} {unit}"] if rope.length is not None else []
        over = f" over {listed(ends[1:-1])}" if ends[1:-1] else ""
        way = f"a rope runs from {ends[0]}{over} to {'its free end ' if rope.is_free else ''}{ends[-1]}"
        return way, "; ".join(data)

    def mass(self, inertia: Inertia) -> str:
        """A link's mass, its centre of mass and its moment of inertia."""
        parts = [f"mass {self.show(inertia.mass)} kg"] if inertia.mass is not None else []
        parts += [f"centre of mass {inertia.centre}"] if inertia.centre else []
        parts += (
            [f"moment of inertia {self.show(inertia.moment)} kg*m^2"] if inertia.moment is not None else []
        )
        return ", ".join(parts)

    def gravity(self) -> Iterator[Row]:
        """How fast things fall, where a load is the weight of a mass."""
        loads = self.case.loads if self.case.space is None else self.case.space.loads
        if any(isinstance(load, Weight) and load.mass for load in loads):
            yield "gravity", f"{self.show(self.case.gravity)} m/s^2"

    # --- loads ------------------------------------------------------------------------------------

    def loads(self, unknown: bool | None = None) -> Iterator[Row]:
        """The loads, a force of unknown direction as one; with ``unknown`` those that are asked, or those
        that are given, without the forces of inertia.
        """
        for load in self.case.loads:
            name, _, axis = load.name.rpartition(".")
            if name in self.case.directed and isinstance(load, Force):
                if axis == "x" and unknown is not False:
                    where = f"on link {load.link} at {self.place(load.at)}"
                    yield name, f"to be found in size and direction, {where}"
            elif unknown is None or ((_size_of(load) is None) == unknown and not name_of_inertia(load.name)):
                yield load.name, self.load(load)

    def load(self, load: Load) -> str:
        """A load: ``force of 100 lbf on link 4 at E, at 180 deg``."""
        case, size, kind = self.case, _size_of(load), _kind(load)
        unit, over = unit_of(load, case), getattr(load, "over", None)
        if isinstance(load, ForceVector):
            kind += f" ({self.show(load.x)}, {self.show(load.y)}) {case.units.force}"
        elif isinstance(size, Like):
            kind += self.like(size)
        elif isinstance(size, Number):
            kind += f" of {self.show(size)} {unit}"
        else:
            kind += f"{' of a stiffness' if isinstance(load, Spring | TorsionSpring) else ''} to be found,"
        if isinstance(over, Area):
            kind += self._area(over)
        on = f"on {link_words(load.link)}"
        against = getattr(load, "against", None)
        if against is not None and against != case.ground:
            on += f" against link {against}"
        if isinstance(over, Stretch):
            on += f" from {over.a} to {over.b}"
            on += f", {self.show(over.end)} {unit} there" if over.end is not None else ""
        elif (at := getattr(load, "at", "")) and not isinstance(load, TorsionSpring):
            on += f" at {self.place(at)}"
        return f"{kind} {on}{self._way(load)}"

    def like(self, size: Like) -> str:
        """Which other load it is as large as."""
        times = f"{self.show(size.times)} times " if size.times is not None else ""
        return f", {times}as large as {size.load},"

    def _area(self, over: Area) -> str:
        """What a pressure acts on: `` on an area of 0.05 m^2``."""
        unit = self.case.units.length
        if over.area is not None:
            return f" on an area of {self.show(over.area)} {unit}^2"
        bore = f" on a bore of {self.show(over.bore)} {unit}" if over.bore is not None else ""
        return bore + (f" less a rod of {self.show(over.rod)} {unit}" if over.rod is not None else "")

    def _way(self, load: Load) -> str:
        """Which way a load acts; of an unknown torque which sense counts as positive."""
        match load:
            case Torque():
                positive = "positive " if load.value is None else ""
                if not is_link(load.link):
                    return ", positive clockwise as one looks along its axis"
                return f", {positive}{SPELT[load.turns]}"
            case Spring():
                end = self.place(load.to) if is_named(self.place(load.to)) else "a fixed point"
                return f" to {end}, free length {self.show(load.free)} {self.case.units.length}"
            case TorsionSpring():
                return f" by the angle {''.join(load.corner)}, free at {self.show(load.free)} deg"
            case Force(heading=Toward(point, away)):
                return f", {'away from' if away else 'toward'} {point}"
            case Force(heading=Slope(run, rise)):
                return f", along the slope {self.show(run)} : {self.show(rise)}"
            case Force(heading=AlongRope(rope)):
                return f", along the rope {rope.name}"
            case Force(heading=Number() as angle):
                return f", at {self.show(angle)} deg"
        return ""

    # --- motions ----------------------------------------------------------------------------------

    def moving(self, motion: Motion) -> str:
        """What moves."""
        if motion.point is None:
            return f"Link {motion.link} turns"
        return f"Point {motion.point} of link {motion.link} moves"

    def motion(self, motion: Motion) -> str:
        """Which way, and how fast; an acceleration counts in the sense of the speed."""
        speed, gain = motion.speed, motion.acceleration
        unit = "rad" if motion.point is None else self.case.units.length
        if motion.point is None:
            back = (motion.turns == "cw") != (speed is not None and speed.value < 0.0)
            parts = [f"at {self._turning(speed)}"] if speed is not None else []
            parts.append(SPELT["cw" if back else "ccw"])
        else:
            parts = [f"at {self.show(speed)} {unit}/s"] if speed is not None else []
            parts += [f"at {self.show(motion.angle)} deg"] if motion.angle is not None else []
        if gain is not None and gain.value:
            change = "speeding up" if gain.value > 0.0 else "slowing down"
            parts.append(f"{change} at {self._size(gain)} {unit}/s^2")
        return ", ".join(parts)

    def _turning(self, speed: Number) -> str:
        """A speed of turning, in revolutions a minute where it is written so and shown as written."""
        if self.show is as_written and speed.factor == _RPM:
            return f"{speed.digits.lstrip('+-')} rpm"
        return f"{self._size(speed)} rad/s"

    def _size(self, number: Number) -> str:
        return self.show(number).lstrip("+-")


def _size_of(load: Load) -> Number | Like | Load | None:
    return load if isinstance(load, ForceVector) else load.value


def _kind(load: Load) -> str:
    match load:
        case Force(over=Area()):
            return "pressure"
        case Force(over=Stretch()):
            return "force per length"
        case Force() | ForceVector():
            return "force"
        case Torque():
            return "torque"
        case Weight():
            return "mass" if load.mass else "weight"
        case Spring():
            return "spring"
        case TorsionSpring():
            return "torsion spring"
