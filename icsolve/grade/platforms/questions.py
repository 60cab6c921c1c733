"""A case as a question in words, and as one of Moodle (XML, GIFT) and of Canvas (QTI 1.2): figures, bands,
units, wrong answers with feedback.

Canvas takes every range and every alternative for a right answer (`numeric_interaction.rb` of its importer),
and passes over a bare equality: known wrong answers stand so, with their feedback, for readers that compare,
and what they are told stands, without the values, in what Canvas tells of any wrong answer. The variants of a
case are a group of which each student gets one.
"""

from __future__ import annotations

import base64
import hashlib
import io
import math
import zipfile
from collections import Counter
from collections.abc import Iterable, Iterator

from icsolve.case import Case
from icsolve.case.expected import LoadIs, PositionIs, ReactionIs, SpeedIs, Target
from icsolve.grade.judge import judge, share_of
from icsolve.grade.keys import AnyKey, ChoiceKey, NumberKey, PlaceKey, RangeKey, numbers_of
from icsolve.grade.mistakes.lookup import ORDER, Wrong, message
from icsolve.grade.written.answer import WrittenAnswer
from icsolve.grade.written.words import factors_between, unit_word
from icsolve.numbers.units import parse_unit
from icsolve.tuples import NamedTuple
from icsolve.wording import direction_words, escaped


def figure(case: Case) -> str:
    """The case drawn as an exercise, as SVG."""
    from icsolve.draw.figure import ASKED, draw
    from icsolve.report.derivation.known import known_of

    return draw(case, ASKED._replace(captions=True), known_of(case, centres=False).as_asked)


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
        if isinstance(key.keys[0] if isinstance(key, ChoiceKey) else key, RangeKey):
            datum = f"{told} {datum}{unit}{ccw},"
            return f"Over which range of {datum} does the mechanism hold still? Give both ends."
        return f"In which position is the mechanism in equilibrium? Find {told} {datum}{unit}{ccw}."
    if isinstance(key, RangeKey):
        return f"Over which range of {name}{unit} does the mechanism hold still? Give both ends."
    assert isinstance(key, NumberKey)
    sign = ""
    if key.expected.turn:
        sign = f" ({'counterclockwise' if key.expected.turn > 0 else 'clockwise'} positive)"
    elif key.expected.asked:
        sign = ", and its direction in degrees counterclockwise from +x"
    elif isinstance(target, SpeedIs) or (isinstance(target, ReactionIs) and not target.part):
        name = f"the size of {name}"
    elif key.expected.given:
        sign = f" (positive {key.expected.given})"
    elif key.expected.heading is not None:
        sign = f" (positive at {direction_words(key.expected.heading)} from +x)"
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
    "angle": "deg rad",
    "mass": "kg g t lbm slug",
    "stiffness or line load": "N/m N/mm kN/m lbf/in lbf/ft",
    "torsional stiffness": "N*m/rad N*mm/rad lbf*in/rad lbf*ft/rad",
    "pressure": "MPa kPa Pa bar psi N/mm^2",
}


class Question(NamedTuple):
    """One question: its name, what is given and asked, the key, what is accepted in words, and a picture (SVG
    text) if there is one.

    ``others`` are the keys of further right answers: other positions of equilibrium.
    """

    name: str
    given: tuple[tuple[str, str], ...]
    asked: str
    key: NumberKey
    accepted: str
    picture: str = ""
    title: str = ""
    others: tuple[NumberKey, ...] = ()


def moodle_xml(questions: Iterable[Question], category: str) -> str:
    """A quiz file of numerical questions, in a category of their own."""
    head = f"$course$/{category}"
    body = "\n".join(_xml_question(question) for question in questions)
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n<quiz>\n'
        f'<question type="category"><category><text>{escaped(head)}</text></category></question>\n'
        f"{body}\n</quiz>\n"
    )


