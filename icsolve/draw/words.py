"""Names, numbers and captions as a figure writes them."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence

from icsolve.answer.bodies import Reaction
from icsolve.case import Pair, is_angle, pair_name
from icsolve.case.loads import name_of_inertia
from icsolve.draw.marks import Mark, MarkGroup, TextMark, TextRun, bounds, text_width
from icsolve.draw.svg import runs_of
from icsolve.errors import refuse_overflow
from icsolve.report import positions_text
from icsolve.report.derivation.known import Known
from icsolve.report.derivation.ratios import Step
from icsolve.structure import welded
from icsolve.wording import holding, plural, spelt
from icsolve.wording.joints import joint_of_normal, normal_name
from icsolve.wording.sentences import provenance

DIGITS = 4


def figure_number(value: float, digits: int = DIGITS) -> str:
    """A number with so many significant digits, without an exponent where it can do without.

    Raises SceneError (``unsupported``) where that is beyond the range of doubles.
    """
    value = float(format(value, f".{digits}g")) + 0.0
    refuse_overflow("a number of the figure", value)
    if value == 0.0:
        return "0"
    if 1e-4 <= abs(value) < 10.0 ** max(digits, 7):
        decimals = max(digits - 1 - math.floor(math.log10(abs(value))), 0)
        text = f"{value:.{decimals}f}"
        text = text.rstrip("0").rstrip(".") if "." in text else text
    else:
        mantissa, _, exponent = f"{value:.{digits - 1}e}".partition("e")
        text = f"{mantissa.rstrip('0').rstrip('.')}×10{str(int(exponent)).translate(_RAISED)}"
    return text.replace("-", "−")


_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def unit_word(unit: str) -> str:
    """``lbf*in`` with a dot between, ``m^2`` with a raised number."""
    return unit.replace("*", "·").replace("^2", "²").replace("^4", "⁴")


def quantity(value: float, unit: str, digits: int = DIGITS) -> str:
    """A number with its unit."""
    return f"{figure_number(value, digits)} {unit_word(unit)}".rstrip()


def name_runs(name: str) -> tuple[TextRun, ...]:
    """``T12`` as a T with 12 set low, an inertia force as F with i and the link low, ``B'`` as it is."""
    if name_of_inertia(name):
        _, kind, link = name.split(" ", 2)
        return (TextRun("F" if kind == "force" else "T"), TextRun(f"i{link}", True))
    found = re.fullmatch(r"([^\W\d_]+)_?(\d+)('*)", name)
    if found is None:
        return (TextRun(name),)
    letters, digits, primes = found.groups()
    return (TextRun(letters + primes), TextRun(digits, True))


def centre_runs(a: str, b: str) -> tuple[TextRun, ...]:
    """I with the pair of links set low: ``24``, or ``crank,rod``."""
    low = a + b if len(a) == len(b) == 1 else f"{a},{b}"
    return (TextRun("I"), TextRun(low, True))


def force_runs(name: str, by: str, on: str, where: str) -> tuple[TextRun, TextRun]:
    """F with the links low, and the joint's point where the pair has several joints."""
    low = centre_runs(by, on)[1].text
    return (TextRun("F"), TextRun(f"{low}@{where}" if "@" in name else low, True))


def wrapped(text: str, size: float, width: float) -> list[str]:
    """A text in lines of a width; a word that is longer than a line is cut."""
    lines: list[str] = []
    line = ""
    for whole in text.split():
        word = whole
        longer = f"{line} {word}" if line else word
        if text_width(longer, size) <= width:
            line = longer
            continue
        if line:
            lines.append(line)
        while text_width(word, size) > width:
            cut = _fitting(word, size, width)
            lines.append(word[:cut])
            word = word[cut:]
        line = word
    return [*lines, line] if line else lines


def _fitting(word: str, size: float, width: float) -> int:
    """How many characters of a word fill a line; one at least."""
    count = 1
    while count < len(word) and text_width(word[: count + 1], size) <= width:
        count += 1
    return count


# --- what stands above and below a figure ----------------------------------------------------------------


TITLE, NOTE = 17.0, 12.5
NARROWEST = 420.0
"""Captions are set at least so wide."""


def captioned(known: Known, marks: Sequence[Mark], steps: Sequence[Step], step: int | None) -> list[Mark]:
    """Marks with the title above and the captions below."""
    left, top, right, bottom = bounds(marks)
    width = max(right - left, NARROWEST)
    left = min(left, (left + right - width) / 2.0)
    title = wrapped(known.title, TITLE, width)
    above = [
        TextMark((left, top - 16.0 - TITLE * 1.3 * n), (TextRun(line),), "t-title", TITLE, "start")
        for n, line in enumerate(reversed(title))
    ]
    below: list[Mark] = []
    y = bottom + 20.0
    for kind, text in _below(known, steps, step):
        for line in wrapped(text, NOTE, width):
            below.append(TextMark((left, y), _caption_runs(known, kind, line), kind, NOTE, "start"))
            y += NOTE * 1.45
    return [MarkGroup("title", "", tuple(reversed(above))), *marks, MarkGroup("caption", "", tuple(below))]


