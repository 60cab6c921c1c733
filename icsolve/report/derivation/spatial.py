"""What a drawing or an explanation reads of a case in space: places, ties, loads with their numbers."""

from __future__ import annotations

from collections.abc import Mapping

from icsolve.case import Case
from icsolve.case.loads import aim_of
from icsolve.case.space import SpatialTorque, TorqueVector
from icsolve.errors import SceneError
from icsolve.report.derivation.known import Known
from icsolve.screws.space import ZERO, Vec, times
from icsolve.statics.power import known_value
from icsolve.statics.space.power import wrenches
from icsolve.statics.space.reaction_basis import SpatialFigure, SpatialTie, figure_of, in_case, ties_of
from icsolve.statics.space.reactions import unit_of, way_words
from icsolve.tuples import NamedTuple


class Push(NamedTuple):
    """A load in space, case units: force and couple on ``link`` at ``at`` (None for a couple alone), their
    opposites on ``against`` at ``end``; ``value`` its number (None where it was not found), ``way`` the one
    in which it acts where that is positive."""

    name: str
    link: str
    against: str
    at: Vec | None
    end: Vec | None
    where: str
    direction: Vec
    force: Vec
    couple: Vec
    value: float | None
    unit: str
    unknown: bool
    way: str


class InSpace(NamedTuple):
    """A case in space as far as it is known."""

    case: Case
    places: Mapping[str, Vec]
    ties: tuple[SpatialTie, ...]
    loads: tuple[Push, ...]
    figure: SpatialFigure | None

    def at(self, tie: SpatialTie) -> Vec:
        """The place of a joint, case units."""
        return tie.at if self.figure is None else self.figure.frame.shown(tie.at)

    def carried(self, link: str) -> list[Vec]:
        """Where a link has joints and loads; each place once."""
        found = [self.at(tie) for tie in self.ties if link in (tie.by, tie.on) and not tie.mesh]
        found += [
            self.places[c] for j in in_case(self.case).joints for c in _centres(j, link) if c in self.places
        ]
        found += [p.at for p in self.loads if p.at is not None and p.link == link]
        found += [p.end for p in self.loads if p.end not in (None, p.at) and p.against == link]
        return list(dict.fromkeys(found))


def _centres(joint: object, link: str) -> tuple[str, ...]:
    """The centre of a gear on a link."""
    links: tuple[str, ...] = getattr(joint, "links", ())
    centres: tuple[str, ...] = getattr(joint, "centres", ())
    return tuple(c for other, c in zip(links, centres, strict=False) if other == link)


def in_space(known: Known) -> InSpace:
    """The parts of a case in space; nothing where even its points are refused."""
    case = known.case
    try:
        figure = figure_of(in_case(case))
    except SceneError:
        return InSpace(case, {}, (), (), None)
    try:
        ties = ties_of(case, figure)
    except SceneError:
        ties = ()
    return InSpace(case, figure.places, ties, _loads(known, figure), figure)


def _loads(known: Known, figure: SpatialFigure) -> tuple[Push, ...]:
    try:
        loads = wrenches(known.case, figure)
    except SceneError:
        return ()
    answers = {} if known.answer is None else known.answer.answers
    found = []
    for w in loads:
        load = w.load
        number = known_value(w)
        value = None if number is None else w.ratio * number
        if value is None and load.name in answers:
            value = answers[load.name].value
        where = "" if isinstance(load, SpatialTorque | TorqueVector) else load.at
        at = figure.places[where] if where else None
        end = figure.places.get(aim_of(load), at) if where else None
        direction: Vec = w.unit[:3] if where else w.unit[3:]
        push = times((value or 0.0) * w.gain, direction)
        force, couple = (push, ZERO) if where else (ZERO, push)
        unit = unit_of(load, known.case)
        acts = (load.name, load.link, w.against, at, end, where, direction, force, couple)
        found.append(Push(*acts, value, unit, number is None, way_words(w)))
    return tuple(found)