def _xml_question(question: Question) -> str:
    key = question.key
    otherwise = f"Not right. Accepted is an answer {key.rule}."
    parts = [
        '<question type="numerical">',
        f"<name><text>{escaped(question.name)}</text></name>",
        _statement(question),
        '<generalfeedback format="html"><text/></generalfeedback>',
        f"<defaultgrade>{key.policy.points:.10g}</defaultgrade><penalty>0.3333333</penalty>",
        "<hidden>0</hidden>",
        *(
            _answer(100.0, right, _half(own), f"Right: {question.accepted} is accepted.")
            for own, right in rights(question)
        ),
        *(
            _answer(share, w.value, reach, message(w.code, w.where, key.kind))
            for w, share, reach in wrong_rows(question)
        ),
        '<answer fraction="0" format="moodle_auto_format"><text>*</text>'
        f'<feedback format="html"><text>{escaped(otherwise)}</text></feedback>'
        "<tolerance>0</tolerance></answer>",
        _units(key),
        "</question>",
    ]
    return "\n".join(parts)


def table_of(question: Question, image: str) -> str:
    """The statement in HTML: title, figure, what is given, what is asked."""
    rows = "".join(
        f"<tr><td>{escaped(name)}</td><td>{escaped(value)}</td></tr>" for name, value in question.given
    )
    title = f"<p>{escaped(question.title)}</p>" if question.title else ""
    return f"{title}{image}<table>{rows}</table><p>{escaped(question.asked)}</p>"


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
        f'<feedback format="html"><text>{escaped(feedback)}</text></feedback>'
        f"<tolerance>{number(tolerance)}</tolerance></answer>"
    )


def wrong_rows(question: Question) -> Iterator[tuple[Wrong, float, float]]:
    """Known wrong answers, simplest first, with the shares that `grade` gives them in percent and absolute
    tolerances; none that another reading makes right.

    Moodle takes the first row that matches, so the right answer stands before them.
    """
    key, right = question.key, list(rights(question))
    unit = unit_word(key.unit_name)
    ordered = sorted(key.wrongs.all, key=lambda w: (ORDER[w.code], _decades(w.value, key.value), w.value))
    seen: list[float] = []
    counts: Counter[str] = Counter()
    for wrong in ordered:
        reach = key.wrongs.reach * abs(wrong.value)
        if any(abs(wrong.value - value) <= _half(own) for own, value in right):
            continue
        if counts[wrong.code] < _MOST_OF_ONE and all(abs(wrong.value - other) > reach for other in seen):
            seen.append(wrong.value)
            counts[wrong.code] += 1
            share = 100.0 * judge(key, WrittenAnswer(wrong.value, unit, None)).share
            yield wrong, min(_FRACTIONS, key=lambda f: abs(f - share)), reach


def _decades(wrong: float, right: float) -> float:
    """How far two values are apart, in powers of ten; whole powers of a thousand are the likeliest."""
    powers = abs(math.log10(abs(wrong)) - math.log10(abs(right))) if wrong and right else 99.0
    return 0.5 if abs(powers - 3.0) < 1e-9 else powers


def _units(key: NumberKey) -> str:
    """Units with how many of each make one of the question's own; how a missing one counts."""
    if not key.unit_name:
        return (
            "<unitgradingtype>0</unitgradingtype><unitpenalty>0.1</unitpenalty>"
            "<showunits>3</showunits><unitsleft>0</unitsleft>"
        )
    rows = "".join(
        f"<unit><multiplier>{number(multiplier)}</multiplier><unit_name>{escaped(name)}</unit_name></unit>"
        for name, multiplier in unit_rows(key)
    )
    graded, cost = "0", 0.1
    if key.policy.unit == "required":
        graded, cost = "1", 1.0 - share_of(key, (True, False, True), ())
    return (
        f"<units>{rows}</units><unitgradingtype>{graded}</unitgradingtype><unitpenalty>{cost:.7g}</unitpenalty>"
        "<showunits>0</showunits><unitsleft>0</unitsleft>"
    )


