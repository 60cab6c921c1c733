"""A large class on paper: a file of answers to 25 cases of the library."""

from __future__ import annotations

from pathlib import Path

from icsolve.bench import speed

CASES = Path(__file__).parent.parent / "cases"
CHOSEN = (
    "13_01_drag_link 13_02_four_bar_free_bodies 13_05_force_on_block 13_06_six_bar_slider 13_10_black_box",
    "13_07_slider_crank 13_08_four_bar 13_09_four_bar_two_forces 13_11_vice_grip 13_12_five_links four_bar",
    "13_13_five_links 13_14_slider_drives_crank 13_15_swivel_arm roller_follower gear_pair geared_five_bar",
    "three_links_on_one_pin welded_link geneva quick_return slider_crank_offset wedge",
    "bolt_cutter scissor_lift toggle_clamp",
)


def questions(count: int = 25) -> list[speed.Asked]:
    """Cases with their answers and units."""
    found = speed.asked_of(str(CASES), " ".join(CHOSEN).split()[:count])
    assert len(found) == count
    return found


def write_class(path: Path, students: int, seed: int = 1) -> int:
    """A row a student and case; how many rows."""
    return speed.write_class(path, students, questions(), seed)
