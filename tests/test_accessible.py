"""What a screen reader and a keyboard need of worked solutions, pages and galleries: names, headings in
order, headers of tables; all that axe-core finds, where AXE_CORE is its axe.min.js (npm install axe-core).
HTML as its standard has it; all that the Nu checker finds, where VNU_JAR is its vnu.jar (npm install
vnu-jar)."""

from __future__ import annotations

import json
import os
import subprocess
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

import icsolve
from browser import Browser
from icsolve.explain import explain
from icsolve.page import page_html
from icsolve.page.gallery import exhibit, index_html
from shell import exit_status

CASES = Path(__file__).parent.parent / "cases"
AXE = os.environ.get("AXE_CORE", "")
VNU = os.environ.get("VNU_JAR", "")
UNKNOWN_TO_IT = ("paint-order", "vector-effect")
"""Properties of SVG that the Nu checker does not have among those of CSS."""
VOID = {"br", "hr", "img", "input", "link", "meta"}


class Outline(HTMLParser):
    """Headings, tables' headers, ids, pictures and fields of a document, and whether each has a name."""

    def __init__(self) -> None:
        super().__init__()
        self.levels: list[int] = []
        self.ids: list[str] = []
        self.labelled: set[str] = set()
        self.nameless: list[str] = []
        self.values: list[str] = []
        self.open: list[tuple[str, list[str]]] = []
        self.language = ""

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        self.language = given.get("lang") or self.language
        self.ids += [given["id"]] if given.get("id") else []
        self.labelled |= {given["for"]} if tag == "label" and given.get("for") else set()
        if len(tag) == 2 and tag[0] == "h" and tag[1].isdigit():
            self.levels.append(int(tag[1]))
        named = given.get("aria-label") or given.get("aria-labelledby") or given.get("alt") is not None
        inside = any(name == "label" for name, _ in self.open)
        self.values += ["of a label"] if tag == "output" and inside else []
        hidden = given.get("type") == "hidden" or given.get("aria-hidden") == "true"
        if tag in ("img", "input", "select") and not (hidden or inside or named):
            self.nameless.append(given.get("id") or tag)
        self.handle_data(given.get("alt") or "")
        if tag not in VOID:
            self.open.append((tag, [given.get("aria-label") or ""]))

    def handle_data(self, data: str) -> None:
        for _, words in self.open:
            words.append(data.strip())

    def handle_endtag(self, tag: str) -> None:
        while self.open:
            name, words = self.open.pop()
            if name in ("th", "button", "a", "h1", "h2", "h3") and not "".join(words):
                self.nameless.append(f"empty {name}")
            if name == tag:
                return


def graded() -> tuple[str, str]:
    """The summary of a class with all that it can tell, and a student's own page."""
    written = ("29.67", "-29.67", "7", "7", "1,234", "x")
    rows = [f's{n},13_08_four_bar,"{text}"' for n, text in enumerate(written)]
    with TemporaryDirectory() as name:
        table, old, page, pages = (Path(name) / one for one in ("a.csv", "old.csv", "s.html", "students"))
        table.write_text("\n".join(["student_id,case,answer", *rows]))
        words = ("grade", table, "--cases", CASES / "ch13" / "13_08_four_bar.yaml", "-q")
        exit_status(*words, "-o", old)
        exit_status(*words, "-o", pages / "r.csv", "--against", old, "--html", page, "--students", pages)
        return page.read_text(), (pages / "s1.html").read_text()


@cache
def documents() -> dict[str, str]:
    four = icsolve.load(CASES / "ch13" / "13_08_four_bar.yaml")
    rope = icsolve.load(CASES / "ropes" / "capstan.yaml")
    summary, student = graded()
    return {
        "summary": summary,
        "student": student,
        "explain": explain(four, "html", bodies=True),
        "rope": explain(rope, "html"),
        "page": page_html(four),
        "gears": page_html(icsolve.load(CASES / "ch13" / "13_23_spur_gears.yaml")),
        "gallery": index_html(
            [exhibit(one, one.name, "a.yaml", exercise=True) for one in (four, rope)], "Week 3"
        ),
    }


@pytest.mark.parametrize("name", ["summary", "student", "explain", "rope", "page", "gears", "gallery"])
def test_all_has_a_name_and_headings_come_in_order(name: str) -> None:
    outline = Outline()
    outline.feed(documents()[name])
    fields = [one for one in outline.nameless if one not in outline.labelled]
    assert outline.language == "en" and not fields
    assert len(outline.ids) == len(set(outline.ids))
    assert not any(" " in own for own in outline.ids) and not outline.values
    assert outline.levels[0] == 1 and all(
        b <= a + 1 for a, b in zip(outline.levels, outline.levels[1:], strict=False)
    )


@pytest.mark.skipif(not VNU, reason="no VNU_JAR")
def test_the_nu_checker_finds_no_error(tmp_path: Path) -> None:
    for name, html in documents().items():
        (tmp_path / f"{name}.html").write_text(html, encoding="utf-8")
    words = ["java", "-jar", VNU, "--format", "json", "--errors-only", "--exit-zero-always", str(tmp_path)]
    run = subprocess.run([*words, "--skip-non-html"], capture_output=True, text=True, check=True)
    found = [f"{one['url']}: {one['message']}" for one in json.loads(run.stderr)["messages"]]
    assert [told for told in found if not any(name in told for name in UNKNOWN_TO_IT)] == []


@pytest.mark.skipif(not AXE, reason="no AXE_CORE")
@pytest.mark.parametrize("width", [320, 1200])
def test_axe_finds_nothing(width: int, window: Browser, tmp_path: Path) -> None:
    script = Path(AXE).read_text(encoding="utf-8")
    window.size(width, 900)
    for name, html in documents().items():
        path = tmp_path / f"{name}.html"
        path.write_text(html, encoding="utf-8")
        window.open(path)
        window.run(script)
        window.run("document.querySelectorAll('details').forEach(d => d.open = true)")
        found = window.run(
            "return axe.run(document).then(r => r.violations.map(v => v.id + ': ' + v.nodes[0].html))"
        )
        assert found == [], name
        assert window.run("return document.documentElement.scrollWidth") <= width
