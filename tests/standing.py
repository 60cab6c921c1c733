"""Structures of several freedoms that friction holds or does not: crates stacked, bricks in a wall, blocks
joined by bars; and a witness that knows nothing of motions: whether their loads lie in the cone that the
forces of their joints span."""

from __future__ import annotations

import math
from itertools import product
from random import Random
from typing import Any

import numpy as np
import yaml

import equilibrium
import rubbing
from icsolve import case as c
from icsolve.numbers.replay import Array
from reference import frame_of, points_of


def _text(points: dict[str, tuple[float, float]], joints: list[str], loads: list[str]) -> str:
    at = ", ".join(f"{name}: [{x:g}, {y:g}]" for name, (x, y) in points.items())
    listed = "".join(f"  - {{{joint}}}\n" for joint in joints)
    named = "".join(f"  L{n}: {{{load}}}\n" for n, load in enumerate(loads))
    return f"icsolve: 1\npoints: {{{at}}}\njoints:\n{listed}loads:\n{named}"


def _mu(dice: Random) -> str:
    return f"mu: {dice.uniform(0.05, 0.9):.2f}"


def crates(dice: Random) -> str:
    """Up to four crates, each on the one below with two or three of its points, pushed at one or two; the
    floor may slope."""
    tilt = dice.choice([0.0, 0.0, round(dice.uniform(-30, 30), 1)])
    turn = math.radians(tilt)
    points, joints, loads = dict[str, tuple[float, float]](), [], []

    def put(name: str, x: float, y: float) -> str:
        cos, sin = math.cos(turn), math.sin(turn)
        points[name] = (round(x * cos - y * sin, 4), round(x * sin + y * cos, 4))
        return name

    left, right, up = 0.0, round(dice.uniform(0.8, 2.0), 2), 0.0
    for k in range(dice.randint(1, 4)):
        legs = [left, right] + ([round(dice.uniform(left, right), 3)] if dice.random() < 0.3 else [])
        for n, x in enumerate(legs):
            rough = "" if dice.random() < 0.15 else f", {_mu(dice)}"
            at = put(f"F{k}{n}", x, up)
            joints.append(f"contact: [{k + 1}, {k + 2}], at: {at}, normal: {90 + tilt}{rough}")
        high = round(dice.uniform(0.2, 0.8), 2)
        middle = put(f"G{k}", dice.uniform(left - 0.1, right + 0.1), up + high / 2)
        loads.append(f"weight: {dice.randint(20, 200)}, link: {k + 2}, at: {middle}")
        if dice.random() < 0.6:
            at = put(f"P{k}", left, up + dice.uniform(0.0, high))
            toward = dice.choice([0, round(dice.uniform(-60, 60), 1), 180])
            loads.append(f"force: {dice.uniform(1, 60):.1f}, link: {k + 2}, at: {at}, angle: {toward}")
        up += high
        left, right = (round(end + dice.uniform(-0.2, 0.2), 3) for end in (left, right))
        if right - left < 0.3:
            break
    return _text(points, joints, loads)


def bricks(dice: Random) -> str:
    """Two or three bricks on the floor with one or two across them: how the lower ones share what lies on
    them is open where they have more than two contacts."""
    points, joints, loads, count = dict[str, tuple[float, float]](), [], [], dice.randint(2, 3)
    high = round(dice.uniform(0.2, 0.6), 2)

    def contact(by: int, on: int, name: str, x: float, y: float) -> None:
        points[name] = (round(x, 4), y)
        joints.append(f"contact: [{by}, {on}], at: {name}, normal: 90, {_mu(dice)}")

    for k in range(count):
        contact(1, 2 + k, f"A{k}", 1.1 * k, 0)
        contact(1, 2 + k, f"B{k}", 1.1 * k + 1.0, 0)
        points[f"G{k}"] = (1.1 * k + 0.5, high / 2)
        loads.append(f"weight: {dice.randint(20, 100)}, link: {2 + k}, at: G{k}")
    for k in range(count - 1):
        on = 2 + count + k
        contact(2 + k, on, f"C{k}", 1.1 * k + dice.uniform(0.55, 0.95), high)
        contact(3 + k, on, f"D{k}", 1.1 * k + dice.uniform(1.15, 1.55), high)
        points[f"H{k}"] = (1.1 * k + dice.uniform(0.8, 1.4), 1.5 * high)
        loads.append(f"weight: {dice.randint(20, 100)}, link: {on}, at: H{k}")
    link = dice.randint(2, count + 1)
    points["P"] = (1.1 * (link - 2), dice.uniform(0.0, high))
    loads.append(f"force: {dice.uniform(1, 60):.1f}, link: {link}, at: P, angle: {dice.choice((0, 180, 30))}")
    return _text(points, joints, loads)


