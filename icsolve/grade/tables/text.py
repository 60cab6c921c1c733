"""A CSV file of any origin as rows with their line numbers; what can't be a row is reported and passed.

Encodings: UTF-8 with or without its mark, UTF-16, else Windows-1252 byte by byte. Delimiters: comma,
semicolon, tab, bar. Nul characters are taken out; a quote that is never closed takes no other line with it.
"""

from __future__ import annotations

import codecs
import csv
import re
from collections import deque
from collections.abc import Callable, Iterator
from typing import IO

from icsolve.tuples import NamedTuple

LARGEST = 2_000_000
"""Characters of one cell or line."""
_MOST_LINES = 50
"""Lines of one record; a quote that is not closed by then was not meant as one."""
_DELIMITERS = ",;\t|"
_SAMPLE = 65536
_START = 2000
"""Characters of a line that is too long which are kept."""
TOO_LONG = f"this line is longer than {LARGEST} characters"

UNCLOSED = "a quoted cell starts here and does not end"

Report = Callable[[int, str], None]
"""Told of a line number and what is wrong there."""


class TableRow(NamedTuple):
    """The cells of a record, and the line on which it starts; ``trouble`` says what is wrong with it."""

    line: int
    cells: list[str]
    trouble: str = ""


def _as_windows(error: UnicodeError) -> tuple[str, int]:
    """A byte that is not UTF-8, as Windows reads it."""
    assert isinstance(error, UnicodeDecodeError)
    return error.object[error.start : error.end].decode("cp1252", "replace"), error.end


codecs.register_error("icsolve-windows", _as_windows)


