"""Seeded scenes with friction, of each kind that textbooks have, with a load F that is to find or given."""

from __future__ import annotations

import math
from collections.abc import Callable
from random import Random
from typing import NamedTuple

import icsolve


class Rough(NamedTuple):
    """A scene with a load F, and the paths of a coefficient of friction and of another number."""

    text: str
    mu: str
    other: str

    def case(self, load: str) -> icsolve.Case:
        """With this F."""
        return icsolve.load("icsolve: 1\n" + self.text.replace("LOAD", load))


def mu(dice: Random, low: int, high: int) -> float:
    """A coefficient of friction between so many hundredths."""
    return dice.randint(low, high) / 100


def block(dice: Random) -> Rough:
    slope = dice.randint(-40, 40)
    return Rough(
        "points: {C: [0, 0]}\n"
        f"joints: [{{slide: [2, 1], at: C, along: {slope}, mu: {mu(dice, 5, 90)}}}]\n"
        f"loads: {{Q: {{weight: {dice.randint(50, 200)}, link: 2, at: C}}, "
        f"F: {{force: LOAD, link: 2, at: C, angle: {slope + dice.randint(-50, 50)}}}}}\n",
        "joints.C.mu",
        "loads.F.angle",
    )


def wedge(dice: Random) -> Rough:
    a, b, d = (mu(dice, 5, 40) for _ in range(3))
    return Rough(
        f"""points: {{A: [0, 0], B: [0.1, 0.05], C: [0.2, 0.2]}}
joints:
  - {{slide: [wedge, 1], at: A, along: 0, mu: {a}}}
  - {{slide: [block, wedge], at: B, along: {180 - dice.randint(5, 30)}, mu: {b}}}
  - {{slide: [block, 1], at: C, along: 90, mu: {d}}}
loads:
  W: {{weight: {dice.randint(5, 20)}, link: block, at: C}}
  F: {{force: LOAD, link: wedge, at: A, angle: 180}}
""",
        "joints.A.mu",
        "joints.B.mu",
    )


def screw(dice: Random) -> Rough:
    return Rough(
        f"""units: {{length: mm, force: kN, torque: N*m}}
points: {{A: [0, 0]}}
joints:
  - {{screw: [1, 2], at: A, along: 90, lead: {dice.randint(3, 30)} mm, radius: 15 mm, mu: {mu(dice, 5, 40)}}}
loads: {{W: {{weight: {dice.randint(5, 40)} kN, link: 2, at: A}}, F: {{torque: LOAD, screw: 1-2}}}}
""",
        "joints.A.mu",
        "loads.W",
    )


def capstan(dice: Random) -> Rough:
    return Rough(
        f"""points: {{A: [-3, 0.2], O: [0, 0], B: [0.2, -2]}}
joints:
  - rope: [A, O, B]
    on: [2, 1]
    radii: {{O: 0.2}}
    wraps: {{O: cw}}
    mu: {{O: {mu(dice, 5, 40)}}}
    turns: {{O: {dice.randint(0, 3)}}}
  - {{slide: [2, 1], at: A, along: 0}}
loads: {{H: {{weight: {dice.randint(2, 30)}, at: B}}, F: {{force: LOAD, link: 2, at: A, angle: 180}}}}
""",
        "joints.O.mu",
        "loads.H",
    )


def band(dice: Random) -> Rough:
    return Rough(
        f"""units: {{length: cm, force: N}}
points: {{O: [0, 0], D: [30, -5], A: [20, -5], B: [10, -20], E: [60, -5]}}
joints:
  - {{pin: [1, drum], at: O}}
  - {{pin: [1, lever], at: D}}
  - rope: [A, O, B]
    on: [lever, drum, 1]
    radii: {{O: 15}}
    wraps: {{O: ccw}}
    mu: {{O: {mu(dice, 10, 40)}}}
loads:
  P: {{force: {dice.randint(20, 200)}, link: lever, at: E, angle: {dice.choice((90, -90))}}}
  F: {{torque: LOAD, link: drum}}
""",
        "joints.O.mu",
        "loads.P.angle",
    )


def ratchet(dice: Random) -> Rough:
    wheel = dice.random() < 0.5
    torque, spring = (("LOAD", dice.choice((0, 0.5, -1, 5))), (dice.choice((50, 20, -10)), "LOAD"))[not wheel]
    names = ("F", "S") if wheel else ("T", "F")
    normal = dice.choice((6, 8, 8.1301024, 15, -5))
    return Rough(
        f"""units: {{length: mm, force: N, torque: N*m}}
points: {{O: [0, 0], D: [130, 90], P: [60, 80]}}
joints:
  - {{pin: [1, wheel], at: O}}
  - {{pin: [1, pawl], at: D}}
  - {{contact: [wheel, pawl], at: P, normal: {normal}, mu: {mu(dice, 5, 50)}}}
loads:
  {names[0]}: {{torque: {torque}, link: wheel, turns: cw}}
  {names[1]}: {{torque: {spring}, link: pawl}}
""",
        "joints.P.mu",
        "joints.P.normal",
    )