def rod(dice: Random) -> str:
    """A rod whose two pins rub in slots, loaded beside them; the last load at any angle."""
    points = {"A": (0.0, 0.0), "B": (round(dice.uniform(1, 2), 2), round(dice.uniform(0.5, 1.5), 2))}
    points["G"] = (round(dice.uniform(0.2, 1.5), 2), round(dice.uniform(0.3, 1.5), 2))
    joints = [f"slot: [2, 1], at: {name}, along: {dice.randint(0, 179)}, {_mu(dice)}" for name in "AB"]
    push = f"[{dice.uniform(-20, 20):.2f}, {dice.uniform(-20, 20):.2f}]"
    loads = [f"force: {push}, link: 2, at: G", f"torque: {dice.uniform(-5, 5):.2f}, link: 2"]
    loads.append(f"force: 1, link: 2, at: {dice.choice('ABG')}, angle: {dice.randint(0, 359)}")
    return _text(points, joints, loads)


def barred(dice: Random) -> str:
    """Two blocks on slopes, joined by a bar on smooth pins; the last load on one at any angle."""
    points = {"A": (0.0, 0.0), "B": (round(dice.uniform(1, 2), 2), round(dice.uniform(-0.5, 0.5), 2))}
    joints, loads = [], []
    for k, name in enumerate("AB"):
        joints.append(f"slide: [{2 + k}, 1], at: {name}, along: {dice.randint(-50, 50)}, {_mu(dice)}")
        joints.append(f"pin: [{2 + k}, 4], at: {name}")
        loads.append(f"weight: {dice.randint(10, 100)}, link: {2 + k}, at: {name}")
    link, at = dice.choice([(2, "A"), (3, "B")])
    loads.append(f"force: 1, link: {link}, at: {at}, angle: {dice.randint(0, 359)}")
    return _text(points, joints, loads)


def cornered(dice: Random) -> str:
    """A crate on two feet that a third joint keeps from sliding, a wall, a post that leans or a rod, perhaps
    with another crate on it at a wall of its own: a structure, which lifts off some of them if it can."""
    points, joints, loads = dict[str, tuple[float, float]](), [], []
    for k in range(dice.randint(1, 2)):
        by, on, high = k + 1 if k else 1, k + 2, 0.6 * k
        for foot, x in (("A", 0.0), ("B", 1.0)):
            points[f"{foot}{k}"] = (round(x + dice.uniform(-0.1, 0.1), 3), high)
            joints.append(f"contact: [{by}, {on}], at: {foot}{k}, normal: 90, {_mu(dice)}")
        points[f"C{k}"] = (0.0, round(high + dice.uniform(0.1, 0.6), 3))
        if dice.random() < 0.3:
            points[f"D{k}"] = (-1.0, round(high + dice.uniform(0.0, 1.0), 3))
            joints += [f"pin: [{on}, {k + 5}], at: C{k}", f"pin: [1, {k + 5}], at: D{k}"]
        else:
            normal = dice.choice([0, 0, dice.randint(-40, 40)])
            joints.append(f"contact: [1, {on}], at: C{k}, normal: {normal}, {_mu(dice)}")
        points[f"G{k}"] = (round(dice.uniform(0.1, 0.9), 3), high + 0.3)
        points[f"P{k}"] = (1.0, round(high + dice.uniform(0.0, 0.6), 3))
        loads.append(f"weight: {dice.randint(20, 200)}, link: {on}, at: G{k}")
        loads.append(
            f"force: {dice.uniform(1, 90):.1f}, link: {on}, at: P{k}, angle: {dice.randint(-60, 60)}"
        )
    return _text(points, joints, loads)


