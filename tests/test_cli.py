"""The command line as a user meets it: verbs, files, streams, exit statuses, and never a traceback."""

from __future__ import annotations

import io
import json
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from icsolve.cli.run import json_text
from icsolve.errors import SceneError
from icsolve.manual import kinds, template
from shell import Shell
from sizes import sampled

ROOT = str(Path(__file__).parent.parent)
PRESS = template("four-bar")
DEAD = """\
icsolve: 1
title: Slider-crank at its dead centre
points: {A: [0, 0], C: [unknown, 0]}
lengths: {AB: 1, BC: 3}
angles: {AB: 0}
near: {C: [4, 0]}
joints:
  - {pin: [1, 2], at: A}
  - {pin: [2, 3], at: B}
  - {pin: [3, 4], at: C}
  - {slide: [4, 1], at: C, along: 0}
loads:
  T12: {torque: 10, link: 2}
  P: {force: unknown, link: 4, at: C, angle: 180}
"""
LEVER = """\
icsolve: 1
points: {A: [0, 0], B: [2, 0]}
joints:
  - {pin: [1, 2], at: A}
loads:
  P: {force: 100, link: 2, at: B, angle: -90}
  T: {torque: unknown, link: 2}
"""


@pytest.fixture
def icsolve(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Shell:
    monkeypatch.chdir(tmp_path)
    Path("press.yaml").write_text(PRESS)
    Path("dead.yaml").write_text(DEAD)
    Path("lever.yaml").write_text(LEVER)
    Path("broken.yaml").write_text("icsolve: 1\njoints:\n  - {pin: [1, 2], att: A}\n")
    return Shell(capsys)


def test_solve_prints_the_unknown_with_its_unit_and_sense_in_words(icsolve: Shell) -> None:
    ran = icsolve("solve", "lever.yaml")
    assert (ran.code, ran.err) == (0, "")
    assert "T = 200 N*m, counterclockwise" in ran.out


def test_a_file_alone_means_solve(icsolve: Shell) -> None:
    assert icsolve("press.yaml") == icsolve("solve", "press.yaml")
    assert icsolve("--json", "press.yaml") == icsolve("solve", "--json", "press.yaml")


def test_icsolve_alone_gives_short_help_with_two_examples(icsolve: Shell) -> None:
    ran = icsolve()
    assert ran.code == 0
    assert "icsolve press.yaml" in ran.out
    assert "icsolve new four-bar" in ran.out
    assert icsolve("--help").out == ran.out


def test_json_is_one_object_a_file_one_a_line(icsolve: Shell) -> None:
    first, second = icsolve("solve", "--json", "press.yaml", "lever.yaml").objects()
    assert first["schema"] == second["schema"] == "icsolve/solve/1"
    assert (first["case"], second["case"]) == ("press", "lever")
    assert second["answers"]["T"]["value"] == pytest.approx(200.0, rel=1e-14)
    assert second["answers"]["T"]["sense"] == "ccw"


def test_of_several_files_each_answer_stands_under_its_name(icsolve: Shell) -> None:
    lines = icsolve("solve", "press.yaml", "lever.yaml").out.splitlines()
    assert [line for line in lines if line.startswith("===")] == ["=== press.yaml", "=== lever.yaml"]
    assert "===" not in icsolve("solve", "press.yaml").out


def test_a_word_that_is_neither_command_nor_file_suggests_the_command(icsolve: Shell) -> None:
    ran = icsolve("slove", "press.yaml")
    assert (ran.code, ran.out) == (2, "")
    assert "there is no command or file 'slove'; did you mean solve?" in ran.err


@pytest.mark.parametrize(
    ("word", "first"),
    [
        ("statuses", "# Statuses"),
        ("friction", "### Friction"),
        ("variants", "# Grading"),
        ("rpm", "# format"),
    ],
)
def test_the_manual_finds_a_page_a_section_or_the_paragraphs_of_a_word(
    icsolve: Shell, word: str, first: str
) -> None:
    ran = icsolve("manual", word)
    assert ran.code == 0 and ran.out.startswith(first) and word in ran.out.lower()
    assert icsolve("manual", "xylophone").code == 2


def test_rates_and_all_centres_come_on_request(icsolve: Shell) -> None:
    (plain,) = icsolve("press.yaml", "--json").objects()
    (full,) = icsolve("press.yaml", "--json", "--rates", "--all-centres").objects()
    assert "rates" not in plain
    assert "velocities" not in plain
    assert set(full["rates"]) == {"1", "2", "3", "4"}
    assert set(full["centres"]) == {"1-2", "1-3", "1-4", "2-3", "2-4", "3-4"}
    assert full["answers"] == plain["answers"]


def test_a_scene_without_an_answer_is_refused_with_its_status(icsolve: Shell) -> None:
    ran = icsolve("dead.yaml")
    assert (ran.code, ran.out) == (1, "")
    assert ran.err.startswith("dead.yaml: dead-centre: ")
    ran = icsolve("dead.yaml", "--json")
    (entry,) = ran.objects()
    assert ran.code == 1
    assert set(entry) == {"schema", "case", "status", "message"}
    assert (entry["case"], entry["status"]) == ("dead", "dead-centre")


def test_a_file_that_cannot_be_read_leaves_the_others_alone(icsolve: Shell) -> None:
    ran = icsolve("solve", "broken.yaml", "missing.yaml", "dead.yaml", "lever.yaml")
    assert ran.code == 2
    assert "T = 200 N*m" in ran.out
    assert "broken.yaml:3:19: " in ran.err
    assert "missing.yaml:1:1: there is no such file" in ran.err
    assert "dead.yaml: dead-centre" in ran.err


def test_a_folder_is_searched_and_other_yaml_is_passed_over_and_counted(icsolve: Shell) -> None:
    Path("cases/deep").mkdir(parents=True)
    Path("cases/.hidden").mkdir()
    Path("cases/b.yaml").write_text(LEVER)
    Path("cases/deep/a.yml").write_text(LEVER)
    Path("cases/.hidden/c.yaml").write_text(LEVER)
    Path("cases/other.yaml").write_text("version: 2\n")
    Path("cases/mentions.yaml").write_text("tools: [icsolve]\n")
    Path("cases/broken_other.yaml").write_text("a: [1,\n")
    ran = icsolve("solve", "cases", "--json")
    assert ran.code == 0
    assert [entry["case"] for entry in ran.objects()] == ["b", "a"]
    assert ran.err == "cases: 3 YAML files without `icsolve:` passed over\n"


@pytest.mark.parametrize("command", [("solve",), ("solve", "--json"), ("check",), ("check", "--table")])
def test_several_processes_print_what_one_does(icsolve: Shell, command: tuple[str, ...]) -> None:
    """In order, refusals and files that can't be read among the answers."""
    for n, text in enumerate([PRESS, DEAD, LEVER, "icsolve: 1\n", "a: 1\n"] * 3):
        Path(f"c{n:02d}.yaml").write_text(text)
    assert icsolve(*command, ".", "--jobs", "3") == icsolve(*command, ".", "--jobs", "1")


def test_a_folder_without_any_yaml_says_so(icsolve: Shell) -> None:
    Path("empty").mkdir()
    ran = icsolve("empty")
    assert (ran.code, ran.err) == (2, "empty:1:1: there is no YAML file here\n")


def test_globs_are_expanded_where_the_shell_did_not(icsolve: Shell) -> None:
    ran = icsolve("solve", "--json", "[lp]*.yaml")
    assert [entry["case"] for entry in ran.objects()] == ["lever", "press"]
    assert icsolve("solve", "no*.yaml").code == 2


def test_a_file_whose_name_looks_like_a_glob_is_a_file(icsolve: Shell) -> None:
    Path("a[1].yaml").write_text(LEVER)
    assert icsolve("solve", "a[1].yaml").code == 0


def test_standard_input_is_a_file_too(icsolve: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(LEVER.encode())))
    assert "T = 200 N*m" in icsolve("solve", "-").out


