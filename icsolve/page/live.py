"""The scene of a case as JavaScript, every number of figure and loads an input: a page as a laboratory.

The kernels of one scene run once on a record: the construction of the figure a step at a time, with the
branch of every step as an input, then the loop equations of the joints and the wrenches of the loads. The
page walks the steps, and eliminates with pivots of its own, so that what is singular there is seen there.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from itertools import count, pairwise
from typing import Any

from icsolve.assembly.conditions import CONDITIONS, InLine
from icsolve.assembly.loci import is_round
from icsolve.assembly.steps import Given, Mean, Meet, PointGroup, Step, aims, leading_to
from icsolve.assembly.workspace import (
    CORNER,
    LENGTH,
    LINE,
    MEAN,
    RAY,
    ROPE,
    Datum,
    Key,
    PlacedCase,
    Workspace,
    data_of,
    normalised,
    number_of,
)
from icsolve.case import Coordinates, Motion, Number, Rope, Screw, TorsionSpring, is_angle
from icsolve.case.figure import Unknown
from icsolve.case.joints import Guided, Mesh
from icsolve.draw.words import unit_word
from icsolve.kinematics.accelerations import Moving, drives_of, moving, rate_rows
from icsolve.kinematics.loops import Tree, loop_rows, rope_row, span
from icsolve.kinematics.motion import TURN, needed_bonds
from icsolve.kinematics.speeds import joint_order
from icsolve.numbers import HALF_TURN, Scalar
from icsolve.numbers.record import Record, Traced
from icsolve.numbers.source import JAVASCRIPT, straight_line
from icsolve.numbers.units import BOUNDS
from icsolve.page.fields import handles_of, text_data, units_to_write
from icsolve.report.derivation.known import Known
from icsolve.report.derivation.ratios import independent_motions
from icsolve.scene.parts import AnswerBuilder
from icsolve.scene.program import Evaluation, Program, Want, needed_points, prepare
from icsolve.scene.refusals import HANGS, rubs
from icsolve.screws import ORIGIN, Bases, Triple, force_wrench
from icsolve.screws.joints import OFF_RADIUS, at_radius, freedoms, guide_direction, held_centres
from icsolve.screws.ropes import TOUCHING, RopePart, rope_parts
from icsolve.statics import load_wrenches, power
from icsolve.statics.load_wrenches import COUPLE, FORCE, inertia_forces, is_loaded
from icsolve.structure import Bond, topology
from icsolve.structure.torn_points import owners_of_points, torn_points
from icsolve.sweep.program import wanted_points
from icsolve.sweep.varied_numbers import numbers_of
from icsolve.tuples import NamedTuple

SECTIONS = ("points", "lengths", "angles", "joints", "loads", "motion", "gravity", "links")
"""What is an input of the program."""


class Live(NamedTuple):
    """The program of a scene (JavaScript), and what the script of the page must know of it."""

    source: str
    data: dict[str, Any]


class WrittenProgram(NamedTuple):
    """A step of the construction on the record: the expressions that it gives, the first of them its points,
    and what the others are; ``start`` and ``end`` are the nodes that it made."""

    values: tuple[Scalar, ...]
    told: dict[str, Any]
    start: int
    end: int


def why_presolved(known: Known) -> str:
    """Why the numbers of a case can't be changed in its page, as a sentence; '' where they can."""
    case = known.case
    if known.answer is None:
        return "Nothing is solved for here that could follow other numbers."
    if case.space is not None:
        return "A case in space is solved beforehand, as it is written."
    for held, what in (
        (rubs(case), "With friction"),
        (known.answer.case.profiles is not None, "With cam profiles"),
        (len(known.posed) > 1 or known.written is not None, "Where such positions are asked for"),
    ):
        if held:
            return f"{what} every position is solved beforehand: the numbers are those of the case."
    groups = (step for step in _program(known).figure.steps if isinstance(step, PointGroup))
    if any(isinstance(equation, InLine) for group in groups for equation in group.equations):
        return "Points in line by three lengths are placed with others: the numbers are those of the case."
    return ""


