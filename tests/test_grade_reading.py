"""Answers as students write them: the corpus, each with its reading or its flag."""

from __future__ import annotations

import math
import re
from fractions import Fraction
from itertools import product
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from icsolve.grade.written.answer import Reader
from icsolve.grade.written.two_numbers import read_place, read_range
from icsolve.grade.written.words import direction
from sizes import FULL, few, sampled

CORPUS = Path(__file__).parent / "data" / "answers.tsv"


def rows() -> list[tuple[str, ...]]:
    """Text, number, unit, direction, flag (or note); the text may have \\u escapes."""
    lines = CORPUS.read_text(encoding="utf-8").split("\n")[1:]
    fields = [line.split("\t") for line in lines if line and not line.startswith("# ")]
    return [(_unescaped(text), *rest) for text, *rest in fields]


def _unescaped(text: str) -> str:
    return re.sub(r"\\u([0-9a-f]{4})", lambda found: chr(int(found[1], 16)), text)


def test_the_corpus_has_at_least_300_different_texts() -> None:
    texts = [row[0] for row in rows()]
    assert len(set(texts)) == len(texts) >= 300


@pytest.mark.parametrize("row", rows(), ids=lambda row: repr(row[0]))
def test_an_answer_is_read_as_the_corpus_says(row: tuple[str, ...]) -> None:
    text, number, unit, direction, flag = row
    read = Reader().read(text)
    if not number:
        assert read.flag == flag
        return
    assert (read.flag, read.note) == ("", flag)
    assert (read.unit.name if read.unit else "") == unit
    assert (read.direction.words if read.direction else "") == direction
    assert read.number == pytest.approx(float(Fraction(number)), rel=1e-15, abs=0.0)


PIECES = st.sampled_from(
    "412.7 412,7 1,234 1/3 10^2 e2 x × 10 - − + . , N kN lb·ft N*m in ft ° deg ccw cw down left at toward"
    " A ( ) [ ] = : % √ pi T C to the x y above below axis \t \u2009 \u00a0 ½ ² ↓ → ± ~ { } \\ $ ^".split(" ")
)


JOINED = st.lists(PIECES, max_size=9)


@given(st.one_of(st.text(max_size=60), JOINED.map("".join), JOINED.map(" ".join)))
@settings(max_examples=600 if FULL else 40)
def test_any_text_is_read_or_flagged(text: str) -> None:
    """Nothing raises, and what is read is a finite number."""
    read = Reader().read(text)
    assert math.isfinite(read.number)
    assert not read.flag or (read.unit is None and read.direction is None)
    read_place(text)


@given(
    st.floats(1e-6, 1e9),
    st.sampled_from(["", " N", "N", " kN·m", " lbf*in", " ft-lb", " rad/s"]),
    st.sampled_from(["", " down", " (ccw)", " to the left", " at 30 deg"]),
    st.sampled_from(["{:.6g}", "{:.4e}", "{:.3f}", "{!r}"]),
)
def test_a_number_is_read_as_it_is_written(value: float, unit: str, way: str, form: str) -> None:
    text = form.format(value)
    read = Reader().read(text + unit + way)
    assert (read.flag, read.number) == ("", float(text))
    assert bool(read.unit) == bool(unit)
    assert bool(read.direction) == bool(way)
    slow = Reader().slowly(text + unit + way)
    assert slow._replace(digits="") == read._replace(digits="")


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("(0.9, 1.2)", (0.9, 1.2)),
        ("[0.9, 1.2] m", (0.9, 1.2)),
        ("0.9, 1.2", (0.9, 1.2)),
        ("0.9 1.2", (0.9, 1.2)),
        ("0,9; 1,2", (0.9, 1.2)),
        ("x = -0.9, y = 1.2 in", (-0.9, 1.2)),
        ("I24 = (−1.51, 0)", (-1.51, 0.0)),
        ("(0.9 mm, 1.2 mm)", (0.9, 1.2)),
        ("{9e-1, 1.2}", (0.9, 1.2)),
    ],
)
def test_places(text: str, place: tuple[float, float]) -> None:
    read = read_place(text)
    assert (read.flag, read.x, read.y) == ("", *place)


