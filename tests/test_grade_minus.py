"""A minus that is written is never lost: the answer is read with it, or is for a person."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import pytest

from icsolve.grade.one import Task

LEVER = """icsolve: 1
points: {{A: [0, 0], B: [2, 0]}}
joints: [{{pin: [1, 2], at: A}}]
loads:
  P: {{force: {force}, link: 2, at: B, angle: 90}}
  T12: {{torque: unknown, link: 2}}
"""
BLOCK = """icsolve: 1
points: {{A: [0, 0]}}
joints: [{{slide: [2, 1], at: A, along: 0}}]
loads:
  P: {{force: {force}, link: 2, at: A, angle: 0}}
  Q: {{force: unknown, link: 2, at: A, angle: 0}}
"""
WORDS = "minus negative neg. neg moins menos meno negativ négatif negativo negatief".split()
MARKS = ["-", "\u2212", "\u2013", "&minus;"]
BEFORE = [
    *(f"{word}{mark}{{}}" for word in WORDS for mark in (" ", ": ", " = ", "  ")),
    *(
        f"{name}{{}}"
        for name in (
            "T12 (-) = ",
            "T12 (-ve) = ",
            "T12- = ",
            "T12- : ",
            "T12 (\u2212) : ",
            "T12: min ",
            "min ",
        )
    ),
    *(f"{mark}{gap}{{}}" for mark in MARKS for gap in ("", " ", "\u2009", "\\,")),
]
BEHIND = [f"{{}}{gap}{mark}{stop}" for mark in MARKS for gap in (" ", ", ", "; ") for stop in ("", ".", " ")]
HATS = [
    f"{{}} {left}{mark}{gap}{hat}{right}"
    for (left, right), mark, gap, hat in product(
        (("", ""), ("(", ")"), ("$", "$")),
        ("-", "\u2212"),
        ("", " ", "  ", "\\,"),
        ("\\hat{k}", "\\vec k", "\\mathbf{k}", "k\u0302", "k-hat"),
    )
]


def verdicts(folder: Path, case: str, texts: list[str], unit: str) -> list[tuple[str, str, str]]:
    """Each text with its verdicts where the right answer is -12 and where it is 12."""
    tasks = []
    for name, force in (("less", 6 if case is LEVER else 12), ("more", -6 if case is LEVER else -12)):
        path = folder / f"{name}.yaml"
        path.write_text(case.format(force=force), encoding="utf-8")
        tasks.append(Task(path))
    less, more = tasks
    written = [text.replace("{}", f"12{unit}", 1) for text in texts]
    return [(text, less.grade("", text)["verdict"], more.grade("", text)["verdict"]) for text in written]


@pytest.mark.parametrize("unit", ["", " N*m"])
def test_a_minus_before_or_behind_a_torque_is_not_lost(tmp_path: Path, unit: str) -> None:
    found = verdicts(tmp_path, LEVER, [*BEFORE, *BEHIND, *HATS], unit)
    assert not [one for one in found if one[1] == "wrong" or one[2] == "right"]


@pytest.mark.parametrize("unit", ["", " N"])
def test_a_minus_before_a_unit_vector_turns_a_force(tmp_path: Path, unit: str) -> None:
    texts = [text.replace("k", "i", 1) for text in HATS]
    found = verdicts(tmp_path, BLOCK, texts, unit)
    assert not [one for one in found if one[1] == "wrong" or one[2] == "right"]
