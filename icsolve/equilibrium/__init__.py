"""Where a mechanism rests: the loads are known, and a datum of its figure is what is asked.

`load_function` writes the power of the loads in every mode of the figure on a record, `search` encloses its
zeros over the whole range, `branches` follows the modes, `positions` closes in on each zero and tells its
stability, `resting` finds the ranges in which friction holds. `solve_positions` answers a case.
"""

from __future__ import annotations

from icsolve.equilibrium.answering import solve_positions

__all__ = ["solve_positions"]
