"""The form of teeth: pressure angle, pitch or module, helix."""

from __future__ import annotations

import math

from icsolve.case import Helix, Number
from icsolve.case.space import Teeth
from icsolve.read.reading import Entry

SECTIONS = ("", "normal ", "transverse ")
ANGLES = tuple(f"{section}pressure angle" for section in SECTIONS)
PITCHES = tuple(f"{section}diametral pitch" for section in SECTIONS)
MODULES = tuple(f"{section}module" for section in SECTIONS)

Transverse = tuple[Number, Number | None, Number | None, Helix | None]
"""Pressure angle; diametral pitch and module in the plane of the wheel; the helix."""


def read_helical(entry: Entry) -> Transverse | None:
    """The teeth of a mesh of the plane; what is given in the normal section is turned into the plane."""
    entry.need("helix angle")
    teeth = read_teeth(entry, False, False)
    span = entry.number("bearing span")
    if teeth is None or teeth.helix_angle is None or (span is None and entry.has("bearing span")):
        return None
    helix = Helix(teeth.helix_angle, span, teeth.normal_angle)
    cosine = math.cos(math.radians(teeth.helix_angle.value)) if teeth.normal_pitch else 1.0
    pitch, module = teeth.diametral_pitch, teeth.module
    pitch = pitch and pitch._replace(value=pitch.value * cosine, half=pitch.half * cosine)
    module = module and module._replace(value=module.value / cosine, half=module.half / cosine)
    return teeth.pressure_angle, pitch, module, helix


def read_teeth(entry: Entry, pitch_needed: bool, hand_needed: bool = True) -> Teeth | None:
    """The teeth of a mesh; None, with the reason noted, where they can't be read.

    With a helix angle the pressure angle and the pitch say in which section they are meant: square to the
    teeth (``normal``) or in the plane of the wheel (``transverse``).
    """
    angle_key, pitch_key = entry.one_of(ANGLES), entry.one_of((*PITCHES, *MODULES))
    if angle_key is None:
        helical = entry.has("helix angle")
        said = "that of the teeth, such as 20" + (", or 'transverse pressure angle'" if helical else "")
        entry.need("normal pressure angle" if helical else "pressure angle", said)
    if pitch_key is None and pitch_needed:
        entry.need(
            "diametral pitch", "or 'module': it gives the pitch circle of a gear whose mate is not shown"
        )
    helix, hand = _helix(entry, hand_needed)
    good = (helix is not None) == entry.has("helix angle") and (hand is not None) == entry.has("hand")
    for key in (angle_key, pitch_key):
        good = _section_is_clear(entry, key) and good
    angle = _acute(entry, angle_key) if angle_key else None
    pitch, module = _size(entry, pitch_key)
    if angle is None or not good or (pitch_key and pitch is None and module is None):
        return None
    is_normal = (_is_normal(angle_key), _is_normal(pitch_key))
    return Teeth(angle, is_normal[0], helix, hand or "right", pitch, module, is_normal[1])


def _helix(entry: Entry, hand_needed: bool) -> tuple[Number | None, str | None]:
    helix = _acute(entry, "helix angle")
    hand = entry.word("hand", ("right", "left"))
    if hand_needed and entry.has("helix angle") and not entry.has("hand"):
        entry.need("hand")
    if hand_needed and entry.has("hand") and not entry.has("helix angle"):
        entry.need("helix angle")
    return helix, hand


def _acute(entry: Entry, key: str) -> Number | None:
    angle = entry.number(key)
    if angle is not None and angle.value >= 90.0:
        entry.refuse(entry.mark(key), f"a {key} is less than 90 degrees")
        return None
    return angle


def _is_normal(key: str | None) -> bool:
    return key is not None and key.startswith("normal")


def _section_is_clear(entry: Entry, key: str | None) -> bool:
    """Straight teeth have one section; of a helix one must say which."""
    if key is None or (key[:6] in ("normal", "transv")) == entry.has("helix angle"):
        return True
    if entry.has("helix angle"):
        said = f"with a helix angle say whether it is the 'normal {key}' or the 'transverse {key}'"
    else:
        said = (
            f"straight teeth have one {key.partition(' ')[2]}; without a helix angle leave out the first word"
        )
    entry.refuse(entry.mark(key), f"'{key}' of {entry.what}: {said}")
    return False


def _size(entry: Entry, key: str | None) -> tuple[Number | None, Number | None]:
    """Diametral pitch or module."""
    if key is None:
        return None, None
    if key.endswith("pitch"):
        return entry.number(key), None
    return None, entry.number(key)