def test_set_changes_a_number_before_solving(icsolve: Shell) -> None:
    ran = icsolve("lever.yaml", "--json", "--set", "loads.P=50", "--set", "points.B.x=3")
    (entry,) = ran.objects()
    assert entry["answers"]["T"]["value"] == pytest.approx(150.0, rel=1e-14)


@pytest.mark.parametrize("setting", ["angles.AB", "=30", "angles.AB=", "angles.XY=30", "loads.P=fifty"])
def test_a_setting_that_means_nothing_is_refused(icsolve: Shell, setting: str) -> None:
    ran = icsolve("press.yaml", "--set", setting)
    assert (ran.code, ran.out) == (2, "")
    assert ran.err.strip()


def test_digits_of_the_text(icsolve: Shell) -> None:
    assert "T12 = 33.8 lbf*in" in icsolve("press.yaml", "--digits", "3").out
    assert icsolve("press.yaml", "--digits", "0").code == 2


def test_report_adds_the_kind_of_mechanism(icsolve: Shell) -> None:
    ran = icsolve("press.yaml", "--report")
    assert "Grashof crank-rocker: link 2 turns fully, link 4 rocks" in ran.out
    (entry,) = icsolve("press.yaml", "--report", "--json").objects()
    assert entry["report"]["loops"][0]["points"] == ["A", "B", "C", "D"]


