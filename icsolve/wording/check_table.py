"""Published values against found ones as a Markdown table, a row a case."""

from __future__ import annotations

from icsolve.case import Case
from icsolve.check import AGREES, ERRATUM, Row

HEADER = "| case | published, and found | agree | errata |\n|---|---|---|---|"


def table_row(case: Case, rows: list[Row]) -> str:
    """The row of one case: what it asks for, how many values agree, and what is wrong in print."""
    answers = {load.name for load in case.loads}
    asked = [row for row in rows if row.key in answers] or rows[:3]
    values = "; ".join(f"{row.key} {row.published}, {row.found}" for row in asked)
    agree = sum(row.verdict == AGREES for row in rows)
    errata = "; ".join(f"{row.key}: {row.text}" for row in rows if row.verdict == ERRATUM)
    label = " (reconstructed)" if case.reconstructed else ""
    cells = (f"{case.name}{label}", values, f"{agree} of {len(rows)}", errata)
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"
