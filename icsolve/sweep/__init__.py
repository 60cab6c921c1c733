"""Sweeps: the plan and the kernels of one scene, recorded once and run on arrays of rows.

`icsolve.sweep.sweeping` has `sweep`; the rest follows a sweep on its way. A case is solved as written and
becomes a ``mechanism`` of links that keep their shapes; ``drivers`` says what the varied numbers do to it,
``closing`` in which order its links follow them. ``moving`` and ``scene`` write places and statics into a
``record``, which ``runner`` replays on blocks of rows, along a ``way`` on which ``branches`` are kept.
"""

from __future__ import annotations

from icsolve.sweep.sweeping import sweep
from icsolve.sweep.table import Sweep

__all__ = ["Sweep", "sweep"]
