"""The bare float kernel of a four-bar: what a single scene costs without a program around it."""

from __future__ import annotations

import math

from icsolve.assembly.loci import meet_circles
from icsolve.numbers.arithmetic import FLOATS, turn_of
from icsolve.screws.plane import Triple, cross, dyad_twists, pairing, pin_twist

HERE: Triple = (0.0, 0.0, 1.0)
TORQUE: Triple = (0.0, 0.0, 1.0)


def componentwise(
    d: float, a: float, b: float, c: float, angle: float, torque: float
) -> tuple[Triple, float]:
    """The coupler's centre with the frame and the torque on the crank, by the kernels that icsolve uses.

    A is the origin, D at (d, 0); a, b, c are the lengths AB, BC, CD; the angle is that of AB in
    degrees, the torque that on the rocker.
    """
    cosine, sine = turn_of(angle)
    crank = (a * cosine, a * sine)
    found = meet_circles((*crank, b), (d, 0.0, c), FLOATS, False)
    assert found.half is not None
    rod = (found.middle[0] + found.half[0], found.middle[1] + found.half[1])
    p12, p23, p34, p14 = HERE, pin_twist(crank), pin_twist(rod), (d, 0.0, 1.0)
    centre = cross(cross(p12, p23), cross(p14, p34))
    factor, _, rocker = dyad_twists(p23, p34, p14, (0.0, 0.0, -1.0))
    turning = pairing(TORQUE, (rocker * p14[0], rocker * p14[1], rocker * p14[2]))
    return centre, -torque * turning / pairing(TORQUE, (0.0, 0.0, factor))


def written_out(d: float, a: float, b: float, c: float, angle: float, torque: float) -> tuple[Triple, float]:
    """The same without a function call but sine, cosine and square root."""
    radians = math.radians(angle)
    bx, by = a * math.cos(radians), a * math.sin(radians)
    dx, dy = d - bx, -by
    s = math.sqrt(dx * dx + dy * dy)
    ux, uy = dx / s, dy / s
    along = ((s - c) * (s + c) + b * b) / (2.0 * s)
    h = math.sqrt((s + b + c) * (b + c - s) * (s - b + c) * (s + b - c)) / (2.0 * s)
    cx, cy = bx + along * ux - h * uy, by + along * uy + h * ux
    rx, m = cx - d, cy * d
    centre = (-bx * m, -by * m, by * rx - bx * cy)
    ex, ey = cx - bx, cy - by
    return centre, -torque * (ey * bx - ex * by) / (ey * rx - ex * cy)
