"""A case as a question in words, and as one of Moodle: XML (numerical, units, wrong answers) and GIFT."""

from __future__ import annotations

import base64
import math
from collections import Counter
from collections.abc import Iterable, Iterator
from html import escape
from typing import NamedTuple

from icsolve.case import Case, LoadIs, PositionIs, Target
from icsolve.grade.keys import AnyKey, Key, PlaceKey, RangeKey
from icsolve.grade.mistakes import Wrong, message
from icsolve.grade.mistakes.codes import ORDER
from icsolve.grade.written import factors_between
from icsolve.units import parse_unit


def figure(case: Case) -> str:
    """The case drawn without its answer, as SVG."""
    from icsolve.derivation import known_of
    from icsolve.draw import Drawing, draw

    return draw(case, Drawing(centres="none"), known_of(case)._replace(answer=None))


def asked(key: AnyKey, target: Target) -> str:
    """The question's sentence: what to find, in which unit, with which sign."""
    what = key.question.partition(":")[2]
    name = target.load if isinstance(target, LoadIs) else what
    unit = f" in {key.unit_name}" if key.unit_name else ""
    if isinstance(key, PlaceKey):
        return f"Where is the centre {name}? Give x and y{unit}."
    if isinstance(target, PositionIs):
        section, _, datum = target.path.partition(".")
        told = {"angles": "the angle", "lengths": "the length", "points": "the coordinate"}[section]
        ccw = ", counterclockwise positive" if section == "angles" else ""
        return f"In which position is the mechanism in equilibrium? Find {told} {datum}{unit}{ccw}."
    if isinstance(key, RangeKey):
        return f"Over which range of {name}{unit} does the mechanism hold still? Give both ends."
    assert isinstance(key, Key)
    sign = ""
    if key.expected.turn:
        sign = f" ({'counterclockwise' if key.expected.turn > 0 else 'clockwise'} positive)"
    elif key.expected.asked:
        sign = ", and its direction in degrees counterclockwise from +x"
    elif key.expected.heading is not None:
        sign = f" (positive at {key.expected.heading % 360.0:.6g} deg from +x)"
    return f"Find {name}{unit}{sign}."


_FRACTIONS = [
    float(share)
    for share in (
        "100 90 83.33333 80 75 70 66.66667 60 50 40 33.33333 30 25 20 16.66667 14.28571 12.5 11.11111 10 5 0"
    ).split()
]
"""The shares of a mark that Moodle knows."""
_MOST_OF_ONE = 4
"""Wrong answers of one code in a question."""
_UNITS = {
    "force": "N kN lbf kip kgf",
    "torque": "N*m N*mm kN*m lbf*ft lbf*in",
    "length": "m mm cm in ft",
    "angular": "rad/s rpm deg/s",
    "speed": "m/s mm/s in/s ft/s",
}


class Question(NamedTuple):
    """One question: its name, what is given and asked, the key, and a picture (SVG text) if there is one."""

    name: str
    given: tuple[tuple[str, str], ...]
    asked: str
    key: Key
    picture: str = ""
    title: str = ""


def moodle_xml(questions: Iterable[Question], category: str) -> str:
    """A quiz file of numerical questions, in a category of their own."""
    head = f"$course$/{category}"
    body = "\n".join(_xml_question(question) for question in questions)
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n<quiz>\n'
        f'<question type="category"><category><text>{_text(head)}</text></category></question>\n'
        f"{body}\n</quiz>\n"
    )


def _xml_question(question: Question) -> str:
    key = question.key
    otherwise = f"Not right. Accepted is an answer {key.rule}."
    parts = [
        '<question type="numerical">',
        f"<name><text>{_text(question.name)}</text></name>",
        _statement(question),
        '<generalfeedback format="html"><text/></generalfeedback>',
        f"<defaultgrade>{key.policy.points:.10g}</defaultgrade><penalty>0.3333333</penalty>",
        "<hidden>0</hidden>",
        *(_answer(100.0, right, _half(key), f"Right: {key.accepted} is accepted.") for right in rights(key)),
        *(
            _answer(share, w.value, reach, message(w.code, w.where, key.kind))
            for w, share, reach in wrong_rows(key)
        ),
        '<answer fraction="0" format="moodle_auto_format"><text>*</text>'
        f'<feedback format="html"><text>{_text(otherwise)}</text></feedback>'
        "<tolerance>0</tolerance></answer>",
        _units(key),
        "</question>",
    ]
    return "\n".join(parts)


def table_of(question: Question, image: str) -> str:
    """The statement in HTML: title, figure, what is given, what is asked."""
    rows = "".join(
        f"<tr><td>{_text(name)}</td><td>{_text(value)}</td></tr>" for name, value in question.given
    )
    title = f"<p>{_text(question.title)}</p>" if question.title else ""
    return f"{title}{image}<table>{rows}</table><p>{_text(question.asked)}</p>"


def _statement(question: Question) -> str:
    """The text with its table of values, and the picture in the file itself."""
    image = '<p><img src="@@PLUGINFILE@@/figure.svg" alt="figure"/></p>' if question.picture else ""
    html = table_of(question, image).replace("]]>", "]]&gt;")
    file = ""
    if question.picture:
        data = base64.b64encode(question.picture.encode("utf-8")).decode("ascii")
        file = f'<file name="figure.svg" path="/" encoding="base64">{data}</file>'
    return f'<questiontext format="html"><text><![CDATA[{html}]]></text>{file}</questiontext>'