@pytest.mark.parametrize(
    ("text", "flag"),
    [
        ("0,9, 1,2", "ambiguous-number"),
        ("0.9", "unread"),
        ("1 2 3", "two-values"),
        ("here", "no-number"),
        ("", "missing"),
        ("(0.9 mm, 1.2 m)", "unread"),
    ],
)
def test_what_is_no_place(text: str, flag: str) -> None:
    assert read_place(text).flag == flag


def test_places_at_infinity() -> None:
    assert read_place("at infinity toward 90 deg").toward == 90.0
    assert read_place("∞, 30°").toward == 30.0
    assert math.isnan(read_place("infinity").toward or 0.0)


NAMES = re.compile(r"(?<!\w)[A-Za-z]{1,2}_?\d{1,3}'?(?![\w.,]*\d)")


@given(st.one_of(st.text(max_size=60), JOINED.map("".join), JOINED.map(" ".join)))
@settings(max_examples=few(600))
def test_a_text_with_a_digit_is_never_invalid(text: str) -> None:
    """But for the digits of names, as in T12."""
    if any(c in "0123456789" for c in NAMES.sub("", text)):
        assert Reader().read(text).flag != "no-number"
        assert read_place(text).flag != "no-number"
        assert read_range(text).flag != "no-number"


SENSES = [
    ("N*m", "ccw", "cw"), ("lbf*in", "clockwise", "ccw"), ("kN*m", "anti-clockwise", "cw"),
    ("N", "right", "left"), ("kN", "downwards", "up"), ("lbf", "upward", "down"),
    ("N", "tension", "compression"), ("N*m", "im Uhrzeigersinn", "ccw"),
    ("N*m", "rechtsherum", "links herum"), ("kN*m", "linksherum", "rechts herum"),
]  # fmt: skip
CONVENTIONS = [
    "{} ({} positive)", "{}, {} is positive", "{}; {} = +", "{} (+ {})", "{}, positive {}",
    "{} with {} as positive", "{} ({} +ve)", "{}, taking {} as positive", "{} [{} +]",
]  # fmt: skip


@sampled(3)
@pytest.mark.parametrize("form", CONVENTIONS)
@pytest.mark.parametrize(("unit", "word", "other"), SENSES)
def test_a_sense_that_is_said_to_be_positive_gives_the_sign_its_meaning(
    unit: str, word: str, other: str, form: str
) -> None:
    """A minus beside a word has two readings only while nobody says which way is positive."""
    for sign, said in (("", word), ("-", other), ("−", other)):
        read, meant = (
            Reader().read(form.format(f"{sign}12.5 {unit}", word)),
            Reader().read(f"12.5 {unit} {said}"),
        )
        assert read == meant, (read, meant)
        assert not meant.flag
    assert Reader().read(f"-12.5 {unit} {word}").flag == "ambiguous-direction"


@pytest.mark.parametrize(
    ("unit", "letter", "along", "against"),
    [("N", "i", "right", "left"), ("kN", "j", "up", "down"), ("N*m", "k", "ccw", "cw")],
)
def test_unit_vectors_are_directions_with_the_sign_of_the_number(
    unit: str, letter: str, along: str, against: str
) -> None:
    hats = {"i": "î", "j": "ĵ", "k": "k̂"}
    forms = ["{} {u} {}", "{} {u} {}-hat", f"{{}} {{u}} {hats[letter]}", f"{{}} {hats[letter]} {{u}}"]
    forms += [f"${{}}\\,\\hat{{{{{letter}}}}}\\ \\mathrm{{{{N}}}}$"] if unit == "N" else []
    for form in forms:
        for sign, said in (("", along), ("-", against)):
            read = Reader().read(form.format(f"{sign}12.5", letter, u=unit))
            assert read == Reader().read(f"12.5 {unit} {said}"), (form, read)


