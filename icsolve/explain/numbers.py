"""The digits that a worked solution shows."""

from __future__ import annotations

import math
from typing import NamedTuple

from icsolve.answer import Centre
from icsolve.case import Units
from icsolve.case.names import pair_name
from icsolve.construction import Known
from icsolve.explain.formula import Name, Num, Quantity


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
        from icsolve.construction.spatial import in_space

        places = in_space(known).places.values()
        size = max((abs(c) for place in places for c in place), default=0.0)
    return Figures(digits, size, known.case.units)


def centre_name(known: Known, pair: tuple[str, str]) -> Name:
    """I with the links of the pair low: ``I24``, ``I_2-14``."""
    name = pair_name(known.case, pair)
    short = name.replace("-", "")
    return Name("I", short if len(short) == 2 else name)


def load_name(name: str) -> Name:
    """A load as a symbol: ``T12`` as T with 12 low, other names whole."""
    letters = name.rstrip("0123456789")
    return Name(letters, name[len(letters) :]) if len(letters) == 1 else Name(name)


def rate_name(link: str) -> Name:
    """The angular velocity of a link."""
    return Name("w", link)


def speed_name(link: str) -> Name:
    """The speed of a link that slides."""
    return Name("v", link)


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