def test_check_says_a_line_a_value(icsolve: Shell) -> None:
    Path("known.yaml").write_text(
        LEVER + 'expect:\n  T: 200 ccw\n  I12: [0, 0]\n  w2: {value: 2, erratum: "turns at 1"}\n'
    )
    ran = icsolve("check", "known.yaml", "lever.yaml")
    assert ran.code == 0
    assert ran.out.splitlines() == [
        "known.yaml: T agrees: published 200 ccw, found 200 ccw",
        "known.yaml: I12 agrees: published [0, 0], found [0, 0]",
        "known.yaml: w2 is an erratum: published 2, found 1 (turns at 1)",
        "lever.yaml: solved; no published value to compare",
    ]
    assert ran.err == "2 cases: 2 agree, 1 errata\n"


def test_check_fails_where_a_value_disagrees_and_where_there_is_no_answer(icsolve: Shell) -> None:
    Path("wrong.yaml").write_text(LEVER + "expect:\n  T: 201\n")
    ran = icsolve("check", "wrong.yaml")
    assert ran.code == 1
    assert "T disagrees: published 201, found 200" in ran.out
    assert icsolve("check", "dead.yaml").code == 1


def test_check_as_json(icsolve: Shell) -> None:
    Path("known.yaml").write_text(LEVER + "expect:\n  T: 200\n")
    (entry,) = icsolve("check", "--json", "known.yaml").objects()
    assert entry["schema"] == "icsolve/check/1"
    assert entry["status"] == "ok"
    assert entry["values"][0]["verdict"] == "agrees"


def test_check_as_json_has_an_object_for_a_case_without_an_answer(icsolve: Shell) -> None:
    Path("known.yaml").write_text(LEVER + "expect:\n  T: 200\n")
    ran = icsolve("check", "--json", "dead.yaml", "known.yaml")
    assert ran.code == 1
    refused, known = ran.objects()
    assert (refused["schema"], refused["case"], refused["values"]) == ("icsolve/check/1", "dead", [])
    assert refused["status"] == icsolve("solve", "--json", "dead.yaml").objects()[0]["status"] != "ok"
    assert known["status"] == "ok"


def test_validate_examines_the_whole_case(icsolve: Shell) -> None:
    ran = icsolve("validate", "press.yaml")
    assert (ran.code, ran.out.splitlines()[0]) == (0, "press.yaml: valid: 4 links, 4 joints, mobility 1")
    assert icsolve("validate", "broken.yaml").code == 2
    assert icsolve("validate", "dead.yaml").code == 1


def test_new_lists_its_kinds(icsolve: Shell) -> None:
    lines = icsolve("new").out.splitlines()
    assert len(lines) == len(kinds())
    assert any(line.startswith("slider-crank") and "piston" in line for line in lines)


@pytest.mark.parametrize("kind", kinds())
def test_every_template_solves_whole(icsolve: Shell, kind: str) -> None:
    assert icsolve("new", kind, "-o", "mine.yaml").code == 0
    assert Path("mine.yaml").read_text() == icsolve("new", kind).out
    ran = icsolve("mine.yaml", "--json", "--all-centres", "--rates", "--report")
    (entry,) = ran.objects()
    assert (ran.code, entry["status"]) == (0, "ok")
    assert icsolve("validate", "mine.yaml").code == 0
    assert icsolve("check", "mine.yaml").code == 0


def test_new_never_writes_over_a_file(icsolve: Shell) -> None:
    ran = icsolve("new", "four-bar", "-o", "lever.yaml")
    assert ran.code == 2
    assert "is there already" in ran.err
    assert Path("lever.yaml").read_text() == LEVER
    assert icsolve("new", "four-bar", "-o", "no/such/folder.yaml").code == 2


def test_an_unknown_kind_suggests_one(icsolve: Shell) -> None:
    ran = icsolve("new", "slidercrank")
    assert ran.code == 2
    assert "did you mean slider-crank?" in ran.err
    for word, kind in (
        ("planetary", "epicyclic"),
        ("pump", "slider-crank"),
        ("jack", "scissor-jack or screw-jack"),
    ):
        assert f"did you mean {kind}?" in icsolve("new", word).err
    assert "`icsolve new epicyclic` starts" in icsolve("manual", "planetary").err


def test_a_number_set_twice_is_told(icsolve: Shell) -> None:
    ran = icsolve("press.yaml", "--set", "angles.AB=60", "--set", "angles.AB=30")
    assert ran.code == 2 and "angles.AB is set twice, to 60 and 30" in ran.err