@pytest.mark.parametrize(
    "text", ["33.76 (-) lbf*in", "1070 N at 180 deg (−)", "12.5 N (-) up", "(-) 3 N left"]
)
def test_a_minus_in_brackets_beside_a_unit_is_not_left_out(text: str) -> None:
    """Alone it is the unit of a ratio; beside another unit it may be the sign."""
    assert Reader().read(text).flag
    assert Reader().read("0.133 (-)").number == Reader().read("0.133 [-]").number == 0.133


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("33.76 lb_f in cw", "33.76 lbf in cw"),
        (r"33.76\,\mathrm{lb_{f}\cdot in}$ cw", "33.76 lbf in cw"),
        ("12 kg_f up", "12 kgf up"),
        ("12 lb_m", "12 lbm"),
        ("12.50 N up (3 s.f.)", "12.50 N up"),
        ("12.50 N (to 4 sig. figs.)", "12.50 N"),
        ("12.50 N, 3 significant figures", "12.50 N"),
        ("12.50 N (2 d.p.)", "12.50 N"),
        ("12.5 Nm rechtsom", "12.5 Nm cw"),
        ("12.5 Nm tegen de klok in", "12.5 Nm ccw"),
        ("12.5 N naar rechts", "12.5 N right"),
        ("12.5 Nm no sentido anti-horário", "12.5 Nm ccw"),
        ("12.5 Nm sentido horário", "12.5 Nm cw"),
        ("12.5 N para a esquerda", "12.5 N left"),
        ("12.5 N para baixo", "12.5 N down"),
        ("12.5 N tração", "12.5 N pull"),
    ],
)  # fmt: skip
def test_subscripts_remarks_on_figures_and_more_tongues(text: str, meant: str) -> None:
    read, same = Reader().read(text), Reader().read(meant)
    assert read == same
    assert not read.flag


@pytest.mark.parametrize(
    "text", ["w4 = {} w2", "{} w2", "{} ω2", "{} ω_2", "{} W2", "{} T2", "{} w4/w2", "{} N12 cw"]
)
def test_a_symbol_with_a_number_is_no_power_of_a_unit(text: str) -> None:
    """The speed of link 2, not watts squared: a person reads it; of a unit's own power nothing changes."""
    assert Reader().read(text.format("0.2278")).flag in ("unread", "two-values")
    for unit in ("m2", "in2", "m^2", "s2"):
        assert not Reader().read(f"0.2278 {unit}").flag


@pytest.mark.parametrize("text", ["30.1/312.0 N", "30.1 / 312", "-30.1/312 N up"])
def test_two_ends_with_a_stroke_between_may_be_a_quotient(text: str) -> None:
    assert read_range(text).flag == "ambiguous-number"
    assert read_range("1/3 N to 2/3 N")[:2] == pytest.approx((1 / 3, 2 / 3), abs=0.0)


@pytest.mark.parametrize("mark", ["=", ":", "≈", "~", " = "])
def test_the_coordinates_of_a_place_may_be_about(mark: str) -> None:
    read = read_place(f"x{mark}-0.9, y{mark}1.2")
    assert (read.flag, read.x, read.y) == ("", -0.9, 1.2)


@sampled(3)
@pytest.mark.parametrize("way", ["cw", "CW", "clockwise", "counter clockwise", "down", "+x"])
@pytest.mark.parametrize("mark", [" in {}", " in. {}", "in {}", " in, {}", " (in {})"])
def test_an_in_between_number_and_direction_may_be_inches(way: str, mark: str) -> None:
    """Where no other unit stands and no noun makes it a preposition, a person looks."""
    assert Reader("point").read("33.76" + mark.format(way)).flag == "ambiguous-unit"
    for text in (f"33.76 in the {way} direction", f"33.76 in {way} direction"):
        read = Reader("point").read(text)
        assert (read.flag, read.unit) == ("", None) and read.direction is not None
    unit = "N" if way in ("down", "+x") else "Nm"
    for text in (f"64.5 {unit} in {way}", "64.5 N in tension", "64.5 in tension"):
        read = Reader("point").read(text)
        assert not read.flag and read.direction is not None


@pytest.mark.parametrize(
    ("written", "degrees"),
    [
        ("opwaarts", 90.0),
        ("neerwaarts", 270.0),
        ("vertical upwards", 90.0),
        ("downwards vertically", 270.0),
        ("to the right side", 0.0),
        ("to the left side", 180.0),
    ],
)
def test_words_of_direction_in_their_other_forms(written: str, degrees: float) -> None:
    found = direction(written)
    assert found is not None and (found.kind, found.value) == ("line", degrees)