def joined(dice: Random) -> str:
    """Two blocks on slopes, joined by a bar on smooth pins; a third may stand on one of them."""
    points, joints, loads = {"A": (0.0, 0.0)}, [], []
    points["B"] = (round(dice.uniform(1, 3), 2), round(dice.uniform(-1, 1), 2))
    slopes = [dice.choice([0, dice.randint(-50, 50)]) for _ in range(2)]
    for k, (name, slope) in enumerate(zip("AB", slopes, strict=True)):
        joints.append(f"slide: [{2 + k}, 1], at: {name}, along: {slope}, {_mu(dice)}")
        joints.append(f"pin: [{2 + k}, 4], at: {name}")
        loads.append(f"weight: {dice.randint(20, 200)}, link: {2 + k}, at: {name}")
    if dice.random() < 0.5:
        x, y = points["A"]
        points["C"] = (x, round(y + 0.4, 2))
        joints.append(f"slide: [5, 2], at: C, along: {slopes[0] + dice.randint(-20, 20)}, {_mu(dice)}")
        loads.append(f"weight: {dice.randint(20, 100)}, link: 5, at: C")
    link, at = dice.choice([(2, "A"), (3, "B")])
    loads.append(f"force: {dice.uniform(1, 150):.1f}, link: {link}, at: {at}, angle: {dice.randint(0, 359)}")
    return _text(points, joints, loads)


KINDS = (crates, bricks, joined)


def off_the_cone(generators: Any, right: Any) -> float:
    """How far a vector is from the cone of some others, as a share of its length: non-negative least squares
    (C. Lawson and R. Hanson, Solving Least Squares Problems, 1974, ch. 23)."""
    count = generators.shape[1]
    x, used = np.zeros(count), np.zeros(count, dtype=bool)
    for _ in range(30 * count):
        slope = generators.T @ (right - generators @ x)
        slope[used] = -1.0
        best = int(np.argmax(slope))
        if slope[best] <= 1e-11 * np.linalg.norm(right):
            break
        used[best] = True
        while True:
            own = np.zeros(count)
            own[used] = np.linalg.lstsq(generators[:, used], right, rcond=1e-13)[0]
            if own[used].min() > 0.0:
                x = own
                break
            below = used & (own <= 0.0)
            step = np.min(x[below] / (x[below] - own[below]))
            x = x + step * (own - x)
            used &= x > 1e-13 * np.abs(x).max()
            x[~used] = 0.0
            if not used.any():
                break
    return float(np.linalg.norm(right - generators @ x) / np.linalg.norm(right))


def with_friction(case: c.Case) -> tuple[Array, Array, Array, list[rubbing.Place]]:
    """The equations of the free bodies, (3 bodies, forces), what the frictions add, (3 bodies, rubs), the
    loads, and the rubs."""
    points = points_of(case)
    places = rubbing.places_of(case, points)
    a, b, _ = equilibrium.equations(case, points)
    row = {link: 3 * k for k, link in enumerate(link for link in case.links if link != case.ground)}
    friction = np.zeros((len(b), len(places)))
    for k, place in enumerate(places):
        for link, sign in ((place.on, 1.0), (place.by, -1.0)):
            if link in row:
                friction[row[link] : row[link] + 3, k] += sign * place.wrench
    return a, friction, b, places


def carried(case: c.Case) -> list[tuple[float | None, float | None]]:
    """The force of each joint on its second link, as far as equilibrium says it where what rubs carries force
    along itself too: None of a component that it leaves open."""
    points = points_of(case)
    a, friction, b, places = with_friction(case)
    both = np.hstack([a, friction])
    _, sizes, rows = np.linalg.svd(both)
    free = rows[int((sizes > 1e-11 * sizes[0]).sum()) :]
    x = np.linalg.lstsq(both, b, rcond=1e-12)[0]
    assert np.allclose(both @ x, b, atol=1e-9 * np.abs(b).max())
    column, rub, found = 0, 0, []
    for joint in case.joints:
        units = {k: w[:2] for k, (*_, w) in enumerate(transmitted(case, joint, points), start=column)}
        column += len(units)
        if any(row in units for place in places[rub : rub + 1] for row in np.flatnonzero(place.force[0])):
            units[a.shape[1] + rub] = tuple(places[rub].wrench[:2])
            rub += 1
        own = np.zeros((2, both.shape[1]))
        for k, unit in units.items():
            own[:, k] = unit
        told = [None if np.abs(free @ row).max(initial=0.0) > 1e-9 else float(row @ x) for row in own]
        found.append((told[0], told[1]))
    return found


def transmitted(case: c.Case, joint: c.Joint, points: Any) -> list[tuple[str, str, Any]]:
    """The unit forces and couples of a joint."""
    return equilibrium.transmitted(case, joint, points, frame_of(case, points))