def test_schema_is_a_draft_07_schema(icsolve: Shell) -> None:
    schema = json.loads(icsolve("schema").out)
    assert schema["$schema"].startswith("http://json-schema.org/draft-07/schema")


@pytest.mark.parametrize("arguments", [["solve"], ["solve", "--nonsense", "press.yaml"], ["check"]])
def test_bad_usage_is_exit_2_with_a_hint(icsolve: Shell, arguments: list[str]) -> None:
    ran = icsolve(*arguments)
    assert (ran.code, ran.out) == (2, "")
    assert "Usage: icsolve" in ran.err


@pytest.mark.parametrize("verb", ["solve", "check", "validate", "new", "schema"])
def test_every_verb_has_help(icsolve: Shell, verb: str) -> None:
    ran = icsolve(verb, "-h")
    assert ran.code == 0
    assert f"Usage: icsolve {verb}" in ran.out


def test_version(icsolve: Shell) -> None:
    from icsolve import __version__

    assert icsolve("--version").out == f"icsolve {__version__}\n"


def test_a_fault_of_icsolve_is_one_line_and_the_other_files_are_solved(
    icsolve: Shell, monkeypatch: pytest.MonkeyPatch
) -> None:
    solved = __import__("icsolve").solve

    def faulty(case: Any, **options: Any) -> Any:
        if case.name == "press":
            raise ZeroDivisionError("float division by zero")
        return solved(case, **options)

    monkeypatch.setattr(sys.modules["icsolve.solve"], "solve", faulty)
    ran = icsolve("solve", "press.yaml", "lever.yaml")
    assert ran.code == 3
    assert "T = 200 N*m" in ran.out
    assert ran.err.count("\n") == 1
    assert "please report it" in ran.err


def test_an_interrupt_ends_with_130(icsolve: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("icsolve.cli.run.sources", interrupted)
    ran = icsolve("press.yaml")
    assert (ran.code, ran.err.strip()) == (130, "icsolve: interrupted")


def _process(*arguments: str, **environment: str) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        [sys.executable, "-m", "icsolve", *arguments],
        env={**os.environ, "PYTHONPATH": ROOT, **environment},
        capture_output=True,
        check=False,
    )


def test_the_same_bytes_every_run_whatever_the_terminal(icsolve: Shell) -> None:
    call = ("solve", "press.yaml", "lever.yaml", "--all-centres", "--rates", "--report")
    first = _process(*call, PYTHONHASHSEED="1", NO_COLOR="1", LC_ALL="C")
    second = _process(*call, PYTHONHASHSEED="2", TERM="dumb", FORCE_COLOR="1", PYTHONIOENCODING="ascii")
    assert first.returncode == 0
    assert first.stdout == second.stdout
    assert b"\x1b" not in first.stdout


def test_a_closed_pipe_is_quiet(icsolve: Shell) -> None:
    for number in range(50):
        Path(f"many{number}.yaml").write_text(PRESS)
    process = subprocess.Popen(
        [sys.executable, "-m", "icsolve", "solve", "--all-centres", "many*.yaml"],
        env={**os.environ, "PYTHONPATH": ROOT},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    assert process.stdout is not None
    assert process.stderr is not None
    process.stdout.read(1)
    process.stdout.close()
    assert process.stderr.read() == b""
    process.stderr.close()
    assert process.wait() == 141


@sampled(3)
@pytest.mark.parametrize(
    "call",
    [
        "grade answers.csv --cases lever.yaml -o -",
        "grade answers.csv --cases lever.yaml -o /dev/stdout",
        "sweep press.yaml --vary angles.AB=0:360:0.01",
        "page press.yaml",
        "schema",
    ],
)
def test_the_reader_of_any_command_may_go_away(icsolve: Shell, call: str) -> None:
    rows = "".join(f"{n},lever,{n} N*m\n" for n in range(2000))
    Path("answers.csv").write_text(f"student_id,case,answer\n{rows}")
    process = subprocess.Popen(
        ["sh", "-c", '"$@" 2>err; echo $? >code', "sh", sys.executable, "-m", "icsolve", *call.split()],
        env={**os.environ, "PYTHONPATH": ROOT},
        stdout=subprocess.PIPE,
    )
    assert process.stdout is not None
    process.stdout.close()
    process.wait()
    assert Path("code").read_text() == "141\n"
    assert "icsolve" not in Path("err").read_text()


@pytest.mark.parametrize("call", ["lever.yaml", "lever.yaml --json", "check lever.yaml"])
def test_results_that_a_closed_output_does_not_take_are_no_success(icsolve: Shell, call: str) -> None:
    ran = _closed(*call.split())
    assert ran.returncode == 2
    assert ran.stderr == b"icsolve: standard output is closed: the results can't be written\n"


def test_a_closed_output_that_nothing_needs_is_no_fault(icsolve: Shell) -> None:
    assert _closed("new", "slider-crank", "-o", "pump.yaml").returncode == 0
    assert Path("pump.yaml").exists()


def _closed(*call: str) -> subprocess.CompletedProcess[bytes]:
    """A call with its standard output closed."""
    shell = ["sh", "-c", 'exec "$@" >&-', "sh", sys.executable, "-m", "icsolve", *call]
    return subprocess.run(shell, env={**os.environ, "PYTHONPATH": ROOT}, stderr=subprocess.PIPE, check=False)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full")
@pytest.mark.parametrize(("stream", "path"), [("stdout", "lever.yaml"), ("stderr", "missing.yaml")])
def test_a_full_disk_is_said_where_it_still_can_be(icsolve: Shell, stream: str, path: str) -> None:
    with Path("/dev/full").open("wb") as full:
        streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, stream: full}
        process = subprocess.Popen(
            [sys.executable, "-m", "icsolve", path], env={**os.environ, "PYTHONPATH": ROOT}, **streams
        )
        _, err = process.communicate()
    assert process.returncode == 2
    assert err in {None, b"icsolve: No space left on device\n"}


