"""Where followers first meet their cams in all rows at once, as the cam sees it.

To a cam the way of a roller's centre is one closed line, which no row changes: its pieces moved out by the
roller's radius, with an arc about each corner. Likewise a face only asks how far the profile reaches in a
direction. Both are sampled once; in every row the samples say on which chord of the line the follower meets
it first, and the place is closed in on the exact piece. Rows in doubt are left to `contact_candidates`.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from icsolve.cams.contact_candidates import Freedom, Shift
from icsolve.cams.curve import MEETING, Body, Curve
from icsolve.cams.pieces import TURN, CircularArc, Piece, PolarPiece, Spline, Straight
from icsolve.numbers.replay import Array, Mask
from icsolve.tuples import NamedTuple

CLOSE = 1e-4
"""Of the profile's size: what is as near as this to being otherwise is left open."""
WAYS = 720
"""Directions in which the reach of a profile is known beforehand."""
ROWS = 512
"""Rows that are looked at together: their samples fit the cache."""
STEPS = 60
NEWTON = 12
AT_ONE = 1e-12
"""A step of this part of a turn is none."""
AT_END = 1e-9
"""So near to the end of a piece (of its length) doubles leave open whether the next one is touched."""

Which = npt.NDArray[np.intp]
Vectors = tuple[Array, Array]
"""x and y, (n,) each."""


class FirstContacts(NamedTuple):
    """Where followers meet their cams.

    Attributes
    ----------
    by : how far each is moved from its pose, (n,) [case length; rad where it turns]
    point : where it touches, as the cam sees it, (n, 2) [case length]
    normal : unit normal there, from the cam into the follower, (n, 2)
    sure : in which rows this is decided, (n,); the others are left to `contact_candidates`
    centre : of the arc well within which it touches, (n, 2) [case length]; not a number on other pieces
    radius : of the curvature of the cam there, as `radius_ratio`, (n, 2); not a number where the next piece
        has another
    within : in which rows it touches well within a piece, (n,), or the normal is the same on the next
    """

    by: Array
    point: Array
    normal: Array
    sure: Mask
    centre: Array
    radius: Array
    within: Mask


