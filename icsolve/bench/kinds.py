"""Random mechanisms with joints of all kinds."""

from __future__ import annotations

from random import Random

from icsolve.bench.sheet import Sheet, torques


def all_joints(rng: Random) -> str:
    """A crank or a block, and two groups on it by joints of any kind: four to eight links."""
    sheet = Sheet(rng)
    if rng.random() < 0.7:
        sheet.pin(1, sheet.link())
    else:
        _slide(sheet, 1, sheet.link())
    for _ in range(2):
        rng.choice([_dyad, _dyad, _lever, _wheel])(sheet)
    return sheet.text(torques(sheet.links, 2) if rng.random() < 0.5 else _forces(sheet))


def _forces(sheet: Sheet) -> str:
    """A known force on the last link, a force to find on the first that moves."""
    at, to = sheet.spot(), sheet.spot()
    known = f"K: {{force: 7.5, link: {sheet.links}, at: [{at[0]}, {at[1]}], angle: {sheet.angle()}}}"
    return f"{known}, U: {{force: unknown, link: 2, at: [{to[0]}, {to[1]}], angle: {sheet.angle()}}}"


def _slide(sheet: Sheet, i: int, j: int) -> None:
    one, two = sheet.rng.sample((i, j), 2)
    at = sheet.point()
    sheet.joints.append(f"  - {{slide: [{one}, {two}], at: {at}, along: {sheet.angle()}}}")


def _full(sheet: Sheet, i: int, j: int) -> None:
    """A joint that leaves one freedom."""
    kind = sheet.rng.choice(("pin", "pin", "slide", "roll", "centre"))
    if kind == "slide":
        _slide(sheet, i, j)
    elif kind == "pin":
        sheet.pin(i, j)
    else:
        sheet.joints.append(f"  - {{{kind}: [{i}, {j}], at: {sheet.point()}}}")


def _half(sheet: Sheet, i: int, j: int) -> None:
    """A joint that leaves two."""
    one, two = sheet.rng.sample((i, j), 2)
    at = sheet.point()
    if sheet.rng.random() < 0.5:
        sheet.joints.append(f"  - {{slot: [{one}, {two}], at: {at}, along: {sheet.angle()}}}")
    else:
        sheet.joints.append(f"  - {{contact: [{one}, {two}], at: {at}, normal: {sheet.angle()}}}")


def _two(sheet: Sheet) -> tuple[int, int]:
    i, j = sheet.rng.sample(range(1, sheet.links + 1), 2)
    return i, j


def _dyad(sheet: Sheet) -> None:
    """Two links by three full joints, the first of them a pin."""
    (i, j), a, b = _two(sheet), sheet.link(), sheet.link()
    sheet.pin(i, a)
    _full(sheet, a, b)
    _full(sheet, b, j)


def _lever(sheet: Sheet) -> None:
    """One link on another, driven by a third through a slot or a contact."""
    (i, j), a = _two(sheet), sheet.link()
    _full(sheet, i, a)
    _half(sheet, j, a)


def _wheel(sheet: Sheet) -> None:
    """Two wheels on the frame, the first driven by a link through a rod."""
    rng, a, rod, b = sheet.rng, sheet.link(), sheet.link(), sheet.link()
    sheet.pin(1, a)
    sheet.pin(rng.randrange(2, a), rod)
    sheet.pin(rod, a)
    sheet.pin(1, b)
    teeth = f"{rng.randrange(12, 40)}, {rng.choice((1, -1)) * rng.randrange(41, 90)}"
    if rng.random() < 0.6:
        sheet.joints.append(f"  - {{gears: [{a}, {b}], teeth: [{teeth}]}}")
    else:
        radii = f"{rng.uniform(0.2, 0.9):.3f}, {rng.uniform(0.2, 0.9):.3f}"
        sheet.joints.append(
            f"  - {{belt: [{a}, {b}], radii: [{radii}], crossed: {'true' if a % 2 else 'false'}}}"
        )


def geared_five_bar(rng: Random) -> str:
    """Two cranks that gears on the frame join, and two rods."""
    sheet = Sheet(rng)
    for i, j in ((1, 2), (2, 3), (3, 4), (4, 5), (5, 1)):
        sheet.pin(i, j)
    teeth = f"{rng.randrange(12, 60)}, {rng.choice((1, -1)) * rng.randrange(61, 120)}"
    sheet.joints.append(f"  - {{gears: [2, 5], teeth: [{teeth}], carrier: 1}}")
    return sheet.text(torques(4, 2))


def coupler_slot(rng: Random) -> str:
    """A four-bar with a slot in its coupler that drives a lever's pin."""
    sheet = Sheet(rng)
    for i, j in ((1, 2), (2, 3), (3, 4), (4, 1)):
        sheet.pin(i, j)
    sheet.joints.append(f"  - {{slot: [5, 3], at: {sheet.point()}, along: {sheet.angle()}}}")
    sheet.pin(5, 1)
    return sheet.text(torques(5, 2))
