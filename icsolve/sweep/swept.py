"""The rows of a sweep as arrays."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import numpy.typing as npt

from icsolve.case import Case
from icsolve.errors import Status
from icsolve.numbers.replay import Array
from icsolve.sweep.second import WORDS, Codes


@dataclass(frozen=True, eq=False)
class Sweep:
    """The rows of a sweep; n is their number. Arrays that were not wanted are not there.

    Attributes
    ----------
    vary : the varied numbers by path, and the turnings of driven links by link, (n,)
    answers : unknown loads by name, (n,) [case units]; not a number where the status is another than
        ok, or change-point for a row beyond one that was passed
    error : bounds of the absolute rounding errors of the answers, (n,)
    errors : the same by kind (``answers``, ``points``, ``centres``, ``rates``) and name, each number's own,
        in the shape of its array; not a number where none is proven (with friction)
    points : places, (n, 2) [case length]
    centres : relative centres as homogeneous coordinates, (n, 3): (x, y, w) at (x/w, y/w), at infinity
        toward (x, y) where w is zero; all zero where the two links have no relative motion
    rates : angular velocities of the links, (n,) [rad/s, or scaled as in one scene]
    touching : with profiles and where points were wanted, the places of the contacts by their two links
        (``2-3``), (n, 2) [case length]; not a number where the status is another than ok
    holds : with friction and no motion, the ranges in which unknown loads hold, (n, 2)
    notes : sentences about the sweep
    """

    case: Case
    vary: dict[str, Array]
    answers: dict[str, Array] = field(default_factory=dict)
    points: dict[str, Array] = field(default_factory=dict)
    centres: dict[str, Array] = field(default_factory=dict)
    rates: dict[str, Array] = field(default_factory=dict)
    errors: dict[str, dict[str, Array]] = field(default_factory=dict)
    holds: dict[str, Array] = field(default_factory=dict)
    touching: dict[str, Array] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    codes: Codes = field(default_factory=lambda: np.empty(0, np.int8))
    _case_of: Callable[[int], Case] | None = None

    def __len__(self) -> int:
        return len(self.codes)

    def __repr__(self) -> str:
        """What was varied, and how the rows came out."""
        return f"<Sweep {self.case.name}: {self.outcome}>"

    @property
    def outcome(self) -> str:
        """What was varied, and how many rows came out how, in words."""
        counts = Counter(str(word) for word in self.status)
        rows = "1 row" if len(self) == 1 else f"{len(self)} rows"
        varied = f" of {', '.join(self.vary)}" if self.vary else ""
        return f"{rows}{varied}: " + (", ".join(f"{n} {word}" for word, n in counts.most_common()) or "none")

    @cached_property
    def status(self) -> npt.NDArray[np.str_]:
        """The status of every row in words, (n,)."""
        if not self.codes.any():
            return np.full(len(self.codes), WORDS[0])
        return np.array(WORDS)[self.codes]

    def case_of(self, row: int) -> Case:
        """The case of a row, as `icsolve.solve` takes it: its points by coordinates.

        In a family of figures: the case as if written so. Raises ValueError where the links do not
        assemble.
        """
        if self._case_of is None or self.status[row] == Status.CANNOT_ASSEMBLE:
            raise ValueError(f"row {row} does not assemble")
        return self._case_of(row)

    @property
    def error(self) -> dict[str, Array]:
        """Bounds of the answers."""
        return self.errors.get("answers", {})

    @property
    def kinds(self) -> dict[str, dict[str, Array]]:
        """The arrays of each kind."""
        return dict(zip(KINDS, (self.answers, self.points, self.centres, self.rates), strict=True))


KINDS = ("answers", "points", "centres", "rates")


def by_kind(arrays: Mapping[tuple[str, str], Array]) -> dict[str, dict[str, Array]]:
    """Arrays by kind and then by name."""
    kinds: dict[str, dict[str, Array]] = {kind: {} for kind in KINDS}
    for (kind, name), array in arrays.items():
        kinds[kind][name] = array
    return kinds
