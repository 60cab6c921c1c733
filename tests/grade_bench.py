"""A large class on paper: a file of answers to 25 cases, and the times that grading is measured by."""

from __future__ import annotations

import csv
import random
import time
from pathlib import Path

from icsolve.grade.case_store import CaseStore
from icsolve.grade.course import Course

CASES = Path(__file__).parent.parent / "cases"
CHOSEN = (
    "13_01_drag_link 13_02_four_bar_free_bodies 13_05_force_on_block 13_06_six_bar_slider 13_10_black_box",
    "13_07_slider_crank 13_08_four_bar 13_09_four_bar_two_forces 13_11_vice_grip 13_12_five_links four_bar",
    "13_13_five_links 13_14_slider_drives_crank 13_15_swivel_arm roller_follower gear_pair geared_five_bar",
    "three_links_on_one_pin welded_link rolling_disk geneva quick_return slider_crank_offset wedge",
    "bolt_cutter scissor_lift toggle_clamp",
)


def questions(count: int = 25) -> list[tuple[str, float, str]]:
    """Cases with their answers and units."""
    case_store = CaseStore(CASES, Course())
    keys = [case_store.key(name) for name in " ".join(CHOSEN).split()[:count]]
    assert len(keys) == count
    return [(key.question, key.value, key.unit_name) for key in keys]  # type: ignore[union-attr]


def write_class(path: Path, students: int, seed: int = 1) -> int:
    """A row a student and case; right answers differ in their fourth figure; how many rows."""
    rng = random.Random(seed)
    asked = questions()
    wrong = (-1.0, 0.5, 2.0, 10.0, 0.001, 25.4, 1.02, 1.37, 0.62)
    with open(path, "w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["student_id", "case", "answer", "attempt", "submitted_at"])
        for _ in range(students):
            student = f"{rng.randrange(10**8):08d}"
            for case, value, unit in asked:
                factor = rng.choice(wrong) if rng.random() < 0.35 else 1.0
                answer = value * factor * (1.0 + rng.uniform(-0.004, 0.004))
                text = f"{answer:.5g} {unit}" if rng.random() < 0.9 else f"{answer:.4e}"
                timestamp = (
                    f"2025-03-{rng.randrange(1, 29):02d}T{rng.randrange(24):02d}:{rng.randrange(60):02d}:00"
                )
                rows.writerow([student, case, text, rng.randrange(1, 4), timestamp])
    return students * len(asked)


def floor(path: Path) -> float:
    """Seconds in which Python's csv reads the file and float its numbers."""
    best = float("inf")
    for _ in range(3):
        start = time.process_time()
        with open(path, encoding="utf-8", newline="") as file:
            rows = csv.reader(file)
            next(rows)
            for row in rows:
                float(row[2].partition(" ")[0])
        best = min(best, time.process_time() - start)
    return best
