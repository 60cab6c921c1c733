"""A CSV file of any origin, or the first sheet of an ``.xlsx`` workbook, as rows with their line numbers;
what can't be a row is reported and passed.

Encodings: UTF-8 with or without its mark, UTF-16, else Windows-1252 byte by byte. Delimiters: comma,
semicolon, tab, bar. Nul characters are taken out; a quote that is never closed takes no other line with it.
"""

from __future__ import annotations

import codecs
import csv
import io
import re
from collections import deque
from collections.abc import Callable, Iterator
from datetime import datetime, timedelta
from typing import IO, TYPE_CHECKING

from icsolve.grade.written.numerals import without_unseen
from icsolve.tuples import NamedTuple

if TYPE_CHECKING:
    import zipfile
    from xml.etree import ElementTree

LARGEST = 2_000_000
"""Characters of one cell or line."""
_MOST_LINES = 50
"""Lines of one record; a quote that is not closed by then was not meant as one."""
_DELIMITERS = ",;\t|"
_SAMPLE = 65536
_START = 2000
"""Characters of a line that is too long which are kept."""
_NO_TEXT = (b"\xd0\xcf\x11\xe0", b"%PDF", b"\x89PNG", b"\x1f\x8b")
"""How an archive, a picture or a spreadsheet's own format begins."""
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
        sample = file.read(_SAMPLE)
        file.seek(0)
        if sample.startswith(b"PK\x03\x04"):
            file = as_csv(file)
            sample = file.read(_SAMPLE)
            file.seek(0)
        if sample.startswith(_NO_TEXT):
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
            return [" ".join(without_unseen(cell).split()) for cell in row.cells]
        raise ValueError("there is nothing in it but empty lines")

    def rows(self) -> Iterator[TableRow]:
        """The rows that follow, each with the number of its first line; those in which nothing stands, which
        spreadsheets have below a table, are passed over."""
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
                is_open = sum(line.count('"') for line in pending) % 2 == 1
                if (lines.ended and is_open) or self._swallows(pending):
                    raise _RunawayError
                line -= len(pending) - 1
            pending.clear()
            if any(map(str.strip, cells)):
                yield TableRow(line, cells, TOO_LONG if lines.cut and line in lines.cut else "")

    def _swallows(self, lines: list[str]) -> bool:
        """Whether a record of several lines has taken in rows: a quote in it stands where none may, or a
        line of it is a whole row by itself. Of a record whose first cell ends in its last line that line is
        one anyway."""
        if len(lines) < 2:
            return False
        try:
            deque(csv.reader(lines, delimiter=self.delimiter, strict=True), 0)
        except csv.Error:
            return True
        width = len(self.header) if self.header else 0
        first, *alone = (next(csv.reader([line], delimiter=self.delimiter), []) for line in lines)
        if len(first) == 1 and lines[0].count(self.delimiter) < width - 1:
            alone.pop()
        return width > 2 and any(len(cells) == width for cells in alone)


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
            more = line
            while more and more[-1] not in "\r\n":
                more = self._file.readline(LARGEST)
            self.cut.add(self.number)
            line = line[:_START].replace('"', "") + "\n"
        if "\0" in line:
            self._report(self.number, "nul characters are taken out of this line")
        return line.replace("\0", "")

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


_LARGEST = 200_000_000
"""Bytes of a part, unpacked."""
_MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
_RELATION = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}id"
_EPOCH = datetime(1899, 12, 30)
_EPOCH_1904 = datetime(1904, 1, 1)
_MOST_ROWS, _MOST_COLUMNS = 1_048_576, 16_384
_MOST_CELLS = 20_000_000
"""Cells with the empty ones among them; a cell far out would fill memory."""


def as_csv(file: IO[bytes]) -> IO[bytes]:
    """The first sheet as a CSV file in UTF-8, each cell as its column shows it: dates in ISO, whole numbers
    without an exponent.

    Raises ValueError, with a sentence, where it is no such workbook.
    """
    import zipfile
    from xml.etree import ElementTree

    try:
        with zipfile.ZipFile(file) as archive:
            names = set(archive.namelist())
            if "xl/workbook.xml" not in names:
                raise ValueError("this is not a text file; save it as CSV")
            texts = _shared(archive) if "xl/sharedStrings.xml" in names else []
            dates = _date_styles(archive) if "xl/styles.xml" in names else set()
            sheet, epoch = _first_sheet(archive)
            out = io.StringIO()
            table = csv.writer(out, lineterminator="\n")
            for cells in _rows(_part(archive, sheet), texts, dates, epoch):
                table.writerow(cells)
    except zipfile.BadZipFile:
        raise ValueError("this is not a text file; save it as CSV") from None
    except (ElementTree.ParseError, KeyError, IndexError, OverflowError) as error:
        raise ValueError(f"this workbook can't be read ({error}); save it as CSV") from None
    return io.BytesIO(out.getvalue().encode("utf-8"))


