"""`icsolve gallery`: every case on one page, the user's files left alone, broken cases listed."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from urllib.parse import unquote
from xml.etree import ElementTree

import pytest

import icsolve
from icsolve.case import Case
from icsolve.draw.tikz import standalone
from icsolve.draw.words import answer_sentences
from icsolve.explain import explain
from icsolve.explain.given import exercise, sheet_tex
from icsolve.grade.platforms.questions import figure
from icsolve.page.gallery import ENDINGS, KINDS, exhibit, index_html
from icsolve.report.derivation.known import known_of
from pictures import parsed
from shell import exit_status
from test_draw import DEAD_CENTRE, FOUR_BAR, HOSTILE

ROOT = Path(__file__).parent.parent
LIBRARY = ROOT / "cases"
README = (ROOT / "README.md").read_text(encoding="utf-8")
PICTURES = re.findall(r'(?:\]\(|src=")(\.pictures/gallery/[^")]+\.svg)', README)


def page(path: Path) -> ElementTree.Element:
    """The body of a page, which is XML too but for its first line."""
    html = path.read_text(encoding="utf-8")
    assert not re.search(r"<script(?! type=)|https?://(?!www\.w3\.org)|@import", html)
    return ElementTree.fromstring(f"<body>{html.partition('<body>')[2].partition('</body>')[0]}</body>")


def addresses(body: ElementTree.Element) -> list[str]:
    """What the page links to and shows, but for places on itself."""
    found = [e.get("href") or e.get("src") or "" for e in body.iter() if e.tag in ("a", "img")]
    return [unquote(address) for address in found if not address.startswith("#")]


@pytest.fixture(scope="module")
def gallery(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The gallery of a folder of the library, as a stranger makes it."""
    folder = tmp_path_factory.mktemp("gallery") / "out"
    words = ["gallery", "cases/springs", "cases/rolling", "-o", str(folder)]
    command = [sys.executable, "-m", "icsolve", *words]
    ran = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert (ran.stdout, ran.stderr) == ("", "")
    return folder


def test_every_case_has_a_card_with_its_answer_its_figure_and_its_files(gallery: Path) -> None:
    body = page(gallery / "index.html")
    cards = {card.findtext("p[@class='soft']"): card for card in body.iter("article")}
    sources = sorted(p for kind in ("springs", "rolling") for p in (LIBRARY / kind).glob("*.yaml"))
    assert set(cards) == {p.relative_to(ROOT).as_posix() for p in sources}
    for path in sources:
        card = cards[path.relative_to(ROOT).as_posix()]
        case = icsolve.load(path)
        assert card.findtext("h3") == case.title
        said = " ".join("".join(p.itertext()) for p in card.iter("p"))
        for name, found in icsolve.solve(case).answers.items():
            assert f"{name} = {abs(found.value):.4g}".rstrip("0") in said.replace("−", "-")
        files = addresses(card)
        assert {"".join(Path(f).suffixes) for f in files} == set(ENDINGS)


def test_the_index_of_the_whole_library_stays_small(gallery: Path) -> None:
    """What a card takes, times the cases of the library: under 300 kB."""
    index = gallery / "index.html"
    cards = sum(1 for _ in page(index).iter("article"))
    assert index.stat().st_size / cards * len(list(LIBRARY.rglob("*.yaml"))) < 300_000


@pytest.mark.parametrize(
    ("case", "kind"),
    [("ropes/capstan", "Ropes"), ("tools/vice", "Screws"), ("dynamics/rolling_disk", "Inertia")],
)
def test_cases_stand_under_their_kind(case: str, kind: str) -> None:
    assert exhibit(icsolve.load(LIBRARY / f"{case}.yaml"), case, case, exercise=True).kind.startswith(kind)


def test_every_link_leads_to_a_file_and_every_file_is_linked(gallery: Path) -> None:
    linked = {gallery / address for address in addresses(page(gallery / "index.html"))}
    files = {path for path in gallery.rglob("*") if path.is_file()} - {gallery / "index.html"}
    assert linked == files
    for path in files:
        if path.suffix == ".svg":
            ElementTree.parse(path)


