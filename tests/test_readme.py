"""Every example of the README and of the manual is run, and every form in their tables is read.

Console blocks are sessions: a line with `$` is run, and what stands below is its whole output (`...` for
what is left out, and white space is then free). Files are the YAML blocks whose first line is a comment
with their name. Python blocks are doctests.
"""

from __future__ import annotations

import doctest
import json
import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import click
import pytest

import icsolve
import texts
from icsolve.cli.commands import icsolve as commands
from icsolve.errors import Status
from icsolve.manual import TOPICS, kinds
from icsolve.read.keys import SECTIONS
from shell import exit_status
from texts import PAGES, README, ROOT, blocks, section


class Session(NamedTuple):
    """A command and the output that the README promises."""

    command: str
    output: str


def sessions() -> list[Session]:
    return [
        Session(command.strip(), output)
        for page in PAGES.values()
        for kind, text in blocks(page)
        if kind == "console"
        for command, output in re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", text, re.MULTILINE)
    ]


@pytest.fixture
def files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the files of all pages."""
    monkeypatch.chdir(tmp_path)
    for name, text in texts.files().items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize("session", sessions(), ids=lambda session: session.command)
def test_every_session_prints_what_the_readme_shows(
    session: Session, files: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    program, *arguments = shlex.split(session.command)
    assert program == "icsolve"
    code = exit_status(*arguments)
    shown = capsys.readouterr()
    assert code == 0
    flags = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE if "..." in session.output else 0
    assert doctest.OutputChecker().check_output(session.output, shown.out + shown.err, flags), shown.out


@pytest.mark.parametrize("topic", ["README", "library", "inside"])
def test_the_python_session_says_what_the_page_shows(topic: str, files: Path) -> None:
    shown = [text for kind, text in blocks(PAGES[topic]) if kind == "python"]
    test = doctest.DocTestParser().get_doctest("\n".join(shown), {}, topic, topic, 0)
    assert test.examples
    assert doctest.DocTestRunner(verbose=False).run(test).failed == 0


@pytest.mark.parametrize(
    "example",
    re.findall(r"\| `(icsolve [^`]*)` \|$", section("README", "The commands, one example each"), re.M),
)
def test_every_example_of_a_command_runs(
    example: str, files: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    _, verb, *arguments = shlex.split(example)
    (files / "answers.csv").write_text("student_id,case,answer\n1,press,33.76 lbf*in cw\n")
    (files / "roster.csv").write_text("student_id\n1\n2\n")
    (files / "cases").mkdir()
    varied = (
        texts.files()["press.yaml"].replace("AB: 1,", "AB: $a,") + "variables: {a: {choices: [1, 1.25]}}\n"
    )
    (files / "cases" / "press.yaml").write_text(varied)
    if verb == "bench":
        arguments = ["--help"]  # its catalogue is run by its own tests
    assert exit_status(verb, *arguments) == 0, capsys.readouterr().err


def test_the_slips_that_the_readme_shows_are_told_so(files: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (shown,) = (text for kind, text in blocks(README) if kind == "text" and "slip" in text)
    command, _, said = shown.partition("\n")
    assert exit_status(*shlex.split(command)[2:]) == 2
    assert capsys.readouterr().err == said


def test_the_picture_shows_the_answer_of_its_file(files: Path) -> None:
    picture = README.partition("```\n")[2].partition("```")[0]
    found = icsolve.solve(icsolve.load("press.yaml")).answers["T12"]
    assert found.sense == "cw"
    assert f"T12 = {abs(found.value):.3g} lbf*in, clockwise" in picture


def forms(title: str) -> list[str]:
    """The inline examples of a section that are mappings."""
    return re.findall(r"`(\{[^`]*\})`", section("format", title))


LETTERS = "ABCDEFGHP"
POINTS = "".join(f"  {letter}: [{n}, {n * n % 7}]\n" for n, letter in enumerate(LETTERS))
CHAIN = "".join(f"  - {{pin: [{n}, {n + 1}], at: {LETTERS[n]}}}\n" for n in range(1, 8))
SCAFFOLD = f"icsolve: 1\npoints:\n{POINTS}joints:\n{CHAIN}"


@pytest.mark.parametrize("form", forms("Joints"))
def test_every_form_of_a_joint_is_read(form: str) -> None:
    case = icsolve.load(f"{SCAFFOLD}  - {form}\n")
    assert len(case.joints) == 8


@pytest.mark.parametrize("form", forms("Loads"))
def test_every_form_of_a_load_is_read(form: str) -> None:
    load = f"{{torque: {form}, link: 2}}" if "like" in form else form
    case = icsolve.load(f"{SCAFFOLD}loads:\n  M2: {{torque: 5, link: 3}}\n  Q: {load}\n")
    assert case.loads[1].name.removesuffix(".x") == "Q"


@pytest.mark.parametrize("form", forms("Motion"))
def test_every_form_of_a_motion_is_read(form: str) -> None:
    assert icsolve.load(f"{SCAFFOLD}motion: {form}\n").motion


@pytest.mark.parametrize("form", forms("Expect"))
def test_every_form_of_a_width_is_read(form: str) -> None:
    assert icsolve.load(f"{SCAFFOLD}expect:\n  w4/w2: {form}\n").expect


@pytest.mark.parametrize(
    "entry", re.findall(r"`(\S[^`]*: [^`]*)`", section("format", "Expect").partition("| `{value")[0])
)
def test_every_key_of_expect_is_read(entry: str) -> None:
    loads = "loads:\n  T12: {torque: unknown, link: 2}\n"
    assert len(icsolve.load(f"{SCAFFOLD}{loads}expect:\n  {entry}\n").expect) == 1


@pytest.mark.parametrize(
    "entry", re.findall(r"^\| `((?:points|lengths|angles|near|links): \{.*?\})`", PAGES["format"], re.M)
)
def test_every_entry_of_the_figure_is_read(entry: str) -> None:
    name, key, value = re.fullmatch(r"(\w+): \{(\w+): (.*)\}", entry).groups()  # type: ignore[union-attr]
    others = "".join(line for line in POINTS.splitlines(True) if (name, key) != ("points", line.strip()[0]))
    points = f"{others}  {key}: {value}\n" if name == "points" else f"{POINTS}{entry}\n"
    case = icsolve.load(f"icsolve: 1\npoints:\n{points}joints:\n{CHAIN}")
    assert {"points": case.points, "near": case.near, "links": case.carries}.get(
        name, case.lengths + case.angles
    )


def test_every_status_stands_in_the_manual() -> None:
    stated = set(re.findall(r"^\| `([a-z-]+)` \|", section("statuses", "Statuses"), re.MULTILINE))
    assert stated == {value for name, value in vars(Status).items() if name.isupper()}


@pytest.mark.parametrize(
    "asked",
    [
        "press.yaml --reactions --rates --report --sensitivity --tolerance 0.01 --stability 2",
        "arm.yaml",
        "cam.yaml",
        "crate.yaml",
        "spring.yaml --dynamic --set motion.speed=2",
    ],
)
def test_every_key_of_a_result_stands_in_the_manual(
    asked: str, files: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    spring = files / "spring.yaml"
    spring.write_text(spring.read_text() + "motion: {link: 2, speed: 1}\n")
    assert exit_status("solve", *asked.split(), "--json") == 0
    page = PAGES["results"]
    assert [key for key in json.loads(capsys.readouterr().out) if f"`{key}`" not in page] == []


def test_every_command_and_option_stands_in_the_manual() -> None:
    text = section("commands", "Commands")
    context = click.Context(commands)
    for name in commands.list_commands(context):
        assert f"`icsolve {name}" in text
        assert f"`icsolve {name}" in README
        command = commands.get_command(context, name)
        assert command is not None
        for parameter in command.params:
            long = [option for option in parameter.opts if option.startswith("--")]
            assert not long or any(f"`{option}" in text for option in long) or "--output" in long


def test_every_section_stands_in_the_manual() -> None:
    table = section("format", "The case file")
    assert [name for name in SECTIONS if f"`{name}" not in table] == []


def test_the_kinds_that_the_readme_names_exist() -> None:
    assert {"four-bar", "slider-crank"} <= set(kinds())


def test_exactly_two_commands_get_a_stranger_going() -> None:
    block = README.partition("<!-- two commands -->")[2].partition("<!-- /two commands -->")[0]
    commands_given = [line for line in block.splitlines() if line and not line.startswith("```")]
    assert len(commands_given) == 2
    assert commands_given[0].endswith("icsolve check cases/")
    assert "&& .venv/bin/pytest" in commands_given[1]


def test_the_table_of_the_24_problems_is_what_the_command_prints() -> None:
    table = (
        PAGES["problems"].partition("<!-- the 24 problems -->")[2].partition("<!-- /the 24 problems -->")[0]
    )
    cases = ROOT / "cases" / "ch13"
    printed = subprocess.run(
        [sys.executable, "-m", "icsolve", "check", "--table", str(cases)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    assert table.strip() == printed.stdout.strip()
    problems = {int(name[3:5]) for name in re.findall(r"^\| (13_[0-9]{2})_", table, re.MULTILINE)}
    assert problems == set(range(1, 25))


def test_the_table_of_options_has_those_that_the_commands_have() -> None:
    told: dict[str, set[str]] = {verb: set() for verb in commands.list_commands(click.Context(commands))}
    rows = re.findall(r"^\| (`-.*?) \| ([a-z, ]+) \| ", PAGES["commands"], re.MULTILINE)
    for options, verbs in rows:
        for verb in verbs.split(", "):
            told[verb] |= set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", options))
    for verb, named in told.items():
        command = commands.get_command(click.Context(commands), verb)
        assert command is not None
        shown = [one for one in command.params if isinstance(one, click.Option) and not one.hidden]
        spellings = [{*one.opts, *one.secondary_opts} for one in shown]
        assert named <= {spelling for names in spellings for spelling in names}, verb
        assert [names for names in spellings if not names & {*named, "--output"}] == [], verb


def test_the_readme_is_for_a_newcomer_and_leads_to_every_page() -> None:
    assert len(README.splitlines()) <= 300
    for topic in TOPICS:
        assert f"[{topic}](icsolve/manual/{topic}.md)" in README


def test_every_link_of_a_page_leads_somewhere() -> None:
    for topic, text in PAGES.items():
        here = ROOT if topic == "README" else ROOT / "icsolve" / "manual"
        for place in re.findall(r"\]\((?!https?:)([^)#]+)\)", text):
            assert (here / place).exists(), (topic, place)


@pytest.mark.parametrize(("word", "says"), [("format", "# The case file"), ("friction", "### Friction")])
def test_the_manual_prints_a_page_or_a_section(
    word: str, says: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert exit_status("manual", word) == 0
    assert capsys.readouterr().out.startswith(says)


def test_a_page_that_is_not_there_is_refused_with_the_nearest(capsys: pytest.CaptureFixture[str]) -> None:
    assert exit_status("manual", "swep") == 2
    assert "did you mean sweeps?" in capsys.readouterr().err


def test_the_page_for_contributors_names_modules_that_there_are() -> None:
    table = PAGES["inside"].partition("## Where each kind of change goes")[2]
    named = set(re.findall(r"`((?:[a-z_]+/)+[a-z_]+\.(?:py|md)|[a-z]+\.py)`", table))
    assert len(named) > 15
    for name in named:
        place = ROOT if name.startswith("tests/") else ROOT / "icsolve"
        assert (place / name).exists() or (ROOT / "icsolve" / "assembly" / "driven" / name).exists(), name