def pushing(case: c.Case) -> set[int]:
    """The columns of the normal forces of contacts."""
    points, column, found = points_of(case), 0, set[int]()
    for joint in case.joints:
        if isinstance(joint, c.Contact):
            found.add(column)
        column += len(transmitted(case, joint, points))
    return found


def off_all(case: c.Case) -> float:
    """How far the loads are from those that forces of the joints in either sense could balance, with friction
    without limits: least squares, as a share of the loads."""
    a, friction, b, _ = with_friction(case)
    every = np.hstack([a, friction])
    x = np.linalg.lstsq(every, b, rcond=1e-12)[0]
    return float(np.linalg.norm(every @ x - b) / np.linalg.norm(b))


def off(case: c.Case, grown: float = 1.0) -> float:
    """How far the loads are from those that the joints can balance, friction within ``grown`` times its
    limits, or without any: of contacts, guides (either sense of each) and smooth pins."""
    (a, friction, b, places), push = with_friction(case), pushing(case)
    rough = {int(np.flatnonzero(place.force[0])[0]): k for k, place in enumerate(places)}
    guides = [n for n in rough if n not in push]
    found = []
    for senses in product((1.0, -1.0), repeat=len(guides)):
        by, columns = dict(zip(guides, senses, strict=True)), []
        for n in range(a.shape[1]):
            sense = by.get(n, 1.0)
            if n in rough:
                k = rough[n]
                most, press = (1.0, 0.0) if math.isinf(grown) else (grown * places[k].limit, sense)
                columns += [press * a[:, n] + side * most * friction[:, k] for side in (1.0, -1.0)]
                columns += [sense * a[:, n]] if math.isinf(grown) else []
            else:
                columns += [a[:, n]] if n in push else [a[:, n], -a[:, n]]
        found.append(off_the_cone(np.array(columns).T, b))
    return min(found)


def hung(dice: Random) -> tuple[str, float]:
    """Bars that hang in a row on rough pins, the first on a block that rubs on a slope; and how far the worst
    of the rubs is from its limit, as a share of it (negative beyond): what every joint carries follows from
    what hangs on it."""
    slope, rough = dice.choice([0, dice.randint(-35, 35)]), round(dice.uniform(0.1, 0.9), 2)
    at, points, joints, loads = (0.0, 0.0), {"P0": (0.0, 0.0)}, [], []
    joints.append(f"slide: [2, 1], at: P0, along: {slope}, mu: {rough}")
    bars, own = dice.randint(1, 3), dice.randint(10, 100)
    loads.append(f"weight: {own}, link: 2, at: P0")
    placed, forces, limits = list[tuple[float, float]](), list[tuple[float, float]](), list[float]()
    for k in range(1, bars + 1):
        turn = math.radians(-90 + dice.uniform(-8, 8))
        at = (round(at[0] + math.cos(turn), 4), round(at[1] + math.sin(turn), 4))
        points[f"P{k}"] = at
        radius, mu = round(dice.uniform(0.05, 0.3), 3), round(dice.uniform(0.1, 0.8), 2)
        joints.append(f"pin: [{k + 1}, {k + 2}], at: P{k - 1}, mu: {mu}, radius: {radius}")
        limits.append(radius * math.sin(math.atan(mu)))
        weight, push = dice.randint(10, 100), round(dice.uniform(-5, 5), 1)
        loads.append(f"weight: {weight}, link: {k + 2}, at: P{k}")
        loads.append(f"force: {push}, link: {k + 2}, at: P{k}, angle: 0")
        placed.append(at)
        forces.append((push, -weight))
    spare = []
    for k in range(bars):
        px, py = points[f"P{k}"]
        below = list(zip(placed, forces, strict=True))[k:]
        moment = sum((x - px) * fy - (y - py) * fx for (x, y), (fx, fy) in below)
        most = limits[k] * math.hypot(*(sum(f[n] for f in forces[k:]) for n in (0, 1)))
        spare.append(1.0 - abs(moment) / most)
    fx, fy = sum(f[0] for f in forces), sum(f[1] for f in forces) - own
    c, s = math.cos(math.radians(slope)), math.sin(math.radians(slope))
    spare.append(1.0 - abs(fx * c + fy * s) / (rough * abs(fy * c - fx * s)))
    return _text(points, joints, loads), min(spare)