class FirstContact:
    """The first meetings from outside of one follower and its cam, in many positions.

    Parameters
    ----------
    curve : the cam's profile
    body, freedom : the follower as the cam sees it and how it moves, whose places and directions are pairs of
        arrays, (n,) each [case length]
    side : of a flat face the side on which it has its body, 1 or -1
    sense : 1 where the gap grows as it moves on, -1 where it shrinks
    """

    def __init__(self, curve: Curve, body: Body, freedom: Freedom, side: float, sense: float) -> None:
        self.size, self.side, self.sense = curve.size, side, sense
        self.flat, self.shifts = body.kind == "flat face", isinstance(freedom, Shift)
        self.at: Array = np.array(body.at)
        self.face: Array = np.array(body.face)
        self.guide: Array = np.array(freedom.along if isinstance(freedom, Shift) else freedom.about)
        self.line = _Line(curve, 0.0 if self.flat else body.radius)
        self.angles = np.linspace(0.0, TURN, WAYS + 1)
        if self.flat and not self.shifts:
            self.reach = (
                _outer(np.cos(self.angles), self.line.x) + _outer(np.sin(self.angles), self.line.y)
            ).max(1)

    def run(self) -> FirstContacts:
        """All rows; what does not exist is not sure, and raises nothing."""
        rows = self.at.shape[1]
        parts = [self._block(slice(start, start + ROWS)) for start in range(0, max(rows, 1), ROWS)]
        return FirstContacts(*(np.concatenate(column) for column in zip(*parts, strict=True)))

    def _block(self, rows: slice) -> FirstContacts:
        at, face, guide = self.at[:, rows], self.face[:, rows], self.guide[:, rows]
        with np.errstate(all="ignore"):
            if self.flat:
                met = (self._face_shifted if self.shifts else self._face_turned)(at, face, guide)
            else:
                met = self._centre(at, guide)
        finite = (
            np.isfinite(met.by) & np.isfinite(met.point).all(axis=1) & np.isfinite(met.normal).all(axis=1)
        )
        return met._replace(sure=met.sure & finite)

    # --- rollers and knife edges ------------------------------------------------------------------

    def _centre(self, at: Array, guide: Array) -> FirstContacts:
        """Where the way of the follower's point crosses the line; ``guide`` is the direction in which it
        slides, or its pivot."""
        line, (px, py) = self.line, at
        rows = len(px)
        if self.shifts:
            dx, dy = guide
            off = _outer(dy, line.x)
            off -= _outer(dx, line.y)
            off -= (px * dy - py * dx)[:, None]
        else:
            qx, qy = guide
            square = (px - qx) ** 2 + (py - qy) ** 2
            off = _outer(qx, line.x)
            off += _outer(qy, line.y)
            off *= -2.0
            off += line.square
            off += (qx * qx + qy * qy - square)[:, None]
        beyond = off > 0.0
        row, chord = line.chords(beyond[:, :-1] != beyond[:, 1:])
        a, b = line.first[chord], line.first[chord] + 1
        share = off[row, a] / (off[row, a] - off[row, b])
        x, y = (v[a] + share * (v[b] - v[a]) for v in (line.x, line.y))
        by, sense = self._way(at[:, row], guide[:, row], x, y, line.nx[a], line.ny[a])
        real = np.ones(len(row), dtype=bool) if self.shifts else line.good[a] | line.good[b]
        chosen, sure = self._first(row[real], by[real], sense[real], rows)
        # any chord, where a row has none
        chord, sure = np.append(chord[real], 0)[chosen], sure & (chosen >= 0) & ~self._grazed(off, guide)
        sure &= line.good[line.first[chord]] & line.good[line.first[chord] + 1]

        def miss(x: Array, y: Array) -> Array:
            if self.shifts:
                return np.asarray((x - px) * dy - (y - py) * dx)
            return np.asarray((x - qx) ** 2 + (y - qy) ** 2 - square)

        x, y, nx, ny, closed, centre, radius, within = line.closed(chord, miss)
        by, _ = self._way(at, guide, x, y, nx, ny)
        point = np.stack([x - line.radius * nx, y - line.radius * ny], axis=1)
        return FirstContacts(by, point, np.stack([nx, ny], axis=1), sure & closed, centre, radius, within)

    def _grazed(self, off: Array, guide: Array) -> Mask:
        """Rows in which the way may pass twice through the piece over one chord, whose ends lie to one side
        of it: there it runs along the piece, nearer than that lies to its chord."""
        line, (qx, qy) = self.line, guide
        x, y = line.x[line.first], line.y[line.first]
        dx, dy = line.x[line.first + 1] - x, line.y[line.first + 1] - y
        long = dx * dx + dy * dy
        reach = math.sqrt(line.square.max()) + np.hypot(qx, qy).max(initial=0.0)
        most = 2.0 * line.rise * (1.0 if self.shifts else 2.0 * reach) + AT_ONE * self.size**2
        # else it is far from both ends of the chord
        small = np.abs(off) < most + (0.0 if self.shifts else long.max())
        row, k = line.chords(small[:, :-1] | small[:, 1:])
        a, b = off[row, line.first[k]], off[row, line.first[k] + 1]
        if self.shifts:
            least, along, room = np.minimum(np.abs(a), np.abs(b)), 0.0, 2.0 * line.rise
        else:
            x, y, dx, dy, along, qx, qy = x[k], y[k], dx[k], dy[k], long[k], qx[row], qy[row]
            foot = (qx * dx + qy * dy - (x * dx + y * dy)) / along
            nearest = np.where((foot > 0.0) & (foot < 1.0), a - foot * foot * along, np.minimum(a, b))
            least = np.where(a > 0.0, nearest, -np.maximum(a, b))
            room = 4.0 * line.rise * np.hypot(x - qx, y - qy) + AT_ONE * self.size**2
        beside = ((a > 0.0) == (b > 0.0)) & (least < room) & (np.abs(a - b) <= 1.5 * along + 3.0 * room)
        return np.bincount(row[beside], minlength=len(off)) > 0

    def _way(self, at: Array, guide: Array, x: Array, y: Array, nx: Array, ny: Array) -> tuple[Array, Array]:
        """How far the follower is moved to places, and whether the gap grows there as it moves on."""
        px, py = at
        if self.shifts:
            dx, dy = guide
            return (x - px) * dx + (y - py) * dy, np.sign(nx * dx + ny * dy)
        qx, qy = guide
        by = np.arctan2(y - qy, x - qx) - np.arctan2(py - qy, px - qx)
        return _wrapped(by), np.sign(ny * (x - qx) - nx * (y - qy))

    def _first(self, row: Which, by: Array, sense: Array, rows: int) -> tuple[Which, Mask]:
        """Of the places in each row that which a follower from outside meets first (-1: none), and where no
        other comes near."""
        count = np.bincount(row, minlength=rows)
        most = int(count.max(initial=0))
        if not most:
            return np.full(rows, -1), np.zeros(rows, dtype=bool)
        start = np.concatenate([[0], np.cumsum(count)[:-1]])
        place = np.full((rows, most), -1)
        place[row, np.arange(len(row)) - start[row]] = np.arange(len(row))
        lines = np.where(place >= 0, by[place], np.nan)
        outer = (place >= 0) & (sense[place] == self.sense)
        if self.shifts:
            rank, near = self.sense * lines, CLOSE * self.size + 2.0 * self.line.rise
        else:
            apart = np.where(
                np.eye(most, dtype=bool)[None],
                TURN,
                (self.sense * (lines[:, None, :] - lines[:, :, None])) % TURN,
            )
            rank, near = np.nanmin(apart, axis=2), CLOSE * TURN
        rank = np.where(outer, rank, -np.inf)
        best = rank.argmax(axis=1)
        every = np.arange(rows)
        top = rank[every, best]
        rank[every, best] = -np.inf
        sure = np.isfinite(top) & (top - rank.max(axis=1) > near)
        if self.shifts:  # nor one at which the gap shrinks
            others = np.where((place >= 0) & ~outer, self.sense * lines, -np.inf)
            sure &= top - others.max(axis=1) > near
        return np.where(sure, place[every, best], -1), sure

    # --- faces ------------------------------------------------------------------------------------

    def _face_shifted(self, at: Array, face: Array, along: Array) -> FirstContacts:
        (px, py), (fx, fy), (dx, dy) = at, face, along
        wx, wy = -self.side * fy, self.side * fx
        x, y, sure, centre, radius = self.line.farthest(wx, wy)
        rate = wx * dx + wy * dy
        by = -((px - x) * wx + (py - y) * wy) / rate
        sure &= (np.sign(rate) == self.sense) & (np.abs(rate) > CLOSE)
        point, normal = np.stack([x, y], axis=1), np.stack([wx, wy], axis=1)
        return FirstContacts(by, point, normal, sure, centre, radius, sure)

    def _face_turned(self, at: Array, face: Array, about: Array) -> FirstContacts:
        """A face on an arm: by the angle of its normal, the gap is the arm's less the profile's reach."""
        (px, py), (fx, fy), (qx, qy) = at, face, about
        wx, wy = -self.side * fy, self.side * fx
        rows, start = len(px), np.arctan2(wy, wx)
        own = wx * (px - qx) + wy * (py - qy)
        gap = own[:, None] + _outer(qx, np.cos(self.angles)) + _outer(qy, np.sin(self.angles)) - self.reach
        beyond = gap > 0.0
        row, k = np.nonzero(beyond[:, :-1] != beyond[:, 1:])
        share = gap[row, k] / (gap[row, k] - gap[row, k + 1])
        angle = self.angles[k] + share * (self.angles[1] - self.angles[0])
        sense = np.where(beyond[row, k], -1.0, 1.0)
        chosen, sure = self._first(row, _wrapped(angle - start[row]), sense, rows)
        angle = angle[chosen] if len(angle) else np.full(rows, np.nan)
        for _ in range(NEWTON):
            c, s = np.cos(angle), np.sin(angle)
            x, y, smooth, centre, radius = self.line.farthest(c, s)
            step = (own + c * (qx - x) + s * (qy - y)) / (c * (qy - y) - s * (qx - x))
            angle = angle - step
            if np.nanmax(np.abs(step), initial=0.0) <= AT_ONE:
                break
        sure &= (np.abs(step) <= 1e3 * AT_ONE) & smooth
        point, normal = np.stack([x, y], axis=1), np.stack([np.cos(angle), np.sin(angle)], axis=1)
        return FirstContacts(_wrapped(angle - start), point, normal, sure, centre, radius, sure)