def test_names_that_no_encoding_knows_are_shown_all_the_same(icsolve: Shell) -> None:
    ran = icsolve("solve", os.fsdecode(b"caf\xe9.yaml"), "lever.yaml")
    assert ran.code == 2
    assert "no such file" in ran.err
    assert "T = 200" in ran.out


@pytest.mark.parametrize("number", [math.inf, -math.inf, math.nan])
def test_an_answer_with_a_number_beyond_all_doubles_is_refused_and_no_fault(number: float) -> None:
    with pytest.raises(SceneError, match="larger than the largest double") as refused:
        json_text({"answers": {"T12": {"value": number}}})
    assert refused.value.status == "unsupported"


def test_an_option_that_would_do_nothing_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A column of a gradebook that is not written, and a link to turn where a number is to vary."""
    monkeypatch.chdir(tmp_path)
    shell = Shell(capsys)
    Path("ladder.yaml").write_text(template("four-bar").replace("torque: unknown", "torque: 30"))
    Path("a.csv").write_text("student,ladder\nann,1\n")
    for option in ("total", "template"):
        refused = shell("grade", "a.csv", "--cases", ".", f"--{option}", "a.csv")
        assert refused.code == 2 and f"--{option} needs --write KIND=FILE" in refused.err
    refused = shell("sweep", "ladder.yaml", "--drive", "2=0:10:1", "--find", "hold")
    assert refused.code == 2 and "vary what poses link 2" in refused.err


def test_a_table_of_published_values_has_a_row_of_a_case_without_an_answer(
    icsolve: Shell, tmp_path: Path
) -> None:
    """A row a case, whatever came of it, also where its values could not be compared."""
    one = template("four-bar") + "expect: {T12: 1, w4/w2: 0.3}\n"
    (tmp_path / "one.yaml").write_text(one.replace("  - {pin: [4, 1], at: D}\n", ""))
    (tmp_path / "two.yaml").write_text(template("four-bar"))
    ran = icsolve("check", "--table", "one.yaml", "two.yaml")
    assert [line.split(" | ")[0] for line in ran.out.splitlines()[2:]] == ["| one", "| two"]
    assert "| no answer (mobility) | 0 of 2 |" in ran.out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("manual", "frction"), "did you mean friction?"),
        (("manual", "tolerence"), "did you mean tolerance?"),
        (("new", "toggle"), "did you mean four-bar"),
        (("new", "clamp"), "four-bar"),
        (("new", "excavator"), "did you mean cylinder?"),
    ],
)
def test_a_word_that_is_nearly_one_of_the_manual_or_of_a_kind_is_answered(
    icsolve: Shell, words: tuple[str, str], said: str
) -> None:
    """Who looks for a thing by its name in a catalogue finds the kind that it is."""
    ran = icsolve(*words)
    assert ran.code == 2 and said in ran.err


def test_nothing_is_summed_up_of_files_that_cannot_be_read(icsolve: Shell) -> None:
    ran = icsolve("check", "broken.yaml")
    assert ran.code == 2 and "broken.yaml:3:" in ran.err and "cases" not in ran.err
    assert "1 case: " in icsolve("check", "broken.yaml", "lever.yaml").err
