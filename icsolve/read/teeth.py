"""The form of teeth: pressure angle, pitch or module, helix."""

from __future__ import annotations

import math

from icsolve.case import Helix, Number
from icsolve.case.space import Teeth
from icsolve.read.entry import Entry, Values
from icsolve.read.keys import TOOTH_ANGLES, TOOTH_SIZES

Transverse = tuple[Number, Number | None, Number | None, Helix | None]
"""Pressure angle; diametral pitch and module in the plane of the wheel; the helix."""


def read_helical(entry: Entry, values: Values) -> Transverse | None:
    """The teeth of a mesh of the plane; what is given in the normal section is turned into the plane."""
    teeth = read_teeth(entry, values, False)
    if teeth is None or teeth.helix_angle is None:
        return None
    helix = Helix(teeth.helix_angle, values["bearing span"], teeth.normal_angle)
    cosine = math.cos(math.radians(teeth.helix_angle.value)) if teeth.normal_pitch else 1.0
    pitch, module = teeth.diametral_pitch, teeth.module
    pitch = pitch and pitch._replace(value=pitch.value * cosine, half=pitch.half * cosine)
    module = module and module._replace(value=module.value / cosine, half=module.half / cosine)
    return teeth.pressure_angle, pitch, module, helix


def read_teeth(entry: Entry, values: Values, pitch_needed: bool) -> Teeth | None:
    """The teeth of a mesh; None, with the reason noted, where they can't be read.

    With a helix angle the pressure angle and the pitch say in which section they are meant: square to the
    teeth (``normal``) or in the plane of the wheel (``transverse``).
    """
    angle_key = next((key for key in TOOTH_ANGLES if entry.has(key)), "")
    size_key = next((key for key in TOOTH_SIZES if entry.has(key)), "")
    helical = entry.has("helix angle")
    if not angle_key:
        said = "that of the teeth, such as 20" + (", or 'transverse pressure angle'" if helical else "")
        entry.need("normal pressure angle" if helical else "pressure angle", said)
    if not size_key and pitch_needed:
        said = "or 'module': it gives the pitch circle of a gear whose mate is not shown"
        entry.need("diametral pitch", said)
    for key in (angle_key, size_key):
        _check_section(entry, key, helical)
    if not entry.whole:
        return None
    size = values[size_key] if size_key else None
    pitch, module = (size, None) if size_key.endswith("pitch") else (None, size)
    normal_angle, normal_size = (key.startswith("normal") for key in (angle_key, size_key))
    helix, hand = values["helix angle"], values["hand"] or "right"
    return Teeth(values[angle_key], normal_angle, helix, hand, pitch, module, normal_size)


def _check_section(entry: Entry, key: str, helical: bool) -> None:
    """Straight teeth have one section; of a helix one must say which."""
    if not key or key.startswith(("normal", "transverse")) == helical:
        return
    if helical:
        said = f"with a helix angle say whether it is the 'normal {key}' or the 'transverse {key}'"
    else:
        kind = key.partition(" ")[2]
        said = f"straight teeth have one {kind}; without a helix angle leave out the first word"
    entry.refuse(entry.mark(key), f"'{key}' of {entry.what}: {said}")
