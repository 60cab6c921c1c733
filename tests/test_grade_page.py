"""The class summary as a page: complete, safe to open, legible in light and dark."""

from __future__ import annotations

import re
from collections import Counter
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import pytest

from grade_shell import Class
from icsolve.grade.page import _STYLE, histogram
from icsolve.grade.tally import Counts

SVG = "{http://www.w3.org/2000/svg}"
ANSWERS = (
    "student_id,case,answer\n"
    "01,lever,200\n02,lever,-200\n03,lever,-200\n04,lever,100\n05,lever,1,234\n"
    "<script>alert(1)</script>,pusher,5\n06,\"no\"\"><img src=x onerror=alert(1)>\",5\n07,lever,137\n"
)


@pytest.fixture
def a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Class:
    return Class(tmp_path, capsys)


@pytest.fixture
def html(a_class: Class) -> str:
    page = a_class.path("summary.html")
    a_class.grade(ANSWERS, "--html", str(page))
    return page.read_text(encoding="utf-8")


def test_names_and_answers_can_do_nothing_on_the_page(html: str) -> None:
    assert "<script" not in html
    assert "<img" not in html
    assert "&lt;script&gt;alert(1)&lt;/script&gt;" in html
    assert "src=" not in html.replace("&lt;img src=x", "")


def test_marks_mistakes_and_who_is_missing(html: str) -> None:
    text = " ".join(re.sub(r"<[^>]+>", " ", html).split())
    assert "sign 2 50% Right size, wrong sense." in text
    assert "no known cause 1 25%" in text
    assert "Accepted: from 198.0 to 202.0 N*m." in text
    assert "No answer: 01, 02, 03, 04, 05, 06, 07" in text
    assert text.index("sign 2") < text.index("no known cause 1")
    assert "all questions" in text


def test_labels_of_the_marks_do_not_overlap() -> None:
    marks = (*((f"a-long-code-{n}", 0.5 + 0.01 * n) for n in range(8)), ("sign", -1.0), ("double", 2.05))
    counts = Counts(Counter(wrong=1), Counter(), Counter({5: 3}), Counter(), 0.0, 1.0, Counter(), Counter())
    root = ElementTree.fromstring(histogram(counts, marks).replace("<svg", '<svg xmlns="http://www.w3.org/2000/svg"'))
    width = float(root.attrib["viewBox"].split()[2])
    rows: dict[str, list[tuple[float, float]]] = {}
    codes = {code for code, _ in marks}
    for label in root.iter(f"{SVG}text"):
        if label.text in codes:
            middle, half = float(label.attrib["x"]), 3.2 * len(label.text)
            rows.setdefault(label.attrib["y"], []).append((middle - half, middle + half))
    assert sum(map(len, rows.values())) == len(marks)
    for spans in rows.values():
        assert all(low >= -0.1 and high <= width + 0.1 for low, high in spans)
        assert all(end < start for (_, end), (start, _) in pairwise(sorted(spans)))


def luminance(colour: str) -> float:
    """Relative luminance (WCAG 2.1)."""
    colour = "".join(c * 2 for c in colour[1:]) if len(colour) == 4 else colour[1:]
    parts = [int(colour[i : i + 2], 16) / 255 for i in (0, 2, 4)]
    r, g, b = (p / 12.92 if p <= 0.03928 else ((p + 0.055) / 1.055) ** 2.4 for p in parts)
    return 0.2126 * r + 0.7152 * g + 0.0722 * b


@pytest.mark.parametrize("mode", ["light", "dark"])
def test_colours_stand_out(mode: str) -> None:
    """WCAG 2.1 AA: 4.5 for text, 3 for what is drawn."""
    light, dark = _STYLE.split("@media (prefers-color-scheme:dark)")
    style = light if mode == "light" else dark
    (body,) = re.findall(r"body\{color:(#\w+);background:(#\w+)\}", style)

    def contrast(colour: str) -> float:
        high, low = sorted((luminance(colour), luminance(body[1])), reverse=True)
        return (high + 0.05) / (low + 0.05)

    assert contrast(body[0]) >= 4.5
    assert contrast(re.findall(r"a\{color:(#\w+)\}", style)[0]) >= 4.5
    for name in ("bar", "far", "mark", "good"):
        assert contrast(re.findall(rf"\.{name}\{{(?:fill|stroke):(#\w+)", style)[0]) >= 3.0, name
