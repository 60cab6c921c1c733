"""What the motions of the reference say: centres, rates, velocities, and the loads by virtual power."""

from __future__ import annotations

import math
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np

from icsolve import case as c
from reference import DOUBLE, Digits, Frame, Motions, Place, Points, Twist, along, motions, unit

STILL = 1e-10
LAST_DIGITS = (1e-40, 1e-9)
"""Of numbers of size 1: what comes from the 16th digit of a coordinate, and from no other."""
"""A twist this much smaller than the mechanism's largest is rounding of the data."""


# --- centres ---------------------------------------------------------------------------------------


def centre(found: Motions, i: str, j: str) -> Twist | str:
    """Homogeneous centre of two links in the normalised frame; or ``undefined``, ``undetermined``."""
    own = _own(found, i, j)
    relative = [_minus(b[j], b[i]) for b in found.basis]
    largest = max((_size(t) for b in found.basis for t in b.values()), default=0.0)
    moving = [t for t in relative if _size(t) > STILL * largest]
    if not moving:
        return own or "undefined"
    if any(sine(moving[0], t) > 1e-9 for t in moving[1:]):
        return own or "undetermined"
    return max(moving, key=_size)


def hangs_on_last_digits(found: Motions) -> bool:
    """Whether some two links move as one, or about one centre, but for the rounding of data of 16 digits: the
    decimals as written say that they do not, and the limits of `centre` that they do."""
    largest = max((_size(t) for b in found.basis for t in b.values()), default=0.0)
    if not largest:
        return False
    for i, j in combinations(found.case.links, 2):
        relative = [_minus(b[j], b[i]) for b in found.basis]
        most = max(relative, key=_size)
        apart = [_size(t) / largest for t in relative]
        apart += [sine(most, t) for t in relative if t is not most and _size(t) > STILL * largest]
        if any(LAST_DIGITS[0] < size <= LAST_DIGITS[1] for size in apart):
            return True
    return False


def _own(found: Motions, i: str, j: str) -> Twist | None:
    """The centre of the joint of two links, which stands even where they have no relative motion."""
    if j in _welded(found.case, i):
        return None
    joints = (joint for joint in found.case.joints if {i, j} <= set(joint.links))
    return next((own for own in (_centre_of(joint, found) for joint in joints) if own is not None), None)


def _welded(case: c.Case, link: str) -> set[str]:
    """A link, and those that are welded to it."""
    body = {link}
    for _ in case.links:
        for joint in case.joints:
            if isinstance(joint, c.Weld) and body & set(joint.links):
                body |= set(joint.links)
    return body


def _centre_of(joint: c.Joint, found: Motions) -> Twist | None:
    """The relative centre that a joint fixes by itself."""
    num = found.digits.num
    if isinstance(joint, c.Slide):
        ux, uy = along(joint.guide, found.points, found.digits)
        return (-uy, ux, num(0))
    if isinstance(joint, c.KnownCentre) and joint.toward is not None:
        return (*found.digits.turn(joint.toward.value), num(0))
    if isinstance(joint, c.Pin | c.Roll | c.KnownCentre) and joint.at is not None:
        return (*found.frame.place(found.points[joint.at], num), num(1))
    return None


def homogeneous(frame: Frame, entry: dict[str, Any], digits: Digits = DOUBLE) -> Twist:
    """A centre as results print it (``at`` or ``toward``), in the normalised frame."""
    if "toward" in entry:
        return (*digits.turn(entry["toward"]), digits.num(0))
    return (*frame.place(entry["at"], digits.num), digits.num(1))


def sine(a: Twist, b: Twist) -> float:
    """Sine of the angle between two homogeneous vectors."""
    cross = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return _size(cross) / (_size(a) * _size(b))


def _minus(a: Twist, b: Twist) -> Twist:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _size(t: Twist) -> float:
    return math.hypot(*(float(a) for a in t))


# --- loads -----------------------------------------------------------------------------------------


class Part(NamedTuple):
    """What one unit of a load puts on one link: a force at a point, and a couple (force times size)."""

    link: str
    at: Place
    force: Place
    couple: Any


