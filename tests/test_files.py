"""Files that commands write: whole or not at all, through links and into pipes, never over what was read."""

from __future__ import annotations

import itertools
import os
import random
import re
import resource
import shutil
import signal
import stat
import subprocess
import sys
import threading
import time
from collections import Counter
from pathlib import Path

import pytest

from icsolve.files import KeptError, folder_of, one_call, reading, scratch, whole_file, write_whole
from icsolve.manual import template
from shell import exit_status
from sizes import FULL, sampled

ROOT = str(Path(__file__).parent.parent)
VARIED = (
    template("four-bar")
    .replace("force: 100,", "force: $P,")
    .replace("lengths:", "variables: {P: {range: [100, 300], step: 10}}\nlengths:", 1)
)
WRITERS = {
    "new": "new four-bar -o {}",
    "draw": "draw press.yaml -o {}",
    "explain": "explain press.yaml -o {}",
    "sheet": "sheet press.yaml -o {}",
    "page": "page press.yaml -o {}",
    "sweep": "sweep press.yaml --vary angles.AB=50:60:5 -o {}",
    "plot": "sweep press.yaml --vary angles.AB=50:60:5 --plot {}",
    "find": "sweep press.yaml --vary angles.AB=50:70:5 --find max -o {}",
    "grade": "grade hand --cases cases -q --force -o {}",
    "jsonl": "grade hand --cases cases -q --force --jsonl {}",
    "summary": "grade hand --cases cases -q --force --html {}",
    "review": "grade hand --cases cases -q --force --review {}",
    "changes": "grade hand --cases cases -q --force --against old.csv --changes {}",
    "canvas": "grade hand --cases cases -q --force --write canvas={}",
    "moodle": "export moodle-xml cases --no-figures --force -o {}",
    "autograder": "export gradescope-zip cases --force -o {}",
}
"""Every command that writes one file."""
ENDINGS = {
    "draw": ".svg",
    "explain": ".md",
    "sheet": ".tex",
    "page": ".html",
    "sweep": ".csv",
    "plot": ".svg",
    "moodle": ".xml",
    "autograder": ".zip",
}
FOLDERS = {
    "gallery": "gallery cases --force -o {}",
    "variants": "variants cases --roster roster.csv --force -q -o {}",
    "element": "export prairielearn cases --force -o {}",
}
"""Every command that writes a folder."""


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with cases, hand-ins and a roster."""
    monkeypatch.chdir(tmp_path)
    for folder in ("cases", "hand", "out", "scratch"):
        Path(folder).mkdir()
    Path("press.yaml").write_text(template("four-bar"))
    Path("cases/press.yaml").write_text(template("four-bar"))
    Path("cases/varied.yaml").write_text(VARIED)
    Path("hand/first.csv").write_text("student_id,case,answer\n1,press,33.76 cw\n2,press,3 N\n")
    Path("roster.csv").write_text("student_id\n1\n2\n3\n")
    Path("old.csv").write_text(
        "student_id,case,variant,attempt,raw_answer,value,unit,direction,verdict,score,max_score,rel_error,"
        "code,feedback\n1,press,,,33.76 cw,33.76,,cw,wrong,0,1,,,Not right.\n"
    )
    monkeypatch.setenv("TMPDIR", str(tmp_path / "scratch"))
    return tmp_path


def _named(writer: str, folder: str = "out") -> str:
    return f"{folder}/file{ENDINGS.get(writer, '.csv')}"


def _tree(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


@sampled(3)
@pytest.mark.parametrize("writer", [name for name in WRITERS if name != "new"])
def test_a_file_that_is_replaced_keeps_its_mode_and_its_links(writer: str, here: Path) -> None:
    target, link = Path(_named(writer)), Path(_named(writer, "."))
    target.write_text("old")
    target.chmod(0o640)
    link.symlink_to(target)
    assert exit_status(*WRITERS[writer].format(link).split()) in (0, 1)
    assert link.is_symlink()
    assert target.read_bytes() != b"old"
    assert stat.S_IMODE(target.stat().st_mode) == 0o640
    assert os.listdir("out") == [target.name]


@sampled(3)
@pytest.mark.parametrize("writer", WRITERS)
def test_a_link_to_nothing_gets_its_file(writer: str) -> None:
    link, target = Path(_named(writer, ".")), Path(_named(writer))
    link.symlink_to(target)
    assert exit_status(*WRITERS[writer].format(link).split()) in (0, 1)
    assert link.is_symlink()
    assert target.stat().st_size


@sampled(3)
@pytest.mark.parametrize("writer", WRITERS)
def test_a_pipe_is_written_to_and_stays_one(writer: str) -> None:
    pipe = _named(writer)
    os.mkfifo(pipe)
    found: list[bytes] = []
    reader = threading.Thread(target=lambda: found.append(Path(pipe).read_bytes()), daemon=True)
    reader.start()
    assert exit_status(*WRITERS[writer].format(pipe).split()) in (0, 1)
    reader.join()
    assert found[0]
    assert stat.S_ISFIFO(os.stat(pipe).st_mode)


@sampled(3)
@pytest.mark.parametrize("writer", WRITERS)
def test_a_device_stays_a_device(writer: str) -> None:
    link = Path(_named(writer))
    link.symlink_to("/dev/null")
    assert exit_status(*WRITERS[writer].format(link).split()) in (0, 1)
    assert link.is_symlink()
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)


@pytest.mark.skipif(not Path("/proc/self/fd").exists(), reason="this system has no /proc")
def test_ones_own_output_by_name_goes_on_where_it_is() -> None:
    Path("log").write_text("before\n")
    with Path("log").open("ab") as log:
        call = [sys.executable, "-m", "icsolve", "export", "gift", "cases", "-o", "/dev/stdout"]
        ran = subprocess.run(call, stdout=log, env={**os.environ, "PYTHONPATH": ROOT}, check=False)
    assert ran.returncode == 0
    assert Path("log").read_text().startswith("before\n$CATEGORY: ")


def test_a_hyphen_is_ones_own_output_for_exports_too(capfd: pytest.CaptureFixture[str]) -> None:
    line = "export gift cases --count 1 --force -o"
    assert exit_status(*line.split(), "out/gift") == exit_status(*line.split(), "-") == 0
    assert capfd.readouterr().out == Path("out/gift").read_text(encoding="utf-8")
    assert not Path("-").exists()


@pytest.mark.parametrize("writer", [*FOLDERS, "students"])
def test_no_folder_is_called_a_hyphen(writer: str, capsys: pytest.CaptureFixture[str]) -> None:
    line = {**FOLDERS, "students": "grade hand --cases cases -q --force -o out/g.csv --students {}"}[writer]
    assert exit_status(*line.format("-").split()) == 2
    assert "'-' is standard output: name a folder" in capsys.readouterr().err
    assert not Path("-").exists()


@sampled(3)
@pytest.mark.parametrize("writer", [w for w in WRITERS if w != "new"])
@pytest.mark.parametrize("by", ["its name", "a link", "a hard link"])
def test_what_is_read_is_never_written_over(writer: str, by: str, here: Path) -> None:
    """Neither the case, nor one of the folder of cases, nor a hand-in of the folder of hand-ins."""
    line = WRITERS[writer]
    inputs = ["press.yaml"] if "press.yaml" in line else ["cases/varied.yaml", "cases/press.yaml"]
    for read in [*inputs, *(["hand/first.csv"] if "hand" in line else [])]:
        target = read
        if by != "its name":
            target = _named(writer)
            Path(target).unlink(missing_ok=True)
            (os.symlink if by == "a link" else os.link)(here / read, target)
        before = _tree(here)
        if writer != "sweep" or by != "its name":
            assert exit_status(*line.format(target).split()) == 2
        assert _tree(here) == before


OUTPUTS = [
    "-o {}",
    "--jsonl {}",
    "--html {}",
    "--review {}",
    "--against old.csv --changes {}",
    "--write canvas={}",
]


@sampled(3, "force", "one")
@pytest.mark.parametrize("force", ["", "--force"])
@pytest.mark.parametrize(("one", "other"), [*itertools.combinations(OUTPUTS, 2)])
def test_two_outputs_of_one_call_never_take_the_same_file(
    one: str, other: str, force: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """By the same name, another spelling of it, or a link: the first would be lost without a word. None is
    left of a call that writes several and fails."""
    before = sorted(here.rglob("*"))
    for name in ("both.csv", "./both.csv", "link.csv"):
        (here / "link.csv").symlink_to("both.csv")
        words = f"grade hand --cases cases -q {force} {one.format('both.csv')} {other.format(name)}"
        assert exit_status(*words.split()) == 2, words
        assert "is written by this call already; give each output its own name" in capsys.readouterr().err
        (here / "link.csv").unlink()
        assert sorted(here.rglob("*")) == before


def test_nor_is_a_case_that_comes_later_in_a_gallery(here: Path) -> None:
    Path("b.svg").write_text(template("four-bar"))
    before = Path("b.svg").read_bytes()
    assert exit_status(*"gallery press.yaml b.svg -o . --force".split()) == 2
    assert Path("b.svg").read_bytes() == before


def test_nor_a_roster_among_the_sheets() -> None:
    Path("out/varied").mkdir()
    Path("roster.csv").rename("out/varied/values.csv")
    before = Path("out/varied/values.csv").read_bytes()
    again = "variants cases --roster out/varied/values.csv -o out --force -q --no-figures"
    assert exit_status(*again.split()) == 2
    assert Path("out/varied/values.csv").read_bytes() == before


def test_a_template_is_filled_where_it_lies_if_it_is_the_target() -> None:
    book = "Student,ID,SIS User ID,Section,press (7)\nDoe,10,1,A,\nRoe,11,2,A,\n"
    Path("book.csv").write_text(book)
    line = "grade hand --cases cases -q --template book.csv --write canvas=book.csv"
    assert exit_status(*line.split()) == 2
    assert exit_status(*f"{line} --force".split()) in (0, 1)
    assert Path("book.csv").read_text() != book


def test_results_of_an_earlier_run_among_the_hand_ins_are_no_hand_in() -> None:
    line = "grade hand --cases cases -q --force -o hand/results.csv"
    code = exit_status(*line.split())
    first = Path("hand/results.csv").read_bytes()
    assert exit_status(*line.split()) == code
    assert Path("hand/results.csv").read_bytes() == first


def test_the_draft_is_new_and_not_where_a_link_of_its_name_leads(
    here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("os.urandom", lambda n: b"\0" * n)
    trap = here / f".icsolve-{'00' * 8}.part"
    trap.symlink_to("victim")
    with pytest.raises(FileExistsError), whole_file("target"):
        pass
    assert not Path("victim").exists()
    assert not Path("target").exists()


def test_without_force_a_file_that_comes_meanwhile_is_kept() -> None:
    with pytest.raises(KeptError), whole_file("late", force=False):
        Path("late").write_text("theirs")
    assert Path("late").read_text() == "theirs"


def test_what_is_read_while_a_file_is_drafted_is_kept_too() -> None:
    Path("both").write_text("input")
    with one_call(), pytest.raises(KeptError), whole_file("both"):
        reading("both").close()
    assert Path("both").read_text() == "input"


def test_a_file_that_may_not_be_written_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    Path("fixed").write_text("old")
    monkeypatch.setattr("os.access", lambda path, mode: False)
    with pytest.raises(PermissionError), whole_file("fixed"):
        pass
    assert Path("fixed").read_text() == "old"


def test_folders_made_for_a_file_go_again_where_it_fails(here: Path) -> None:
    with pytest.raises(RuntimeError), folder_of("a/b/c.csv"), whole_file("a/b/c.csv"):
        raise RuntimeError
    assert not Path("a").exists()
    write_whole("a/b/c.csv", "done")
    assert Path("a/b/c.csv").read_text() == "done"


@sampled(6)
@pytest.mark.parametrize("writer", [*WRITERS, *FOLDERS])
def test_a_disk_that_is_full_is_said_of_the_file(writer: str) -> None:
    """No file may grow beyond a byte; results that other outputs need are kept in one for the time being."""

    def full() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (1, 1))

    line = (WRITERS | FOLDERS)[writer].format("out" if writer in FOLDERS else _named(writer))
    call = [sys.executable, "-m", "icsolve", *line.split()]
    env = {**os.environ, "PYTHONPATH": ROOT, "PYTHONDONTWRITEBYTECODE": "1"}
    ran = subprocess.run(call, env=env, capture_output=True, check=False, text=True, preexec_fn=full)
    assert ran.returncode == 2
    assert re.search(r": (out|\S*scratch)/\S+( can't be written)?: File too large", ran.stderr), ran.stderr
    assert not _tree(Path("out"))


STRACE = shutil.which("strace")
CALLS = "openat,write,pwrite64,close,fchmod,fchown,rename,link,linkat,unlink,mkdir,newfstatat,fstat,lseek"
FAULTS = 1
"""For each command and run of the tests; ICSOLVE_FAULTS=30 tries more."""


@sampled(3)
@pytest.mark.skipif(STRACE is None, reason="strace is not installed")
@pytest.mark.parametrize("writer", [*WRITERS, *FOLDERS] if FULL else ["page", "canvas", "variants"])
def test_a_fault_of_the_system_leaves_every_target_whole(writer: str, here: Path) -> None:
    """Faults in any call of the system from where the first file is drafted on: of a page, a table, several
    files and a folder, in a full run of all that writes."""
    dice = random.Random(writer)
    line = (WRITERS | FOLDERS)[writer]
    line = line.format("out" if writer in FOLDERS else _named(writer))
    places = _traced(line)
    good = _tree(here)
    for _ in range(int(os.environ.get("ICSOLVE_FAULTS", FAULTS))):
        shutil.rmtree("out")
        Path("out").mkdir()
        old = dice.random() < 0.5 and writer != "new"
        for name in good if old else ():
            if name.startswith("out/"):
                Path(name).parent.mkdir(parents=True, exist_ok=True)
                Path(name).write_text("old")
        call, when = dice.choice(places)
        inject = f"inject={call}:error={dice.choice(['ENOSPC', 'EIO', 'EACCES', 'EMFILE'])}:when={when}"
        _strace("-e", f"trace={call}", "-e", inject, line=line)
        for name, content in _tree(here).items():
            if name in good:
                cut = content != good[name] and good[name].startswith(content)
                assert content == b"old" or not cut, (inject, name)
            assert name in good or name.startswith("scratch/") or call == "unlink", (inject, name)
        assert {name for name in good if not name.startswith("out/")} <= set(_tree(here))


def _traced(line: str) -> list[tuple[str, int]]:
    """The calls of the system from the first draft on, each with its number among those of its name."""
    _strace("-e", f"trace={CALLS}", line=line, to="../trace")
    lines = Path("../trace").read_text().splitlines()
    own = lines[0].split()[0]
    count: Counter[str] = Counter()
    found, drafting = [], False
    for process, rest in (text.split(maxsplit=1) for text in lines):
        name = rest.partition("(")[0]
        if process == own and "(" in rest and name.isidentifier():
            count[name] += 1
            drafting = drafting or ".icsolve-" in rest
            if drafting:
                found.append((name, count[name]))
    return found


def _strace(*how: str, line: str, to: str = "/dev/null") -> int:
    """Run a command under strace, which stops it at the calls that are traced only."""
    strace = [STRACE or "", "-f", "-qq", "--seccomp-bpf", "-o", to, *how]
    return _run([*strace, sys.executable, "-m", "icsolve", *line.split()])


def _run(call: list[str]) -> int:
    env = {**os.environ, "PYTHONPATH": ROOT, "PYTHONDONTWRITEBYTECODE": "1"}
    return subprocess.run(call, env=env, capture_output=True, check=False).returncode


@sampled(3)
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP, signal.SIGINT])
def test_a_signal_leaves_nothing_half_done_at_any_moment(number: signal.Signals, here: Path) -> None:
    dice = random.Random(number)
    Path("hand/more.csv").write_text(
        "student_id,case,answer\n" + "".join(f"s{n},press,{n} N\n" for n in range(60_000))
    )
    lines = [
        "grade hand --cases cases -q --force --jobs 2 --write canvas=out/canvas.csv -o out/results.csv",
        "variants cases --roster roster.csv --force -q -o out",
        "sweep press.yaml --vary angles.AB=50:60:0.0001 -o out/file.csv",
        "draw press.yaml -o out/file.svg",
    ]
    for line in dice.sample(lines, 4 if FULL else 1):
        process = _started(line)
        time.sleep(dice.uniform(0.05, 1.0))
        process.send_signal(number)
        _, err = process.communicate()
        assert process.returncode in (0, 1, 130 if number == signal.SIGINT else -number)
        assert b"Traceback" not in err
        assert not os.listdir("scratch")
        assert not [name for name in _tree(here / "out") if ".part" in name]


@sampled(3)
@pytest.mark.parametrize("command", FOLDERS)
def test_a_folder_is_written_whole_or_not_at_all(command: str, here: Path) -> None:
    """Ended as any of its files is drafted: each takes a random name then."""
    line = FOLDERS[command].format("out/made")
    assert exit_status(*line.split()) == 0
    whole = {*_tree(here / "out")}
    assert len(whole) > 3
    shutil.rmtree("out")
    Path("out").mkdir()
    begun = (
        "import os, signal, sys, icsolve.cli as c\n"
        "last, keep, made = int(sys.argv.pop(1)), os.urandom, []\n"
        "def urandom(n):\n"
        "    made.append(n)\n"
        "    if n == 8 and made.count(8) == last:\n"
        "        os.kill(os.getpid(), signal.SIGTERM)\n"
        "    return keep(n)\n"
        "os.urandom = urandom\n"
        "c.entry()\n"
    )
    env, met = {**os.environ, "PYTHONPATH": ROOT}, set()
    some = {2, 3, len(whole) - 1, len(whole) + 1} if FULL else set()
    for n in sorted({1, len(whole), 1000, *some}):
        call = [sys.executable, "-c", begun, str(n), *line.split()]
        ran = subprocess.run(call, env=env, capture_output=True, check=False)
        there = {*_tree(here / "out")}
        assert ran.returncode in (0, -signal.SIGTERM), ran.stderr
        assert there == (set() if ran.returncode else whole)
        assert ran.returncode == 0 or not os.path.exists("out/made")
        met.add(ran.returncode)
        shutil.rmtree("out")
        Path("out").mkdir()
    assert met == {0, -signal.SIGTERM}


def _started(line: str) -> subprocess.Popen[bytes]:
    """A command that has come as far as heeding signals."""
    begun = "import signal, icsolve.cli as c, sys, os\n" + (
        "keep = c._run\n"
        "def run(arguments):\n    os.write(2, b'.')\n    return keep(arguments)\n"
        "c._run = run\nc.entry()\n"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", begun, *line.split()],
        env={**os.environ, "PYTHONPATH": ROOT},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
    )
    assert process.stderr is not None
    assert process.stderr.read(1) == b"."
    return process


def test_ctrl_c_while_a_package_loads_is_no_fault() -> None:
    """Whatever a package makes of an exception that comes while it loads: none is raised."""
    begun = (
        "import os, signal, sys, icsolve.cli as c\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"  # also where the tests run in background
        "class Interrupting:\n"
        "    def find_spec(self, name, path=None, target=None):\n"
        "        if name == 'numpy.linalg':\n"
        "            os.kill(os.getpid(), signal.SIGINT)\n"
        "            for _ in range(1000): pass\n"
        "sys.meta_path.insert(0, Interrupting())\n"
        "c.entry()\n"
    )
    call = [sys.executable, "-c", begun, *"sweep press.yaml --vary angles.AB=50:60:5".split()]
    env = {**os.environ, "PYTHONPATH": ROOT}
    ran = subprocess.run(call, env=env, capture_output=True, check=False)
    assert (ran.returncode, ran.stdout, ran.stderr) == (130, b"", b"icsolve: interrupted\n")


def test_a_folder_of_ones_own_is_gone_with_all_that_was_made_in_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Folders in it too, as the benchmark's cases have one."""
    own = tmp_path / "own"
    own.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(own))
    with scratch() as folder:
        write_whole(os.path.join(folder, "cases", "deep", "1.yaml"), "x")
        assert os.listdir(own)
    assert not os.listdir(own)


def test_a_signal_while_the_package_of_processes_loads_ends_as_any_other() -> None:
    """A package that has begun to load is there, with nothing in it: then no process has been split off."""
    begun = (
        "import signal, sys, types, icsolve.cli as c\n"
        "sys.modules['multiprocessing'] = types.ModuleType('multiprocessing')\n"
        "c._leave(signal.SIGTERM, None)\n"
    )
    found = subprocess.run(
        [sys.executable, "-c", begun],
        env={**os.environ, "PYTHONPATH": ROOT},
        capture_output=True,
        check=False,
    )
    assert (found.returncode, found.stderr) == (-signal.SIGTERM, b"")
