"""Canvas quizzes: a package of QTI 1.2 with numerical questions, their figures, tolerances and feedback.

Canvas takes every range and every alternative for a right answer (`numeric_interaction.rb` of its importer),
and passes over a bare equality: known wrong answers stand so, with their feedback, for readers that compare,
and what they are told stands, without the values, in what Canvas tells of any wrong answer. The variants of a
case are a group of which each student gets one.
"""

from __future__ import annotations

import hashlib
import io
import zipfile
from collections.abc import Iterable
from html import escape

from icsolve.grade.keys import Key
from icsolve.grade.mistakes import message
from icsolve.grade.platforms.questions import Question, number, rights, sensible, table_of, wrong_rows

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
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in parts.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, text.encode("utf-8"))
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
        f"<imsmd:title><imsmd:string>{_text(title)}</imsmd:string></imsmd:title></imsmd:general></imsmd:lom>"
        "</metadata><organizations/><resources>"
        f'<resource identifier="{quiz}" type="imsqti_xmlv1p2"><file href="{quiz}/{quiz}.xml"/>'
        f'<dependency identifierref="{settings}"/></resource>'
        f'<resource identifier="{settings}" type="{_RESOURCE}" href="{quiz}/assessment_meta.xml">'
        f'<file href="{quiz}/assessment_meta.xml"/></resource>{files}</resources></manifest>\n'
    )


def _meta(quiz: str, title: str, points: float) -> str:
    return (
        f'{_HEAD}<quiz identifier="{quiz}" xmlns="{_CANVAS}"><title>{_text(title)}</title><description/>'
        "<shuffle_answers>false</shuffle_answers><scoring_policy>keep_highest</scoring_policy>"
        f"<quiz_type>assignment</quiz_type><points_possible>{points:.10g}</points_possible>"
        "<allowed_attempts>1</allowed_attempts><available>false</available></quiz>\n"
    )


def _quiz(quiz: str, title: str, questions: list[Question]) -> str:
    body = "".join(_section(group) if len(group) > 1 else _item(group[0]) for group in _groups(questions))
    return (
        f'{_HEAD}<questestinterop xmlns="{_QTI}"><assessment ident="{quiz}" title={_attribute(title)}>'
        f'<qtimetadata>{_field("cc_maxattempts", "1")}</qtimetadata><section ident="root_section">{body}'
        "</section></assessment></questestinterop>\n"
    )


def _section(group: list[Question]) -> str:
    """Variants, of which one is picked."""
    name = group[0].key.question
    items = "".join(map(_item, group))
    return (
        f'<section ident="{_ident("group", name)}" title={_attribute(name)}><selection_ordering><selection>'
        "<selection_number>1</selection_number><selection_extension>"
        f"<points_per_item>{group[0].key.policy.points:.10g}</points_per_item></selection_extension></selection>"
        f"</selection_ordering>{items}</section>"
    )


def _item(question: Question) -> str:
    key, ident = question.key, _ident("item", question.name)
    right = "".join(_right_condition(key, value - float(sensible(key))) for value in rights(key))
    about = "".join(
        _field(label, entry)
        for label, entry in (
            ("question_type", "numerical_question"),
            ("points_possible", f"{key.policy.points:.10g}"),
            ("assessment_question_identifierref", _ident("reference", question.name)),
        )
    )
    wrongs = list(wrong_rows(key))
    causes = dict.fromkeys(message(wrong.code, kind=key.kind) for wrong, _, _ in wrongs)
    checks = f" Check what is often mistaken: {' '.join(list(causes)[:_CAUSES])}" if causes else ""
    otherwise = f"Not right. Accepted is an answer {key.rule}.{checks}"
    return (
        f'<item ident="{ident}" title={_attribute(question.name)}>'
        f"<itemmetadata><qtimetadata>{about}</qtimetadata></itemmetadata>"
        f"<presentation>{_material(_statement(question))}"
        '<response_str ident="response1" rcardinality="Single"><render_fib fibtype="Decimal">'
        '<response_label ident="answer1"/></render_fib></response_str></presentation>'
        '<resprocessing><outcomes><decvar maxvalue="100" minvalue="0" varname="SCORE" vartype="Decimal"/>'
        f"</outcomes>{right}"
        f"{''.join(_wrong_condition(n, wrong.value) for n, (wrong, _, _) in enumerate(wrongs))}"
        '<respcondition continue="Yes"><conditionvar><other/></conditionvar>'
        '<displayfeedback feedbacktype="Response" linkrefid="general_incorrect_fb"/></respcondition>'
        "</resprocessing>"
        f"{_feedback('correct_fb', f'Right: {key.accepted} is accepted.')}"
        f"{_feedback('general_incorrect_fb', otherwise)}"
        + "".join(
            _feedback(f"wrong{n}_fb", message(wrong.code, wrong.where, key.kind))
            for n, (wrong, _, _) in enumerate(wrongs)
        )
        + "</item>"
    )


def _right_condition(key: Key, turned: float) -> str:
    """What is accepted, ``turned`` by nothing or a whole turn."""
    middle = sensible(key) if not turned else number(key.value + turned)
    low, high = (number(key.value + turned + side) for side in (-key.half, key.half))
    return (
        '<respcondition continue="No"><conditionvar><or>'
        f'<varequal respident="response1">{middle}</varequal><and>'
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


def _statement(question: Question) -> str:
    """The text in HTML, with its figure and the unit in its words: Canvas takes bare numbers only."""
    image = ""
    if question.picture:
        path = f"$IMS-CC-FILEBASE$/figures/{_ident('figure', question.name)}.svg"
        image = f'<p><img src="{path}" alt="figure of the mechanism"/></p>'
    unit = question.key.unit_name
    bare = f"<p>Write the number alone, in {_text(unit)}.</p>" if unit else ""
    return f"{table_of(question, image)}{bare}"


def _feedback(ident: str, text: str) -> str:
    inside = _material(f"<p>{_text(text)}</p>")
    return f'<itemfeedback ident="{ident}"><flow_mat>{inside}</flow_mat></itemfeedback>'


def _material(html: str) -> str:
    return f'<material><mattext texttype="text/html">{_text(html)}</mattext></material>'


def _field(label: str, entry: str) -> str:
    inside = f"<fieldlabel>{label}</fieldlabel><fieldentry>{entry}</fieldentry>"
    return f"<qtimetadatafield>{inside}</qtimetadatafield>"


def _text(text: str) -> str:
    return escape("".join(c if c >= " " else " " for c in text), quote=False)


def _attribute(text: str) -> str:
    return f'"{escape(text)}"'