def parts(load: c.Load, found: Motions) -> list[Part]:
    """What one unit of a load puts on the links (on the frame nothing, as it does not move)."""
    num = found.digits.num
    if isinstance(load, c.Torque):
        sense = num(-1 if load.turns == "cw" else 1)
        couple = sense / num(found.case.units.torque_per_force_length) / num(found.frame.size)
        pair = [Part(load.link, (num(0), num(0)), (num(0), num(0)), couple)]
    else:
        at = found.frame.place(found.points[load.at], num)
        pair = [Part(load.link, at, _push(load, found), num(0))]
    opposite = getattr(load, "against", None) or found.case.ground
    first = pair[0]
    return [first, Part(opposite, first.at, (-first.force[0], -first.force[1]), -first.couple)]


def _push(load: c.Load, found: Motions) -> Place:
    """The force that one unit of a load (a newton, a kilogram, a unit of stiffness) is, by components."""
    num, points = found.digits.num, found.points
    if isinstance(load, c.ForceVector):
        return num(load.x.value), num(load.y.value)
    if isinstance(load, c.Weight):
        a_kilogram = num(found.case.gravity.value) * num(found.case.units.force_per_newton)
        return num(0), -(a_kilogram if load.mass else num(1))
    if isinstance(load, c.Spring):
        a, b = ([num(x) for x in points[p]] for p in (load.at, load.to))
        pull = found.digits.sqrt((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2) - num(load.free.value)
        ux, uy = unit((a[0], a[1]), (b[0], b[1]), found.digits)
        return pull * ux, pull * uy
    assert isinstance(load, c.Force)
    return _heading(load, found)


def _heading(load: c.Force, found: Motions) -> Place:
    """Unit vector of a force."""
    if isinstance(load.heading, c.Slope):
        run = (load.heading.run.value, load.heading.rise.value)
        return unit((0, 0), run, found.digits)
    if isinstance(load.heading, c.Toward):
        ends = (load.at, load.heading.point)
        a, b = (found.points[p] for p in (reversed(ends) if load.heading.away else ends))
        return unit(a, b, found.digits)
    return found.digits.turn(load.heading.value)


def share(case: c.Case, load: c.Load) -> tuple[float, str | None]:
    """A load's number: a known one, or a multiple of the unknown that is named."""
    if isinstance(load, c.ForceVector):
        return 1.0, None
    if load.value is None:
        return 1.0, load.name
    if isinstance(load.value, c.Number):
        return load.value.value, None
    other = next(q for q in case.loads if q.name == load.value.load)
    value, unknown = share(case, other)
    return value * (load.value.times.value if load.value.times else 1.0), unknown


class Balance(NamedTuple):
    """The power of every load for every motion: columns of the unknowns, and of the known loads."""

    unknowns: list[str]
    factors: Any
    known: Any


def balance(found: Motions) -> Balance:
    """Power per unit of each unknown, and power of the known loads, a row for each motion."""
    case = found.case
    unknowns = [q.name for q in case.loads if not isinstance(q, c.ForceVector) and q.value is None]
    factors = [[found.digits.num(0)] * len(unknowns) for _ in found.basis]
    known: list[list[Any]] = [[] for _ in found.basis]
    for load in case.loads:
        value, unknown = share(case, load)
        for k, motion in enumerate(found.basis):
            power = found.digits.num(value) * sum(_power(part, motion) for part in parts(load, found))
            if unknown is None:
                known[k].append(power)
            else:
                factors[k][unknowns.index(unknown)] += power
    return Balance(unknowns, factors, known)


def _power(part: Part, motion: dict[str, Twist]) -> Any:
    x, y, w = motion[part.link]
    px, py = part.at
    return part.force[0] * (y - w * py) + part.force[1] * (w * px - x) + part.couple * w


def answers(found: Motions) -> dict[str, float]:
    """The unknown loads that leave no power in any motion, in case units."""
    powers = balance(found)
    a = np.array(powers.factors, dtype=float).reshape(len(found.basis), len(powers.unknowns))
    b = np.array([-float(sum(row)) for row in powers.known])
    if a.shape == (1, 1):
        return {powers.unknowns[0]: float(-sum(powers.known[0]) / powers.factors[0][0])}
    x, _, rank, _ = np.linalg.lstsq(a, b, rcond=1e-10)
    scale = max(
        1e-300, *(abs(float(p)) for row in powers.known for p in row), *np.abs(a @ np.diag(x)).ravel()
    )
    assert rank == len(powers.unknowns), "an unknown does no work"
    assert np.all(np.abs(a @ x - b) <= 1e-9 * scale), "a motion is left out of balance"
    return dict(zip(powers.unknowns, (float(v) for v in x), strict=True))


def firmness(found: Motions) -> float:
    """How well the balance determines its unknowns: 1 at best, 0 at a dead centre.

    The smaller of two ratios, of the unknowns and of the known loads: the power in these motions over the
    most that loads of their sizes could do; of several unknowns, the least independent.
    """
    powers = balance(found)
    largest = max(_size(t) for motion in found.basis for t in motion.values())
    sizes = {True: 1e-300, False: 1e-300}
    for load in found.case.loads:
        value, unknown = share(found.case, load)
        first = parts(load, found)[0]
        size = math.hypot(*(float(f) for f in first.force)) + abs(float(first.couple))
        sizes[unknown is None] += abs(value) * size * largest
    factors = np.array(powers.factors, dtype=float)
    least = (
        float(np.linalg.svd(factors, compute_uv=False)[-1]) if factors.shape[0] == factors.shape[1] else 0.0
    )
    known = math.hypot(*(float(sum(row)) for row in powers.known))
    return min(least / sizes[False], known / sizes[True])


# --- rates and velocities --------------------------------------------------------------------------


class Speeds(NamedTuple):
    """One motion picked from the basis, and what of it is left open."""

    found: Motions
    chosen: Any
    open: Any

    def rate(self, link: str) -> float | None:
        """Angular velocity in rad/s; None where it is left open."""
        return self._mix([b[link][2] for b in self.found.basis], 1.0)

    def velocity(self, point: str, link: str) -> tuple[float, float] | None:
        """Velocity of a point on a link, in length units a second; None where it is left open."""
        each = [self.found.velocity(k, point, link) for k in range(len(self.found.basis))]
        x, y = (self._mix([v[k] for v in each], self.found.frame.size) for k in (0, 1))
        return None if x is None or y is None else (x, y)

    def _mix(self, each: list[Any], unit_of: float) -> float | None:
        row = np.array([float(a) for a in each])
        if np.any(np.abs(row @ self.open) > 1e-9):
            return None
        return float(row @ self.chosen) * unit_of


def speeds(case: c.Case, points: Points | None = None, digits: Digits = DOUBLE) -> Speeds:
    """The motion that `rates` and `velocities` are of: as ``motion`` says, or scaled as the format says."""
    found = motions(case, points, digits)
    conditions = [_given(found, m) for m in case.motion] or [_scaled(found, case)]
    a = np.array([row for row, _ in conditions], dtype=float)
    b = np.array([value for _, value in conditions], dtype=float)
    chosen = np.linalg.lstsq(a, b, rcond=1e-12)[0]
    assert np.allclose(a @ chosen, b, rtol=1e-9)
    _, s, vt = np.linalg.svd(a)
    return Speeds(found, chosen, vt[int(np.sum(s > 1e-12 * s[0])) :].T)


Condition = tuple[list[float], float]


def _given(found: Motions, motion: c.Motion) -> Condition:
    """A row over the basis, and what it must give."""
    if motion.point is not None:
        assert motion.angle is not None and motion.speed is not None
        ux, uy = DOUBLE.turn(motion.angle.value)
        size = found.frame.size
        each = [found.velocity(k, motion.point, motion.link) for k in range(len(found.basis))]
        if len(each) == 1:  # the magnitude as given, along the point's own direction
            vx, vy = (float(v) * size for v in each[0])
            return [math.copysign(math.hypot(vx, vy), vx * ux + vy * uy)], motion.speed.value
        return [size * float(vx * ux + vy * uy) for vx, vy in each], motion.speed.value
    speed = motion.speed.value if motion.speed is not None else 1.0
    return _spins(found, motion.link), -speed if motion.turns == "cw" else speed


def _spins(found: Motions, link: str) -> list[float]:
    return [float(b[link][2]) for b in found.basis]


def _scaled(found: Motions, case: c.Case) -> Condition:
    """The first link that turns at +1; where none turns, the first that moves at unit speed."""
    largest = max(_size(t) for b in found.basis for t in b.values())
    for link in case.links:
        if max(map(abs, _spins(found, link))) > STILL * largest:
            return _spins(found, link), 1.0
    link = next(n for n in case.links if max(_size(b[n]) for b in found.basis) > STILL * largest)
    x, y, _ = found.basis[0][link]
    vx, vy = float(y) * found.frame.size, -float(x) * found.frame.size
    forward = vx if abs(vx) > STILL * abs(vy) else vy
    return [math.copysign(math.hypot(vx, vy), forward)], 1.0
