"""A file's bytes to text: encodings, limits, and characters that no case holds."""

from __future__ import annotations

import os
import re

from icsolve.case import Mark
from icsolve.files import reading
from icsolve.read.problems import Problems, suggestion

LARGEST = 4_000_000
"""Bytes or characters of a case; the largest mechanism in print needs a thousandth of it."""

_FOREIGN = "[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]"
"""Characters that YAML does not allow; compiled only where a text is not plainly printable."""
_SPACING = dict.fromkeys(map(ord, "\n\r\t"))


def text_of(path: str | os.PathLike[str], problems: Problems) -> str:
    """The text of a file.

    Raises
    ------
    Stop
        No such file, a folder, a binary, too large, or not UTF-8 (UTF-16 with its mark is read too).
    """
    try:
        with reading(path) as file:
            data = file.read(LARGEST + 1)
    except (OSError, ValueError) as error:
        raise problems.stop((1, 1), _unreadable(error) + _likely_file(path, error)) from None
    if len(data) > LARGEST:
        raise problems.stop((1, 1), f"the file is larger than {LARGEST // 10**6} MB, too large for a case")
    return _decoded(data, problems)


def _unreadable(error: OSError | ValueError) -> str:
    if isinstance(error, FileNotFoundError):
        return "there is no such file"
    if isinstance(error, IsADirectoryError):
        return "this is a folder, not a file"
    if isinstance(error, PermissionError):
        return "this file may not be read (permission denied)"
    return f"this file cannot be read: {getattr(error, 'strerror', None) or error}"


def _likely_file(path: str | os.PathLike[str], error: OSError | ValueError) -> str:
    """``; did you mean press.yaml?``: the file with its ending, or one of nearly that name beside it."""
    if not isinstance(error, FileNotFoundError):
        return ""
    folder, name = os.path.split(os.fspath(path))
    try:
        there = sorted(one for one in os.listdir(folder or ".") if one.endswith((".yaml", ".yml")))
    except OSError:
        return ""
    ended = [one for one in there if os.path.splitext(one)[0] == name]
    return suggestion(ended[0] if ended else name, there)


def _decoded(data: bytes, problems: Problems) -> str:
    encoding = "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig"
    if encoding != "utf-16" and b"\0" in data:
        raise problems.stop((1, 1), "this is a binary file, not the text of a case")
    try:
        return data.decode(encoding)
    except UnicodeDecodeError as error:
        before = data[: error.start].decode(encoding, "replace")
        raise problems.stop(_place(before, len(before)), _not_utf8(data[error.start])) from None


def _not_utf8(byte: int) -> str:
    return f"the byte 0x{byte:02X} is not UTF-8 text; save the file in the encoding UTF-8"


def _foreign(code: int) -> str:
    """What a character is that YAML does not allow; a stream's undecoded bytes are U+DC80 to U+DCFF."""
    if 0xDC80 <= code <= 0xDCFF:
        return _not_utf8(code - 0xDC00)
    return f"the character U+{code:04X} has no place in a text; delete it"


def checked(text: str, problems: Problems) -> str:
    """The text without its byte order mark.

    Raises
    ------
    Stop
        It is too long, or holds a control character or half a surrogate pair.
    """
    text = text.removeprefix("\ufeff")
    if len(text) > LARGEST:
        raise problems.stop((1, 1), f"the text is longer than {LARGEST} characters, too long for a case")
    if text.translate(_SPACING).isprintable():
        return text
    found = re.search(_FOREIGN, text)
    if found:
        mark = _place(text, found.start())
        raise problems.stop(mark, _foreign(ord(found.group())))
    return text


def _place(text: str, index: int) -> Mark:
    start = text.rfind("\n", 0, index) + 1
    return text.count("\n", 0, index) + 1, index - start + 1