def _outer(a: Array, b: Array) -> Array:
    return np.multiply.outer(a, b)


def _wrapped(by: Array) -> Array:
    """Angles within the whole turn in which ways are looked for."""
    low = 0.001 - TURN / 2.0
    return np.asarray(low + (by - low) % TURN)


class _Line:
    """A profile moved out by a radius: its pieces, samples of each (with their normals) in order, and the
    samples at which chords begin; ``rise`` is how far it lies from its chords. A sample is ``good`` where the
    profile is no nearer than the radius."""

    def __init__(self, curve: Curve, radius: float) -> None:
        self.radius, self.size = radius, curve.size
        self.pieces = list(_pieces(curve, radius > 0.0))
        # a roller rolls about a corner on a piece of its own
        corners = [not radius and curve.foot(k, 1.0).is_corner for k in range(len(self.pieces))]
        self.corners = np.array(corners)
        counts = [piece.chords() for piece in self.pieces]
        self.u = np.concatenate([np.arange(n + 1) / n for n in counts])
        self.piece = np.repeat(np.arange(len(counts)), np.array(counts) + 1)
        self.first = np.concatenate([np.arange(n) + sum(counts[:k]) + k for k, n in enumerate(counts)])
        self.chord = np.full(len(self.u), -1)
        self.chord[self.first] = np.arange(len(self.first))
        self.x, self.y, self.nx, self.ny = self.at(self.piece, self.u)
        self.square = self.x**2 + self.y**2
        self.step = 1.0 / np.array(counts)
        self.whole = np.array([isinstance(piece, PolarPiece) for piece in self.pieces])
        middle = self.at(self.piece[self.first], (self.u[self.first] + self.u[self.first + 1]) / 2.0)
        chord = [(v[self.first] + v[self.first + 1]) / 2.0 for v in (self.x, self.y)]
        self.rise = float(np.hypot(middle[0] - chord[0], middle[1] - chord[1]).max())
        self.good = np.ones(len(self.x), dtype=bool)
        if radius:
            import shapely

            inside = shapely.Polygon([p for p, _, _ in curve.chords])
            shapely.prepare([inside, inside.exterior])
            apart = shapely.distance(inside.exterior, shapely.points(self.x, self.y))
            self.good = ~shapely.contains_xy(inside, self.x, self.y) & (apart > radius - CLOSE * self.size)

    def chords(self, chosen: Mask) -> tuple[Which, Which]:
        """Rows and chords that are chosen, of (rows, samples but the last): from a sample to the next, which
        may be of another piece."""
        row, sample = np.nonzero(chosen)
        chord = self.chord[sample]
        real = chord >= 0
        return row[real], chord[real]

    def at(self, pieces: Which, u: Array) -> tuple[Array, Array, Array, Array]:
        """Places and normals on the pieces at their parameters ``u``: x, y, nx, ny, (rows,) each [frame]."""
        found = np.empty((4, len(u)))
        for k in np.unique(pieces).tolist():
            some = pieces == k
            found[:, some] = _at(self.pieces[k], u[some], self.radius)
        return found[0], found[1], found[2], found[3]

    def closed(
        self, chord: Which, miss: Callable[[Array, Array], Array]
    ) -> tuple[Array, Array, Array, Array, Mask, Array, Array, Mask]:
        """Where a function of the place vanishes on a chord of each row: x, y, nx, ny, and where it does,
        (rows,) each [frame]; and ``centre``, ``radius`` and ``within`` of `FirstContacts`.
        """
        first = self.first[chord]
        pieces = self.piece[first]

        def value(u: Array) -> Array:
            x, y, _, _ = self.at(pieces, u)
            return miss(x, y)

        u, there = _zero(value, self.u[first], self.u[first + 1])
        within = np.asarray(self.whole[pieces] | (self.radius > 0.0) | ((u > AT_END) & (u < 1.0 - AT_END)))
        return (*self.at(pieces, u), there, self.centres(pieces, u), self.radii(pieces, u), within)

    def centres(self, pieces: Which, u: Array) -> Array:
        """The centres of the arcs well within which places lie, (rows, 2); not a number elsewhere."""
        own = [piece.centre if isinstance(piece, CircularArc) else (np.nan, np.nan) for piece in self.pieces]
        found = np.array(own)[pieces]
        found[~((u > AT_END) & (u < 1.0 - AT_END))] = np.nan
        return found

    def radii(self, pieces: Which, u: Array) -> Array:
        """``radius`` of `FirstContacts` on the profile itself; at a corner 0."""
        found = np.empty((len(u), 2))
        for k in np.unique(pieces).tolist():
            some, piece = pieces == k, self.pieces[k]
            found[some] = _bend(piece, u[some], self.size)
        at_end = ~self.whole[pieces] & ((u <= AT_END) | (u >= 1.0 - AT_END))
        corner = ((u == 0.0) & self.corners[pieces - 1]) | ((u == 1.0) & self.corners[pieces])
        found[at_end] = np.where(corner[at_end, None], (0.0, 1.0), np.nan)
        return found

    def farthest(self, wx: Array, wy: Array) -> tuple[Array, Array, Mask, Array, Array]:
        """Where the profile reaches farthest in a direction, x and y [frame], and in which rows at one place
        only, (rows,) each; and ``centre`` and ``radius`` of `FirstContacts`.
        """
        if not self.whole.any():
            return self._farthest_of_pieces(wx, wy)
        reach = _outer(wx, self.x) + _outer(wy, self.y)
        best = reach.argmax(axis=1)
        u, sure = self._turned(best, wx, wy)
        x, y, _, _ = self.at(self.piece[best], u)
        far = (self.x - x[:, None]) ** 2 + (self.y - y[:, None]) ** 2 > (0.05 * self.size) ** 2
        level = reach > (reach.max(axis=1) - self.rise - CLOSE**1.5 * self.size)[:, None]
        own = self.piece[best]
        return x, y, sure & ~(far & level).any(axis=1), self.centres(own, u), self.radii(own, u)

    def _farthest_of_pieces(self, wx: Array, wy: Array) -> tuple[Array, Array, Mask, Array, Array]:
        """The same for straight lines and arcs, of each the farthest place."""
        every = np.empty((4, len(self.pieces), len(wx)))
        for k, piece in enumerate(self.pieces):
            ends = [wx * x + wy * y for x, y in (piece.at(0.0), piece.at(1.0))]
            u = np.where(ends[1] > ends[0], 1.0, 0.0)
            if isinstance(piece, CircularArc):
                turn = (np.arctan2(wy, wx) - piece.start) * math.copysign(1.0, piece.sweep) % TURN
                u = np.where(turn <= abs(piece.sweep), turn / abs(piece.sweep), u)
            every[:2, k], every[2, k] = _at(piece, u, 0.0)[:2], u
        every[3] = wx * every[0] + wy * every[1]
        best, rows = every[3].argmax(axis=0), np.arange(len(wx))
        x, y, u, reach = every[:, best, rows]
        apart = np.hypot(every[0] - x, every[1] - y) > MEETING * self.size
        level = every[3] > reach - CLOSE**2 * self.size
        return x, y, ~(apart & level).any(axis=0), self.centres(best, u), self.radii(best, u)

    def _turned(self, best: Which, wx: Array, wy: Array) -> tuple[Array, Mask]:
        """Where the normal has a direction, near a sample of each row; the sample where it has not."""
        pieces = self.piece[best]
        step, whole = 1.5 * self.step[pieces], self.whole[pieces]
        low, high = self.u[best] - step, self.u[best] + step
        low, high = np.where(whole, low, np.maximum(low, 0.0)), np.where(whole, high, np.minimum(high, 1.0))

        def aside(u: Array) -> Array:
            _, _, nx, ny = self.at(pieces, u)
            return nx * wy - ny * wx

        u, there = _zero(aside, low, high)
        return np.where(there, u, self.u[best]), there