def test_the_same_bytes_every_run(gallery: Path, tmp_path: Path) -> None:
    """Whatever the seed of hashes is, and the order of the folders' files."""
    words = ["gallery", "cases/rolling", "-o", str(tmp_path)]
    environment = {**os.environ, "PYTHONHASHSEED": "1"}
    subprocess.run([sys.executable, "-m", "icsolve", *words], cwd=ROOT, env=environment, check=True)
    again = {p.relative_to(tmp_path): p.read_bytes() for p in tmp_path.rglob("*") if p.is_file()}
    del again[Path("index.html")]
    assert len(again) > 6
    assert all((gallery / name).read_bytes() == content for name, content in again.items())


# --- what is there stays -----------------------------------------------------------------------------


@pytest.fixture
def cases(tmp_path: Path) -> Path:
    """A folder with a case that has an answer, one that has none, one that can't be read, and other YAML."""
    folder = tmp_path / "cases"
    (folder / "sub").mkdir(parents=True)
    (folder / "good.yaml").write_text(FOUR_BAR.format(title="Good", crank=1))
    (folder / "sub" / "long.yaml").write_text(FOUR_BAR.format(title="Long crank", crank=20))
    (folder / "dead.yaml").write_text(DEAD_CENTRE)
    (folder / "broken.yaml").write_text("icsolve: 1\njoints: [\n")
    (folder / "other.yaml").write_text("a: 1\n")
    return folder


def test_nothing_is_written_over_unasked(
    cases: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / "good.svg").write_text("mine")
    assert exit_status("gallery", str(cases), "-o", str(out)) == 2
    assert "good.svg is there already; --force writes over" in capsys.readouterr().err
    assert [(p.name, p.read_text()) for p in out.iterdir()] == [("good.svg", "mine")]
    exit_status("gallery", str(cases), "-o", str(out), "--force")
    assert (out / "good.svg").read_text().startswith("<svg")


def test_other_files_of_the_folder_stay(cases: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / "notes.txt").write_text("mine")
    assert exit_status("gallery", str(cases / "good.yaml"), "-o", str(out)) == 0
    assert (out / "notes.txt").read_text() == "mine"
    assert sorted(p.name for p in out.iterdir()) == sorted(
        ["index.html", "notes.txt", *(f"good{ending}" for ending in ENDINGS)]
    )


