"""A case as it is worked out: its names and numbers as the whole solution shows them, the places that they
are measured between, and the lever of a force on a link."""

from __future__ import annotations

import math
from collections.abc import Mapping

from icsolve.answer import Answer, Centre
from icsolve.case import (
    Area,
    Case,
    Force,
    Load,
    Number,
    Pair,
    Spring,
    TorsionSpring,
    Units,
    Weight,
    bare_name,
    is_link,
    pair_name,
)
from icsolve.case.loads import name_of_inertia
from icsolve.draw.words import name_runs
from icsolve.explain.document import Block, Formula, Inline, formula, words
from icsolve.explain.formula import (
    OMEGA,
    Expr,
    Name,
    Num,
    Of,
    Quantity,
    Sum,
    largest,
    names_in,
    product,
    rewritten,
    worth,
)
from icsolve.numbers import turn_of
from icsolve.report.derivation.known import Known
from icsolve.screws import Point
from icsolve.tuples import NamedTuple
from icsolve.wording import NOTHING, degrees_of, link_words
from icsolve.wording.statement import Statement

MOST_DIGITS = 17
"""More than a double has."""


class Worked(NamedTuple):
    """What is known of a case, and how it is shown: ``digits`` significant digits; lengths to the same place,
    that of the figure's ``size``."""

    known: Known
    digits: int
    size: float

    @property
    def case(self) -> Case:
        """The case."""
        return self.known.case

    @property
    def answer(self) -> Answer:
        """Its answer: a solution without one ends with the reason, before it would be told of."""
        assert self.known.answer is not None
        return self.known.answer

    @property
    def units(self) -> Units:
        """Its units."""
        return self.known.case.units

    def number(self, value: float) -> Num:
        """A number to its significant digits."""
        rounded = float(format(value, f".{self.digits}g")) + 0.0
        return Num(format(rounded, f".{max(self.digits, 12)}g"), value)

    def show(self, value: float) -> str:
        """The digits of a number, among words."""
        return self.number(value).digits

    def length(self, value: float) -> Num:
        """A coordinate or distance to the figure's last place."""
        places = self.digits - 1 - math.floor(math.log10(self.size)) if self.size > 0.0 else 0
        if not 0 <= places <= 12 or abs(value) >= 10.0 ** (15 - places):
            return self.number(value)
        text = f"{value:.{places}f}"
        text = text.rstrip("0").rstrip(".") if "." in text else text
        return Num("0" if text == "-0" else text, value)

    def recomputing(self, block: Block) -> Block:
        """A formula, each side with as many more digits as it takes to come to the last as a calculator has
        it: the sine of an angle near 0, or a difference, has fewer digits than what it is made of."""
        if not isinstance(block, Formula):
            return block
        *sides, last = block.sides
        known = names_in(last)
        return Formula((*(self._recomputing(s, last) if names_in(s) <= known else s for s in sides), last))

    def _recomputing(self, side: Expr, last: Expr) -> Expr:
        sought = worth(last)
        room = 5.0 * 10.0**-self.digits * (abs(sought) or largest(side))
        longer = range(self.digits + 1, MOST_DIGITS + 1)
        more = (rewritten(side, self._replace(digits=n).number) for n in longer)
        return next((one for one in (side, *more) if abs(worth(one) - sought) <= room), side)

    def quantity(self, value: float, unit: str) -> Quantity:
        """A number with a unit."""
        return Quantity(self.number(value), unit)

    def distance(self, value: float) -> Quantity:
        """A length with its unit."""
        return self.quantity(value, self.units.length)

    def difference(self, to: float, start: float) -> Expr:
        """One coordinate less another."""
        return Sum(((1, self.length(to)), (-1, self.length(start))))

    def statement(self) -> Statement:
        """The words of the case, its numbers as they are written, or with these digits."""

        def show(number: Number) -> str:
            return number.written(self.show)

        return Statement(self.known.given or self.case, show, self.known.posed)

    def centre_name(self, pair: Pair) -> Name:
        """I with the links of the pair low: ``I24``, ``I_2-14``."""
        name = pair_name(self.case, pair)
        short = name.replace("-", "")
        return Name("I", short if len(short) == 2 else name)

    def centre_words(self, centre: Centre) -> str:
        """Where a centre is: coordinates, or the direction in which it is at infinity."""
        if centre.kind == "at":
            x, y = (self.length(c).digits for c in centre.place)
            return f"({x}, {y})"
        if centre.kind == "toward":
            return f"at infinity, toward {self.show(centre.place[0])} deg"
        return centre.why

    def motion_name(self, link: str) -> Name:
        """The rate of a link that turns, the speed of one that slides, or of the free end of a rope."""
        if self.known.turns(link):
            return rate_name(link)
        return Name("v", link if is_link(link) else link.rpartition("-")[2])

    def place(self, pair: Pair) -> Point:
        """Coordinates of a finite centre."""
        centre = self.known.centre(*pair)
        assert centre is not None and centre.kind == "at"
        return (centre.place[0], centre.place[1])

    def own_centre(self, link: str) -> Pair:
        """The pair of a link with the frame."""
        return self.known.pair(link, self.case.ground)

    def pivot(self, link: str) -> Point | None:
        """The centre of a link with the frame where it has an arm about it: it turns, or is pinned and
        rests."""
        centre = self.known.centre(*self.own_centre(link))
        if centre is None or centre.kind != "at" or not (self.known.turns(link) or self.known.rests(link)):
            return None
        return (centre.place[0], centre.place[1])


