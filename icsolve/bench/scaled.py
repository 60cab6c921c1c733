"""A case of another size: lengths and loads times powers of two, which change no bit of a fraction."""

from __future__ import annotations

from dataclasses import replace

from icsolve.case import Belt, Case, Centroid, Coordinates, Force, Joint, Load, Number, Torque


def scaled(case: Case, lengths: int, loads: int) -> Case:
    """A case with its lengths times 2**lengths and its known loads times 2**loads.

    Made for the families of the benchmark, whose known and unknown load are both torques or both
    forces: the unknown is then times 2**loads.
    """
    size, load = 2.0**lengths, 2.0**loads
    return replace(
        case,
        points={name: _place(place, size) for name, place in case.points.items()},
        lengths=tuple(side._replace(value=_times(side.value, size)) for side in case.lengths),
        near={name: (x * size, y * size) for name, (x, y) in case.near.items()},
        joints=tuple(_joint(joint, size) for joint in case.joints),
        loads=tuple(_load(given, load) for given in case.loads),
    )


def _times(number: Number, factor: float) -> Number:
    value = number.value * factor
    return number._replace(value=value, half=number.half * factor, digits=repr(value))


def _place(place: Coordinates | Centroid, size: float) -> Coordinates | Centroid:
    if isinstance(place, Centroid):
        return place
    x, y = (None if number is None else _times(number, size) for number in place)
    return Coordinates(x, y)


def _joint(joint: Joint, size: float) -> Joint:
    if not isinstance(joint, Belt):
        return joint
    one, two = joint.radii
    return joint._replace(radii=(_times(one, size), _times(two, size)))


def _load(load: Load, factor: float) -> Load:
    if isinstance(load, Torque | Force) and isinstance(load.value, Number):
        return load._replace(value=_times(load.value, factor))
    return load
