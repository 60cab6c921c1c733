"""The pictures of a page as inline SVG: the figure, whose marks are told what they follow, so that the script
of the page moves each (`Follows`); circle diagram, the plots with their cursors, the track of the slider."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from icsolve.case.joints import Guided
from icsolve.draw.centres import circle_marks
from icsolve.draw.figure import genevas, mechanism_of, scene_over, used_points
from icsolve.draw.frame import point_parts
from icsolve.draw.links import guide_in_picture
from icsolve.draw.loads import load_parts
from icsolve.draw.marks import Box, Mark, MarkGroup, Point, TextMark, bounds
from icsolve.draw.place import Label
from icsolve.draw.plot import PlotFrame, PlottedCurve, plot_marks
from icsolve.draw.ropes import RopeCourse
from icsolve.draw.scene import Scene, around, placed_labels, together
from icsolve.draw.svg import element, number
from icsolve.draw.words import description, figure_number
from icsolve.page.motion import PageMotion
from icsolve.page.poses import FINE, Array, compact, moved
from icsolve.report.derivation.known import Known
from icsolve.report.derivation.ratios import Step
from icsolve.tuples import NamedTuple
from icsolve.wording import escaped, unit_of

ROOM = (430.0, 350.0)
"""The largest that the mechanism is drawn, through all its positions."""


class PageFigure(NamedTuple):
    """The marks of a page's figure, its scene and its window, its ropes as written."""

    scene: Scene
    marks: tuple[Mark, ...]
    window: Box
    ropes: tuple[RopeCourse, ...]


def figure_of(known: Known, steps: Sequence[Step], motion: PageMotion | None) -> PageFigure:
    """The figure in its position as written, without its centres, which the script of the page draws."""
    scene = _scene(known, steps, motion)
    mechanism = mechanism_of(scene, moving=True)
    under = together(mechanism.parts)
    over = together([*load_parts(scene, mechanism.filled), *point_parts(scene)])
    whole = together([under, over])
    going = whole._replace(labels=tuple(label for label in whole.labels if label.follows))
    placed = [_told(label, marks) for label, marks in placed_labels(going, scene.view.window)]
    layers = (
        MarkGroup("mechanism", "", under.marks),
        MarkGroup("centres", "", ()),
        MarkGroup("loads", "", over.marks),
        MarkGroup("labels", "", tuple(placed)),
    )
    left, top, right, bottom = bounds(layers)
    a, b, c, d = scene.view.window
    window = (min(a, left), min(b, top), max(c, right), max(d, bottom))
    return PageFigure(scene, layers, window, mechanism.ropes)


def _told(label: Label, group: MarkGroup) -> MarkGroup:
    """A label that tells what it follows, and from where."""
    x, y = next(mark.at for mark in group.marks if isinstance(mark, TextMark))
    name = f"link-{label.name}" if label.badge else label.name  # the fields of the page are number-PATH
    follows = (*label.follows, ("x", f"{x:.1f}"), ("y", f"{y:.1f}"))
    return group._replace(name=name, kind="label", follows=follows)


def _scene(known: Known, steps: Sequence[Step], motion: PageMotion | None) -> Scene:
    """The scene in a view that holds all positions."""
    if motion is None:
        return scene_over(known, steps, room=ROOM)
    used = used_points(known.case) & motion.found.points.keys()
    ways = [_box(*motion.found.points[p][motion.rows].T) for p in used]
    ways += [around(wheel.centre, wheel.radius) for wheel in genevas(known)]

    def swept(link: str, p: Point, reach: float) -> Box:
        pose = motion.poses.get(link)
        if pose is None:
            return around(p, reach)
        xs, ys = moved(pose, known.points[pose.point], p)
        left, low, right, high = _box(xs[motion.rows], ys[motion.rows])
        return left - reach, low - reach, right + reach, high + reach

    scene = scene_over(known, steps, swept, ways, ROOM)
    return scene._replace(travel=travel_of(scene, motion))


def _box(x: Array, y: Array) -> Box:
    return (float(x.min()), float(y.min()), float(x.max()), float(y.max()))