@pytest.mark.parametrize("form", ["T12 ({}) = {}", "T12 [{}]: {}", "|T12 ({})| = {}", "Torque ({}): {}"])
@pytest.mark.parametrize("said", ["N*m", "N m", "lbf·in", "ft-lb", "cw", "counter-clockwise", "N/mm"])
def test_a_unit_or_a_sense_in_brackets_behind_a_name_counts(form: str, said: str) -> None:
    """As a heading has it: ``T12 (N m) = 41`` was taken for 41 in the unit of the case."""
    assert Reader().read(form.format(said, "41.2"))[:4] == Reader().read(f"41.2 {said}")[:4]


@pytest.mark.parametrize("unit", ["Nm", "kN", "(N m)", "(lbf*in)"])
def test_a_name_divided_by_a_unit_has_that_unit(unit: str) -> None:
    assert Reader().read(f"M/{unit} = -41.2")[:3] == Reader().read(f"-41.2 {unit.strip('()')}")[:3]


@pytest.mark.parametrize(
    "text", ["T12 (N m) = 41 lbf in", "T12 (cw) = 41 ccw", "T12 (cw) = -41", "M/kN = 41 N m"]
)
def test_what_a_name_says_against_its_answer_is_for_a_person(text: str) -> None:
    assert Reader().read(text).flag in ("ambiguous-unit", "ambiguous-direction")


@pytest.mark.parametrize("said", ["max", "magnitude", "unknown", "link 2", "2", "about A", "t", ""])
def test_other_words_in_brackets_behind_a_name_say_nothing(said: str) -> None:
    assert Reader().read(f"T12 ({said}) = 41.2 N*m cw") == Reader().read("41.2 N*m cw")


@pytest.mark.parametrize("words", [
    "at most {}", "below {}", "P is under {}", "P is less than {}", "not more than {}", "up to {}", "P < {}",
    "{} or less", "-inf to {}", "(-∞, {}]", "from -infinity to {}", "-oo < P < {}",
])  # fmt: skip
def test_a_range_with_an_open_end_in_words_below(words: str) -> None:
    """``below 387 N`` was one value, under the name ``below``."""
    read = read_range(words.format("387 N"))
    assert (read.low, read.high, read.flag) == (None, 387.0, "")


@pytest.mark.parametrize("words", [
    "at least {}", "above {}", "P is over {}", "P must be more than {}", "no less than {}", "P > {}",
    "{} or more", "{} to infinity", "[{}, ∞)", "from {} up to inf",
])  # fmt: skip
def test_a_range_with_an_open_end_in_words_above(words: str) -> None:
    read = read_range(words.format("387 N"))
    assert (read.low, read.high, read.flag) == (387.0, None, "")


@pytest.mark.parametrize("word", ["nearby", "exactly", "beside", "force", "not"])
def test_a_word_before_a_range_is_no_name(word: str) -> None:
    assert read_range(f"{word} 387 N").flag == "unread"
    assert read_range("P 113 to 387 N")[:2] == (113.0, 387.0)


_QUOTIENTS = "N/m kN/m N/mm lbf/in lbf/ft kip/ft kgf/m N*m/rad lbf*in/rad N/mm^2 m/s in/s rad/s".split()
_PHRASES = "tension, compression, x direction, down direction, direction of C, traction, the clockwise sense"


@sampled(3, "unit", "phrase")
@pytest.mark.parametrize(("unit", "phrase"), list(product(_QUOTIENTS, _PHRASES.split(", "))))
def test_in_behind_a_quotient_is_no_inch(unit: str, phrase: str) -> None:
    """``200 N/m in tension`` says what it says in columns of its own."""
    reader = Reader("either")
    one, columns = reader.read(f"90 {unit} in {phrase}"), reader.read("90", unit, f"in {phrase}")
    assert one.unit is not None and columns.unit is not None and not one.flag
    assert (one.number, one.unit.unit, one.direction) == (90.0, columns.unit.unit, columns.direction)