def _pieces(curve: Curve, corners: bool) -> list[Piece]:
    """The pieces of a curve in order; with an arc of no radius at each corner that juts out."""
    found: list[Piece] = []
    for k, piece in enumerate(curve.pieces):
        found.append(piece)
        foot = curve.foot(k, 1.0)
        if corners and foot.is_corner and foot.is_convex:
            (ax, ay), (bx, by) = foot.normals
            sweep = math.atan2(ax * by - ay * bx, ax * bx + ay * by)
            found.append(CircularArc(foot.point, 0.0, math.atan2(ay, ax), sweep))
    return found


def _at(piece: Piece, u: Array, out: float) -> Array:
    """Places on a piece moved out, and its normals there: x, y and the normal's, (4, n)."""
    if isinstance(piece, Straight):
        (ax, ay), (bx, by), (tx, ty) = piece.a, piece.b, piece.tangent(0.0)
        x, y, nx, ny = ax + u * (bx - ax), ay + u * (by - ay), np.full(len(u), ty), np.full(len(u), -tx)
    elif isinstance(piece, CircularArc):
        angle, sign = piece.start + u * piece.sweep, math.copysign(1.0, piece.sweep)
        c, s = np.cos(angle), np.sin(angle)
        x, y, nx, ny = (
            piece.centre[0] + piece.radius * c,
            piece.centre[1] + piece.radius * s,
            sign * c,
            sign * s,
        )
    else:
        r, slope, _ = _radius(piece.radius, piece.turn * u * TURN)
        slope = slope * piece.turn
        c, s = np.cos(piece.zero + u * TURN), np.sin(piece.zero + u * TURN)
        x, y, size = piece.about[0] + r * c, piece.about[1] + r * s, np.hypot(r, slope)
        nx, ny = (slope * s + r * c) / size, (r * s - slope * c) / size
    return np.stack([x + out * nx, y + out * ny, nx, ny])


