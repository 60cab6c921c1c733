"""All that is wrong with a file, collected in one run."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import islice

from icsolve.case import Mark
from icsolve.errors import Problem

_MOST_OPTIONS = 300
MOST = 100
"""After so many problems a file is not read further."""


class Stop(Exception):
    """Reading cannot go on; what is wrong is in the problems."""


class Problems:
    """Notes problems of one file."""

    def __init__(self, path: str) -> None:
        self.path = path
        self.found: list[Problem] = []

    def refuse(self, mark: Mark, message: str) -> None:
        """Note a problem; stops at the hundredth."""
        problem = Problem(printable(self.path), mark[0], mark[1], printable(message))
        if problem not in self.found:
            self.found.append(problem)
        if len(self.found) == MOST:
            self.found.append(problem._replace(message="and perhaps more: reading stopped here"))
            raise Stop

    def stop(self, mark: Mark, message: str) -> Stop:
        """Note a problem after which nothing can be read; to be raised."""
        self.refuse(mark, message)
        return Stop()


def printable(message: str) -> str:
    """A message on one line: what a file holds can neither break nor colour the terminal."""
    if message.isprintable() and len(message) < 1000:
        return message
    cut = message if len(message) < 1000 else message[:600] + " ... " + message[-200:]
    return "".join(c if c.isprintable() else " " if c in "\n\r\t" else repr(c)[1:-1] for c in cut)


def shown(text: str) -> str:
    """A value as a message quotes it: in quotes, cut where it is long."""
    return f"'{text}'" if len(text) <= 60 else f"'{text[:40]}...'"


_OTHER_WORDS = {
    "torque": "moment couple twist momentum drehmoment",
    "force": "load pull push thrust tension f kraft",
    "weight": "gravity_force w",
    "angle": "direction dir orientation theta bearing heading degrees inclination",
    "link": "body member bar part element on acts_on links",
    "at": "point position location where node p applied_at",
    "against": "from between reaction other",
    "pin": "revolute hinge pivot joint r turning pinned rotational",
    "slide": "prismatic slider track rail sliding guide p translational piston",
    "slot": "pin_in_slot pinslot",
    "roll": "rolling wheel rack",
    "gears": "gear mesh",
    "contact": "cam",
    "weld": "fixed rigid welded fix",
    "ground": "frame fixed base fixed_link earth",
    "loads": "forces load actions torques unknowns",
    "joints": "constraints connections pairs pins kinematic_pairs",
    "lengths": "dimensions distances length links_lengths sizes",
    "angles": "directions angle orientations",
    "points": "nodes coordinates positions joints_positions point",
    "near": "guess initial start approx",
    "expect": "answer answers expected results published",
    "title": "name heading",
    "source": "reference book",
    "motion": "speed speeds velocity input",
    "along": "direction dir axis angle guide",
    "through": "on passing",
    "mu": "friction coefficient",
    "speed": "omega velocity rate w v",
    "turns": "sense rotation direction",
    "cw": "clockwise right negative",
    "ccw": "counterclockwise anticlockwise counter-clockwise left positive",
    "free": "unstretched natural length rest free_length l0",
    "spring": "stiffness k",
    "centroid": "midpoint middle mean centre center",
    "length": "lengths distance",
}
"""Words that people write for a key of the format, where they are no slip of the pen."""


def suggestion(name: str, options: Iterable[str]) -> str:
    """``; did you mean ...?`` for the nearest option, else nothing."""
    near = nearest(name, options)
    return f"; did you mean '{near}'?" if near else ""


def nearest(name: str, options: Iterable[str]) -> str:
    """The option that is meant by a name: in other letters, by another word, by a slip of the pen; or ''."""
    from difflib import get_close_matches

    known = list(islice(options, _MOST_OPTIONS))
    word = name.lower().strip()
    lower = [option for option in known if option.lower() == word]
    other = [option for option in known if word.replace(" ", "_") in _OTHER_WORDS.get(option, "").split()]
    near = lower or other or get_close_matches(name[:60], known, 1, 0.6)
    return near[0] if near else ""
