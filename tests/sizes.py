"""How large the laws run: seeded samples in every run, and in full by hand with ``ICSOLVE_FULL=1``."""

from __future__ import annotations

import os

FULL = os.environ.get("ICSOLVE_FULL") == "1"
MORE = 20 if FULL else 1
"""So many times as many random scenes."""
