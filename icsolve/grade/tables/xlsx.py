"""The first sheet of an ``.xlsx`` workbook as CSV: a table in a zip of XML (ECMA-376, part 1)."""

from __future__ import annotations

import csv
import io
import re
import zipfile
from collections.abc import Iterator
from datetime import datetime, timedelta
from typing import IO
from xml.etree import ElementTree

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
    try:
        with zipfile.ZipFile(file) as archive:
            names = set(archive.namelist())
            if "xl/workbook.xml" not in names:
                raise ValueError("this is not a text file; save it as CSV")
            texts = _shared(archive) if "xl/sharedStrings.xml" in names else []
            dates = _date_styles(archive) if "xl/styles.xml" in names else set()
            sheet, epoch = _first_sheet(archive, names)
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


def _first_sheet(archive: zipfile.ZipFile, names: set[str]) -> tuple[str, datetime]:
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