def five_bar(dice: Random) -> str:
    """A five-bar of two freedoms with four rough pins, some large beside the links, and one smooth one."""
    at = {name: (dice.uniform(*x), dice.uniform(*y)) for name, x, y in PLACES}
    points = {name: (round(x, 2), round(y, 2)) for name, (x, y) in at.items()}
    joints, loads = [], []
    for k, (by, on, name) in enumerate(((1, 2, "A"), (2, 3, "B"), (3, 4, "C"), (4, 5, "D"), (5, 1, "E"))):
        rough = (
            f", {_mu(dice)}, radius: {dice.choice((1, 10)) * dice.uniform(0.05, 0.4):.2f}" if k < 4 else ""
        )
        joints.append(f"pin: [{by}, {on}], at: {name}{rough}")
    for link, names in ((2, "AB"), (3, "BC"), (4, "CD"), (5, "DE")):
        if dice.random() < 0.3:
            continue
        push = f"[{dice.uniform(-30, 30):.1f}, {dice.uniform(-30, 30):.1f}]"
        loads.append(f"force: {push}, link: {link}, at: {dice.choice(names)}")
    return _text(points, joints, loads or ["force: [3, 4], link: 3, at: B"])


PLACES = (
    ("A", (0, 0), (0, 0)),
    ("B", (-1, 0.5), (1, 2)),
    ("C", (1, 2.5), (1.5, 3)),
    ("D", (3, 5), (0.8, 2)),
    ("E", (2, 4), (-0.5, 0.5)),
)


def most_spare(case: c.Case, cuts: int = 121, zooms: int = 12) -> float:
    """How far the worst friction of a case of rough pins is from its limit where it is farthest, over the
    largest load: the two frictions that equilibrium leaves open are tried on grids, each about the best place
    of the one before."""
    a, friction, b, places = with_friction(case)
    whole = np.hstack([a, friction])
    first = np.linalg.lstsq(whole, b, rcond=1e-12)[0]
    assert np.allclose(whole @ first, b, atol=1e-9 * np.abs(b).max())
    _, sizes, turns = np.linalg.svd(whole)
    open_ = turns[len(sizes) :].T
    assert open_.shape[1] == 2
    middle, reach, best = np.zeros(2), 30.0 * np.abs(b).max(), -math.inf
    for _ in range(zooms):
        steps = np.linspace(-reach, reach, cuts)
        grid = np.stack(np.meshgrid(*(x + steps for x in middle)), axis=-1).reshape(-1, 2)
        forces = first + grid @ open_.T
        spare = np.full(len(grid), math.inf)
        for k, place in enumerate(places):
            pressing = np.linalg.norm(forces[:, : a.shape[1]] @ place.force.T, axis=1)
            spare = np.minimum(spare, place.limit * pressing - np.abs(forces[:, a.shape[1] + k]))
        middle, best, reach = grid[int(spare.argmax())], max(best, float(spare.max())), 0.4 * reach
    return best / float(np.abs(b).max())


def side_by_side(texts: list[str]) -> str:
    """Several scenes of one kind of units as one case: points, links and loads of each under names of their
    own, the frame in common."""
    whole: dict[str, Any] = {"icsolve": 1, "points": {}, "lengths": {}, "angles": {}, "near": {}}
    whole |= {"joints": [], "loads": {}}
    for n, text in enumerate(texts):
        one = yaml.load(text, Loader=yaml.BaseLoader)

        def renamed(value: Any, key: str = "", n: int = n) -> Any:
            if isinstance(value, dict):
                named = key in ("radii", "wraps", "turns", "mu")
                return {f"{k}{n}" if named else k: renamed(v, k) for k, v in value.items()}
            if isinstance(value, list) and key not in ("at", "slope"):
                return [renamed(v, key) for v in value]
            if key in ("link", "on", "pin", "slide", "contact") and value != "1":
                return f"k{n}{value}"
            if key == "screw":
                return value if value == "1" else "-".join(renamed(v, "link") for v in value.split("-"))
            return f"{value}{n}" if key in ("at", "rope", "centroid", "through") else value

        for section in ("points", "near", "loads"):
            whole[section] |= {f"{k}{n}": renamed(v) for k, v in one.get(section, {}).items()}
        for section in ("lengths", "angles"):
            pairs = one.get(section, {}).items()
            whole[section] |= {"-".join(f"{p}{n}" for p in k): v for k, v in pairs}
        whole["joints"] += [renamed(joint) for joint in one["joints"]]
        whole |= {"units": one["units"]} if "units" in one else {}
    return str(yaml.dump(whole, sort_keys=False)).replace("'", "")