def ladder(dice: Random) -> Rough:
    up, high = math.radians(dice.randint(40, 75)), dice.uniform(0.2, 0.95)
    x, y = round(4 * math.cos(up), 3), round(4 * math.sin(up), 3)
    return Rough(
        f"""points:
  A: [{-x}, 0]
  B: [0, {y}]
  G: [{-x / 2}, {y / 2}]
  H: [{x * (high - 1):.3f}, {y * high:.3f}]
joints:
  - {{contact: [1, 2], at: A, normal: 90, mu: {mu(dice, 10, 60)}}}
  - {{contact: [1, 2], at: B, normal: 180, mu: {dice.choice((0, mu(dice, 5, 40)))}}}
loads:
  W: {{weight: {dice.randint(50, 200)}, link: 2, at: G}}
  F: {{force: LOAD, link: 2, at: {dice.choice("AH")}, angle: {dice.choice((0, 30, -90))}}}
""",
        "joints.A.mu",
        "loads.F.angle",
    )


def crate(dice: Random) -> Rough:
    wide, high = dice.randint(3, 12) / 10, dice.randint(5, 25) / 10
    lift = f"  U: {{force: {dice.choice((20, 80, 400))}, link: 2, at: G, angle: 90}}\n"
    return Rough(
        f"""points:
  A: [0, 0]
  B: [{wide}, 0]
  G: [{wide * dice.choice((0.5, 0.3)):.3f}, {high / 2}]
  H: [0, {high}]
joints:
  - {{contact: [1, 2], at: A, normal: 90, mu: {mu(dice, 10, 90)}}}
  - {{contact: [1, 2], at: B, normal: 90, mu: {mu(dice, 10, 90)}}}
loads:
  W: {{weight: {dice.randint(50, 300)}, link: 2, at: G}}
{lift if dice.random() < 0.4 else ""}  F: {{force: LOAD, link: 2, at: H, angle: {dice.choice((0, 20, -25))}}}
""",
        "joints.A.mu",
        "loads.W",
    )


def table(dice: Random) -> Rough:
    mu = dice.choice((0.3, 0.6))
    return Rough(
        f"""points: {{A: [0, 0], B: [2, 0], G: [{dice.choice((0.5, 1.9, 2.5, -0.4))}, 1]}}
joints:
  - {{contact: [1, 2], at: A, normal: 90, mu: {mu}}}
  - {{contact: [1, 2], at: B, normal: 90, mu: {mu}}}
loads: {{W: {{weight: 50, link: 2, at: G}}, F: {{force: LOAD, link: 2, at: A, angle: 0}}}}
""",
        "joints.A.mu",
        "points.G.x",
    )


def cam_lock(dice: Random) -> Rough:
    return Rough(
        f"""units: {{length: mm, force: N}}
points: {{D: [0, 30], P: [{dice.choice((8, -6, 4, 15))}, 0], B: [60, -5]}}
joints:
  - {{pin: [1, cam], at: D}}
  - {{contact: [cam, bar], at: P, normal: -90, mu: {mu(dice, 10, 60)}}}
  - {{slide: [bar, 1], at: B, along: 0}}
loads:
  F: {{force: LOAD, link: bar, at: B, angle: 180}}
  S: {{torque: {dice.choice((1, -1, 20, -20))}, link: cam}}
""",
        "joints.P.mu",
        "joints.P.normal",
    )


def brake(dice: Random) -> Rough:
    drum = dice.random() < 0.6
    torque, push = (("LOAD", dice.choice((300, 849, -200))), (dice.choice((60, -60)), "LOAD"))[not drum]
    names = ("F", "P") if drum else ("T", "F")
    return Rough(
        f"""units: {{length: mm, force: N, torque: N*m}}
points: {{O: [0, 0], S: [-150, 0], D: [{-dice.choice((200, 170, 260))}, -250], E: [-200, 350]}}
joints:
  - {{pin: [1, drum], at: O}}
  - {{pin: [1, lever], at: D}}
  - {{contact: [drum, lever], at: S, normal: 180, mu: {mu(dice, 10, 60)}}}
loads:
  {names[0]}: {{torque: {torque}, link: drum, turns: cw}}
  {names[1]}: {{force: {push}, link: lever, at: E, angle: 0}}
""",
        "joints.S.mu",
        f"loads.{names[1]}.angle",
    )


def crank(dice: Random) -> Rough:
    return Rough(
        f"""points: {{A: [0, 0], C: [unknown, 0]}}
lengths: {{AB: 2, BC: 6}}
angles: {{AB: {dice.randint(20, 160)}}}
near: {{C: [6, 0]}}
joints:
  - {{pin: [1, 2], at: A, mu: 0.2, radius: {dice.randint(1, 5) / 10}}}
  - {{pin: [2, 3], at: B, mu: 0.2, radius: 0.3}}
  - {{pin: [3, 4], at: C}}
  - {{slide: [4, 1], at: C, along: 0, mu: {mu(dice, 0, 30)}}}
loads: {{P: {{force: {dice.randint(50, 200)}, link: 4, at: C, angle: 180}}, F: {{torque: LOAD, link: 2}}}}
""",
        "joints.A.mu",
        "angles.AB",
    )


KINDS: tuple[Callable[[Random], Rough], ...] = (
    *(block, wedge, screw, capstan, band, ratchet, ladder, crate, table, cam_lock, brake, crank),
)
TOUCHING = (ratchet, ladder, crate, table, cam_lock, brake)
"""Those whose contacts alone rub."""
