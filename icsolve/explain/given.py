"""What a problem gives, and what it asks; names and digits as the whole solution shows them."""

from __future__ import annotations

import math
from collections.abc import Container, Iterable
from typing import TypeGuard

from icsolve.answer import Centre
from icsolve.case import (
    Area,
    Centroid,
    Coordinates,
    Force,
    Load,
    Number,
    Spring,
    TorsionSpring,
    Units,
    Weight,
    bare_name,
    is_link,
    is_named,
    pair_name,
)
from icsolve.draw.words import name_runs
from icsolve.explain.document import Block, Items, Section, ShownTable, words
from icsolve.explain.formula import OMEGA, Name, Num, Quantity
from icsolve.report.derivation.known import Known
from icsolve.statics.power import has_friction
from icsolve.tuples import NamedTuple
from icsolve.wording.sentences import listed
from icsolve.wording.statement import Row, Statement


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

    def statement(self, known: Known) -> Statement:
        """The words of a case, its numbers as they are written, or with these digits."""

        def show(number: Number) -> str:
            return number.digits if number.factor == 1.0 else self.number(number.value).digits

        return Statement(known.case, show, known.posed)

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


def gain_names(load: Load) -> tuple[Name, ...]:
    """What stands beside the name of a load where a unit of it is no unit of force or torque: what a kilogram
    weighs, by how much a spring is stretched or turned, the area or length that a load acts on."""
    if isinstance(load, Weight):
        return (Name("g"),) if load.mass else ()
    if isinstance(load, Spring | TorsionSpring):
        return (Name("s", load.name),)
    if isinstance(load, Force) and load.over is not None:
        return (Name("A" if isinstance(load.over, Area) else "L", load.name),)
    return ()


def rate_name(link: str) -> Name:
    """The angular velocity of a link, or of a screw."""
    return Name(OMEGA, bare_name(link).replace(" ", "_"))


def speed_name(link: str) -> Name:
    """The speed of a link that slides, or of the free end of a rope."""
    return Name("v", link if is_link(link) else link.rpartition("-")[2])


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
    case, told = known.case, figures.statement(known)
    others = [link for link in case.links if link != case.ground]
    s, verb = ("", "s") if len(others) == 1 else ("s", "")
    verb = f" {'is' if verb else 'are'} held" if known.structure else f" move{verb}"
    blocks: list[Block] = [words(f"The frame is link {case.ground}; link{s} {listed(others)}{verb}.")]
    rows = [told.joint(joint) for joint in case.joints]
    rows += [told.rope(rope) for rope in case.ropes]
    rows += [(f"link {link}", told.mass(inertia)) for link, inertia in case.inertia.items()]
    rows += told.profiles()
    blocks.append(_items(rows))
    blocks += _points(known, figures, told)
    known_loads = [*told.loads(unknown=False)]
    if known_loads:
        blocks += [words("Loads:"), _loads(known_loads)]
    blocks += [words(f"{told.moving(one)} {told.motion(one)}.") for one in case.motion]
    return Section("Given", tuple(blocks))


def _items(rows: Iterable[Row]) -> Items:
    return Items(tuple((f"{name}: {value}" if value else name,) for name, value in rows))


def _loads(rows: Iterable[Row]) -> Items:
    return Items(tuple((load_name(name), f": {value}") for name, value in rows))


def asked_section(known: Known, figures: Figures) -> Section:
    """What is to be found."""
    unknown = [*figures.statement(known).loads(unknown=True)]
    if known.posed:
        return Section("Asked", (words(position_asked(known)),))
    if not unknown:
        return Section("Asked", (words(f"The {asked_without_unknown(known)}."),))
    one = len(unknown) == 1
    loads, s = ("is the load", "s") if one else ("are the loads", "")
    said = f"What {loads} that hold{s} the mechanism in equilibrium in this position?"
    if has_friction(known.case):
        said = f"What {loads} that keep{s} the motion up in this position?"
        if not known.case.motion:
            load = "load does" if one else "loads do"
            said = f"Over what range of the {load} the mechanism hold still in this position?"
    return Section("Asked", (words(said), _loads(unknown)))


def asked_without_unknown(known: Known) -> str:
    """What a case asks for that has no unknown."""
    if known.structure or known.case.space is not None:
        return "forces and couples in the joints"
    return "instant centres, and how fast the links move"


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


def _points(known: Known, figures: Figures, told: Statement) -> list[Block]:
    """A table of the points, those that the case gives by coordinates and those that follow, and what else
    places the figure."""
    rows = []
    asked = {one.path for one in known.posed}
    given = {name: data for name, data in known.case.points.items() if _is_given(data, asked)}
    for name in dict.fromkeys((*known.case.points, *known.points)):
        if not is_named(name) or name not in known.points:
            continue
        if known.posed and known.answer is None and name not in given:
            continue
        if name in given:
            rows.append(((name,), *((told.show(n),) for n in given[name] if n is not None), ("given",)))
            continue
        x, y = (figures.length(c).digits for c in known.points[name])
        rows.append(((name,), (x,), (y,), ("from the figure's data",)))
    unit = known.case.units.length
    table = [ShownTable(("point", f"x, {unit}", f"y, {unit}", "how"), tuple(rows))] if rows else []
    data = [told.point(name) for name in told.case.points if is_named(name) and name not in given]
    data += told.figure()
    return [*table, words("Data of the figure:"), _items(data)] if data else [*table]


def _is_given(data: Coordinates | Centroid, asked: Container[str]) -> TypeGuard[Coordinates]:
    """Whether a point is given by both coordinates, neither of which is open or asked for."""
    return isinstance(data, Coordinates) and all(n is not None and n.path not in asked for n in data)
