"""The construction behind an answer: what is known of a scene, the order in which its centres are found,
and how the speed of one link follows from another's. Explanations, drawings and pages all read it."""

from __future__ import annotations

from icsolve.report.derivation.known import (
    Acting,
    Known,
    acting_loads,
    joint_of_normal,
    known_at,
    known_of,
    resting,
)
from icsolve.report.derivation.ratios import (
    Ratio,
    Ratios,
    Step,
    all_steps,
    answer_ratios,
    loaded_links,
    needed_steps,
)
from icsolve.report.derivation.ropes import Pull, pulls_on, rope_pulls, tension_name

__all__ = [
    "Acting",
    "Known",
    "Pull",
    "Ratio",
    "Ratios",
    "Step",
    "acting_loads",
    "all_steps",
    "answer_ratios",
    "joint_of_normal",
    "known_at",
    "known_of",
    "loaded_links",
    "needed_steps",
    "pulls_on",
    "resting",
    "rope_pulls",
    "tension_name",
]
