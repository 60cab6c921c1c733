"""Methods by matrices: null space by SVD, LU with the input fixed, equilibrium of free bodies, Newton."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from icsolve.bench.rivals import Drawn, Failed, OtherData, Posed, balanced, posed
from icsolve.case import Case, Coordinates
from icsolve.screws.joints import transmitted
from icsolve.screws.plane import Point, Triple
from icsolve.statics import power

Matrix = npt.NDArray[np.float64]


def by_svd(scene: Drawn, normalised: bool) -> float:
    """Twists as the last right singular vector of the joints' conditions."""
    pose = posed(scene, normalised)
    return balanced(pose, _twists(pose, np.linalg.svd(_conditions(pose))[2][-1]))


def by_lu(scene: Drawn, normalised: bool) -> float:
    """Twists by LU with the rate of one joint at the frame fixed to 1."""
    pose = posed(scene, normalised)
    rows = _conditions(pose)
    top = pose.top
    if rows.shape[0] + 1 != rows.shape[1]:
        raise Failed("not as many conditions as unknowns")
    k = next(k for k in top.at[top.ground] if top.bonds[k].freedom == 1)
    basis, body = pose.bases[k][0], top.bonds[k].other(top.ground)
    drive = np.zeros(rows.shape[1])
    place = _columns(pose)[body]
    drive[place : place + 3] = (0.0, 0.0, 1.0) if basis[2] else basis
    right = np.zeros(rows.shape[1])
    right[-1] = 1.0
    return balanced(pose, _twists(pose, _solved(np.vstack([rows, drive]), right)))


def by_free_bodies(scene: Drawn, normalised: bool) -> float:
    """The wrenches of all joints and the unknown load from the equilibrium of every body, by LU."""
    pose = posed(scene, normalised)
    rows, columns = _conditions(pose), _columns(pose)
    known, unknown, measure = np.zeros(rows.shape[1]), np.zeros(rows.shape[1]), 1.0
    for w in pose.wrenches:
        number = power.known_value(w)
        for link, sign in ((w.load.link, 1.0), (w.against, -1.0)):
            place = columns.get(pose.top.body_of[link])
            if place is None:
                continue
            wrench = sign * w.gain * np.array(w.unit)
            if number is None:
                unknown[place : place + 3] += wrench
            else:
                known[place : place + 3] += wrench * number * w.measure
        measure = w.measure if number is None else measure
    matrix = np.column_stack([rows.T, unknown])
    if matrix.shape[0] != matrix.shape[1]:
        raise Failed("not as many equations as unknowns")
    return float(_solved(matrix, -known)[-1]) / measure


def by_newton(scene: Drawn, normalised: bool) -> float:
    """The pins of a four-bar from its lengths by Newton's method, started at ``near``; then SVD."""
    if scene.raw:
        raise OtherData("only for figures that are given by lengths")
    return by_svd(scene._replace(raw=_assembled(scene.case)), normalised)


def _solved(matrix: Matrix, right: Matrix) -> Matrix:
    try:
        return np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
    except np.linalg.LinAlgError:
        raise Failed("a singular matrix") from None


def _columns(pose: Posed) -> dict[int, int]:
    """The first column of every moving body."""
    moving = [body for body in range(len(pose.top.members)) if body != pose.top.ground]
    return {body: 3 * n for n, body in enumerate(moving)}


def _conditions(pose: Posed) -> Matrix:
    """A row a wrench that a joint transmits, three columns a moving body."""
    columns = _columns(pose)
    rows = []
    for k, bond in enumerate(pose.top.bonds):
        for wrench in transmitted(pose.bases[k]):
            row = np.zeros(3 * len(columns))
            for body, sign in ((bond.a, -1.0), (bond.b, 1.0)):
                if body in columns:
                    row[columns[body] : columns[body] + 3] = sign * np.array(wrench)
            rows.append(row)
    return np.array(rows)


def _twists(pose: Posed, vector: Matrix) -> list[Triple]:
    columns = _columns(pose)
    result: list[Triple] = [(0.0, 0.0, 0.0)] * len(pose.top.members)
    for body, k in columns.items():
        result[body] = (float(vector[k]), float(vector[k + 1]), float(vector[k + 2]))
    return result


MOST_STEPS = 50


def _assembled(case: Case) -> dict[str, Point]:
    """The pin C at the distances b from B and c from D; A, B and D follow from what is given."""
    a, b, c = (length.value.value for length in case.lengths)
    place = case.points["D"]
    assert isinstance(place, Coordinates) and place.x is not None
    angle = math.radians(case.angles[0].value.value)
    crank, pivot = np.array([a * math.cos(angle), a * math.sin(angle)]), np.array([place.x.value, 0.0])
    rod = np.array(case.near["C"])
    for _ in range(MOST_STEPS):
        arms = np.array([rod - crank, rod - pivot])
        off = np.hypot(arms[:, 0], arms[:, 1]) - (b, c)
        step = _solved(arms / np.hypot(arms[:, 0], arms[:, 1])[:, None], off)
        rod = rod - step
        if np.abs(step).max() <= 1e-16 * (b + c):
            break
    pins = {"A": np.zeros(2), "B": crank, "C": rod, "D": pivot}
    return {name: (float(x), float(y)) for name, (x, y) in pins.items()}