def _answer(fraction: float, value: float, tolerance: float, feedback: str) -> str:
    return (
        f'<answer fraction="{fraction:.7g}" format="moodle_auto_format"><text>{number(value)}</text>'
        f'<feedback format="html"><text>{_text(feedback)}</text></feedback>'
        f"<tolerance>{number(tolerance)}</tolerance></answer>"
    )


def wrong_rows(key: Key) -> Iterator[tuple[Wrong, float, float]]:
    """Known wrong answers, simplest first, with their shares in percent and absolute tolerances.

    Moodle takes the first row that matches, so the right answer stands before them.
    """
    known = dict(key.policy.mistakes)
    ordered = sorted(key.wrongs.all, key=lambda w: (ORDER[w.code], _decades(w.value, key.value), w.value))
    seen: list[float] = []
    counts: Counter[str] = Counter()
    for wrong in ordered:
        reach = key.wrongs.reach * abs(wrong.value)
        if counts[wrong.code] < _MOST_OF_ONE and all(abs(wrong.value - other) > reach for other in seen):
            seen.append(wrong.value)
            counts[wrong.code] += 1
            share = 100.0 * known.get(wrong.code, 0.0)
            yield wrong, min(_FRACTIONS, key=lambda f: abs(f - share)), reach


def _decades(wrong: float, right: float) -> float:
    """How far two values are apart, in powers of ten; whole powers of a thousand are the likeliest."""
    powers = abs(math.log10(abs(wrong)) - math.log10(abs(right))) if wrong and right else 99.0
    return 0.5 if abs(powers - 3.0) < 1e-9 else powers


def _units(key: Key) -> str:
    """Units with how many of each make one of the question's own; how a missing one counts."""
    if not key.unit_name:
        return (
            "<unitgradingtype>0</unitgradingtype><unitpenalty>0.1</unitpenalty>"
            "<showunits>3</showunits><unitsleft>0</unitsleft>"
        )
    rows = "".join(
        f"<unit><multiplier>{number(multiplier)}</multiplier><unit_name>{_text(name)}</unit_name></unit>"
        for name, multiplier in unit_rows(key)
    )
    graded = "1" if key.policy.unit == "required" else "0"
    return (
        f"<units>{rows}</units><unitgradingtype>{graded}</unitgradingtype><unitpenalty>0.1</unitpenalty>"
        "<showunits>0</showunits><unitsleft>0</unitsleft>"
    )


def unit_rows(key: Key) -> Iterator[tuple[str, float]]:
    """The question's own unit first, then others of its kind, each with the number that makes one of it."""
    yield key.unit_name, 1.0
    for names in _UNITS.values():
        for name in names.split():
            factor = factors_between(key.unit, parse_unit(name))
            if factor is not None and name != key.unit_name:
                yield name, factor


def gift(questions: Iterable[Question], category: str) -> str:
    """The questions in GIFT; without units, which it does not know."""
    return f"$CATEGORY: $course$/{_gift(category)}\n\n" + "\n\n".join(map(_gift_question, questions)) + "\n"


def _gift_question(question: Question) -> str:
    key = question.key
    values = "; ".join(f"{name} = {value}" for name, value in question.given)
    text = _gift(f"{_sentence(question.title)}Given: {values}. {question.asked}")
    told = _gift(f"Right: {key.accepted} is accepted.")
    rows = [f"=%100%{number(right)}:{number(key.half)}#{told}" for right in rights(key)]
    for wrong, share, reach in wrong_rows(key):
        said = _gift(message(wrong.code, wrong.where, key.kind))
        rows.append(f"=%{share:.7g}%{number(wrong.value)}:{number(reach)}#{said}")
    body = "\n".join(rows)
    return (
        f"::{_gift(question.name)}::{text} {{#\n{body}\n####{_gift(f'Accepted is an answer {key.rule}.')}\n}}"
    )


def _sentence(title: str) -> str:
    """A title before other sentences."""
    return f"{title.rstrip('. ')}. " if title else ""


def _gift(text: str) -> str:
    """Text with GIFT's own characters escaped, on one line."""
    plain = " ".join(text.split())
    return "".join(f"\\{c}" if c in "\\~=#{}:" else c for c in plain)


def number(value: float) -> str:
    """A number with twelve digits at most."""
    return f"{value:.12g}"


def rights(key: Key) -> list[float]:
    """The right answer, and what a whole turn makes of it."""
    value = float(sensible(key))
    turned = (value - math.copysign(key.period, value),) if key.period else ()
    return [value, *turned]


def _half(key: Key) -> float:
    """Half the accepted band, as large a part of the answer as it is shown as of the answer itself."""
    return key.half * abs(float(sensible(key)) / key.value) if key.value else key.half


def sensible(key: Key) -> str:
    """The right answer with six digits, and more where its tolerance asks for them."""
    ratio = key.half / abs(key.value) if key.value else 1.0
    digits = 6 if ratio >= 1e-3 else min(17, 4 - math.floor(math.log10(ratio))) if ratio > 0.0 else 17
    return f"{key.value:.{digits}g}"


def _text(text: str) -> str:
    return escape("".join(c if c >= " " else " " for c in text), quote=False)
