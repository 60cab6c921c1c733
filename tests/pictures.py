"""What an SVG drawing shows, read back from its text: where its labels and its joints are."""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import combinations
from typing import NamedTuple
from xml.etree import ElementTree

import shapely

from icsolve.draw.marks import LOW, text_width

SVG = "{http://www.w3.org/2000/svg}"


class Label(NamedTuple):
    """A text and the rectangle that it fills."""

    text: str
    kind: str
    box: shapely.Polygon


class Picture(NamedTuple):
    """A parsed drawing."""

    root: ElementTree.Element
    labels: tuple[Label, ...]
    joints: tuple[shapely.Geometry, ...]
    view: shapely.Polygon

    @property
    def ids(self) -> list[str]:
        """Every id, in order."""
        return [e.attrib["id"] for e in self.root.iter() if "id" in e.attrib]

    def texts(self, kind: str = "") -> list[str]:
        """What the texts of a class say."""
        return [label.text for label in self.labels if kind in ("", label.kind)]


def parsed(svg: str) -> Picture:
    """A drawing from its text; raises where it is no XML."""
    root = ElementTree.fromstring(svg)
    left, top, width, height = map(float, root.attrib["viewBox"].split())
    joints = [circle(e) for e in root.iter(f"{SVG}circle") if e.attrib["class"] in JOINTS]
    view = shapely.box(left, top, left + width, top + height)
    texts = (e for e in root.iter(f"{SVG}text") if "halo" not in e.attrib["class"])
    return Picture(root, tuple(map(label, texts)), tuple(joints), view)


JOINTS = ("pin", "primary", "secondary")


def circle(element: ElementTree.Element) -> shapely.Geometry:
    """The disc of a circle element."""
    x, y, r = (float(element.attrib[key]) for key in ("cx", "cy", "r"))
    return shapely.Point(x, y).buffer(r)


def label(element: ElementTree.Element) -> Label:
    """A text element with the rectangle from its baseline up, by the widths that the drawing reckons with."""
    size = float(element.attrib["font-size"])
    width = text_width(element.text or "", size)
    for part in element:
        small = LOW if "font-size" in part.attrib else 1.0
        width += text_width(part.text or "", size * small) + text_width(part.tail or "", size)
    x, y = float(element.attrib["x"]), float(element.attrib["y"])
    left = {"start": x, "middle": x - width / 2, "end": x - width}[element.attrib.get("text-anchor", "start")]
    box = shapely.box(left, y - 0.78 * size, left + width, y + 0.1 * size)
    return Label("".join(element.itertext()), element.attrib["class"], box)


def overlaps(picture: Picture) -> list[str]:
    """Labels that touch another label or a joint (a tenth of a unit is the rounding of the file)."""
    found = []
    for a, b in combinations(picture.labels, 2):
        if a.box.buffer(-0.1).intersects(b.box):
            found.append(f"{a.text!r} on {b.text!r}")
    for one in picture.labels:
        box = one.box.buffer(-0.1)
        found += [f"{one.text!r} on a joint" for joint in picture.joints if box.intersects(joint)]
    return found


def on_arrows(picture: Picture) -> list[str]:
    """Labels that cover the head or the line of an arrow."""
    kinds = ("known", "unknown", "velocity", "reaction")
    arrows = [shape for kind in kinds for shape in shapes(picture, kind)]
    return [one.text for one in picture.labels for arrow in arrows if one.box.buffer(-0.8).intersects(arrow)]


def shapes(picture: Picture, kind: str) -> Iterable[shapely.Geometry]:
    """The straight lines of a class, and its heads."""
    for element in picture.root.iter(f"{SVG}path"):
        points = list(coordinates(element))
        if element.get("class") == f"{kind}-head":
            yield shapely.Polygon(points)
        elif element.get("class") == kind and "A" not in element.attrib["d"]:
            yield shapely.LineString(points)


def outside(picture: Picture) -> list[str]:
    """Shapes and texts that leave the view."""
    view = picture.view.buffer(0.01)
    found = [one.text for one in picture.labels if not view.covers(one.box)]
    for element in picture.root.iter():
        points = list(coordinates(element))
        if points and not view.covers(shapely.MultiPoint(points)):
            found.append(element.tag.removeprefix(SVG) + " " + element.attrib.get("class", ""))
    return found


def coordinates(element: ElementTree.Element) -> Iterable[tuple[float, float]]:
    """The corners of a path, the extremes of a circle."""
    if element.tag == f"{SVG}circle":
        yield from zip(*[iter(circle(element).bounds)] * 2, strict=True)
    if element.tag == f"{SVG}path":
        for x, y in re.findall(r"(-?[\d.]+),(-?[\d.]+)(?! 0 [01])", element.attrib["d"]):
            yield float(x), float(y)
