"""What a problem gives, and what it asks, in the plane and in space; and an exercise sheet for LaTeX, which
has no more than that: figures and questions, with the key behind them."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Sequence
from typing import TypeGuard

from icsolve.case import Centroid, Coordinates, Like, Spring, Toward, is_named, told_links
from icsolve.case.space import GearPair, SpatialForceVector, SpatialPoint, TorqueVector
from icsolve.draw import tikz
from icsolve.draw.figure import ASKED, drawn
from icsolve.draw.marks import Mark, kinds_of
from icsolve.draw.words import answer_sentences, holding_sentences, position_sentences, reaction_sentences
from icsolve.explain.document import AsTex, Block, Inline, Items, Section, ShownTable, picture_tex, words
from icsolve.explain.worked import Worked, load_name, worked
from icsolve.report.derivation.known import Known
from icsolve.report.derivation.spatial import Push, in_space
from icsolve.screws.space import Vec, size
from icsolve.statics.power import has_friction
from icsolve.statics.space.reaction_basis import SpatialTie, in_case
from icsolve.statics.space.reactions import direction_words, heading_words
from icsolve.structure import welded
from icsolve.tuples import NamedTuple
from icsolve.wording import at_words, listed
from icsolve.wording.joints import form_of_teeth
from icsolve.wording.sentences import provenance
from icsolve.wording.statement import Row, Statement


def given_section(work: Worked) -> Section:
    """Links and joints, the points, the loads, and the given motion."""
    if work.case.space is not None:
        return _given_in_space(work)
    case, told = work.case, work.statement()
    blocks: list[Block] = [words(f"The frame is {_frame_and_others(work)}.")]
    rows = [told.joint(joint) for joint in told.case.joints]
    rows += [told.rope(rope) for rope in case.ropes]
    rows += [(f"link {link}", told.mass(inertia)) for link, inertia in case.inertia.items()]
    rows += told.profiles()
    blocks.append(_items(rows))
    blocks += _points(work, told)
    known_loads = [*told.loads(unknown=False)]
    if known_loads:
        blocks += [words("Loads:"), _loads(known_loads)]
    blocks += _gravity(told)
    blocks += [words(f"{told.moving(one)} {told.motion(one)}.") for one in case.motion]
    return Section("Given", tuple(blocks))


def _frame_and_others(work: Worked) -> str:
    """The frame, and the links that it holds; or that move, and what else is frame, as it is welded to it."""
    case, still = work.case, work.known.structure
    frame = (case.ground,) if still else welded(case, case.ground)
    others = [link for link in told_links(case) if link not in frame]
    s, verb = ("", "s") if len(others) == 1 else ("s", "")
    verb = f" {'is' if verb else 'are'} held" if still else f" move{verb}"
    held = [link for link in told_links(case) if link in frame and link != case.ground]
    more = f", with link{'s' * (len(held) > 1)} {listed(held)} welded to it" if held else ""
    return f"link {case.ground}{more}; link{s} {listed(others)}{verb}"


def _items(rows: Iterable[Row]) -> Items:
    return Items(tuple((f"{name}: {value}" if value else name,) for name, value in rows))


def _gravity(told: Statement) -> list[Block]:
    return [words(f"{name.capitalize()} is {value}.") for name, value in told.gravity()]


def _loads(rows: Iterable[Row]) -> Items:
    return Items(tuple((load_name(name), f": {value}") for name, value in rows))


def asked_section(work: Worked) -> Section:
    """What is to be found."""
    if work.case.space is not None:
        return _asked_in_space(work)
    unknown = [*work.statement().loads(unknown=True)]
    if work.known.posed:
        return Section("Asked", (words(position_asked(work.known)),))
    if not unknown:
        return Section("Asked", (words(asked_without_unknown(work.known)),))
    one = len(unknown) == 1
    loads, s = ("is the load", "s") if one else ("are the loads", "")
    said = f"What {loads} that hold{s} the mechanism in equilibrium in this position?"
    if has_friction(work.case):
        said = f"What {loads} that keep{s} the motion up in this position?"
        if not work.case.motion:
            load = "load does" if one else "loads do"
            said = f"Over what range of the {load} the mechanism hold still in this position?"
    return Section("Asked", (words(said), _loads(unknown)))


def asked_without_unknown(known: Known) -> str:
    """What a case asks for that has no unknown."""
    if known.structure or known.case.space is not None:
        return "The forces and couples in the joints."
    if known.asks_holding:
        return "Does friction hold the mechanism still under these loads?"
    return "The instant centres, and how fast the links move."


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


def _points(work: Worked, told: Statement) -> list[Block]:
    """A table of the points, those that the case gives by coordinates and those that follow, and what else
    places the figure."""
    rows = []
    asked = {one.path for one in work.known.posed}
    given = {name: data for name, data in told.case.points.items() if _is_given(data, asked)}
    for name in dict.fromkeys((*work.case.points, *work.known.points)):
        if not is_named(name) or name not in work.known.points:
            continue
        if work.known.posed and work.known.answer is None and name not in given:
            continue
        if name in given:
            rows.append(((name,), *((told.show(n),) for n in given[name] if n is not None), ("given",)))
            continue
        x, y = (work.length(c).digits for c in work.known.points[name])
        rows.append(((name,), (x,), (y,), ("from the figure's data",)))
    unit = work.units.length
    table = [ShownTable(("point", f"x, {unit}", f"y, {unit}", "how"), tuple(rows))] if rows else []
    data = [told.point(name) for name in told.case.points if is_named(name) and name not in given]
    data += told.figure()
    return [*table, words("Data of the figure:"), _items(data)] if data else [*table]


def _is_given(data: Coordinates | Centroid, asked: Container[str]) -> TypeGuard[Coordinates]:
    """Whether a point is given by both coordinates, neither of which is open or asked for."""
    return isinstance(data, Coordinates) and all(n is not None and n.path not in asked for n in data)


# --- in space --------------------------------------------------------------------------------------------


def _given_in_space(work: Worked) -> Section:
    scene, case = in_space(work.known), work.case
    others = [link for link in told_links(case) if link != case.ground]
    said = words(f"The frame is link {case.ground}; the links that it holds: {listed(others)}.")
    blocks: list[Block] = [said, Items(tuple((_joint(work, tie),) for tie in scene.ties))]
    named = [(name, place) for name, place in scene.places.items() if is_named(name)]
    rows = tuple(((name,), *_coordinates(work, name, place)) for name, place in named)
    if rows:
        blocks.append(ShownTable(("point", *(f"{axis}, {work.units.length}" for axis in "xyz")), rows))
    loads = [push for push in scene.loads if not push.unknown]
    if loads:
        blocks += [words("Loads:"), Items(tuple(_load(work, push) for push in loads))]
    blocks += _gravity(work.statement())
    return Section("Given", tuple(blocks))


def _asked_in_space(work: Worked) -> Section:
    unknown = [push for push in in_space(work.known).loads if push.unknown]
    if not unknown:
        return Section("Asked", (words("The force and the couple at every joint."),))
    said = words("What load holds the links in equilibrium in this position?")
    return Section("Asked", (said, Items(tuple(_load(work, push) for push in unknown))))


def _joint(work: Worked, tie: SpatialTie) -> str:
    axis = f" along {direction_words(tie.axis)}" if size(tie.axis) > 0.5 else ""
    kind = KINDS.get(tie.joint_kind, tie.joint_kind)
    form = _teeth(work, tie.joint) if isinstance(tie.joint, GearPair) else ()
    place = _place(work, "at", tie.where)
    return ", ".join((f"a {kind} of links {tie.by} and {tie.on}{place}{axis}", *form))


def _teeth(work: Worked, gears: GearPair) -> Iterator[str]:
    show, teeth = work.statement().show, gears.teeth
    counts = zip(gears.links, gears.counts, gears.centres, strict=False)
    for link, count, centre in counts:
        inside = "internal " if count.value < 0.0 else ""
        yield f"{show(count).lstrip('-')} {inside}teeth on link {link} about {centre}"
    form = (teeth.pressure_angle, teeth.helix_angle, teeth.diametral_pitch, teeth.module)
    yield from form_of_teeth(form, (teeth.normal_angle, teeth.normal_pitch), work.units.length, show)
    if teeth.helix_angle is not None:
        yield f"link {gears.links[0]} {teeth.hand}-handed"
    if gears.toward is not None:
        mate = gears.toward
        way = f"toward {mate.point if isinstance(mate, Toward) else heading_words(mate, forth=True)}"
        yield f"its mate {way}"


def _coordinates(work: Worked, name: str, place: Vec) -> Iterator[tuple[str]]:
    """Of a point: as they are given, or as they follow."""
    given, show = in_case(work.case).points[name], work.statement().show
    if isinstance(given, SpatialPoint):
        yield from ((show(c),) for c in given)
    else:
        yield from ((work.length(c).digits,) for c in place)


def _place(work: Worked, word: str, name: str) -> str:
    """A point by its name, or by its coordinates where it has none."""
    p = in_case(work.case).points.get(name)
    if is_named(name) or not isinstance(p, SpatialPoint):
        return at_words(name).replace(" at ", f" {word} ")
    return f" {word} ({', '.join(map(work.statement().show, p))}) {work.units.length}"


KINDS = {
    "ball": "ball joint",
    "radial": "radial bearing",
    "thrust": "thrust bearing",
    "gears": "mesh of gears",
}


def _load(work: Worked, push: Push) -> tuple[Inline, ...]:
    told = work.statement()
    (load,) = (load for load in in_case(work.case).loads if load.name == push.name)
    what, way = f"a {'couple' if push.at is None else 'load'}", f", {push.way}"
    if isinstance(load, Spring):
        what, unit = "a spring", work.units.length
        way = f"{_place(work, 'to', load.to)}, free length {told.show(load.free)} {unit}"
    if isinstance(load, SpatialForceVector | TorqueVector):
        what, way = f"{what} of ({', '.join(map(told.show, load.parts))}) {push.unit}", ""
    elif isinstance(load.value, Like):
        what += told.like(load.value)
    elif load.value is not None:
        what += f" of {told.show(load.value)} {push.unit}"
    against = "" if push.against == work.case.ground else f" against link {push.against}"
    place = _place(work, "at", push.where)
    return load_name(push.name), f": {what} on link {push.link}{place}{against}{way}"


# --- exercises ------------------------------------------------------------------------------------------


DIGITS = 6


class Exercise(NamedTuple):
    """A case as it is asked: its title, figure and text, and what the key says."""

    title: str
    figure: tuple[Mark, ...]
    blocks: tuple[Block, ...]
    key: tuple[Inline, ...]


def exercise(known: Known) -> Exercise:
    """A case as an exercise: its figure has neither answer nor centres."""
    asked = known.as_asked
    work = worked(known, DIGITS)
    own = work._replace(known=asked)
    found = reaction_sentences(known) if known.structure else answer_sentences(known)
    held = "".join(f"{said}." for said in holding_sentences(known))
    sections = (given_section(own), asked_section(work if known.structure else own))
    answers = ((sentence.split(" ", 1)[0], sentence) for sentence in found)
    key: tuple[Inline, ...] = tuple(
        part for name, told in answers for part in (load_name(name), f"{told.removeprefix(name)}. ")
    )
    if known.posed:
        key = (f"{'; '.join(position_sentences(known))}.",)
    if known.refusal is not None:
        key = (f"No answer ({known.refusal.status}): {known.refusal.message}",)
    blocks = tuple(block for section in sections for block in section.blocks)
    lead = tuple(words(told) for told in provenance(known.case))
    key = key or (held or "See the worked solution.",)
    return Exercise(known.title, tuple(drawn(asked, ASKED)), (*lead, *blocks), key)


def sheet_tex(title: str, sheets: Sequence[tuple[str, Sequence[Exercise]]]) -> str:
    """A document with the exercises of every student, each on pages of their own, and all keys behind."""
    layout = AsTex()
    used = kinds_of(mark for _, some in sheets for one in some for mark in one.figure)
    questions, keys = [], []
    for who, some in sheets:
        heading = layout.text(title) + (f" \\hfill {layout.text(who)}" if who else "")
        questions.append(f"\\section*{{{heading}}}\n")
        questions += [_question(layout, n, one) for n, one in enumerate(some, 1)]
        questions.append("\\clearpage\n")
        name = f"Key {layout.text(who)}".rstrip()
        items = "".join(f"\\item {layout.inline(one.key)}\n" for one in some)
        keys.append(f"\\section*{{{name}}}\n\\begin{{enumerate}}\n{items}\\end{{enumerate}}\n")
    return (
        f"\\documentclass[11pt]{{article}}\n{tikz.PREAMBLE}{layout.packages}{layout.page}"
        f"{tikz.styles(used)}\\begin{{document}}\n{''.join((*questions, *keys))}\\end{{document}}\n"
    )


def _question(layout: AsTex, n: int, one: Exercise) -> str:
    """An exercise, on one page where it has room there; the first on that of the heading."""
    body = "".join(map(layout.block, one.blocks))
    figure = picture_tex(one.figure, 0.34)
    start = "\\filbreak\n" if n > 1 else ""
    return f"{start}\\subsection*{{{n}. {layout.text(one.title)}}}\n{figure}{body}"