def encoding_of(sample: bytes) -> str:
    """The encoding of a file by its first bytes."""
    if sample[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return "utf-16"
    even, odd = sample[0:2000:2], sample[1:2000:2]
    if len(sample) > 3 and odd.count(0) > 0.7 * len(odd) > even.count(0):
        return "utf-16-le"
    if len(sample) > 3 and even.count(0) > 0.7 * len(even) > odd.count(0):
        return "utf-16-be"
    return "utf-8-sig"


class AnswerTable:
    """The rows of an open file, after its header.

    ``header`` has the names of the columns, ``delimiter`` what divides them. ``report`` is told of lines that
    can't be read.
    """

    def __init__(self, file: IO[bytes], report: Report) -> None:
        import io

        sample = file.read(_SAMPLE)
        file.seek(0)
        if sample.startswith(b"PK\x03\x04"):
            from icsolve.grade.tables.xlsx import as_csv

            file = as_csv(file)
            sample = file.read(_SAMPLE)
            file.seek(0)
        if not _is_text(sample):
            raise ValueError("this is not a text file; save it as CSV")
        encoding = encoding_of(sample)
        errors = "icsolve-windows" if encoding.startswith("utf-8") else "replace"
        self._report = report
        self._lines = _Lines(io.TextIOWrapper(file, encoding, errors, newline=""), report)
        self.header: list[str] = []
        self.delimiter = self._delimiter()
        self.header = self._header()

    def _delimiter(self) -> str:
        """By Excel's own ``sep=;``, else the one that divides the first line into most cells."""
        for line in self._lines:
            if not line.strip():
                continue
            named = re.match(r"sep=([,;\t|])\s*$", line.lstrip("\ufeff"), re.IGNORECASE)
            if named:
                return named.group(1)
            self._lines.push_back(line)
            return max(_DELIMITERS, key=lambda d: len(next(csv.reader([line], delimiter=d), [])))
        raise ValueError("there is nothing in it")

    def _header(self) -> list[str]:
        for row in self.rows():
            if any(cell.strip() for cell in row.cells):
                return [" ".join(cell.replace("\ufeff", "").split()) for cell in row.cells]
        raise ValueError("there is nothing in it but empty lines")

    def rows(self) -> Iterator[TableRow]:
        """The rows that follow, each with the number of its first line; empty ones are passed over."""
        csv.field_size_limit(max(csv.field_size_limit(), LARGEST + 1))
        while not self._lines.done:
            reader = csv.reader(iter(self._lines), delimiter=self.delimiter)
            try:
                yield from self._records(reader)
            except (_RunawayError, csv.Error):
                line, text = self._lines.give_up_first()
                cells = next(csv.reader([text.replace('"', "")], delimiter=self.delimiter), [])
                yield TableRow(line, cells, UNCLOSED)

    def _records(self, reader: Iterator[list[str]]) -> Iterator[TableRow]:
        lines = self._lines
        pending = lines.pending
        for cells in reader:
            line = lines.number
            if len(pending) > 1 or lines.ended:
                if (lines.ended and _is_open(pending)) or self._swallows(pending):
                    raise _RunawayError
                line -= len(pending) - 1
            pending.clear()
            if cells:
                yield TableRow(line, cells, TOO_LONG if lines.cut and line in lines.cut else "")

    def _swallows(self, lines: list[str]) -> bool:
        """Whether a record of several lines has taken in rows: a quote in it stands where none may, or a
        line of it is a whole row by itself."""
        if len(lines) < 2:
            return False
        try:
            deque(csv.reader(lines, delimiter=self.delimiter, strict=True), 0)
        except csv.Error:
            return True
        width = len(self.header) if self.header else 0
        alone = (next(csv.reader([line], delimiter=self.delimiter), []) for line in lines[1:])
        return width > 2 and any(len(cells) == width for cells in alone)


def _is_text(sample: bytes) -> bool:
    """Not an archive, a picture or a spreadsheet's own format."""
    return not sample.startswith((b"\xd0\xcf\x11\xe0", b"%PDF", b"\x89PNG", b"\x1f\x8b"))


def _is_open(lines: list[str]) -> bool:
    """Whether a quote is open at the end of a record's lines."""
    return sum(line.count('"') for line in lines) % 2 == 1


class _RunawayError(Exception):
    """A record that goes on for too many lines."""


class _Lines:
    """Lines of a file for the csv reader: ``pending`` holds those of the record being read."""

    def __init__(self, file: IO[str], report: Report) -> None:
        self._file = file
        self._again: list[str] = []
        self._report = report
        self.pending: list[str] = []
        self.number = 0
        self.ended = False
        self.cut: set[int] = set()
        """lines of which only the start is kept"""

    @property
    def done(self) -> bool:
        """Whether all lines have been read."""
        return self.ended and not self._again

    def __iter__(self) -> Iterator[str]:
        pending, again, readline = self.pending, self._again, self._file.readline
        while True:
            if len(pending) >= _MOST_LINES:
                raise _RunawayError
            line = again.pop() if again else readline(LARGEST)
            if not line:
                self.ended = True
                return
            self.number += 1
            if "\0" in line or len(line) == LARGEST:
                line = self._mended(line)
            pending.append(line)
            yield line

    def _mended(self, line: str) -> str:
        """Without nul characters; of an overlong line the start, which may say whose it is."""
        if len(line) == LARGEST and line[-1] not in "\r\n":
            self._skip_rest()
            self.cut.add(self.number)
            line = line[:_START].replace('"', "") + "\n"
        if "\0" in line:
            self._report(self.number, "nul characters are taken out of this line")
        return line.replace("\0", "")

    def _skip_rest(self) -> None:
        """Pass over what is left of a line that is too long."""
        while True:
            more = self._file.readline(LARGEST)
            if not more or more[-1] in "\r\n":
                return

    def push_back(self, line: str) -> None:
        """Read this line once more."""
        self._again.append(line)
        self.number -= 1
        self.pending.clear()

    def give_up_first(self) -> tuple[int, str]:
        """The first line of the record, with its number; the others are read again."""
        first, text = self.number - len(self.pending) + 1, self.pending[0]
        self._again.extend(reversed(self.pending[1:]))
        self.number = first
        self.pending.clear()
        return first, text
