"""Files: what a call reads is remembered, and what it writes appears whole or not at all, never over that.

A file is drafted beside its target under a random name and takes the target's name once all of it is
written: whoever looks finds the old content or the new. Through a link its target is replaced; a device, a
pipe and one's own open files (``/dev/stdout``) are written to and stay what they are.

Below that, work in processes that share what was read and solved; where systems can't, all is done in one.
"""

from __future__ import annotations

import errno
import os
import stat
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import IO, Any

_LINKS = 40
"""Links that are followed one after the other, as the kernel does."""
_MODE = 0o777
UNWRITTEN = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO}
"""What the system says of a file that it can write no more to, without its name."""


class KeptError(OSError):
    """A file that stays as it is; the message is a sentence with the way out."""


_Waiting = tuple[str, str, bool]
"""A draft that is written: its name, that of its file as it was given, and whether it goes over another."""


class _Call:
    """What one call has read, and what it would leave behind if it ended now."""

    def __init__(self) -> None:
        self.runs = False
        self.read: set[tuple[int, int]] = set()
        self.written: set[tuple[int, int]] = set()
        self.drafts: set[str] = set()
        self.scratch: set[str] = set()
        self.made: list[str] = []
        self.waiting: dict[str, _Waiting] | None = None
        """by name, what takes its name together with others"""

    def forget_others(self) -> None:
        """In a process split off: drafts and folders are the parent's to remove."""
        self.drafts, self.scratch, self.made = set(), set(), []
        self.waiting = None if self.waiting is None else {}


_call = _Call()
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_call.forget_others)


@contextmanager
def one_call() -> Iterator[None]:
    """A call of the command line: files that are read or written in it are not written over in it."""
    _call.read, _call.written, _call.runs = set(), set(), True
    try:
        yield
    finally:
        _call.runs = False


def note(file: str | os.PathLike[str] | int) -> None:
    """Remember a file, by name or number, as one that this call reads."""
    _remember(file, _call.read)


def _remember(file: str | os.PathLike[str] | int, among: set[tuple[int, int]]) -> None:
    if _call.runs:
        with suppress(OSError, ValueError):
            found = os.stat(file)
            if stat.S_ISREG(found.st_mode):
                among.add((found.st_dev, found.st_ino))


def reading(path: str | os.PathLike[str]) -> IO[bytes]:
    """Open a file to read its bytes. Raises OSError."""
    file = open(path, "rb")  # noqa: SIM115
    note(file.fileno())
    return file


def reading_text(path: str | os.PathLike[str], encoding: str, errors: str | None = None) -> IO[str]:
    """Open a file to read its text. Raises OSError."""
    file = open(path, encoding=encoding, errors=errors)  # noqa: SIM115
    note(file.fileno())
    return file


def is_plain(path: str) -> bool:
    """Whether a name found in a folder is to be read: a regular file, or a link that leads nowhere (which
    the reader explains); a pipe or a device would hang or never end."""
    try:
        return stat.S_ISREG(os.stat(path).st_mode)
    except OSError:
        return True


def files_of(folder: str, endings: tuple[str, ...]) -> Iterator[str]:
    """The regular files of a folder and of the folders in it that end so, by name; hidden folders and links
    to folders are passed over."""
    for here, folders, names in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        for name in sorted(names):
            path = os.path.join(here, name)
            if name.lower().endswith(endings) and is_plain(path):
                yield path


def check_free(path: str, force: bool) -> None:
    """Raises KeptError where a file would be overwritten that may not: one that this call reads or wrote,
    and without ``force`` any that is there."""
    if _descriptor(path) is not None:
        return
    found = _status(path)
    if found is None or not stat.S_ISREG(found.st_mode):
        return
    if _call.runs and (found.st_dev, found.st_ino) in _call.read:
        raise KeptError(f"{path} is one of the files read here, and is left as it is; choose another name")
    if _call.runs and (found.st_dev, found.st_ino) in _call.written:
        raise _twice(path)
    if not force:
        raise KeptError(f"{path} is there already, and is left as it is; --force writes over it")


def check_ending(path: str, endings: Iterable[str], writer: str) -> None:
    """Raises KeptError where a file's name ends as nothing that ``writer`` writes; without an ending, as of a
    device, it may be all of it."""
    *some, last = filter(None, endings)
    ending = os.path.splitext(path)[1].lower()
    if ending and ending not in (*some, last):
        names = f"{', '.join(some)} or {last}" if some else last
        raise KeptError(f"{path} should end in {names}, which is what {writer} writes")