def unit_rows(key: NumberKey) -> Iterator[tuple[str, float]]:
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
    values = "; ".join(
        name + (": " if " " in name else " = ") + value if value else name for name, value in question.given
    )
    title = f"{question.title.rstrip('. ')}. " if question.title else ""
    text = _gift(f"{title}Given: {values}. {question.asked}")
    told = _gift(f"Right: {question.accepted} is accepted.")
    rows = [f"=%100%{number(right)}:{number(_half(own))}#{told}" for own, right in rights(question)]
    for wrong, share, reach in wrong_rows(question):
        said = _gift(message(wrong.code, wrong.where, key.kind))
        rows.append(f"=%{share:.7g}%{number(wrong.value)}:{number(reach)}#{said}")
    body = "\n".join(rows)
    return (
        f"::{_gift(question.name)}::{text} {{#\n{body}\n####{_gift(f'Accepted is an answer {key.rule}.')}\n}}"
    )


def _gift(text: str) -> str:
    """Text with GIFT's own characters escaped, on one line."""
    plain = " ".join(text.split())
    return "".join(f"\\{c}" if c in "\\~=#{}:" else c for c in plain)


def number(value: float) -> str:
    """A number with twelve digits at most."""
    return f"{value:.12g}"


def rights(question: Question) -> Iterator[tuple[NumberKey, float]]:
    """The right answers, each with its key, and what a whole turn makes of them; where no sense is asked
    their opposites too."""
    for key in (question.key, *question.others):
        right = float(sensible(key))
        for value in (right, -right) if right and key.policy.direction == "ignored" else (right,):
            yield key, value
            if key.period:
                yield key, value - math.copysign(key.period, value)


def _half(key: NumberKey) -> float:
    """Half the band about the right answer as it is shown, so that it holds all that `grade` takes."""
    return key.half + abs(float(sensible(key)) - key.value)


def sensible(key: NumberKey) -> str:
    """The right answer with six digits, and more where its tolerance asks for them."""
    ratio = key.half / abs(key.value) if key.value else 1.0
    digits = 6 if ratio >= 1e-3 else min(17, 4 - math.floor(math.log10(ratio))) if ratio > 0.0 else 17
    return f"{key.value:.{digits}g}"


def right_in_words(key: AnyKey) -> str:
    """The right answer as a student may write it: with its direction where that is asked; of several that are
    right all."""
    if isinstance(key, ChoiceKey):
        return "; ".join(map(right_in_words, key.keys))
    if isinstance(key, PlaceKey):
        if key.toward is not None:
            return f"at infinity at {key.toward:.6g} deg"
        return f"({key.place[0]:.6g}, {key.place[1]:.6g}) {key.unit_name}"
    unit = f" {key.unit_name}".rstrip()
    if isinstance(key, RangeKey):
        ends = [f"{sensible(end)}{unit}" for end in numbers_of(key)]
        return " to ".join(ends) if len(ends) > 1 else f"{ends[0]} or {'more' if key.low else 'less'}"
    expected = key.expected
    way = f" at {expected.heading:.6g} deg" if expected.asked and expected.heading is not None else ""
    return f"{sensible(key)}{unit}{way}"


_QTI = "http://www.imsglobal.org/xsd/ims_qtiasiv1p2"
_CANVAS = "http://canvas.instructure.com/xsd/cccv1p0"
_PACKAGE = "http://www.imsglobal.org/xsd/imsccv1p1/imscp_v1p1"
_METADATA = "http://www.imsglobal.org/xsd/imsmd_v1p2"
_RESOURCE = "associatedcontent/imscc_xmlv1p1/learning-application-resource"
_HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n'
_CAUSES = 5
"""Mistakes that are told with any wrong answer: the simplest."""
SMALLEST = 1e-4
"""Canvas keeps four decimals of a numerical answer."""


def qti_zip(questions: Iterable[Question], title: str) -> bytes:
    """The zip to import; the same questions give the same bytes.

    ``imsmanifest.xml`` at its root names the quiz, its settings and the figures.
    """
    found = list(questions)
    quiz = _ident("quiz", title, *(q.name for q in found))
    figures = {f"figures/{_ident('figure', q.name)}.svg": q.picture for q in found if q.picture}
    points = sum(group[0].key.policy.points for group in _groups(found))
    parts = {
        "imsmanifest.xml": _manifest(quiz, title, figures),
        f"{quiz}/assessment_meta.xml": _meta(quiz, title, points),
        f"{quiz}/{quiz}.xml": _quiz(quiz, title, found),
        **figures,
    }
    return zipped((name, text.encode("utf-8")) for name, text in parts.items())


