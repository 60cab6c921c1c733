"""What a user reads when icsolve itself is at fault: one line, never a traceback."""

from __future__ import annotations

import os


def bug_report(path: str, error: Exception) -> str:
    """One line that asks to report; with ``ICSOLVE_DEBUG`` set, the traceback as well."""
    where = f"{path}: " if path else ""
    said = " ".join(str(error).split())[:200]
    line = (
        f"{where}icsolve failed on this ({type(error).__name__}: {said}). This is a fault of icsolve,"
        " not yours: please report it with the file. ICSOLVE_DEBUG=1 shows where it happened."
    )
    if not os.environ.get("ICSOLVE_DEBUG"):
        return line
    import traceback

    return f"{line}\n{''.join(traceback.format_exception(error))}"