def _part(archive: zipfile.ZipFile, name: str) -> ElementTree.Element:
    if archive.getinfo(name).file_size > _LARGEST:
        raise ValueError("this workbook is too large; save its sheet as CSV")
    from xml.etree import ElementTree

    return ElementTree.fromstring(archive.read(name))


def _shared(archive: zipfile.ZipFile) -> list[str]:
    """The texts that cells refer to by number; ruby for pronunciation is no part of them."""
    root = _part(archive, "xl/sharedStrings.xml")
    return [_text_of(item) for item in root.iter(f"{_MAIN}si")]


def _text_of(item: ElementTree.Element) -> str:
    runs = [item.find(f"{_MAIN}t"), *(run.find(f"{_MAIN}t") for run in item.findall(f"{_MAIN}r"))]
    return "".join(run.text or "" for run in runs if run is not None)


def _date_styles(archive: zipfile.ZipFile) -> set[str]:
    """The styles of cells that show a number as a date."""
    root = _part(archive, "xl/styles.xml")
    own = {
        form.get("numFmtId", "")
        for form in root.iter(f"{_MAIN}numFmt")
        if re.search(
            r"[yd]|h+[:.]m", re.sub(r'"[^"]*"|\[[^\]]*\]|\\.', "", form.get("formatCode", "").lower())
        )
    }
    known = own | {str(n) for n in (*range(14, 23), *range(45, 48))}
    formats = root.find(f"{_MAIN}cellXfs")
    styles = enumerate(formats if formats is not None else [])
    return {str(n) for n, style in styles if style.get("numFmtId") in known}


def _first_sheet(archive: zipfile.ZipFile) -> tuple[str, datetime]:
    """The part of the first sheet, and the day from which dates are counted."""
    root = _part(archive, "xl/workbook.xml")
    properties = root.find(f"{_MAIN}workbookPr")
    old = properties is not None and properties.get("date1904") in ("1", "true")
    sheet = next(root.iter(f"{_MAIN}sheet"))
    wanted = sheet.get(_RELATION)
    for relation in _part(archive, "xl/_rels/workbook.xml.rels"):
        if relation.get("Id") == wanted:
            target = relation.get("Target", "")
            path = target.lstrip("/") if target.startswith("/") else f"xl/{target}"
            return path, _EPOCH_1904 if old else _EPOCH
    return "xl/worksheets/sheet1.xml", _EPOCH


def _rows(
    sheet: ElementTree.Element, texts: list[str], dates: set[str], epoch: datetime
) -> Iterator[list[str]]:
    """The rows with their empty cells; empty rows between them too, so that lines are numbered as shown."""
    last, width, count = 0, 0, 0
    for row in sheet.iter(f"{_MAIN}row"):
        number = int(row.get("r", last + 1))
        cells: dict[int, str] = {}
        for cell in row.iter(f"{_MAIN}c"):
            column = _column(cell.get("r", ""), max(cells, default=-1) + 1)
            cells[column] = _shown(cell, texts, dates, epoch)
        width = max(width, max(cells, default=-1) + 1)
        count += width + max(number - last - 1, 0)
        if number > _MOST_ROWS or width > _MOST_COLUMNS or count > _MOST_CELLS:
            raise ValueError("this workbook has too many cells; save its sheet as CSV")
        yield from ([] for _ in range(number - last - 1))
        yield [cells.get(column, "") for column in range(width)]
        last = number


def _column(reference: str, otherwise: int) -> int:
    """``B`` of ``B7`` is 1."""
    letters = re.match(r"[A-Z]{1,3}", reference)
    if letters is None:
        return otherwise
    value = 0
    for letter in letters.group():
        value = 26 * value + ord(letter) - 64
    return value - 1


def _shown(cell: ElementTree.Element, texts: list[str], dates: set[str], epoch: datetime) -> str:
    """A cell as text."""
    kind = cell.get("t", "n")
    if kind == "inlineStr":
        inside = cell.find(f"{_MAIN}is")
        return _text_of(inside) if inside is not None else ""
    found = cell.find(f"{_MAIN}v")
    value = (found.text or "") if found is not None else ""
    if kind == "s":
        return texts[int(value)] if value else ""
    if kind == "b":
        return {"1": "TRUE", "0": "FALSE"}.get(value, value)
    return _number(value, cell.get("s", "") in dates, epoch) if kind == "n" and value else value


def _number(text: str, is_date: bool, epoch: datetime) -> str:
    try:
        value = float(text)
    except ValueError:
        return text
    if is_date and 0.0 <= value < 3e6:
        moment = epoch + timedelta(seconds=round(value * 86400.0))
        return moment.isoformat(sep=" ")
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)