def _program(known: Known) -> Program:
    scene = known.scene
    return prepare(known.case, Want(bodies=True)) if scene is None else scene.program


def live_of(known: Known) -> Live | None:
    """The scene of a case as a program; None where it has to be solved beforehand."""
    if why_presolved(known):
        return None
    live = _ProgramWriter(_program(known), known.scene).live()
    live.data["still"] = known.scene is None
    live.data["posed"] = [_posed(live.data, unknown) for unknown in known.posed]
    motions = () if known.structure else independent_motions(known)
    several = len(motions) > 1 and all(motion.turns for motion in motions)
    live.data["drivers"] = [motion.driver for motion in motions] if several else []
    return live


def _posed(data: dict[str, Any], unknown: Unknown) -> dict[str, Any]:
    """A datum that is asked for: its place among the inputs, and the range to search, of an angle a whole
    turn; it can't be pulled."""
    number = data["paths"].index(unknown.path)
    ends = [None if end is None else end.value for end in (unknown.low, unknown.high)]
    turns = is_angle(unknown.path)
    for name, moves in list(data["handles"].items()):
        data["handles"][name] = [move for move in moves if move[1] != number]
    data["handles"] = {name: moves for name, moves in data["handles"].items() if moves}
    return {"name": unknown.path, "number": number, "range": ends, "turns": turns}


def _moves(found: Evaluation) -> Moving:
    """The motion that is given, with as many digits as settle it."""
    place, motions, *_ = found.outcome
    return moving(place, motions.twists, motions.slack)


class _CountingRecord(Record):
    """A record on which every torsion spring has an input about which its turns are counted: where the page
    stands, or what the spring is free at where numbers are typed."""

    def __init__(self) -> None:
        super().__init__()
        self.follows = False
        self.springs: dict[tuple[int, int], tuple[Traced, Scalar, Traced]] = {}
        """by the nodes of an angle and what it is counted about: the angle with its turns, the latter, the
        input"""

    def key(self, x: Scalar, y: Scalar, about: Scalar) -> tuple[int, int]:
        """The nodes of a vector's angle and of what it is counted about."""
        return self.lifted(self.angle(x, y)).index, self.lifted(about).index

    def turns(self, x: Scalar, y: Scalar, about: Scalar = 0.0) -> Scalar:
        """By how much a vector has turned from +x, whole turns too: those nearest to an input [degrees]."""
        key = self.key(x, y, about)
        if key not in self.springs:
            angle, start = self.nodes[key[0]], self.input(f"about {len(self.springs)}", float(about))
            counted = angle + 360.0 * self.nearest((start - angle) / 360.0 - HALF_TURN)
            self.springs[key] = (self.lifted(counted), about, start)
        return self.springs[key][0]

    def round_it(self, signed: Scalar) -> Scalar:
        """The angle over which a rope lies on a pulley, of one within half a turn [degrees]."""
        return signed + 360.0 * self.nearest(0.5 - (signed + TOUCHING) / 360.0)


