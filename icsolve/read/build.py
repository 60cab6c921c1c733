"""The sections of a file, in the order in which each needs what others name, to a Case."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from icsolve.case import Case, Centroid, Joint, Number, Rope, Units
from icsolve.read.document import Mapping, Node, Scalar, Sequence, is_null
from icsolve.read.figure import (
    check_given,
    check_unknowns,
    guides_without_line,
    read_angles,
    read_dynamic,
    read_lengths,
    read_links,
    read_near,
    read_points,
    small_angles,
    stray_points,
)
from icsolve.read.joints import JOINTS, mention_links, read_joints
from icsolve.read.keys import LOADS, SECTIONS, SPACE_JOINTS
from icsolve.read.loads import PLANE, driven, read_motion, read_section
from icsolve.read.names import Problems, meant_by, shown
from icsolve.read.owners import (
    FRAMES,
    FigureData,
    carried,
    check_frame,
    check_guides,
    check_loads,
    with_masses,
)
from icsolve.read.reading import Reading, number

if TYPE_CHECKING:
    from icsolve.case.expected import Expected, Tolerance
    from icsolve.case.profiles import Profiles

NO_CASE = "this is not an icsolve case: it has no 'icsolve: 1' at its top"
TEXTS = ("title", "source", "reconstructed")


def build(root: Mapping, problems: Problems, name: str, units: Units) -> Case:
    """The case of a planar tree; whether it may be used, the problems tell."""
    reading = Reading(problems, units)
    reading.marks.update(root.keys)
    reading.check_keys(root, SECTIONS, "a case", _elsewhere)
    mention_links(reading, root.items.get("joints"))
    ground = ground_of(reading, root)
    parts, shaped = _parts(reading, root)
    joints, loads, motion = parts["joints"], parts["loads"], parts["motion"]
    check_frame(reading, "ground" in root.items, ground, [one.links for one in joints if not one.freedom])
    check_unknowns(reading, loads)
    if readable(root, "points", "lengths", "angles"):
        check_given(reading)
        figure = FigureData(joints, parts["lengths"], parts["angles"], parts["points"], shaped)
        if not reading.problems.found:
            given = (loads, motion, parts["inertia"], parts["expect"])
            reading.noticed += check_loads(reading, root, figure, *given, ground)
            reading.noticed += check_guides(figure)
            reading.noticed += (*stray_points(reading, figure), *guides_without_line(reading, figure))
            reading.noticed += small_angles(figure)
    links = tuple(reading.links or ())
    return Case(
        **told_of_itself(reading, root, name, units, ground),
        **parts,
        carries=carried(links, ground, joints, loads, with_masses(shaped, parts["inertia"]), motion),
        gravity=_gravity(reading, root) or Case.gravity,
        directed=tuple(reading.directed),
        unknowns=tuple(reading.unknowns),
        dynamic=read_dynamic(reading, root.items.get("dynamic")),
        noticed=tuple(reading.noticed),
    )


def _elsewhere(key: str) -> str:
    """In which entries a key stands that is none of a case; '' where in none, or where a section is meant."""
    if meant_by(key, SECTIONS):
        return ""
    joints = [kind for kind, entry in JOINTS.items() if key in (kind, *entry.keys)]
    loads = [kind for kind, entry in LOADS.items() if key in (kind, *entry.keys)]
    where = [f"a {what}: {', '.join(kinds)}" for what, kinds in (("joint", joints), ("load", loads)) if kinds]
    return f"; it stands in {' or in '.join(where)}" if where else ""


def told_of_itself(reading: Reading, root: Mapping, name: str, units: Units, ground: str) -> dict[str, Any]:
    """What every case says of itself, in the plane and in space."""
    return {
        "name": name,
        "path": reading.problems.path,
        **{key: reading.text(root.items[key], key) for key in TEXTS if key in root.items},
        "units": units,
        "ground": ground,
        "links": tuple(reading.links or ()),
        "tolerance": _tolerance(reading, root),
        "marks": reading.marks,
    }


def is_in_space(root: Mapping) -> bool:
    """Whether points have three coordinates; one alone among planar joints is a slip, and read as planar."""
    points = root.items.get("points")
    if type(points) is not Mapping:
        return False
    counts = {len(node.items) for node in points.items.values() if type(node) is Sequence}
    if 3 not in counts:
        return False
    joints = root.items.get("joints")
    entries = joints.items if type(joints) is Sequence else []
    kinds = {key for entry in entries if type(entry) is Mapping for key in entry.items}
    return (
        2 not in counts
        or bool(kinds & (SPACE_JOINTS.keys() - JOINTS.keys()))
        or not kinds & (JOINTS.keys() - SPACE_JOINTS.keys())
    )


def _parts(reading: Reading, root: Mapping) -> tuple[dict[str, Any], dict[str, tuple[str, ...]]]:
    """The sections as fields of the case, and further points of links. Joints, loads and points first: their
    names tell how a key such as AB is read."""
    section = root.items.get("profile")
    reading.profiled = set(section.items) if type(section) is Mapping else set()
    listed = root.items.get("joints")
    if type(listed) is Sequence and any("screw" in n.items for n in listed.items if type(n) is Mapping):
        reading.driven = driven(root.items.get("loads"))
    joints, ropes = _joints(reading, root)
    profiles = None
    if section is not None:
        from icsolve.read.profiles import read_profiles

        profiles = read_profiles(reading, section_of(reading, root, "profile"))
    points = read_points(reading, section_of(reading, root, "points"))
    listed_loads = section_of(reading, root, "loads")
    loads = read_section(reading, listed_loads, PLANE)
    if ropes:
        from icsolve.read.ropes import check_ends

        check_ends(reading, ropes, joints, listed_loads)
    links, inertia = read_links(reading, section_of(reading, root, "links"))
    near = read_near(reading, section_of(reading, root, "near"))
    motion = read_motion(reading, root.items["motion"]) if stands(root, "motion") else ()
    known = reading.given | set(reading.used) | _hyphened(root)
    lengths = read_lengths(reading, section_of(reading, root, "lengths"), known)
    angles = read_angles(reading, section_of(reading, root, "angles"), known)
    named = reading.given | set(reading.used)
    expect: tuple[Expected, ...] = ()
    if stands(root, "expect"):
        from icsolve.read.expect import read_expect

        published = section_of(reading, root, "expect")
        expect = read_expect(reading, published, named) if readable(root, "loads") else ()
    middles = {name: Centroid(ends) for name, ends in reading.middles.items()}
    points = {**points, **reading.hidden, **middles}
    fields: dict[str, Any] = {"points": points, "lengths": lengths, "angles": angles, "near": near}
    fields |= {"joints": joints, "loads": loads, "motion": motion, "inertia": inertia, "ropes": ropes}
    return fields | {"profiles": profiles, "expect": expect}, _shaped(links, ropes, profiles)


def check_version(root: Mapping, problems: Problems) -> None:
    """``icsolve: 1`` is the version that this program reads; of another one nothing is judged."""
    node = root.items.get("icsolve")
    if node is None:
        if not any(key.lower() == "icsolve" for key in root.items):  # else it is told what is meant
            problems.refuse(root.mark, NO_CASE)
    elif type(node) is not Scalar or node.text != "1":
        said = f"version {shown(node.text)}" if type(node) is Scalar and node.text else "this version"
        raise problems.stop(node.mark, f"{said} of the format is not known; this program reads 'icsolve: 1'")


def stands(root: Mapping, key: str) -> bool:
    """Whether a section holds something."""
    return key in root.items and not is_null(root.items[key])


def readable(root: Mapping, *keys: str) -> bool:
    """Whether these sections, where they stand, are mappings: else what they name is not known."""
    return all(not stands(root, key) or type(root.items[key]) is Mapping for key in keys)


def section_of(reading: Reading, root: Mapping, key: str, form: str = "") -> Mapping:
    """A section; empty where it is left out, holds nothing, or can't be read."""
    form = form or f"as in {SECTIONS[key].says.partition(' as in ')[2]}"
    found = reading.mapping(root.items[key], f"'{key}'", form) if stands(root, key) else None
    return found if found is not None else Mapping({}, {}, (1, 1))