def travel_of(scene: Scene, motion: PageMotion) -> dict[tuple[str, Point], tuple[float, float]]:
    """How far each joint's place goes along its guide, in picture units (see `Scene`)."""
    found: dict[tuple[str, Point], tuple[float, float]] = {}
    for joint in scene.joints():
        if isinstance(joint, Guided) and joint.at in motion.found.points:
            u = guide_in_picture(scene, joint)
            found[(joint.links[1], scene.known.points[joint.at])] = _along(
                scene, motion, joint.links[1], joint.at, u
            )
        if not joint.stays_known and not joint.stands_in and joint.at in motion.found.points:
            for edge in scene.round.edges:
                if edge.at == scene.known.points[joint.at]:
                    u = (edge.normal[1], edge.normal[0])
                    found[(edge.link, edge.at)] = _along(scene, motion, edge.link, joint.at, u)
    return found


def _along(scene: Scene, motion: PageMotion, link: str, point: str, u: Point) -> tuple[float, float]:
    """The least and largest way of a point along a direction of a link, from its place as written."""
    rows = motion.rows
    x, y = motion.found.points[point][rows].T
    pose = motion.poses.get(link)
    x0, y0 = scene.known.points[point]
    if pose is None:
        dx, dy = x - x0, y - y0
    else:
        turn = np.radians(-pose.angle[rows])
        rx, ry = x - pose.x[rows], y - pose.y[rows]
        px, py = scene.known.points[pose.point]
        dx = np.cos(turn) * rx - np.sin(turn) * ry + px - x0
        dy = np.sin(turn) * rx + np.cos(turn) * ry + py - y0
    way = (dx * u[0] - dy * u[1]) * scene.view.scale
    return min(float(way.min()), 0.0), max(float(way.max()), 0.0)


# --- plots ---------------------------------------------------------------------------------------------


SIZE = (440.0, 250.0)
MOST = 3
"""So many curves are told apart in one plot."""


class Plot(NamedTuple):
    """A plot's marks with their view, its heading, and what the cursor needs: frame and values."""

    heading: str
    marks: tuple[Mark, ...]
    view: tuple[float, float, float, float]
    frame: PlotFrame
    curves: tuple[PlottedCurve, ...]


def plots_of(known: Known, motion: PageMotion) -> list[Plot]:
    """The answer and the mechanical advantage; without an unknown load the ratios of the rates."""
    x = motion.degrees[motion.rows].tolist()
    dead = motion.dead
    found = [
        ("The answer" if len(some) == 1 else "The answers", some) for some in _answers(known, motion, dead)
    ]
    advantage = _advantage(known, motion, dead)
    found += [("Mechanical advantage", advantage)] if advantage else []
    rates = [] if motion.found.answers else _rates(known, motion)
    found += [("Ratios of angular velocities", rates)] if rates else []
    found += _dynamics(known, motion) if motion.found.accelerations else []
    axis = f"link {motion.driver} {motion.by.verb} from the position as written, {motion.by.unit_name}"
    return [_plot(heading, x, curves, axis) for heading, curves in found]


def _rows(motion: PageMotion, column: Array) -> list[float]:
    found: list[float] = column[motion.rows].tolist()
    return found


def _answers(known: Known, motion: PageMotion, dead: Sequence[float]) -> list[list[PlottedCurve]]:
    """The curves of the unknown loads, those of one unit together."""
    units = {load.name: unit_of(load, known.case) for load in known.case.loads}
    curves = []
    for name, column in motion.found.answers.items():
        if name in motion.found.holds:
            low, high = motion.found.holds[name].T
            curves.append(PlottedCurve(f"{name}, least", _rows(motion, low), units[name]))
            curves.append(PlottedCurve(f"{name}, most", _rows(motion, high), units[name]))
        else:
            curves.append(PlottedCurve(name, _rows(motion, column), units[name], dead))
    kinds = dict.fromkeys(curve.unit for curve in curves)
    return [[c for c in curves if c.unit == unit][:MOST] for unit in kinds]