def _caption_runs(known: Known, kind: str, line: str) -> tuple[TextRun, ...]:
    """A line of a caption; the name of an answer as the figure writes it."""
    if kind == "t-axis":
        return runs_of(line)
    name, space, rest = line.partition(" ")
    if kind == "t-unknown" and known.answer is not None and name in known.answer.answers:
        return (*name_runs(name), TextRun(space + rest))
    return (TextRun(line),)


def _below(known: Known, steps: Sequence[Step], step: int | None) -> Iterable[tuple[str, str]]:
    if step is not None and steps:
        yield "t-axis", step_sentence(known, steps, step)
    for sentence in found_sentences(known):
        yield "t-unknown", sentence
    if known.refusal is not None:
        yield "t-reason", f"No answer ({known.refusal.status}): {known.refusal.message}"
    for told in provenance(known.case):
        yield "t-note", told


def answer_sentences(known: Known) -> list[str]:
    """Each unknown with its unit and its sense in words."""
    if known.answer is None:
        return []
    found = []
    for name, value in known.answer.answers.items():
        if value.holds is not None:
            found.append(f"{name} {holding(value._replace(unit=unit_word(value.unit)), figure_number)}")
            continue
        sense = spelt(value.sense, figure_number)
        found.append(f"{name} = {quantity(abs(value.value), value.unit)}" + (f", {sense}" if sense else ""))
    return found


def datum_name(path: str) -> str:
    """A datum of the figure in words: ``angle AB``, ``x of B``."""
    section, name, *axis = path.split(".")
    return f"{axis[0]} of {name}" if axis else f"{section.removesuffix('s')} {name}"


def datum_unit(known: Known, path: str) -> str:
    """Its unit as a figure has it."""
    return "\N{DEGREE SIGN}" if is_angle(path) else unit_word(known.case.units.length)


def position_sentences(known: Known) -> list[str]:
    """Where the mechanism rests, of a case that asks for it."""
    said = [] if known.answer is None else positions_text(known.answer, DIGITS)
    return [sentence.replace("*", "·") for sentence in said]


def holding_sentences(known: Known) -> list[str]:
    """Whether friction holds the loads, of a case that asks for that."""
    if known.answer is None or not known.asks_holding:
        return []
    holds = known.answer.holds_still
    if holds is None:
        return ["It is open whether friction holds it still"]
    return ["Friction holds it still" if holds else "Friction does not hold it still"]


def found_sentences(known: Known) -> list[str]:
    """What is found of what a case asks for: its unknown loads, where it rests, or whether it is held."""
    return [*answer_sentences(known), *position_sentences(known), *holding_sentences(known)]


def reaction_sentences(known: Known) -> list[str]:
    """The forces in the joints of a structure that statics gives, and their couples."""
    torque, found = known.case.units.torque, []
    for name, force in ((known.answer and known.answer.reactions) or {}).items():
        if not isinstance(force, Reaction) or force.magnitude is None:
            continue
        at = "" if force.direction is None else f" at {figure_number(force.direction)} deg"
        couple = f" and {quantity(abs(force.moment), torque)}" if force.moment else ""
        sense = "" if not force.moment else f", {spelt('ccw' if force.moment > 0.0 else 'cw', figure_number)}"
        found.append(f"{name} = {quantity(force.magnitude, known.case.units.force)}{at}{couple}{sense}")
    return found


def step_sentence(known: Known, steps: Sequence[Step], number: int) -> str:
    """How the last centre that is shown was found."""
    last = next((s for s in steps if s.number == number), None)
    if number == 0 or last is None:
        count = max((s.number for s in steps), default=0) if number else 0
        return ("The centres by inspection.", "The one step.")[count] if count < 2 else f"All {count} steps."
    name = f"I{pair_name(known.case, last.centre.pair)}"
    if not last.centre.lines:
        return f"Step {number}: {name} from the loop equations of the whole mechanism."
    if len(last.centre.lines) == 1 and len(last.centre.lines[0]) > 1:
        both = line_words(known, last.centre.lines, 0).removeprefix("the line ").replace(" ", " and ")
        return f"Step {number}: {name} is in the place of {both}."
    lines = last.centre.lines
    met = " meets ".join(line_words(known, lines, n) for n in range(len(lines)))
    return f"Step {number}: {name} is where {met}."


def line_words(known: Known, lines: Sequence[tuple[Pair, ...]], number: int) -> str:
    """A line of centres in words."""
    if len(lines[number]) == 1:
        return f"the {normal_name(joint_of_normal(known.case, lines, number))}"
    first, second = sorted(f"I{pair_name(known.case, pair)}" for pair in lines[number])
    return f"the line {first} {second}"


def description(known: Known) -> str:
    """The picture in a sentence, for those who can't see it."""
    case = known.case
    frame = (case.ground,) if known.structure or case.space is not None else welded(case, case.ground)
    moving = {*case.links}.difference(frame)
    what, link = ("Structure", "link") if known.structure else ("Mechanism", "moving link")
    joints = plural(len(case.joints), "joint")
    said = [f"{what} of {plural(len(moving), link)} and the frame, {joints}."]
    said += [f"{sentence}." for sentence in found_sentences(known)]
    if known.refusal is not None:
        said.append(f"No answer: {known.refusal.message}")
    return " ".join(said)
