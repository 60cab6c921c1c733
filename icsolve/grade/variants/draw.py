"""Each student's values: they follow from case, student and seed alone, the same on every machine."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping

from icsolve.case import Variable
from icsolve.read.variables import count, value_at

TRIALS = 60
"""Draws of one student, until one suits."""


def drawn(case: str, variables: tuple[Variable, ...], student: str, seed: str, trial: int) -> dict[str, str]:
    """The values of one draw: each variable's index is a hash of all that it depends on, modulo its count."""
    values = {}
    for variable in variables:
        text = "\x1f".join((case, student, seed, str(trial), variable.name))
        digest = hashlib.sha256(text.encode("utf-8", "surrogatepass")).digest()
        values[variable.name] = value_at(variable, int.from_bytes(digest, "big") % count(variable))
    return values


def label(case: str, values: Mapping[str, str]) -> str:
    """A short name of a variant: eight hexadecimal digits that follow from its values."""
    text = "\x1f".join((case, *(f"{name}={value}" for name, value in values.items())))
    return hashlib.sha256(text.encode("utf-8")).hexdigest()[:8]