def _advantage(known: Known, motion: PageMotion, dead: Sequence[float]) -> list[PlottedCurve]:
    """The unknown load over each known one: what a unit of it asks."""
    if len(motion.found.answers) != 1:
        return []
    (name,) = motion.found.answers
    units = {load.name: unit_of(load, known.case) for load in known.case.loads}
    curves = []
    for other, share in motion.shares.items():
        unit = "" if units[name] == units[other] else f"{units[name]} per {units[other]}"
        curves.append(PlottedCurve(f"{name}/{other}", _rows(motion, -share), unit, dead))
    same = [curve for curve in curves if curve.unit == curves[0].unit]
    return same[:MOST]


def _rates(known: Known, motion: PageMotion) -> list[PlottedCurve]:
    rates = motion.found.rates
    with np.errstate(all="ignore"):
        return [
            PlottedCurve(f"w{link}/w{motion.driver}", _rows(motion, rates[link] / rates[motion.driver]), "")
            for link in known.case.links
            if link in rates and link not in (known.case.ground, motion.driver) and np.any(rates[link])
        ][:MOST]


def _dynamics(known: Known, motion: PageMotion) -> list[tuple[str, list[PlottedCurve]]]:
    """How fast links turn and points move under the given motion, and their accelerations."""
    found, length = motion.found, known.case.units.length
    link_rates = {f"w{link}": rate for link, rate in found.rates.items()}
    link_changes = {f"alpha{link}": rate for link, rate in found.angular_accelerations.items()}
    sizes = [
        {f"{kind}{name.split()[0]}": np.hypot(*column.T) for name, column in columns.items()}
        for kind, columns in (("v", found.velocities), ("a", found.accelerations))
    ]
    kinds = (
        ("Angular velocities", link_rates, "rad/s"),
        ("Angular accelerations", link_changes, "rad/s^2"),
        ("Speeds of points", sizes[0], f"{length}/s"),
        ("Accelerations of points", sizes[1], f"{length}/s^2"),
    )
    drawn = (
        (heading, [PlottedCurve(n, _rows(motion, c), unit) for n, c in columns.items() if np.any(c != 0.0)])
        for heading, columns, unit in kinds
    )
    return [(heading, curves[:MOST]) for heading, curves in drawn if curves]


def _plot(heading: str, x: Sequence[float], curves: Sequence[PlottedCurve], axis: str) -> Plot:
    frame, marks = plot_marks(x, curves, axis, (0.0, 0.0), SIZE)
    return Plot(heading, tuple(marks), bounds(marks, 8.0), frame, tuple(curves))


def plot_data(plot: Plot) -> dict[str, Any]:
    """What the script of the page needs to place a cursor."""
    frame = plot.frame
    return {
        "box": [round(v, 2) for v in (frame.left, frame.top, frame.right, frame.bottom)],
        "x": list(frame.x),
        "dots": [{"x": {"v": []}, "y": _heights(frame, curve)} for curve in plot.curves],
    }


def _heights(frame: PlotFrame, curve: PlottedCurve) -> dict[str, Any]:
    """Where the cursor's dot is on a curve, picture units; beyond the frame it is not shown."""
    low, high = frame.y
    values = np.array(curve.values, float)
    up = (values - low) / (high - low)
    height = np.where((up >= 0.0) & (up <= 1.0), frame.bottom - up * (frame.bottom - frame.top), np.nan)
    return compact(height, FINE["px"])


# --- pictures --------------------------------------------------------------------------------------------


ALWAYS = frozenset(("paper", "primary", "secondary", "construction", "far", "t-centre", "plot"))
"""Classes of what the script draws."""
LARGE = 1.3
"""Pictures are shown at most so many times as large as they were measured."""


def svg(marks: Iterable[Mark], box: Box, name: str, title: str, more: str = "", largest: float = 1.0) -> str:
    """Marks as an SVG element of the page, at most so many times their size."""
    left, top, right, bottom = box
    view = " ".join(map(number, (left, top, right - left, bottom - top)))
    body = "\n".join(element(mark) for mark in marks)
    width, height = number(largest * (right - left)), number(largest * (bottom - top))
    role = "group" if name == "figure" else "img"  # the figure has handles
    return (
        f'<svg class="ic" id="{name}" viewBox="{view}" width="{width}" height="{height}" role="{role}"'
        f' aria-label="{escaped(title)}">'
        f"{more}\n{body}\n</svg>"
    )


