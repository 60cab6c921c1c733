"""What `links:` says of a link: further points of it, its mass, its centre of mass, its moment of inertia."""

from __future__ import annotations

from icsolve.case import Inertia
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.entry import Entry
from icsolve.read.geometry import read_carried
from icsolve.read.problems import shown
from icsolve.read.reading import Reading

KEYS = ("points", "mass", "centre", "inertia")
_FORM = "as in {points: [G, H], mass: 2 kg, centre: G, inertia: 0.04 kg*m^2}"


def read_links(
    reading: Reading, section: Mapping
) -> tuple[dict[str, tuple[str, ...]], dict[str, Inertia]]:
    """Further points of links, and the masses of those that have one."""
    listed: dict[str, Node] = {}
    found: dict[str, Inertia] = {}
    for key, node in section.items.items():
        listed[key] = node
        if type(node) is not Mapping:
            continue
        listed[key] = node.items.get("points", Sequence([], node.mark))
        inertia = _inertia(Entry(reading, node, f"links.{key}", f"link {shown(key)}"))
        if inertia is not None and reading.knows_link(key):
            found[key] = inertia
    points = read_carried(reading, Mapping(listed, section.keys, section.mark))
    for link, inertia in found.items():
        if inertia.centre is not None and link in points:
            points[link] = tuple(dict.fromkeys((*points[link], inertia.centre)))
    return points, found


def _inertia(entry: Entry) -> Inertia | None:
    """The mass of a link; None where it has none, or it can't be read."""
    entry.only(*KEYS)
    if not entry.has("mass") and not entry.has("inertia"):
        if entry.has("centre"):
            entry.refuse(entry.mark("centre"), f"{entry.what} has a centre of mass and no 'mass'; give it")
        return None
    if entry.has("mass"):
        entry.need("centre", "its centre of mass, a point of the link, as in {mass: 2 kg, centre: G}")
    centre = entry.point("centre")
    mass = entry.number("mass", "mass", "not negative")
    moment = entry.number("inertia", "moment of inertia", "not negative")
    read = all(value is not None for key, value in (("mass", mass), ("inertia", moment)) if entry.has(key))
    return Inertia(mass, centre, moment) if read and (centre or mass is None) else None


def read_dynamic(reading: Reading, node: Node | None) -> bool:
    """Whether the case asks for inertia forces."""
    if node is None:
        return False
    word = node.text.lower() if type(node) is Scalar else ""
    if word not in ("yes", "no", "true", "false"):
        reading.refuse(node.mark, "'dynamic' should be yes or no: whether inertia forces are among the loads")
    return word in ("yes", "true")
