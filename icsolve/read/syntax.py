"""What the errors of YAML mean, in the words of someone who wrote the file by hand."""

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
    return (
        _of_characters(error, place, line)
        or _of_wide_signs(place[0], lines)
        or _of_another_language(error.problem or "", place[0], lines)
        or _of_lines(error, place, lines, line)
    )


WIDE = dict(zip("：，｛｝［］", ":,{}[]", strict=True))
"""Signs of Chinese and Japanese keyboards, and those of YAML."""


def _of_wide_signs(line: int, lines: list[str]) -> tuple[Mark, str] | None:
    """A sign of another keyboard in the line of the complaint, or in the one before."""
    for n in (line, line - 1):
        text = lines[n - 1].partition(" #")[0] if 0 < n <= len(lines) else ""
        found = next((k for k, sign in enumerate(text) if sign in WIDE), None)
        if found is not None:
            sign = text[found]
            return (n, found + 1), f"the wide '{sign}' is a letter to YAML; write '{WIDE[sign]}'"
    return None


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
    asked = re.search(r"[\[{,:]\s*\?(?=\s*[,\]}])", line)
    if asked or here == "?" or (here and before == "?"):
        at = (place[0], asked.end()) if asked else place
        return at, "a '?' cannot stand here; write 'unknown' for what is to find"
    if here == "," and "node content" in (error.problem or ""):
        return place, "a value is missing before this comma"
    if "found unexpected ':'" in (error.problem or "") and re.search(r":\s*,", line):
        return place, "there is no value between the colon and the comma"
    if line.startswith("```"):
        return place, "take the lines with ``` away: they belong to what the case was copied from"
    if "scanning an a" in (error.context or "") and before in ("*", "&"):
        here, place = before, (place[0], place[1] - 1)
        if not line[: place[1] - 1].strip():
            return place, f"an item of a list starts with a dash, not with '{here}'"
    if here and here in "@`%&*!|>":
        return place, f"a value cannot start with '{here}'; put the text in quotes"
    return None


def _of_lines(
    error: yaml.MarkedYAMLError, place: Mark, lines: list[str], line: str
) -> tuple[Mark, str] | None:
    """Colons, brackets, quotation marks and the beginnings of lines."""
    before, rest = line[: place[1] - 1], line[place[1] - 1 :]
    if rest[:1] == "," and not rest[1:].strip():
        return place, "take this comma away: entries that stand in lines of their own have none between"
    return (
        _of_spaces(error.problem or "", place, line)
        or _of_colons(error, place, lines, line)
        or _of_brackets(error, place, before.rstrip(), rest)
        or _of_starts(error.problem or "", place, lines, line)
    )


def _of_spaces(problem: str, place: Mark, line: str) -> tuple[Mark, str] | None:
    """Spaces that are wanted, or one that makes a dash the beginning of an item."""
    glued = re.search(r"[\w'\"]:[\[{]", line) if "found unexpected ':'" in problem else None
    if glued:
        return (place[0], glued.start() + 2), "write a space after the colon"
    if line.lstrip().startswith("-{"):
        return (place[0], line.index("-") + 1), "write a space after the dash, - {"
    if "block sequence entries" in problem and line[: place[1] - 1].strip():
        return place, "a value cannot start with '- '; put the text in quotes"
    return None


def _of_colons(
    error: yaml.MarkedYAMLError, place: Mark, lines: list[str], line: str
) -> tuple[Mark, str] | None:
    """A colon without its space, within a text, where none should be, and none where one should."""
    problem, at = error.problem or "", error.context_mark
    if not any(sign in problem for sign in _OF_A_COLON):
        return None
    cause = _unspaced_line(place[0], lines)
    if cause:
        return cause, "write a space after the colon"
    text = re.match(r"\s*(\w+): +(?=[^\s\[{\"'])(.*: .*)", line)
    if text:
        quoted = f'{text[1]}: "{text[2].strip()[:60]}"'
        return (place[0], text.start(2) + 1), f"a text with a colon in it stands in quotes, {quoted}"
    bare = re.match(r"\s*(\w+)\s*([{\[])", line)
    if bare:
        return (
            place[0],
            bare.start(2) + 1,
        ), f"write a colon and a space before this bracket, {bare[1]}: {bare[2]}"
    above = re.match(r"(\w+) +([^:#\s].*)", lines[place[0] - 2]) if place[0] > 1 else None
    if "mapping values" in problem and above and ":" not in above[0]:
        written = f"{above[1]}: {above[2].strip()[:60]}"
        return (place[0] - 1, above.end(1) + 1), f"write a colon after the key, {written}"
    item, over = (
        re.match(r"\s*- ", line),
        re.match(r"(\w+): +\S", lines[place[0] - 2] if place[0] > 1 else ""),
    )
    if "mapping values" in problem and item and over:
        said = f"this item of a list stands under '{over[1]}', which has a value: put it with its list"
        return (place[0], item.end() - 1), said
    if "mapping values" in problem and re.match(r"\s+[\w-]+:", line):
        return (place[0], len(line) - len(line.lstrip()) + 1), _ASKEW
    if "could not find expected ':'" in problem and at and ":" not in lines[at.line].partition(" #")[0]:
        said = "an entry is a key, a colon and its value, and a text of two lines stands in quotes"
        return (at.line + 1, at.column + 1), f"this line has no colon: {said}"
    return None


