"""The numbers of a case as fields of its page, each beside what it is of, and handles of the points that they
place; and where in the text of the case they stand, so that the page can write it with others."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from contextlib import suppress
from html import escape
from itertools import accumulate
from typing import Any

from icsolve.assembly.loci import Axis, CircleLocus, Locus
from icsolve.assembly.steps import Given, Meet, Polar, Step
from icsolve.assembly.workspace import LENGTH, RAY, Datum, X, number_of
from icsolve.case import Case, Load, Mark, Number, bare_name, is_named, pair_name
from icsolve.draw.words import unit_word
from icsolve.errors import CaseError
from icsolve.numbers.units import numbers_in
from icsolve.read import load
from icsolve.read.document import parse, scalars
from icsolve.read.names import Problems
from icsolve.read.reading import unit_names
from icsolve.report.derivation.known import Known
from icsolve.statics.load_wrenches import is_loaded
from icsolve.sweep.varied_numbers import numbers_of
from icsolve.tuples import NamedTuple


class Field(NamedTuple):
    """A number with what stands before it, its unit, and what it may not be."""

    path: str
    text: str
    before: str
    unit: str
    said: str
    """its name for who does not see the page"""
    bound: str


class FieldLine(NamedTuple):
    """Fields that are told in one line, after words."""

    words: str
    fields: tuple[Field, ...]


def lines_of(case: Case, asked: Collection[str]) -> list[tuple[str, list[FieldLine]]]:
    """The numbers of a case by section, in lines as one would say them, without those that are ``asked``."""
    held = {path: number for path, number in numbers_of(case).items() if path not in asked}
    sections = (
        ("Points", _points(case, held)),
        ("Lengths", _plain(case, held, "lengths")),
        ("Angles", _plain(case, held, "angles")),
        ("Links", _masses(case)),
        ("Joints", _joints(case, held)),
        ("Loads", _loads(case, held)),
        ("Motion", _motion(case, held)),
    )
    return [(title, lines) for title, found in sections if (lines := list(found))]


def _field(case: Case, number: Number, before: str, said: str) -> Field:
    text = number.written("{:.12g}".format)
    unit = unit_names(case.units).get(number.dimension, "").replace("deg", "°").replace("^2", "²")
    return Field(number.path, text, before, unit_word(unit), said, number.bound)


def _points(case: Case, held: Mapping[str, Number]) -> Iterable[FieldLine]:
    for name in case.points:
        axes = [axis for axis in "xy" if f"points.{name}.{axis}" in held]
        fields = [_field(case, held[f"points.{name}.{axis}"], axis, f"{axis} of {name}") for axis in axes]
        if fields:
            yield FieldLine(bare_name(name), tuple(fields))


def _plain(case: Case, held: Mapping[str, Number], section: str) -> Iterable[FieldLine]:
    for path, number in held.items():
        if path.startswith(f"{section}."):
            name = path.partition(".")[2]
            yield FieldLine("", (_field(case, number, f"{name} =", name),))


def _masses(case: Case) -> Iterable[FieldLine]:
    for link, inertia in case.inertia.items() if is_loaded(case) else ():
        said = f"link {link}"
        own = [(n, n.path.rpartition(".")[2]) for n in numbers_in(inertia)]
        yield FieldLine(said, tuple(_field(case, n, key, f"{key} of {said}") for n, key in own))


def _joints(case: Case, held: Mapping[str, Number]) -> Iterable[FieldLine]:
    for joint in case.joints:
        own = [n for n in numbers_in(joint) if n.path in held]
        if own:
            kind = type(joint).__name__.lower()
            at = getattr(joint, "at", None)
            words = f"{kind} {pair_name(case, joint.links[:2]) if len(joint.links) == 2 else ''}"
            words += f" at {at.lstrip('@')}" if at and not joint.pivot else ""
            yield FieldLine(words, tuple(_of_joint(case, n, words) for n in own))

    for rope in case.ropes:
        words, fields = f"rope {rope.name}", []
        for number in numbers_in(rope.radii, rope.length):
            key, at = (*number.path.split(".")[2:], "")[:2]
            shown = f"radius at {at}" if at else key
            fields.append(_field(case, number, shown, f"{shown} of the {words}"))
        if fields:
            yield FieldLine(words, tuple(fields))


def _of_joint(case: Case, number: Number, words: str) -> Field:
    key, place = _key(number.path, 2)
    shown = f"{key} {'xy'[int(place)] if key == 'at' else int(place) + 1}" if place else key
    return _field(case, number, shown, f"{shown} of the {words}")


def _key(path: str, after: int) -> tuple[str, str]:
    """The key at the end of a path, and the place in a list behind it."""
    parts = path.split(".")[after:] or [""]
    return (parts[-2], parts[-1]) if parts[-1].isdigit() and len(parts) > 1 else (parts[-1], "")


def _loads(case: Case, held: Mapping[str, Number]) -> Iterable[FieldLine]:
    for one in case.loads:
        own = [n for n in numbers_in(one) if n.path in held]
        if own:
            yield FieldLine(one.name, tuple(_of_load(case, one, n) for n in own))
    if "gravity" in held and any(getattr(one, "mass", False) for one in case.loads):
        yield FieldLine("", (_field(case, held["gravity"], "gravity", "gravity"),))


def _of_load(case: Case, one: Load, number: Number) -> Field:
    name, *rest = number.path.split(".")[2:] or [""]
    if name in ("", "x", "y", "0", "1"):
        before = {"": "=", "0": "from", "1": "to"}.get(name, f"{name} =")
        return _field(case, number, before, f"{one.name} {name}".strip())
    shown = " ".join((name, *rest))
    return _field(case, number, shown, f"{shown} of {one.name}")


def _motion(case: Case, held: Mapping[str, Number]) -> Iterable[FieldLine]:
    for given in case.motion:
        own = [n for n in (given.speed, given.angle, given.acceleration) if n is not None and n.path in held]
        keys = [n.path.rpartition(".")[2] for n in own]
        said = f"link {given.link}"
        fields = [_field(case, n, key, f"{key} of {said}") for n, key in zip(own, keys, strict=True)]
        if fields:
            yield FieldLine(f"{said}, point {given.point}" if given.point else said, tuple(fields))


# --- handles ---------------------------------------------------------------------------------------------


def handles_of(case: Case, steps: Iterable[Step], paths: list[str]) -> dict[str, list[list[Any]]]:
    """For each point what moves it: kind of number, its place among the inputs, and what it is measured from.

    ``x``, ``y``: a coordinate; ``turn`` (base, sense): an angle; ``span`` (centre): a length to a centre.
    """

    def number(datum: Datum) -> int:
        return paths.index(number_of(case, datum).path)

    found: dict[str, list[list[Any]]] = {}
    for step in steps:
        for key in step.targets:
            if isinstance(step, Given):
                ways = ((axis, f"points.{key}.{axis}") for axis in "xy")
                found[str(key)] = [[axis, paths.index(path)] for axis, path in ways if path in paths]
            elif isinstance(step, Polar):
                found[str(key)] = list(_turning(step, number))
            elif isinstance(step, Meet):
                found[str(key)] = [
                    move for locus in (step.first, step.second) for move in _along(locus, number)
                ]
    return {name: moves for name, moves in found.items() if moves and is_named(name) and name[0] != "("}


def _turning(step: Polar, number: Callable[[Datum], int]) -> Iterable[list[Any]]:
    """The angle that turns a point about another."""
    root, corners = step.direction.root, step.direction.turns
    datum, sense = corners[-1] if corners else (root, 1)
    if isinstance(datum, Datum) and (corners or datum.kind == RAY):
        yield ["turn", number(datum), step.base, sense]


def _along(locus: Locus, number: Callable[[Datum], int]) -> Iterable[list[Any]]:
    """The length or coordinate that moves a locus."""
    if isinstance(locus, CircleLocus) and isinstance(locus.radius, Datum) and locus.radius.kind == LENGTH:
        yield ["span", number(locus.radius), locus.centre]
    elif isinstance(locus, Axis):
        yield ["x" if locus.datum.kind == X else "y", number(locus.datum)]


# --- the text of the case --------------------------------------------------------------------------------


def text_of(case: Case) -> tuple[str, Case] | None:
    """The text of a case's file, where it still says what the case says (but for numbers that were set), and
    the case that it is."""
    with suppress(OSError, UnicodeDecodeError, CaseError, ValueError):
        with open(case.path, encoding="utf-8-sig", newline="") as file:
            text = file.read()
        written = load(text) if "\n" in text else None
        if written is not None and numbers_of(written).keys() == numbers_of(case).keys():
            return text.replace("\r\n", "\n"), written
    return None


def _places(text: str, marks: Mapping[str, Mark]) -> dict[str, list[int]]:
    """Where in a text each number stands, from character to character; of one that the text does not have by
    itself nothing is said."""
    written = {scalar.mark: scalar.text for scalar in scalars(parse(text, Problems("<text>")))}
    lines = [0, *accumulate(map(len, text.splitlines(keepends=True)))]
    ends = ((path, lines[mark[0] - 1] + mark[1] - 1, written.get(mark, "")) for path, mark in marks.items())
    return {path: [at, at + len(own)] for path, at, own in ends if own and text.startswith(own, at)}


UNITS_NEEDED = ("mass", "moment of inertia", "pressure", "acceleration")
"""Dimensions of numbers that bare would be refused, or mean another unit."""


def units_to_write(case: Case) -> dict[str, str]:
    """By path the unit of a number that has to carry it."""
    names = unit_names(case.units)
    return {
        path: names[number.dimension]
        for path, number in numbers_of(case).items()
        if number.dimension in UNITS_NEEDED
    }


def text_data(case: Case, paths: list[str]) -> dict[str, Any] | None:
    """The text with the places of its numbers, by the place of each among the inputs; and of `near`."""
    found = text_of(case)
    if found is None:
        return None
    text, written = found
    at, now, before = _places(text, written.marks), numbers_of(case), numbers_of(written)
    near = [f"{name}.{axis}" for name in case.near for axis in "xy"]
    return {
        "text": text,
        "at": [at.get(path) for path in paths],
        "near": {name: at[f"near.{name}"] for name in near if f"near.{name}" in at},
        "set": [n for n, path in enumerate(paths) if now[path].value != before[path].value],
    }


# --- markup ----------------------------------------------------------------------------------------------


def section(known: Known) -> str:
    """The numbers as a section of the page."""
    groups = "".join(
        f'<fieldset><legend>{title}</legend><ul class="lines">{"".join(map(_line, lines))}</ul></fieldset>'
        for title, lines in lines_of(known.case, {unknown.path for unknown in known.posed})
    )
    return (
        '<section aria-label="Numbers" id="numbers"><h2>The numbers: change any</h2>\n'
        '<p class="fine"><label for="fine" id="fine-name">Tap a number for its slider.</label>'
        '<input type="range" id="fine" autocomplete="off" disabled></p>\n'
        f"{groups}\n"
        '<p class="hint" id="live-hint" role="status"></p>\n'
        '<div class="row"><button type="button" id="reset">As written</button>'
        '<button type="button" id="copy-case">Copy the case</button>'
        '<button type="button" id="copy-link">Copy a link</button></div>\n'
        '<p id="copied-line" hidden><label for="copied">Copied</label>'
        '<textarea id="copied" rows="6" readonly></textarea></p></section>'
    )


def _line(one: FieldLine) -> str:
    words = f'<span class="what">{escape(one.words)}</span> ' if one.words else ""
    return f"<li>{words}{' '.join(map(_input, one.fields))}</li>"


def _input(field: Field) -> str:
    name, own = escape(field.path), escape(f"number-{field.path.replace(' ', '-')}")
    unit = f' <span class="unit">{escape(field.unit)}</span>' if field.unit else ""
    return (
        f'<span class="number"><label for="{own}">{escape(field.before)}</label> '
        f'<input type="text" inputmode="decimal" autocomplete="off" spellcheck="false" id="{own}" '
        f'data-path="{name}" data-bound="{field.bound}" size="{max(len(field.text), 4) + 1}" '
        f'aria-label="{escape(field.said)}" value="{escape(field.text)}">{unit}</span>'
    )