def worked(known: Known, digits: int) -> Worked:
    """A case to be worked out with so many digits."""
    size = known.size
    if known.case.space is not None:
        from icsolve.report.derivation.spatial import in_space

        places = in_space(known).places.values()
        size = max((abs(c) for place in places for c in place), default=0.0)
    return Worked(known, digits, size)


def load_name(name: str) -> Name:
    """A load as a symbol: ``T12`` as T with 12 low, an inertia force as F with i and the link low, others
    whole."""
    if name_of_inertia(name):
        return Name(*(run.text for run in name_runs(name)))
    letters = name.rstrip("0123456789")
    return Name(letters, name[len(letters) :]) if len(letters) == 1 else Name(name)


def exerted_name(load: Load) -> Name:
    """What a load exerts as a symbol: the force or moment of a spring is not its stiffness."""
    if isinstance(load, Spring | TorsionSpring):
        return Name("T" if isinstance(load, TorsionSpring) else "F", load.name)
    return load_name(load.name)


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


# --- levers ----------------------------------------------------------------------------------------------


class Lever(NamedTuple):
    """``h`` or ``c`` with its number: the power of a unit of the force while its link moves at 1."""

    name: Name
    number: Num
    value: float


def lever(
    work: Worked,
    headings: Mapping[str, float],
    force: tuple[Inline, ...],
    low: str,
    link: str,
    at: Point,
    direction: Point,
) -> tuple[Lever, list[Block]]:
    """The lever of a force (in words) along a direction at a place of a link, and its formula: its arm about
    the link's centre where the link turns, the cosine of the angle with the motion where it slides.

    ``headings`` are the directions in which links slide, degrees.
    """
    angle = degrees_of(direction)
    written = work.number(angle)
    about = work.pivot(link)
    if about is None:
        cosine = turn_of(angle - headings[link])[0]
        found = Lever(Name("c", low), work.number(cosine), cosine)
        between = Sum(((1, written), (-1, work.number(headings[link]))))
        said = words("The part of ", *force, f" along the motion of {link_words(link)}:")
        return found, [said, formula(found.name, Of("cos", between), found.number)]
    parts = ((at[0] - about[0]) * direction[1], (at[1] - about[1]) * direction[0])
    arm = parts[0] - parts[1]
    arm = arm if abs(arm) > NOTHING * max(*map(abs, parts), work.size) else 0.0
    found = Lever(Name("h", low), work.number(arm), arm)
    across, up = (work.difference(to, start) for to, start in zip(at, about, strict=True))
    moments = Sum(((1, product(across, Of("sin", written))), (-1, product(up, Of("cos", written)))))
    turns = f", positive where it turns link {link} counterclockwise:"
    said = words("The arm of ", *force, " about ", work.centre_name(work.own_centre(link)), turns)
    return found, [said, formula(found.name, moments, work.distance(arm))]
