"""The class summary as a page: complete, safe to open, legible in light and dark."""

from __future__ import annotations

import re
from collections import Counter
from html.parser import HTMLParser
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import pytest

from grade_shell import Class
from icsolve.grade.marking import Counts, bin_of
from icsolve.grade.summary import _STYLE, histogram

SVG = "{http://www.w3.org/2000/svg}"
ANSWERS = (
    "student_id,case,answer\n"
    "01,lever,200\n02,lever,-200\n03,lever,-200\n04,lever,100\n05,lever,1,234\n"
    '<script>alert(1)</script>,pusher,5\n06,"no""><img src=x onerror=alert(1)>",5\n07,lever,137\n'
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
    counts = Counts()
    counts.verdicts, counts.bins, counts.max_score = Counter(wrong=1), Counter({5: 3}), 1.0
    root = ElementTree.fromstring(
        histogram(counts, marks).replace("<svg", '<svg xmlns="http://www.w3.org/2000/svg"')
    )
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


class Outline(HTMLParser):
    """What an accessibility checker looks at: headings, headers of tables, main regions, scrolled regions."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: Counter[str] = Counter()
        self.headings: list[int] = []
        self.headers: list[str] = []
        self.regions: list[dict[str, str | None]] = []
        self._in_header = False
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        self.tags[tag] += 1
        if re.fullmatch("h[1-6]", tag):
            self.headings.append(int(tag[1]))
        if tag == "th":
            assert given.get("scope") in ("col", "row")
            self.headers.append("")
            self._in_header = True
        if given.get("role") == "region":
            self.regions.append(given)

    def handle_endtag(self, tag: str) -> None:
        self._in_header = self._in_header and tag != "th"

    def handle_data(self, data: str) -> None:
        if self._in_header:
            self.headers[-1] += data


def check_outline(text: str) -> None:
    found = Outline(text)
    assert found.tags["main"] == found.tags["h1"] == 1
    assert all(after - before <= 1 for before, after in pairwise(found.headings))
    assert all(header.strip() for header in found.headers)
    assert all(region["tabindex"] == "0" and region["aria-label"] for region in found.regions)
    assert len({region["aria-label"] for region in found.regions}) == len(found.regions)
    assert found.tags["table"] <= len(found.regions)


def test_the_page_has_an_outline_that_readers_follow(html: str) -> None:
    check_outline(html)


def test_the_page_can_be_read_on_a_telephone(html: str) -> None:
    """Tables and pictures scroll in their own boxes; nothing else is wider than the screen."""
    assert 'content="width=device-width, initial-scale=1"' in html
    assert ".wide{overflow-x:auto" in _STYLE
    assert html.count('class="wide"') == html.count("<table>") + html.count("<svg")


def test_what_waits_and_what_nobody_explains_is_told(a_class: Class) -> None:
    rows = [f"{n:02d},lever,137.7" for n in range(5)] + [f"{n:02d},lever,1 234 apples" for n in range(5, 8)]
    ran = a_class.run(
        "grade", a_class.file("a.csv", "student_id,case,answer\n" + "\n".join(rows) + "\n"), "--cases",
        a_class.path("cases"), "--html", a_class.path("p.html"),
    )  # fmt: skip
    text = " ".join(re.sub(r"<[^>]+>", " ", a_class.path("p.html").read_text()).split())
    assert "The commonest wrong answers of no known cause: 137.7 (5 times)" in text
    assert "lever 1 234 apples 3" in text
    assert "the commonest of them: 137.7 (5 times)" in ran.out


def test_totals_sections_difficulty_and_discrimination(a_class: Class) -> None:
    """Of twelve students the first six have both right, the others both wrong: the questions tell all."""
    rows = "".join(
        f"{n:02d},lever,{200 if n < 6 else 5}\n{n:02d},pusher,{100 if n < 6 else 3}\n" for n in range(12)
    )
    roster = "student_id,section\n" + "".join(f"{n:02d},{'A' if n < 8 else 'B'}\n" for n in range(12))
    a_class.grade("student_id,case,answer\n" + rows, "--html", str(a_class.path("p.html")), "--roster",
                  a_class.file("roster.csv", roster))  # fmt: skip
    html = a_class.path("p.html").read_text()
    text = " ".join(re.sub(r"<[^>]+>", " ", html).split())
    assert "lever 6 6 0 0 0 50% 1.00" in text
    assert "A 8 75% B 4 0%" in text
    assert "00 A 2 2" in text
    assert "11 B 0 2" in text
    check_outline(html)


def test_a_students_page_shows_own_marks_and_no_answers(a_class: Class) -> None:
    folder = a_class.path("pages")
    a_class.grade(ANSWERS, "--students", str(folder))
    assert len(list(folder.iterdir())) == 8
    good, bad = ((folder / f"{name}.html").read_text() for name in ("01", "02"))
    assert "01: 1 of 2 marks." in good
    assert "198" not in good + bad
    assert "<td>-200" not in good
    assert "Right size, wrong sense." in bad
    assert "1 not judged yet." in (folder / "05.html").read_text()
    for page in folder.iterdir():
        text = page.read_text()
        check_outline(text)
        assert "<script" not in text


def test_landmarks_lie_in_the_middle_of_bins() -> None:
    """Answers within rounding of the right one, its half, double and opposite are one bar each."""
    for ratio in (1.0, 0.5, 2.0, -1.0, 0.1):
        assert len({bin_of(200.0 * ratio * off, 200.0, 2.0) for off in (0.99, 0.999, 1.0, 1.001, 1.01)}) == 1
