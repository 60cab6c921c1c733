"""A record as straight-line source text: one generator, a table of forms for each language.

A value that is used once stands where it is used; the others have a name. Cosine and sine of an angle come
from one function, which reduces it exactly (`arithmetic.turn_of`).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from itertools import chain

from icsolve.numbers.record import Op, Traced, live
from icsolve.tuples import NamedTuple

DEEPEST = 12
"""Brackets in brackets."""


class Language(NamedTuple):
    """How a language writes the operations; ``{a}`` and ``{b}`` are operands."""

    forms: Mapping[int, str]
    turned: str
    """cosine and sine of ``{a}`` degrees to the names ``{c}`` and ``{s}``"""
    assigned: str
    number: Callable[[float], str]


def _number(value: float) -> str:
    text = repr(value)
    return f"({text})" if text.startswith("-") else text


_ARITHMETIC = {
    Op.ADD: "({a}+{b})",
    Op.SUB: "({a}-{b})",
    Op.MUL: "{a}*{b}",
    Op.DIV: "({a}/{b})",
    Op.NEG: "(-{a})",
}
PYTHON = Language(
    {
        **_ARITHMETIC,
        Op.MUL: "({a}*{b})",
        Op.SQRT: "root({a})",
        Op.ANGLE: "degrees(atan2({b},{a}))",
        Op.NEAREST: "float(round({a}))",
    },
    "{c},{s}=turn({a})",
    "{name}={value}",
    _number,
)
JAVASCRIPT = Language(
    {
        **_ARITHMETIC,
        Op.MUL: "times({a},{b})",
        Op.DIV: "over({a},{b})",
        Op.SQRT: "root({a})",
        Op.ANGLE: "angle({a},{b})",
        Op.NEAREST: "nearest({a})",
    },
    "[{c},{s}]=turn({a});",
    "{name}={value};",
    _number,
)


class Text(NamedTuple):
    """Lines in order with the node that each ends at, the names that they assign, and the expression of
    every wanted node."""

    lines: tuple[str, ...]
    names: tuple[str, ...]
    wanted: tuple[str, ...]
    at: tuple[int, ...]


def straight_line(
    nodes: Sequence[Traced], wanted: Sequence[int], inputs: Mapping[int, str], language: Language
) -> Text:
    """The source of a program from the inputs to the wanted nodes.

    Parameters
    ----------
    nodes : of the record
    wanted : indices of nodes
    inputs : by node, the name of the variable that has it; every other input keeps the value with which it
        was recorded
    language : `PYTHON` or `JAVASCRIPT`; the text calls ``turn``, ``root``, ``degrees``, ``atan2`` (Python) or
        ``turn``, ``root``, ``angle``, ``nearest``, ``times``, ``over``, which may take any numbers

    Returns
    -------
    Text
        Lines without indentation, to be run in order. Angles are in degrees.
    """
    order = live(nodes, wanted, inputs)
    uses = Counter(chain(wanted, *(nodes[k].of for k in order if k not in inputs)))
    text: dict[int, tuple[str, int]] = {k: (name, 0) for k, name in inputs.items()}
    lines: list[str] = []
    names: list[str] = []
    at: list[int] = []

    def form(k: int) -> tuple[str, int]:
        if k not in text:  # the same in every row
            text[k] = (language.number(nodes[k].value), 0)
        return text[k]

    for k in order:
        node = nodes[k]
        if k in text:
            continue
        if node.op in (Op.COS, Op.SIN):
            cosine = k if node.op == Op.COS else node.b
            text[cosine], text[cosine + 1] = (f"v{cosine}", 0), (f"v{cosine + 1}", 0)
            names += [f"v{cosine}", f"v{cosine + 1}"]
            lines.append(language.turned.format(c=names[-2], s=names[-1], a=form(node.a)[0]))
            at.append(k)
            continue
        if node.op == Op.INPUT:
            form(k)
            continue
        parts = [form(n) for n in nodes[k].of]
        value = language.forms[node.op].format(a=parts[0][0], b=parts[-1][0])
        depth = 1 + max(d for _, d in parts)
        if uses[k] > 1 or depth > DEEPEST:
            names.append(f"v{k}")
            lines.append(language.assigned.format(name=names[-1], value=value))
            at.append(k)
            value, depth = names[-1], 0
        text[k] = (value, depth)
    return Text(tuple(lines), tuple(names), tuple(form(k)[0] for k in wanted), tuple(at))
