"""What YAML's own errors mean, in the words of someone who wrote the file by hand."""

from __future__ import annotations

import re

import yaml

from icsolve.case import Mark

_OF_A_COLON = ("mapping values are not allowed", "could not find expected ':'", "expected <document start>")
_OF_A_START = ("expected key", "expected <block end>", "expected '-' indicator")
_LOOKBACK = 5
"""Lines before YAML's complaint among which its cause is sought."""


def explained(error: yaml.MarkedYAMLError, text: str) -> tuple[Mark, str]:
    """Place and wording of a syntax error."""
    mark = error.problem_mark or error.context_mark
    place = (mark.line + 1, mark.column + 1) if mark else (1, 1)
    lines = text.splitlines()
    line = lines[place[0] - 1] if place[0] <= len(lines) else ""
    return _known(error, place, lines, line) or (place, f"this is not YAML: {_plain(error)}")


def _known(error: yaml.MarkedYAMLError, place: Mark, lines: list[str], line: str) -> tuple[Mark, str] | None:
    """Causes that are met often."""
    return _of_characters(error, place, line) or _of_lines(error, place, lines, line)


def _of_characters(error: yaml.MarkedYAMLError, place: Mark, line: str) -> tuple[Mark, str] | None:
    """A character that YAML takes otherwise than it was meant."""
    here, before = line[place[1] - 1 : place[1]], line[max(place[1] - 2, 0) : place[1] - 1]
    if "\t" in line[: len(line) - len(line.lstrip())] or here == "\t":
        column = line.index("\t") + 1
        return (place[0], column), "a tab stands here; YAML is indented with spaces only"
    curly = [line.index(sign) + 1 for sign in "\u201c\u201d" if sign in line]
    if curly:
        said = 'these quotation marks are letters to YAML; write straight ones (")'
        return (place[0], min(curly)), said
    if here == "?" or (here and before == "?"):
        return place, "a '?' cannot stand here; write 'unknown' for what is to find"
    if "found unexpected ':'" in (error.problem or "") and re.search(r":\s*,", line):
        return place, "there is no value between the colon and the comma"
    if here and here in "@`%&*!|>":
        return place, f"a value cannot start with '{here}'; put the text in quotes"
    return None


def _of_lines(
    error: yaml.MarkedYAMLError, place: Mark, lines: list[str], line: str
) -> tuple[Mark, str] | None:
    """Colons, brackets, quotation marks and the beginnings of lines."""
    problem = error.problem or ""
    if any(sign in problem for sign in _OF_A_COLON):
        cause = _unspaced_line(place[0], lines)
        if cause:
            return cause, "write a space after the colon"
        text = re.match(r"\s*(\w+): +(?=[^\s\[{\"'])(.*: .*)", line)
        if text:
            quoted = f'{text[1]}: "{text[2].strip()[:60]}"'
            return (place[0], text.start(2) + 1), f"a text with a colon in it stands in quotes, {quoted}"
    if "'[' or" in problem or "or ']'" in problem or "or '}'" in problem:
        return place, f"a bracket{_opened(error)} is not closed, or a comma is missing before this"
    if "quoted scalar" in (error.context or "") and "end of stream" in problem:
        return place, f"a quotation mark{_opened(error)} is not closed"
    if any(sign in problem for sign in (*_OF_A_START, *_OF_A_COLON)):
        before = lines[place[0] - 2] if place[0] > 1 else ""
        if before.lstrip().startswith("{") and line.lstrip().startswith("-"):
            return (
                place[0] - 1,
                before.index("{") + 1,
            ), "an item of a list starts with a dash, as in - {...}"
    if any(sign in problem for sign in _OF_A_START):
        return place, "this line is indented otherwise than the lines that it should stand beside"
    return None


def _opened(error: yaml.MarkedYAMLError) -> str:
    mark = error.context_mark
    return f" (opened in line {mark.line + 1}, column {mark.column + 1})" if mark else ""


def _unspaced_line(number: int, lines: list[str]) -> Mark | None:
    """The nearest line, from line ``number`` up, whose colon has no space after it."""
    for at in range(min(number, len(lines)), max(number - _LOOKBACK, 0), -1):
        line = lines[at - 1]
        key = line.strip().removeprefix("- ").split(" ")[0]
        if missing_space(key):
            return at, line.index(":") + 1
    return None


def missing_space(key: str) -> bool:
    """Whether a key looks like ``x:1``: a colon with something right after it."""
    before, colon, after = key.partition(":")
    return bool(colon and after and before) and not after.startswith("//")


def _plain(error: yaml.MarkedYAMLError) -> str:
    parts = [part for part in (error.context, error.problem) if part]
    return ", ".join(parts) or "it cannot be parsed"