@contextmanager
def whole_file(path: str, force: bool = True, binary: bool = False) -> Iterator[IO[Any]]:
    """A file to write, in UTF-8 unless ``binary``; it takes its name only when all is written.

    What is there keeps its mode, and its owner where the system allows it. Raises KeptError or OSError.
    """
    check_free(path, force)
    how: dict[str, Any] = {"mode": "wb"} if binary else {"mode": "w", "encoding": "utf-8", "newline": ""}
    found = _status(path)
    number = _descriptor(path)
    if number is not None or (found is not None and not stat.S_ISREG(found.st_mode)):
        through = os.dup(number) if number is not None else os.open(path, os.O_WRONLY)
        with open(through, **how) as file:
            yield file
        return
    real = os.path.realpath(path)
    if found is not None and not os.access(real, os.W_OK):
        raise PermissionError(13, "it is protected against writing", path)
    folder = os.path.dirname(real)
    if not os.path.isdir(folder):
        raise FileNotFoundError(2, f"there is no folder {os.path.dirname(path) or folder}", path)
    draft = os.path.join(folder, f".icsolve-{os.urandom(8).hex()}.part")
    _call.drafts.add(draft)
    try:
        opener = _anew if found is None else _anew_for_oneself
        with filling(path), open(draft, opener=opener, **how) as file:
            if found is not None:
                _keep_mode(file.fileno(), found)
            yield file
        check_free(path, force)
        if _call.waiting is None:
            _take_name(draft, real, path, force)
        elif _call.waiting.setdefault(real, (draft, path, force))[0] != draft:
            raise _twice(path)
    except OSError as error:
        if error.filename == draft:
            error.filename = path
        raise
    finally:
        if draft not in {one for one, _, _ in (_call.waiting or {}).values()}:
            _drop(draft)


@contextmanager
def filling(path: str) -> Iterator[None]:
    """A file is written to: a fault of the system, such as a full disk, has its name."""
    try:
        yield
    except OSError as error:
        if error.filename is None and error.errno in UNWRITTEN:
            error.filename = path
        raise


@contextmanager
def together() -> Iterator[None]:
    """Files that are written within take their names at its end, all of them: a call that fails or is ended
    before leaves none."""
    _call.waiting = {}
    try:
        yield
        for _, path, force in _call.waiting.values():
            check_free(path, force)
        with _undisturbed():
            for real, (draft, path, force) in _call.waiting.items():
                _take_name(draft, real, path, force)
        _call.made = []
    finally:
        drafts = [draft for draft, _, _ in _call.waiting.values()]
        _call.waiting = None
        for draft in drafts:
            _drop(draft)
        _remove_empty(_call.made)
        _call.made = []


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Signals to end wait until it is over."""
    import signal  # here: it makes enumerations, at every start

    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    held = signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT, signal.SIGTERM, signal.SIGHUP))
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, held)


def _drop(draft: str) -> None:
    with suppress(OSError):
        os.unlink(draft)
    _call.drafts.discard(draft)


def _twice(path: str) -> KeptError:
    return KeptError(f"{path} is written by this call already; give each output its own name")


def write_whole(path: str, data: str | bytes | Iterable[str | bytes], force: bool = True) -> None:
    """Write a file, and the folders that it needs; they go again where it fails.

    Raises KeptError or OSError.
    """
    with folder_of(path), whole_file(path, force, binary=True) as file:
        for part in [data] if isinstance(data, str | bytes) else data:
            file.write(part.encode("utf-8") if isinstance(part, str) else part)


@contextmanager
def folder_of(path: str) -> Iterator[None]:
    """The folder of a file that is written within; what had to be made for it goes again where that fails.

    Raises KeptError where it is called ``-``, which is standard output: no folder goes there.
    """
    if path.startswith(f"-{os.sep}"):
        raise KeptError("several files are written here, and '-' is standard output: name a folder")
    missing = []
    folder = os.path.dirname(os.path.abspath(path))
    while not os.path.lexists(folder):
        missing.append(folder)
        folder = os.path.dirname(folder)
    _call.made += missing
    try:
        for folder in reversed(missing):
            with suppress(FileExistsError):
                os.mkdir(folder)
        yield
    except BaseException:
        _remove_empty(missing)
        raise
    finally:
        if _call.waiting is None:
            _call.made = [folder for folder in _call.made if folder not in missing]


@contextmanager
def scratch() -> Iterator[str]:
    """A folder for files of one's own that no one else may read, gone at the end however that comes."""
    from tempfile import gettempdir

    folder = os.path.join(gettempdir(), f"icsolve-{os.urandom(8).hex()}")
    _call.scratch.add(folder)
    try:
        os.mkdir(folder, 0o700)
        yield folder
    finally:
        _remove(folder)
        _call.scratch.discard(folder)