def test_a_case_is_never_written_over_even_by_force(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = tmp_path / "press.svg"
    text = FOUR_BAR.format(title="Press", crank=1)
    case.write_text(text)
    assert exit_status("gallery", str(case), "-o", str(tmp_path), "--force") == 2
    assert "is one of the files read here" in capsys.readouterr().err
    assert case.read_text() == text


def test_a_folder_that_cannot_be_made_is_said(
    cases: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "file"
    file.write_text("mine")
    assert exit_status("gallery", str(cases / "good.yaml"), "-o", str(file)) == 2
    assert exit_status("gallery", str(cases / "good.yaml"), "-o", str(file / "below")) == 2
    assert capsys.readouterr().err.count("can't be written") == 2
    assert file.read_text() == "mine"


def test_an_empty_folder_is_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert exit_status("gallery", str(tmp_path), "-o", str(tmp_path / "out")) == 2
    assert "there is no case in" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


# --- broken cases ------------------------------------------------------------------------------------


def test_broken_cases_are_listed_with_the_reason(
    cases: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The worst outcome is the exit status; YAML that is no case is passed over."""
    out = tmp_path / "out"
    assert exit_status("gallery", str(cases), "-o", str(out)) == 2
    said = capsys.readouterr().err
    assert "broken.yaml:3:1:" in said and "cannot meet at C" in said
    body = page(out / "index.html")
    assert body.findtext(".//main/p") == "4 cases, 2 without an answer, 1 that can't be read."
    listed = [" ".join("".join(entry.itertext()).split()) for entry in body.iter("li")]
    assert len(listed) == 3
    assert any("broken.yaml:3:1:" in entry and "unreadable" in entry for entry in listed)
    assert any("Long crank: cannot-assemble" in entry and "cannot meet at C" in entry for entry in listed)
    assert any("dead: " in entry or "dead-centre" in entry for entry in listed)
    assert (out / "sub" / "long.svg").exists()
    ids = {e.get("id") for e in body.iter()}
    assert all(e.get("href", "")[1:] in ids for e in body.iter("a") if e.get("href", "").startswith("#"))
    assert not (out / "other.svg").exists()


def test_a_case_without_an_answer_alone_ends_with_one(cases: Path, tmp_path: Path) -> None:
    assert exit_status("gallery", str(cases / "dead.yaml"), "-o", str(tmp_path / "out")) == 1


def test_files_of_one_name_have_names_of_their_own(cases: Path, tmp_path: Path) -> None:
    (cases / "index.yaml").write_text(FOUR_BAR.format(title="Index", crank=1))
    (cases / "good.yml").write_text(FOUR_BAR.format(title="Second", crank=1))
    out = tmp_path / "out"
    paths = [str(cases / name) for name in ("index.yaml", "good.yaml", "good.yml")]
    assert exit_status("gallery", *paths, "-o", str(out)) == 0
    assert {p.name for p in out.glob("*.svg")} == {"index-2.svg", "good.svg", "good-2.svg"}
    assert [e.text for e in page(out / "index.html").iter("h3")] == ["Index", "Good", "Second"]


@pytest.mark.parametrize("title", HOSTILE)
def test_text_stays_text(title: str, tmp_path: Path) -> None:
    case = icsolve.load(FOUR_BAR.format(title=title, crank=1))
    shown = exhibit(case, "a'b\"<c>&/d", "<x> & 'y'.yaml")
    path = tmp_path / "index.html"
    path.write_text(index_html([shown], title), encoding="utf-8")
    body = page(path)
    assert (body.findtext(".//h3") or "").split() == case.title.split()
    assert addresses(body)[0].startswith("a'b\"<c>&/d")
    assert {e.tag for e in body.iter()} <= {
        "body", "main", "h1", "h2", "h3", "p", "section", "div", "article", "a", "img", "iframe", "nav",
    }  # fmt: skip
    assert not [a for e in body.iter() for a in e.attrib if a.startswith("on")]


@pytest.mark.skipif(sys.platform != "linux", reason="names of any bytes are Linux's")
def test_file_names_of_any_bytes(tmp_path: Path) -> None:
    path = os.path.join(os.fsencode(tmp_path), b"\xff %23#?.yaml")
    with open(path, "w") as file:
        file.write(FOUR_BAR.format(title="''", crank=1))
    out = tmp_path / "out"
    assert exit_status("gallery", os.fsdecode(path), "-o", str(out)) == 0
    assert (out / "index.html").exists()


def test_exercises_give_no_answer_away(tmp_path: Path) -> None:
    """Figures ask, cards say what for, and there is no page; kinds stand in place of folders."""
    out = tmp_path / "out"
    assert exit_status("gallery", str(LIBRARY / "sliders"), "-o", str(out), "--exercises") == 0
    assert not [path for path in out.rglob("*.html") if path.name != "index.html"]
    body = page(out / "index.html")
    assert {e.text for e in body.iter("h2")} <= set(KINDS)
    for path in (LIBRARY / "sliders").glob("*.yaml"):
        figure = parsed((out / path.with_suffix(".svg").name).read_text(encoding="utf-8"))
        asked = figure.texts("t-unknown")
        assert all(text.endswith("= ?") for text in asked)
        for sentence in answer_sentences(known_of(icsolve.load(path))):
            assert asked and sentence not in (out / "index.html").read_text(encoding="utf-8")


ASK = [
    lambda case: exhibit(case, "a", "a.yaml", exercise=True).files[".svg"],
    lambda case: standalone(list(exercise(known_of(case)).figure), "a"),
    figure,
]


@pytest.mark.parametrize("ask", ASK, ids=["gallery", "sheet", "variants and quizzes"])
def test_where_a_position_is_asked_no_figure_has_it(ask: Callable[[Case], str]) -> None:
    """Who measures an angle in the figure of an exercise does not find the answer there: it is the same
    figure for doors that rest elsewhere."""
    doors = [DOOR.format(weight=weight) for weight in (300, 320)]
    first, other = (re.sub("3[02]0", "", ask(icsolve.load(door))) for door in doors)
    assert first == other


DOOR = """icsolve: 1
points: {{A: [0, 0], G: {{centroid: [A, B]}}, D: [0, 2]}}
lengths: {{AB: 1.2}}
angles: {{AB: {{unknown: [-80, 80]}}}}
joints: [{{pin: [1, 2], at: A}}]
loads: {{W: {{weight: {weight}, link: 2, at: G}}, S: {{spring: 250, free: 0.9, link: 2, at: B, to: D}}}}
"""


@pytest.mark.parametrize("name", ["bascule_bridge", "heavy_bar_on_spring", "collar_on_level_rod"])
def test_a_card_tells_where_a_mechanism_rests(name: str) -> None:
    """All positions of `solve` with their stability, for those who can't see the figure too."""
    case = icsolve.load(LIBRARY / "equilibrium" / f"{name}.yaml")
    card, positions = exhibit(case, name, f"{name}.yaml"), icsolve.solve(case).positions
    assert positions and len(card.answers) == len(positions)
    for told, position in zip(card.answers, positions, strict=True):
        (value,) = position.at.values()
        assert isinstance(value, float) and f" = {value:.4g}".rstrip("0").rstrip(".") in told
        assert f"{position.stability}" in told and told in card.alt


TRUSS = """icsolve: 1
points: {A: [0, 0], B: [2, 0], C: [1, 1]}
joints: [{pin: [1, 2], at: A}, {pin: [2, 3], at: C}, {pin: [1, 3], at: B}]
loads: {P: {force: 10, link: 2, at: C, angle: 270}}
"""


def test_what_is_asked_of_a_structure_is_the_same_on_its_card_and_in_its_solution() -> None:
    case = icsolve.load(TRUSS)
    (told,) = exhibit(case, "a", "a.yaml").answers
    assert told == "Asked: the forces and couples in the joints"
    assert "The forces and couples in the joints." in explain(case, "txt")


# --- the README's pictures ---------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["slider_crank_piston", "hoist_starting"])
def test_an_exercise_asks_for_inertia_forces_and_tells_the_acceleration(name: str) -> None:
    """Neither its figure nor its sheet has an inertia force, which is to be found; the key has the answer."""
    case = icsolve.load(LIBRARY / "dynamics" / f"{name}.yaml")
    one = exercise(known_of(case))
    figure = exhibit(case, name, "a.yaml", exercise=True).files[".svg"]
    sheet, _, key = sheet_tex("Exercises", [("", [one])]).rpartition("section*{Key")
    for text in (figure, sheet):
        assert not re.search(r"inertia (force|couple)|>i\d|_\{i\d", text)
    assert f"speeding up at {case.motion[0].acceleration.digits} rad/s" in sheet.replace("\\", "")
    assert f"{icsolve.solve(case).answers['T'].value:.4g}" in key


def test_the_readme_shows_three_pictures_of_the_gallery() -> None:
    assert len(PICTURES) == 3


@pytest.mark.parametrize("picture", PICTURES)
def test_the_readmes_pictures_are_what_the_command_makes(picture: str, tmp_path: Path) -> None:
    """After a wanted change of the drawings run with ICSOLVE_GOLDEN=write, and look at them."""
    (source,) = LIBRARY.rglob(f"{Path(picture).stem}.yaml")
    assert exit_status("gallery", str(source), "-o", str(tmp_path)) == 0
    drawn = (tmp_path / Path(picture).name).read_bytes()
    if os.environ.get("ICSOLVE_GOLDEN") == "write":
        (ROOT / picture).parent.mkdir(parents=True, exist_ok=True)
        (ROOT / picture).write_bytes(drawn)
    assert drawn == (ROOT / picture).read_bytes()
