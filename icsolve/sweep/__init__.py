"""Sweeps: the plan and the kernels of one scene, recorded once and run on arrays of rows.

`sweeping` has `sweep`; the rest follows a sweep through its steps. A case is solved as written and becomes a
mechanism of links that keep their shapes (`assembly.driven`); ``drivers`` says what the varied numbers do to
it. ``program`` writes places (``continuation`` and ``branches`` where they have to be followed) and statics
(``recorded_scene``) into a record, which ``runner`` replays on blocks of rows.
"""

from __future__ import annotations

from icsolve.sweep.sweeping import sweep
from icsolve.sweep.table import Sweep

__all__ = ["Sweep", "sweep"]