def radius_ratio(above: Array, below: Array, size: float) -> Array:
    """A radius of curvature as the ratio of two numbers, (n, 2) [case length, 1], of which the second is 0
    where it is straight; neither is large or small beside a size."""
    pair = np.stack([above, below], axis=-1)
    return np.asarray(pair * (size / (np.abs(above) + size * np.abs(below)))[..., None])


def _bend(piece: Piece, u: Array, size: float) -> Array:
    """Radii of curvature on a piece, as its ``radius_at``."""
    if isinstance(piece, PolarPiece):
        r, slope, bend = _radius(piece.radius, piece.turn * u * TURN)
        return radius_ratio(np.hypot(r, slope) ** 3, 2.0 * slope**2 + r * (r - bend), size)
    radius, one = piece.radius_at(0.5), np.ones(len(u))
    return radius_ratio(one, 0.0 * one, size) if radius is None else radius_ratio(radius * one, one, size)


def _radius(by: Spline, angle: Array) -> tuple[Array, Array, Array]:
    """Values of a spline, its slopes and their slopes, as `Spline.at`."""
    places, values, bends = (np.array(row) for row in (by.places, by.values, by.bends))
    x = places[0] + (angle - places[0]) % by.period
    k = np.minimum(np.searchsorted(places, x, side="right"), len(places)) - 1
    n = (k + 1) % len(places)
    h = places[n] - places[k] + np.where(n <= k, by.period, 0.0)
    b = (x - places[k]) / h
    a = 1.0 - b
    value = a * values[k] + b * values[n] + ((a**3 - a) * bends[k] + (b**3 - b) * bends[n]) * h * h / 6.0
    bent = (3.0 * b * b - 1.0) * bends[n] - (3.0 * a * a - 1.0) * bends[k]
    return value, (values[n] - values[k]) / h + bent * h / 6.0, a * bends[k] + b * bends[n]


def _zero(function: Callable[[Array], Array], low: Array, high: Array) -> tuple[Array, Mask]:
    """Where a function of each row changes its sign, by false position (Illinois); in which rows it does."""
    a, b = low.copy(), high.copy()
    at_a, at_b = function(a), function(b)
    there = (at_a <= 0.0) != (at_b <= 0.0)
    u = np.where(np.abs(at_a) < np.abs(at_b), a, b)
    for _ in range(STEPS):
        new = b - at_b * (b - a) / (at_b - at_a)
        new = np.where((new >= np.minimum(a, b)) & (new <= np.maximum(a, b)), new, (a + b) / 2.0)
        here = function(new)
        crossed = (here <= 0.0) != (at_b <= 0.0)
        a, at_a = np.where(crossed, b, a), np.where(crossed, at_b, at_a / 2.0)
        b, at_b = new, here
        settled = (np.abs(new - u) <= 2.0**-51 * np.maximum(np.abs(new), 2.0**-20)) | (here == 0.0) | ~there
        u = new
        if settled.all():
            break
    return u, there & settled
