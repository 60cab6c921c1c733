"""A sweep: many positions of one mechanism, or a family of mechanisms, with the kernels of one scene."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import numpy.typing as npt

from icsolve.case import Case
from icsolve.turn.ask import Columns, columns_of, wanted_of
from icsolve.turn.replay import Array
from icsolve.turn.second import WORDS, Codes
from icsolve.turn.work import Work


@dataclass(frozen=True, eq=False)
class Sweep:
    """The rows of a sweep; n is their number. Arrays that were not wanted are not there.

    Attributes
    ----------
    vary : the varied numbers by path (drives by link), (n,)
    answers : unknown loads by name, (n,) [case units]; not a number where the status is another than
        ok (or change-point, where the row lies beside one that was passed)
    error : bounds of the absolute rounding errors of the answers, (n,)
    points : places, (n, 2) [case length]
    centres : relative centres as homogeneous coordinates, (n, 3): (x, y, w) at (x/w, y/w), at infinity
        toward (x, y) where w is zero; all zero where the two links have no relative motion
    rates : angular velocities of the links, (n,) [rad/s, or scaled as in one scene]
    notes : sentences about the sweep
    """

    case: Case
    vary: dict[str, Array]
    answers: dict[str, Array] = field(default_factory=dict)
    error: dict[str, Array] = field(default_factory=dict)
    points: dict[str, Array] = field(default_factory=dict)
    centres: dict[str, Array] = field(default_factory=dict)
    rates: dict[str, Array] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    codes: Codes = field(default_factory=lambda: np.empty(0, np.int8))

    def __len__(self) -> int:
        return len(self.codes)

    @cached_property
    def status(self) -> npt.NDArray[np.str_]:
        """The status of every row in words, (n,)."""
        used = np.unique(self.codes)
        if len(used) == 1:
            return np.full(len(self.codes), WORDS[used[0]])
        return np.array(WORDS)[self.codes]


def sweep(
    case: Case,
    vary: Mapping[str, npt.ArrayLike] | None = None,
    want: Sequence[str] = ("answers", "status"),
    *,
    drive: Mapping[str, npt.ArrayLike] | None = None,
) -> Sweep:
    """Solve a case for many values of some of its numbers.

    A number that only poses the figure moves the mechanism from the position as written; one that would
    reshape a link, or a load's, gives another case in each row, as if written so.

    Parameters
    ----------
    case : as `icsolve.load` returns it
    vary : arrays of values by path (``angles.AB``, ``loads.P``), zipped; case units, degrees
    want : ``answers``, ``status``, ``error``, ``points``, ``centres``, ``rates``; or single ones,
        ``points.C``, ``centres.2-4``
    drive : arrays of degrees by which links are turned from the position as written, by link

    Raises
    ------
    CaseError
        For a path that the case does not have.
    SceneError
        Where no row can be solved: the case as written has no figure, or cannot be moved so.
    ValueError
        For arrays that can't be columns, or words that can't be wanted.
    """
    columns = columns_of(case, vary, drive)
    wanted = wanted_of(case, want)
    work = Work(case, columns, wanted)
    work.run()
    return Sweep(case, _shown(columns), **work.tables(), notes=tuple(work.notes), codes=work.codes)


def _shown(columns: Columns) -> dict[str, Array]:
    return {columns.names[own]: array for own, array in columns.arrays.items()}