def clear_away() -> None:
    """Remove what a call that ends now would leave behind: drafts, scratch files, folders without a file."""
    for draft in list(_call.drafts):
        with suppress(OSError):
            os.unlink(draft)
    for folder in list(_call.scratch):
        _remove(folder)
    _remove_empty(_call.made)


def _status(path: str) -> os.stat_result | None:
    """What is there, through links; None for nothing, and for a link to nothing."""
    try:
        return os.stat(path)
    except FileNotFoundError:
        return None


def _descriptor(path: str) -> int | None:
    """The number of one's own open file that a name such as ``/dev/stdout``, or ``-``, leads to."""
    if path == "-":
        return 1
    own = f"/proc/{os.getpid()}/fd"
    for _ in range(_LINKS):
        folder, name = os.path.split(path)
        if name.isdigit() and os.path.realpath(folder) == own:
            return int(name)
        try:
            path = os.path.join(folder, os.readlink(path))
        except OSError:
            return None
    return None


def _anew(path: str, flags: int) -> int:
    return os.open(path, flags | os.O_EXCL | getattr(os, "O_NOFOLLOW", 0), 0o666)


def _anew_for_oneself(path: str, flags: int) -> int:
    """For a draft of a file that others perhaps may not read; it gets that file's mode."""
    return os.open(path, flags | os.O_EXCL | getattr(os, "O_NOFOLLOW", 0), 0o600)


def _keep_mode(draft: int, found: os.stat_result) -> None:
    if os.name == "posix":
        with suppress(PermissionError):
            os.fchown(draft, found.st_uid, found.st_gid)
        os.fchmod(draft, found.st_mode & _MODE)


def _take_name(draft: str, real: str, path: str, force: bool) -> None:
    """The draft becomes the file; without ``force`` never over one that came meanwhile."""
    try:
        if force:
            os.replace(draft, real)
        else:
            os.link(draft, real)
    except FileExistsError:
        raise KeptError(f"{path} is there already, and is left as it is") from None
    except OSError:
        if force:
            raise
        check_free(path, force)  # a file system without links
        os.replace(draft, real)
    _remember(real, _call.written)


def _remove(folder: str) -> None:
    """Remove a folder and all that is in it."""
    from shutil import rmtree

    rmtree(folder, ignore_errors=True)


def _remove_empty(folders: Iterable[str]) -> None:
    for folder in sorted(folders, key=len, reverse=True):
        with suppress(OSError):
            os.rmdir(folder)


def can_fork() -> bool:
    """Whether a process can be split in two with all that it knows."""
    return sys.platform == "linux"


@contextmanager
def started(calls: Sequence[tuple[Callable[..., Any], tuple[Any, ...]]]) -> Iterator[Callable[[], list[Any]]]:
    """Start each call in a process of its own; gives what waits for their results, in order.

    Raises RuntimeError from the waiting where a process failed.
    """
    from multiprocessing import get_context

    context = get_context("fork")
    running = []
    for function, arguments in calls:
        receiver, sender = context.Pipe(duplex=False)
        process = context.Process(target=_run, args=(function, arguments, sender), daemon=True)
        process.start()
        sender.close()  # else a process that dies would leave the receiver waiting
        running.append((process, receiver))
    try:
        yield lambda: [_received(receiver) for _, receiver in running]
    finally:
        for process, receiver in running:
            receiver.close()
            process.join(1.0)
            if process.is_alive():
                process.terminate()
                process.join()


def _run(function: Callable[..., Any], arguments: tuple[Any, ...], sender: Any) -> None:
    """In the new process: the result, or what went wrong; and what waits for its name, with its folders."""
    try:
        good, result = True, function(*arguments)
    except BaseException as error:
        good, result = False, f"{type(error).__name__}: {error}"
    try:
        sender.send((good, result, _call.waiting or {}, _call.made))
    finally:
        sender.close()


def _received(receiver: Any) -> Any:
    try:
        good, result, waiting, made = receiver.recv()
    except EOFError:
        good, result, waiting, made = False, "it ended early", {}, []
    if _call.waiting is not None:
        _call.waiting |= waiting
        _call.drafts |= {draft for draft, _, _ in waiting.values()}
        _call.made += made
    if not good:
        raise RuntimeError(f"a process failed: {result}")
    return result