def _of_brackets(error: yaml.MarkedYAMLError, place: Mark, before: str, rest: str) -> tuple[Mark, str] | None:
    """Brackets and quotation marks: what stands behind them, and those that are not closed."""
    problem = error.problem or ""
    is_open = "'[' or" in problem or "or ']'" in problem or "or '}'" in problem
    if is_open or any(sign in problem for sign in _OF_A_START):
        if before.lstrip("- ").startswith("("):
            return place, "write braces or square brackets, round ones hold nothing here"
        if before.endswith(("'", '"')) and rest[:1].isalpha():
            other = "'" if before[-1] == '"' else '"'
            return place, f"the text ends at the {before[-1]} before this; put it between {other} and {other}"
        if before.endswith(("]", "}")) and re.match(r"[^\W\d]+\s*(?:[,}]|$)", rest):
            said = "a unit goes with each number, and a text that starts with a bracket stands in quotes"
            return place, f"nothing stands behind a bracket: {said}"
        if rest[:1] in ("]", "}") and not is_open:
            return place, "this bracket closes none: take it away, or open it where its entry starts"
        if rest[:1] == "," and not is_open:
            return place, "an entry of several keys in one line stands in braces, as in {pin: [1, 2], at: A}"
        if rest[:1] == "[" and before[-1:].isdigit():
            return place, "a unit stands behind its number without brackets"
        if ";" in before.rpartition(",")[2]:
            return (place[0], before.rindex(";") + 1), "write a comma between entries, not a semicolon"
    if is_open and rest[:1] == ":" and (inner := re.search(r"(\w+): +(unknown)$", before)):
        value = re.match(r":\s*(\[[^\]]*\])?", rest)
        written = f"{inner[1]}: {{{inner[2]}: {(value and value[1]) or '[0, 90]'}}}"
        return (place[0], inner.start(2) + 1), f"an unknown with its range stands in braces, {written}"
    if is_open:
        return place, f"a bracket{_opened(error)} is not closed, or a comma is missing before this"
    if "quoted scalar" in (error.context or "") and "end of stream" in problem:
        return place, f"a quotation mark{_opened(error)} is not closed"
    return None


def _of_starts(problem: str, place: Mark, lines: list[str], line: str) -> tuple[Mark, str] | None:
    """Dashes and spaces at the beginning of lines."""
    if not any(sign in problem for sign in (*_OF_A_START, *_OF_A_COLON)):
        return None
    before = lines[place[0] - 2] if place[0] > 1 else ""
    for number in range(place[0] - 1, max(place[0] - _LOOKBACK, 1), -1):
        above, item = lines[number - 2].lstrip(), lines[number - 1]
        if item.lstrip().startswith("{") and (above.startswith("- ") or line.lstrip().startswith("-")):
            return (number, item.index("{") + 1), "an item of a list starts with a dash, as in - {...}"
    first = next((n for n, text in enumerate(lines, 1) if text.strip() and text.lstrip()[0] != "#"), 0)
    if "<document start>" in problem and lines[first - 1][:1] == " ":
        return (
            first,
            1,
        ), "this first line is indented, and the others are not: take the spaces before it away"
    for number, text in ((place[0] - 1, before), (place[0], line)):
        if "\xa0" in text[: len(text) - len(text.lstrip())]:
            return (number, text.index("\xa0") + 1), "this line starts with a no-break space"
    return (place, _ASKEW) if any(sign in problem for sign in _OF_A_START) else None


_ASKEW = "this line is indented otherwise than the lines that it should stand beside"


def _of_another_language(problem: str, last: int, lines: list[str]) -> tuple[Mark, str] | None:
    """What is a comment, or gives a value, elsewhere, in the line of a problem or the one before it."""
    if not any(sign in problem for sign in (*_OF_A_COLON, *_OF_A_START)):
        return None
    for at in range(min(last, len(lines)), max(last - 2, 0), -1):
        line = lines[at - 1]
        comment = re.search(r"(?:^\s*|[\]}]\s*)(//|/\*)|^\s*(--|%)", line)
        if comment:
            sign = comment[1] or comment[2]
            return (at, comment.end() - len(sign) + 1), f"a comment starts with '#', not with '{sign}'"
        given = re.match(r"\s*(\w+)\s*=\s*(.*)", line)
        if given:
            return (at, given.start(1) + 1), f"write a colon in place of '=', {given[1]}: {given[2][:60]}"
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