def _joints(reading: Reading, root: Mapping) -> tuple[tuple[Joint, ...], tuple[Rope, ...]]:
    node = joint_list(reading, root, "{pin: [1, 2], at: A}")
    ropes: tuple[Rope, ...] = ()
    if any(type(item) is Mapping and "rope" in item.items for item in node.items):
        from icsolve.read.ropes import read_ropes

        ropes, node = read_ropes(reading, node)
    return read_joints(reading, node), ropes


def joint_list(reading: Reading, root: Mapping, example: str) -> Sequence:
    """The joints as they are listed; none, with the reason noted, where they are not."""
    node = root.items.get("joints")
    if type(node) is Sequence and node.items:
        return node
    mark = root.keys.get("joints", root.mark)
    if node is None or is_null(node) or type(node) is Sequence:
        reading.refuse(mark, f"the case has no joints; list them, as in joints: [{example}]")
    else:
        reading.refuse(node.mark, f"'joints' should be a list, each item as in - {example}")
    return Sequence([], mark)


def ground_of(reading: Reading, root: Mapping) -> str:
    """The frame; a joint must have it."""
    node = root.items.get("ground")
    if node is not None:
        return reading.link(node, "'ground'") or "1"
    if reading.links and "1" not in reading.links:
        likely = next((link for link in reading.links if link.lower() in FRAMES), None)
        how = f"write 'ground: {likely}'" if likely else "name it with 'ground:'"
        message = f"no joint has link 1, the frame; if another link is the frame, {how}"
        reading.refuse(root.keys["joints"], message)
    return "1"


def _gravity(reading: Reading, root: Mapping) -> Number | None:
    node = root.items.get("gravity")
    value = number(reading, node, "acceleration", "gravity") if node is not None else None
    if value is not None and node is not None and value.value < 0.0:
        reading.refuse(node.mark, "gravity is given by its size, along -y; it should not be negative")
    return value and value._replace(bound="not negative")


def _tolerance(reading: Reading, root: Mapping) -> Tolerance | None:
    """How far a student's answer may lie from the right one, where the case says so."""
    if not stands(root, "tolerance"):
        return None
    from icsolve.read.expect import read_tolerance

    return read_tolerance(reading, root.items["tolerance"])


def _hyphened(root: Mapping) -> set[str]:
    """Points that keys with hyphens name."""
    sections: list[Node | None] = [root.items.get("lengths"), root.items.get("angles")]
    keys = [key for node in sections if type(node) is Mapping for key in node.items if "-" in key]
    return {name for key in keys for name in key.split("-")}


def _shaped(
    links: dict[str, tuple[str, ...]], ropes: tuple[Rope, ...], profiles: Profiles | None
) -> dict[str, tuple[str, ...]]:
    """Further points of links: those of ``links:``, of ropes, and of profiles."""
    links = dict(links)
    for rope in ropes:
        for point, link in zip(rope.points, rope.links, strict=False):
            links[link] = (*links.get(link, ()), point)
    if profiles is None:
        return links
    from icsolve.case.profiles import points_of

    return links | {link: (*links.get(link, ()), *points_of(s)) for link, s in profiles.shapes.items()}