def figure_svg(known: Known, figure: PageFigure) -> str:
    """The figure; what the script draws is clipped to its window."""
    left, top, right, bottom = figure.window
    width, height = number(right - left), number(bottom - top)
    clip = (
        f'<defs><clipPath id="window"><rect x="{number(left)}" y="{number(top)}" width="{width}"'
        f' height="{height}"/></clipPath></defs>'
    )
    return svg(figure.marks, figure.window, "figure", description(known), clip, LARGE)


def still_svg(known: Known) -> tuple[str, tuple[Mark, ...]]:
    """The figure of a case in space."""
    from icsolve.draw.space import space_marks

    _, marks = space_marks(known)
    return svg(marks, bounds(marks, 10.0), "figure", description(known)), tuple(marks)


def circle_svg(known: Known, steps: Sequence[Step]) -> tuple[str, tuple[Mark, ...]]:
    """The Kennedy circle diagram, with the triangles of every step."""
    marks = tuple(circle_marks(known, steps, (0.0, 0.0), each=True))
    title = "Kennedy circle diagram: the links, and a chord for every centre that is known"
    return svg(marks, bounds(marks, 4.0), "circle-figure", title, largest=1.1), marks


def plot_svg(plot: Plot, n: int) -> str:
    """A plot with its cursor."""
    names = ", ".join(curve.name for curve in plot.curves)
    dots = "".join('<circle class="cursor-dot" r="4"/>' for _ in plot.curves)
    title = f"{plot.heading}: {names} over the range of the input"
    text = svg(plot.marks, plot.view, f"plot-{n}", title, largest=LARGE)
    return text.removesuffix("</svg>") + f'<path class="cursor" d=""/>{dots}</svg>'


def track_svg(motion: dict[str, Any]) -> str:
    """The range of the input under the slider: where it can be, dead centres, where the links do not meet."""
    low, high = motion["low"], motion["high"]
    first, last = motion["first"], motion["first"] + motion["step"] * (motion["rows"] - 1)

    def share(degrees: float) -> str:
        return number(100.0 * (degrees - low) / (high - low)) + "%"

    def bar(kind: str, start: float, end: float) -> str:
        width = number(100.0 * (end - start) / (high - low))
        return f'<rect class="{kind}" x="{share(start)}" y="2" width="{width}%" height="10"/>'

    gaps = [bar("gap", a, b) for a, b in ((low, first), (last, high)) if b - a > 1e-9]
    dead = [
        f'<line class="dead" data-at="{at!r}" x1="{share(at)}" x2="{share(at)}" y1="0" y2="14"/>'
        for at in motion["dead"]
    ]
    ticks = []
    for degrees in _ticks(low, high) if motion["verb"] == "turned" else (low, 0.5 * (low + high), high):
        x = share(degrees)
        anchor = "start" if degrees == low else "end" if degrees == high else "middle"
        ticks.append(f'<line class="tick" x1="{x}" x2="{x}" y1="12" y2="17"/>')
        told = escaped(figure_number(degrees) + motion["unit"])
        ticks.append(f'<text x="{x}" y="28" text-anchor="{anchor}">{told}</text>')
    hatch = (
        '<defs><pattern id="hatch" width="6" height="6" patternUnits="userSpaceOnUse"'
        ' patternTransform="rotate(45)"><path class="hatch" d="M0,0 V6"/></pattern></defs>'
    )
    parts = "".join((hatch, bar("bar", first, last), *gaps, *dead, *ticks))
    return f'<svg class="track" width="100%" height="32" aria-hidden="true">{parts}</svg>'


def _ticks(low: float, high: float) -> list[float]:
    """Four to nine round numbers of degrees."""
    step = next(
        s
        for s in (90.0, 60.0, 45.0, 30.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.5)
        if (high - low) / s >= 3.99 or s == 0.5
    )
    return [k * step for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]