class _ProgramWriter:
    """A case on a record whose inputs are its numbers."""

    def __init__(self, program: Program, scene: AnswerBuilder | None) -> None:
        case = program.case
        self.scene = scene
        self.case, self.record = case, _CountingRecord()
        several = any(len(joint.links) > 2 for joint in case.joints)
        self.figure, self.top = program.figure, topology(case, as_ties=True) if several else program.top
        self.names: dict[int, str] = {}
        self.workspace = Workspace(case, self.figure.frame, self.record)
        numbers = numbers_of(case)
        self.paths = [path for path in numbers if path.partition(".")[0] in SECTIONS]
        for n, path in enumerate(self.paths):
            node = self.record.input(path, numbers[path].value)
            self.record.vary[path] = node
            self.names[node.index] = f"x[{n}]"
        self.order: list[Key] = []
        """the points in the order in which they are placed"""

    def live(self) -> Live:
        """The program, and the data about it."""
        placing = self.figure.steps
        needed = leading_to(wanted_points(self.case)[1], placing)
        steps = [self._written(step, needed) for step in placing]
        bases = {k: freedoms(bond, self._points(), self.record) for k, bond in enumerate(self.top.bonds)}
        top = self.top
        tree = span(top, sorted(bases), (top.ground,), bases, [group[0] for group in top.afloat])
        ends = [steps[-1].end if steps else 0]
        parts = {"scene": self._scene(bases, tree)}
        ends.append(len(self.record.nodes))
        tied = [datum for datum in data_of(self.case) if datum.kind == ROPE and self._is_placed(datum)]
        if tied:  # on what the scene has of the ropes
            parts["tied"] = [CONDITIONS[ROPE](self.workspace, datum, 0).value for datum in tied]
            ends.append(len(self.record.nodes))
        for name, made in self._dynamics() if is_loaded(self.case) else ():
            parts[name] = made
            ends.append(len(self.record.nodes))
        return Live(self._source(steps, parts, ends), self._data(steps, tree, bases))

    def _is_placed(self, datum: Datum) -> bool:
        return all(p in self.workspace.points for p in datum.points)

    def _points(self) -> Mapping[str, tuple[Scalar, Scalar]]:
        return {name: at for name, at in self.workspace.points.items() if isinstance(name, str)}

    def _place(self) -> PlacedCase:
        return PlacedCase(self.case, self.figure.frame, self._points(), self.record)

    # --- the figure -------------------------------------------------------------------------------

    def _written(self, step: Step, needed: Sequence[Step]) -> WrittenProgram:
        """A step, its branch an input."""
        start, ws = len(self.record.nodes), self.workspace
        told: dict[str, Any] = {} if step in needed or isinstance(step, Given) else {"spare": True}
        apart = self._squared_distances(step)
        if isinstance(step, Meet):
            more = self._meet(step, told)
        elif isinstance(step, PointGroup):
            more = self._group(step, told)
        else:
            step.place(ws)
            more = []
        told["p"] = [self._number(key) for key in step.targets]
        told["apart"] = len(apart)
        places = [part for key in step.targets for part in ws.points[key]]
        return WrittenProgram((*places, *apart, *more), told, start, len(self.record.nodes))

    def _number(self, key: Key) -> int:
        if key not in self.order:
            self.order.append(key)
        return self.order.index(key)

    def _squared_distances(self, step: Step) -> list[Scalar]:
        """The squared distances of points whose direction a step goes by."""
        found = []
        for a, b in aims(step):
            (ax, ay), (bx, by) = self.workspace.points[a], self.workspace.points[b]
            found.append((bx - ax) * (bx - ax) + (by - ay) * (by - ay))
        return found

    def _meet(self, step: Meet, told: dict[str, Any]) -> list[Scalar]:
        """Two loci, with what must not be negative; a branch is -1, 1 or 0, where a circle touches."""
        ws = self.workspace
        pair, found = step.loci(ws), step.crossing(ws)
        gaps = step.gaps(ws, *pair)[:3]
        ws.points[step.target] = found.middle
        if found.factors is None:
            told["lines"] = True
        else:
            sign = self.record.input(f"sign {len(self.order)}", float(step.sign))
            told["sign"] = step.sign
            self.names[sign.index] = f"s[{self._number(step.target)}]"
            root = self.record.sqrt(found.factors[0][0] * found.factors[1][0])
            ws.points[step.target] = found.at(sign * root)
            told["round"] = is_round(step.first)
        loci = [(*at, *(rest if isinstance(rest, tuple) else (rest,))) for at, rest in pair]
        told["gaps"], told["loci"] = len(gaps), [len(locus) for locus in loci]
        return [*gaps, *loci[0], *loci[1], *step.ahead(ws)]

    def _group(self, step: PointGroup, told: dict[str, Any]) -> list[Scalar]:
        """One step of Newton's method from where the page stands, and the residuals there."""
        ws = self.workspace
        for target, at in zip(step.targets, step.start, strict=True):
            nodes = [self.record.input(f"{target} {n}", float(part)) for n, part in enumerate(at)]
            for n, node in enumerate(nodes):
                self.names[node.index] = f"q[{2 * self._number(target) + n}]"
            ws.points[target] = (nodes[0], nodes[1])
            ws.starts = {**ws.starts, target: (nodes[0], nodes[1])}
        told["start"] = [list(at) for at in step.start]
        off = [equation.row(ws).value for equation in step.equations]
        step.place(ws)
        return off

    # --- motions and loads ------------------------------------------------------------------------

    def _scene(self, bases: Bases, tree: Tree) -> list[Any]:
        """Loop equations, the path of joints to every body, wrenches, basis twists, the parts of ropes, what
        screws turn by, and the angles of torsion springs with what these are free at."""
        roots = {self.top.ground: ORIGIN}
        rows = [row[:-1] for row in loop_rows(self.top, tree, bases, roots)]
        ropes = {rope.name: self._rope(rope) for rope in self.case.ropes}
        rows += [rope_row(self.top, tree, ropes[rope.name]) for rope in self.top.ropes]
        paths = [
            [[column, *basis] for column, basis in tree.branches[body].path]
            for body in range(len(self.top.members))
        ]
        loads = []
        for w in load_wrenches.wrenches(self._place()):
            loads.append([*w.unit, w.gain, w.ratio, load_wrenches.number_of(w, self.record)])
        freed = [[list(twist) for twist in basis] for _, basis in sorted(bases.items())]
        courses = [[[p.length, *p.wrench, *p.along] for p in parts] for parts in ropes.values()]
        threads = [self._thread(screw) for screw in self.case.screws]
        counted = list(self.record.springs.values())
        self.names |= {start.index: f"w[{n}]" for n, (*_, start) in enumerate(counted)}
        return [rows, paths, loads, freed, courses, threads, [[angle, free] for angle, free, _ in counted]]

    def _rope(self, rope: Rope) -> tuple[RopePart, ...]:
        return rope_parts(rope, self._points(), self.figure.frame.scale, self.record)

    def _thread(self, screw: Screw) -> list[Scalar]:
        """By how much a screw turns as its slide moves, along its two axes."""
        per = self.record.given(TURN) / (self.record.given(screw.thread.lead) * self.figure.frame.scale)
        return [per * part for part in guide_direction(screw.slide.guide, self._points(), self.record)]

    def _dynamics(self) -> Iterable[tuple[str, list[Any]]]:
        """What the rates of the twists fulfil, as places and values of each row; then the wrenches of the
        inertia forces. Twists and rates of the bodies are inputs."""
        assert self.scene is not None
        case, place = self.case, self._place()
        now = self.scene.scene.ask(_moves)
        twists = self._inputs("t", now.twists)
        rows, _ = rate_rows(place, twists, drives_of(place, {link: [t] for link, t in twists.items()}))
        yield "rates", [[[float(column), value] for column, value in row.items()] for row in rows]
        moves = Moving(twists, self._inputs("r", now.rates), frozenset())
        forces = inertia_forces(place, moves)
        found: list[Any] = []
        for load in case.loads:
            if load.name == FORCE.format(load.link):
                centre, force, _ = forces[load.link]
                assert centre is not None and force is not None
                found.append(force_wrench(force, place.points[centre]))
            elif load.name == COUPLE.format(load.link):
                found.append((0.0, 0.0, forces[load.link][2]))
        yield "inertia", found

    def _inputs(self, letter: str, by_link: Mapping[str, Triple]) -> dict[str, Triple]:
        """Triples of the bodies as inputs."""
        nodes: dict[int, Triple] = {}
        for link, triple in by_link.items():
            body = self.top.body_of[link]
            if body not in nodes:
                own = [self.record.input(f"{letter} {body} {n}", float(v)) for n, v in enumerate(triple)]
                self.names |= {node.index: f"{letter}[{3 * body + n}]" for n, node in enumerate(own)}
                nodes[body] = (own[0], own[1], own[2])
        return {link: nodes[self.top.body_of[link]] for link in by_link}

    # --- the program ------------------------------------------------------------------------------

    def _source(
        self, steps: Sequence[WrittenProgram], parts: Mapping[str, list[Any]], ends: Sequence[int]
    ) -> str:
        """The program: a function a step, and one for each of the other parts, which end at these nodes."""
        flat = [v for step in steps for v in step.values] + list(_leaves(list(parts.values())))
        wanted = [self.record.lifted(v).index for v in flat]
        constants: dict[float, str] = {}
        language = JAVASCRIPT._replace(number=lambda v: constants.setdefault(v, f"k{len(constants)}"))
        text = straight_line(self.record.nodes, wanted, self.names, language)
        given = iter(text.wanted)
        functions = []
        for step in steps:
            lines = [s for s, k in zip(text.lines, text.at, strict=True) if step.start <= k < step.end]
            values = ",".join(next(given) for _ in step.values)
            functions.append(f"()=>{{{''.join(lines)}return[{values}]}}")
        others = []
        for (name, made), (start, end) in zip(parts.items(), pairwise(ends), strict=True):
            lines = [s for s, k in zip(text.lines, text.at, strict=True) if start <= k < end]
            others.append(f"{name}: () => {{{''.join(lines)}return{_shaped(made, given)}}}")
        variables = f"let {','.join(text.names)};\n" if text.names else ""
        if constants:
            values = ",".join(map(repr, constants))
            variables += f"const [{','.join(constants.values())}]=[{values}].map(of);\n"
        steps_text = ",\n".join(functions)
        return (
            f"const program = ({{of, root, angle, nearest, turn}}, x, s, q, t, r, w) => {{\n{variables}"
            f"return {{ steps: [{steps_text}],\n{','.join(others)} }};\n}};\n"
        )

    def _data(self, steps: Sequence[WrittenProgram], tree: Tree, bases: Bases) -> dict[str, Any]:
        case, top, frame = self.case, self.top, self.figure.frame
        numbers = numbers_of(case)
        ground = [key for key in self.order if isinstance(key, str)]
        place = {key: n for n, key in enumerate(self.order)}
        for told in (step.told for step in steps):
            keys = [self.order[n] for n in told["p"]]
            if isinstance(keys[0], tuple):  # a shape on a cluster of its own, and its points in the figure
                told |= {"shape": keys[0][0], "own": [place.get(key[1], -1) for key in keys]}
        return {
            "points": {name: place[name] for name in ground},
            "steps": [step.told for step in steps],
            "near": {
                place[name]: list(normalised(frame, at)) for name, at in case.near.items() if name in place
            },
            "frame": list(frame),
            "unit": unit_word(case.units.length),
            "body": self._bodies(),
            "ropes": [self._rope_data(rope) for rope in case.ropes],
            "hangs": HANGS,
            "screws": [[*screw.links, place[screw.slide.at], screw.rotor] for screw in case.screws],
            "ground": top.ground,
            "bodies": len(top.members),
            "columns": tree.columns,
            "freedoms": top.freedoms_by_count,
            "checks": list(self._checks(place)),
            "paths": self.paths,
            "bounds": {own: BOUNDS[own] for own in sorted({"", *(numbers[p].bound for p in self.paths)})},
            "numbers": [numbers[path].value for path in self.paths],
            "exact": {n: exact for n, path in enumerate(self.paths) if (exact := _exact(numbers[path]))},
            "halves": [numbers[path].half for path in self.paths],
            "handles": handles_of(case, self.figure.steps, self.paths),
            "text": text_data(case, self.paths),
            "written": units_to_write(case),
            "links": {
                **{link: [p for p in names if p in place] for link, names in case.carries.items()},
                **{rope.end: [rope.points[-1]] for rope in case.ropes if rope.is_free},
            },
            "aims": [
                [place[p] for p in ends] for ends in self._ends() if ends[0] in place and ends[1] in place
            ],
            "meshes": [mesh for bond in top.bonds for mesh in self._mesh(bond, place)],
            "motion": [self._motion(given, place) for given in case.motion],
            "order": joint_order(case),
            "dynamic": is_loaded(case),
            "rolls": list(self._rolls(place)),
            "held": list(self._held(place)),
            "offRadius": OFF_RADIUS,
            "heavy": [link for link in case.inertia if is_loaded(case)],
            "inexact": any(joint.has_written_centre for joint in case.joints),
            "given": any(joint.stands_in for joint in case.joints),
            "loads": [self._load(w) for w in load_wrenches.wrenches(self._place())],
            "moves": self._by_points(),
            "wound": self._wound(),
            "kinds": [type(bond.joint).__name__ for bond in top.bonds],
            "pivots": [list(bond.pivots) if bond.pivots else None for bond in top.bonds],
            "turning": self._turning(),
            "owner": owners_of_points(case),
            "measures": self._measures(place),
            "at": [bond.joint.at for bond in top.bonds],
            "units": [unit_word(unit) for unit in (case.units.force, case.units.torque)],
            "torque": case.units.torque_per_force_length,
            "frameLink": case.ground,
            "bonds": [
                [*bond.links, len(bases[k]) == 1 or isinstance(bond.joint, Mesh)]
                for k, bond in enumerate(top.bonds)
            ],
            "rails": {
                bond.joint.at: k
                for k, bond in enumerate(top.bonds)
                if isinstance(bond.joint, Guided) and top.ground in (bond.a, bond.b)
            },
            "guides": self._guides(),
        }

    def _bodies(self) -> dict[str, int]:
        """The body of every link, and of what stands for one: ends of ropes that loads pull, screws."""
        ends = [rope.end for rope in self.case.ropes if rope.is_free]
        others = (*ends, *(screw.rotor for screw in self.case.screws))
        first = len(self.top.members)
        return {**self.top.body_of, **{name: n for n, name in enumerate(others, first)}}

    def _rope_data(self, rope: Rope) -> dict[str, Any]:
        """The points that it goes through, the links of its parts, and its free end."""
        parts = [list(pair) for pair in pairwise((*rope.links, "") if rope.is_free else rope.links)]
        end = rope.end if rope.is_free else ""
        return {"name": rope.name, "points": rope.points, "parts": parts, "end": end}

    def _checks(self, place: Mapping[Key, int]) -> Iterable[list[Any]]:
        """The data of what `solve` examines: kind, points, and the number's place among the inputs, of the
        length of a rope that of what is off."""
        tied, examined = count(), self._examined()
        for datum in data_of(self.case):
            if self._is_placed(datum) and examined.issuperset(datum.points):
                path = None if datum.kind in (MEAN, LINE) else number_of(self.case, datum).path
                number = None if path is None else self.paths.index(path)
                number = next(tied) if datum.kind == ROPE else number
                yield [datum.kind, [place[p] for p in datum.points], number]

    def _examined(self) -> set[Key]:
        """The points that reactions need, and those that these are placed by."""
        bonds = needed_bonds(None, self.top)
        needed = needed_points(self.case, self.top, bonds, Want(bodies=True))
        return {key for step in leading_to(needed, self.figure.steps) for key in step.targets}

    def _rolls(self, place: Mapping[Key, int]) -> Iterable[list[Any]]:
        """The radii of links that roll: each with the contact, and the centre that lies at it."""
        points, scale = self.figure.points, self.figure.frame.scale
        for joint in self.case.rollings:
            for link, radius in zip(joint.links, joint.radii or (), strict=True):
                own = at_radius(self.case.carries.get(link, ()), joint.at, radius.value * scale, points)
                centre = place[own[0]] if own and own[0] in place else None
                yield [self.paths.index(radius.path), place.get(joint.at), centre]

    def _held(self, place: Mapping[Key, int]) -> Iterable[list[Any]]:
        """The contacts whose wheels one link carries, their radii, and the pins that may be their centres."""
        for joint in self.case.rollings:
            pairs = held_centres(joint, self.case) if joint.at in place else []
            pairs = [pair for pair in pairs if all(p is None or p in place for p in pair)]
            numbers = [self.paths.index(radius.path) for radius in joint.radii or ()]
            if pairs:
                yield [place[joint.at], numbers, [[p and place[p] for p in pair] for pair in pairs]]

    def _turning(self) -> list[str]:
        """The links that are pinned to the frame."""
        frame = {*self.top.members[self.top.ground]}
        pins = [joint for joint in self.case.joints if joint.pivot is not None]
        found = [link for pin in pins if not frame.isdisjoint(pin.links) for link in pin.links]
        return [link for link in dict.fromkeys(found) if link not in frame]

    def _measures(self, place: Mapping[Key, int]) -> list[list[Any]] | None:
        """How each number that a motion changes is measured: kind, number, points or the link it turns with;
        None where one can't be."""
        case, found = self.case, list[list[Any]]()
        if case.ropes or case.screws or any(torn_points(case, self.top)):
            return None
        number = {path: n for n, path in enumerate(self.paths)}
        for name, at in case.points.items():
            if isinstance(at, Coordinates) and name in place:
                found += [
                    [axis, number[given.path], place[name]]
                    for axis, given in (("x", at.x), ("y", at.y))
                    if given is not None
                ]
        for datum in data_of(case):
            if datum.kind in (LENGTH, RAY, CORNER) and all(p in place for p in datum.points):
                path = number_of(case, datum).path
                found.append([datum.kind, number[path], *(place[p] for p in datum.points)])
        for bond in self.top.bonds:
            guide = getattr(bond.joint, "guide", None)
            if guide is not None and guide.angle is not None:
                found.append(["link", number[guide.angle.path], bond.links[1]])
        for load in case.loads:
            turner = getattr(load, "turns_with", None)
            if turner and not isinstance(getattr(load, "heading", None), Number):
                return None
            if turner:
                found.append(["link", number[load.heading.path], turner])  # type: ignore[union-attr]
        return found

    def _wound(self) -> list[list[int]]:
        """The bodies between which torsion springs turn, in the order in which their angles are counted."""
        bodies: dict[tuple[int, int], list[int]] = {}
        for load in self.case.loads:
            if isinstance(load, TorsionSpring):
                vector = load_wrenches.corner_vector(load, self._points())
                key = self.record.key(*vector, self.record.given(load.free))
                pair = (load.link, load.against or self.case.ground)
                bodies[key] = [self.top.body_of[link] for link in pair]
        return [bodies[key] for key in self.record.springs]

    def _by_points(self) -> bool:
        """Whether the places of the points tell all of a position: they are given, and no guide turns."""
        drawn = all(isinstance(step, Given | Mean) for step in self.figure.steps)
        guides = [bond for bond in self.top.bonds if getattr(bond.joint, "guide", None) is not None]
        still = self.top.ground
        held = all(bond.joint.guide.angle is None or still in (bond.a, bond.b) for bond in guides)  # type: ignore[union-attr]
        return drawn and held and not any(getattr(load, "turns_with", None) for load in self.case.loads)

    def _guides(self) -> dict[str, int]:
        """The bond whose guide tells how a link lies that has one."""
        found: dict[str, list[int]] = {}
        for k, bond in enumerate(self.top.bonds):
            if isinstance(bond.joint, Guided):
                for link in bond.links:
                    found.setdefault(link, []).append(k)
        return {link: ks[0] for link, ks in found.items() if len(ks) == 1}

    def _ends(self) -> Iterable[tuple[str, str]]:
        """Pairs of points that give a direction to a load, a guide, a wheel."""
        guides = [getattr(bond.joint, "guide", None) for bond in self.top.bonds]
        found = [load_wrenches.line_of(load) for load in self.case.loads]
        found += [guide.ends for guide in guides if guide is not None]
        found += [bond.pivots for bond in self.top.bonds if bond.pivots]
        return (ends for ends in found if ends is not None)

    def _mesh(self, bond: Bond, place: Mapping[Key, int]) -> Iterable[list[Any]]:
        """Pivots, teeth, and module or diametral pitch of gears, with the helix angle where it is that of the
        normal section: whether they fit has to be seen."""
        joint = bond.joint
        if isinstance(joint, Mesh) and set(bond.pivots) <= place.keys():
            size = joint.module or joint.diametral_pitch
            if size is not None:
                numbers = [self.paths.index(number.path) for number in (*joint.sizes, size)]
                helix = joint.helix
                angle = None
                if helix is not None and helix.normal_pitch:
                    angle = self.paths.index(helix.angle.path)
                yield [*(place[p] for p in bond.pivots), *numbers, joint.module is not None, angle]

    def _motion(self, given: Motion, place: Mapping[Key, int]) -> dict[str, Any]:
        """What the case says of a speed; numbers by their place among the inputs."""
        numbers = {"speed": given.speed, "angle": given.angle, "acceleration": given.acceleration}
        found = {key: self.paths.index(number.path) for key, number in numbers.items() if number is not None}
        point = {} if given.point is None else {"point": place[given.point]}
        back = given.speed is not None and given.speed.value < 0.0
        half = given.speed.half if given.speed is not None else 0.0
        return {"link": given.link, "half": half, "cw": given.turns == "cw", "back": back, **point, **found}

    def _load(self, w: load_wrenches.Wrench) -> dict[str, Any]:
        load = w.load
        heading = getattr(load, "heading", None)
        return {
            "name": load.name,
            "kind": type(load).__name__,
            "on": load.link,
            "against": w.against,
            "held": getattr(load, "against", None) is not None,
            "root": w.root,
            "measure": w.measure,
            "unknown": power.is_unknown(load),
            "cw": getattr(load, "turns", None) == "cw",
            "toward": getattr(heading, "point", None),
            "away": bool(getattr(heading, "away", False)),
            "at": getattr(load, "at", None),
            "to": getattr(load, "to", None),
        }


def _exact(number: Number) -> list[Any] | None:
    """A number as the file has it, as a ratio and a power of pi; None where its double's numeral says it."""
    if number.exact is not None:
        num, den, power = number.exact
    elif number.factor != 1.0:
        (num, den), power = number.value.as_integer_ratio(), 0
    else:
        (num, den), power = Fraction(number.digits.replace("−", "-")).as_integer_ratio(), 0
    same = power == 0 and Fraction(num, den) == Fraction(repr(number.value))
    return None if same else [str(num), str(den), power]


def _leaves(parts: Any) -> Iterable[Scalar]:
    """The numbers of nested lists."""
    if isinstance(parts, list | tuple):
        for part in parts:
            yield from _leaves(part)
    else:
        yield parts


def _shaped(parts: Any, given: Any) -> str:
    """Nested lists of expressions as text."""
    if isinstance(parts, list | tuple):
        return f"[{','.join(_shaped(part, given) for part in parts)}]"
    return str(next(given))
