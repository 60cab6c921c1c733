"""Answers as students write them: the corpus, each with its reading or its flag."""

from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path

import pytest

from icsolve.grade.written import Reader

CORPUS = Path(__file__).parent / "data" / "answers.tsv"


def rows() -> list[tuple[str, ...]]:
    """Text, number, unit, direction, flag (or note); the text may have \\u escapes."""
    lines = CORPUS.read_text(encoding="utf-8").split("\n")[1:]
    fields = [line.split("\t") for line in lines if line and not line.startswith("# ")]
    return [(_unescaped(text), *rest) for text, *rest in fields]


def _unescaped(text: str) -> str:
    return re.sub(r"\\u([0-9a-f]{4})", lambda found: chr(int(found[1], 16)), text)


def test_the_corpus_has_at_least_300_different_texts() -> None:
    texts = [row[0] for row in rows()]
    assert len(set(texts)) == len(texts) >= 300


@pytest.mark.parametrize("row", rows(), ids=lambda row: repr(row[0]))
def test_an_answer_is_read_as_the_corpus_says(row: tuple[str, ...]) -> None:
    text, number, unit, direction, flag = row
    read = Reader().read(text)
    if not number:
        assert read.flag == flag
        return
    assert (read.flag, read.note) == ("", flag)
    assert (read.unit.name if read.unit else "") == unit
    assert (read.direction.words if read.direction else "") == direction
    assert read.number == pytest.approx(float(Fraction(number)), rel=1e-15, abs=0.0)