def zipped(files: Iterable[tuple[str, bytes]], programs: Iterable[str] = ()) -> bytes:
    """Files in a zip, the ``programs`` among them to be run; the same files give the same bytes."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files:
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.external_attr = (0o100755 if name in programs else 0o100644) << 16
            entry.create_system = 3
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)
    return buffer.getvalue()


def _ident(kind: str, *texts: str) -> str:
    """A name that follows from texts."""
    return f"{kind}_{hashlib.sha256(chr(31).join(texts).encode('utf-8')).hexdigest()[:24]}"


def _groups(questions: list[Question]) -> list[list[Question]]:
    """Questions that are variants of one, together."""
    groups: dict[str, list[Question]] = {}
    for question in questions:
        groups.setdefault(question.key.question, []).append(question)
    return list(groups.values())


def _manifest(quiz: str, title: str, figures: Iterable[str]) -> str:
    files = "".join(
        f'<resource identifier="{_ident("file", path)}" type="webcontent" href="{path}">'
        f'<file href="{path}"/></resource>'
        for path in figures
    )
    settings = f"{quiz}_meta"
    return (
        f'{_HEAD}<manifest identifier="{_ident("package", quiz)}" xmlns="{_PACKAGE}" '
        f'xmlns:imsmd="{_METADATA}">'
        "<metadata><schema>IMS Content</schema><schemaversion>1.1.3</schemaversion><imsmd:lom><imsmd:general>"
        f"<imsmd:title><imsmd:string>{escaped(title)}</imsmd:string></imsmd:title></imsmd:general></imsmd:lom>"
        "</metadata><organizations/><resources>"
        f'<resource identifier="{quiz}" type="imsqti_xmlv1p2"><file href="{quiz}/{quiz}.xml"/>'
        f'<dependency identifierref="{settings}"/></resource>'
        f'<resource identifier="{settings}" type="{_RESOURCE}" href="{quiz}/assessment_meta.xml">'
        f'<file href="{quiz}/assessment_meta.xml"/></resource>{files}</resources></manifest>\n'
    )


def _meta(quiz: str, title: str, points: float) -> str:
    return (
        f'{_HEAD}<quiz identifier="{quiz}" xmlns="{_CANVAS}"><title>{escaped(title)}</title><description/>'
        "<shuffle_answers>false</shuffle_answers><scoring_policy>keep_highest</scoring_policy>"
        f"<quiz_type>assignment</quiz_type><points_possible>{points:.10g}</points_possible>"
        "<allowed_attempts>1</allowed_attempts><available>false</available></quiz>\n"
    )


def _quiz(quiz: str, title: str, questions: list[Question]) -> str:
    body = "".join(_section(group) if len(group) > 1 else _item(group[0]) for group in _groups(questions))
    return (
        f'{_HEAD}<questestinterop xmlns="{_QTI}"><assessment ident="{quiz}" title="{escaped(title)}">'
        f'<qtimetadata>{_field("cc_maxattempts", "1")}</qtimetadata><section ident="root_section">{body}'
        "</section></assessment></questestinterop>\n"
    )


def _section(group: list[Question]) -> str:
    """Variants, of which one is picked."""
    name = group[0].key.question
    items = "".join(map(_item, group))
    return (
        f'<section ident="{_ident("group", name)}" title="{escaped(name)}"><selection_ordering><selection>'
        "<selection_number>1</selection_number><selection_extension>"
        f"<points_per_item>{group[0].key.policy.points:.10g}</points_per_item></selection_extension></selection>"
        f"</selection_ordering>{items}</section>"
    )


def _item(question: Question) -> str:
    key, ident = question.key, _ident("item", question.name)
    right = "".join(_right_condition(value, _half(own)) for own, value in rights(question))
    about = "".join(
        _field(label, entry)
        for label, entry in (
            ("question_type", "numerical_question"),
            ("points_possible", f"{key.policy.points:.10g}"),
            ("assessment_question_identifierref", _ident("reference", question.name)),
        )
    )
    wrongs = list(wrong_rows(question))
    causes = dict.fromkeys(message(wrong.code, kind=key.kind) for wrong, _, _ in wrongs)
    checks = f" Check what is often mistaken: {' '.join(list(causes)[:_CAUSES])}" if causes else ""
    otherwise = f"Not right. Accepted is an answer {key.rule}.{checks}"
    return (
        f'<item ident="{ident}" title="{escaped(question.name)}">'
        f"<itemmetadata><qtimetadata>{about}</qtimetadata></itemmetadata>"
        f"<presentation>{_material(_canvas_statement(question))}"
        '<response_str ident="response1" rcardinality="Single"><render_fib fibtype="Decimal">'
        '<response_label ident="answer1"/></render_fib></response_str></presentation>'
        '<resprocessing><outcomes><decvar maxvalue="100" minvalue="0" varname="SCORE" vartype="Decimal"/>'
        f"</outcomes>{right}"
        f"{''.join(_wrong_condition(n, wrong.value) for n, (wrong, _, _) in enumerate(wrongs))}"
        '<respcondition continue="Yes"><conditionvar><other/></conditionvar>'
        '<displayfeedback feedbacktype="Response" linkrefid="general_incorrect_fb"/></respcondition>'
        "</resprocessing>"
        f"{_feedback('correct_fb', f'Right: {question.accepted} is accepted.')}"
        f"{_feedback('general_incorrect_fb', otherwise)}"
        + "".join(
            _feedback(f"wrong{n}_fb", message(wrong.code, wrong.where, key.kind))
            for n, (wrong, _, _) in enumerate(wrongs)
        )
        + "</item>"
    )


def _right_condition(value: float, half: float) -> str:
    """What is accepted."""
    low, high = (number(value + side) for side in (-half, half))
    return (
        '<respcondition continue="No"><conditionvar><or>'
        f'<varequal respident="response1">{number(value)}</varequal><and>'
        f'<vargte respident="response1">{low}</vargte><varlte respident="response1">{high}</varlte>'
        "</and></or></conditionvar>"
        '<setvar action="Set" varname="SCORE">100</setvar>'
        '<displayfeedback feedbacktype="Response" linkrefid="correct_fb"/></respcondition>'
    )


def _wrong_condition(n: int, value: float) -> str:
    """A known wrong answer as a bare equality, which earns nothing."""
    return (
        f'<respcondition continue="Yes"><conditionvar><varequal respident="response1">{value:.6g}</varequal>'
        f'</conditionvar><displayfeedback feedbacktype="Response" linkrefid="wrong{n}_fb"/></respcondition>'
    )


def _canvas_statement(question: Question) -> str:
    """The text in HTML, with its figure and the unit in its words: Canvas takes bare numbers only."""
    image = ""
    if question.picture:
        path = f"$IMS-CC-FILEBASE$/figures/{_ident('figure', question.name)}.svg"
        image = f'<p><img src="{path}" alt="figure of the mechanism"/></p>'
    unit = question.key.unit_name
    bare = f"<p>Write the number alone, in {escaped(unit)}.</p>" if unit else ""
    return f"{table_of(question, image)}{bare}"


def _feedback(ident: str, text: str) -> str:
    inside = _material(f"<p>{escaped(text)}</p>")
    return f'<itemfeedback ident="{ident}"><flow_mat>{inside}</flow_mat></itemfeedback>'


def _material(html: str) -> str:
    return f'<material><mattext texttype="text/html">{escaped(html)}</mattext></material>'


def _field(label: str, entry: str) -> str:
    inside = f"<fieldlabel>{label}</fieldlabel><fieldentry>{entry}</fieldentry>"
    return f"<qtimetadatafield>{inside}</qtimetadatafield>"
