"""The free bodies of a case in space: every link by itself with the forces and couples on it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from icsolve.construction import Known
from icsolve.draw.bodies import GAP, rows_of
from icsolve.draw.figure import with_labels
from icsolve.draw.marks import Group, Mark, Run, Text, bounds, plain_text
from icsolve.draw.place import Label
from icsolve.draw.scene import Part, around, together
from icsolve.draw.space import ARROW, Sketch, along_arrow, body_part, moving_links, outline_of, vector
from icsolve.draw.words import force_runs, name_runs, quantity
from icsolve.statics.space.figure import Vec, size, times


def space_panels(known: Known, sketch: Sketch, left: float, top: float, width: float) -> list[Mark]:
    """Every link by itself with the forces and couples on it, forces to one scale."""
    spatial = known.answer.spatial if known.answer is not None else None
    if spatial is None:
        return []
    pushes = {link: list(_pushes(sketch, known, link)) for link in moving_links(sketch.scene)}
    largest = max((size(f) for some in pushes.values() for _, _, f, _, _ in some), default=0.0) or 1.0
    panels = [_panel(sketch, link, some, largest) for link, some in pushes.items()]
    title = Text((left, top + 4.0), (Run("Free bodies, forces to one scale"),), "t-note", 12.5, "start")
    return [title, *rows_of(panels, left, top + GAP, width)]


On = tuple[str, tuple[Run, ...], Vec, Vec, tuple[str, Vec]]


def _pushes(sketch: Sketch, known: Known, link: str) -> Iterable[On]:
    """Name, words, force, couple, and kind with place, of all that acts on a link."""
    assert known.answer is not None and known.answer.spatial is not None
    units = known.case.units
    for name, reaction in known.answer.spatial.reactions.items():
        if link not in (reaction.by, reaction.on):
            continue
        r = reaction if reaction.on == link else reaction.reversed()
        low = force_runs(name, r.by, r.on, r.where)
        words = "?" if r.magnitude is None else quantity(r.magnitude, units.force)
        force = (r.force[0] or 0.0, r.force[1] or 0.0, r.force[2] or 0.0)
        couple = (r.couple[0] or 0.0, r.couple[1] or 0.0, r.couple[2] or 0.0)
        text: tuple[Run, ...] = (*low, Run(f" = {words}"))
        if r.moment:
            text = (*text, Run(f", M = {quantity(r.moment, units.torque)}"))
        yield f"reaction-{name}-on-{r.on}", text, force, couple, ("reaction", r.at)
    for push in sketch.scene.loads:
        if link in (push.link, push.against):
            sign = 1.0 if link == push.link else -1.0
            runs = (
                *name_runs(push.name),
                Run(" = ?" if push.value is None else f" = {quantity(abs(push.value), push.unit)}"),
            )
            carried = sketch.scene.carried(link)
            place = push.at or (carried[0] if carried else (0.0, 0.0, 0.0))
            kind = "unknown" if push.unknown else "known"
            yield (
                f"body-load-{push.name}-on-{link}",
                runs,
                times(sign, push.force),
                times(sign, push.couple),
                (kind, place),
            )


def _panel(sketch: Sketch, link: str, pushes: Sequence[On], largest: float) -> list[Mark]:
    part = body_part(sketch, link)
    solid = outline_of(sketch, link)
    parts = [part]
    for name, words, force, couple, (kind, place) in pushes:
        at = sketch.at(place)
        marks: tuple[Mark, ...] = ()
        far, soft = at, []
        if size(force) > 1e-9 * largest:
            direction = times(1.0 / size(force), force)
            marks, far = vector(at, direction, ARROW * size(force) / largest, kind, solid)
            soft.append(along_arrow(at, far))
        if size(couple):
            more, end = vector(at, times(1.0 / size(couple), couple), 0.6 * ARROW, kind, solid, double=True)
            marks, far = (*marks, *more), (far if far != at else end)
            soft.append(along_arrow(at, end))
        label = Label(f"label-{name}", words, f"t-{kind}", 12.5, (far, at), 7.0)
        group = (Group(name, "", marks, plain_text(words)),) if marks else ()
        parts.append(Part(group, tuple(soft), (around(at, 2.8),), (label,)))
    window = bounds(together(parts).marks)
    found = [_renamed(link, mark) for mark in with_labels(together(parts), window)]
    return [Group(f"body-{link}", "", tuple(found), f"link {link} by itself")]


def _renamed(link: str, mark: Mark) -> Mark:
    own = ("reaction-", "body-", "label-reaction", "label-body")
    if isinstance(mark, Group) and mark.name and not mark.name.startswith(own):
        return mark._replace(name=f"free-{link}-{mark.name}")
    return mark
