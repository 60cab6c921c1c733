"""Mutated cases: whatever is done to a file, reading ends in a case or in a refusal with its place."""

from __future__ import annotations

import random
import time
from collections.abc import Callable
from copy import deepcopy

import pytest

from corpus import ALL
from icsolve.errors import CaseError
from icsolve.read import load
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from trees import document, tree

SECONDS = 3.0
"""For each kind of mutation."""

Dice = random.Random
TOKENS = [
    *r"[ ] { } , : ? - # & * ! | > ' % @ ` --- ... é ² ½ ٣ '' \ << = ~ null true NO on .inf -.nan".split(),
    *"1e999 1e-999 0x1F 0o7 1_000 12:30 2024-13-45 !!int !!bool &a *a unknown like centroid icsolve".split(),
    *"joints points O2-A A' -- @x 1/0 N*m ft-lb N^9 kg lbm ° 30% [[[]]] {x:1} [unknown] cw ccw".split(),
    *[
        "",
        '"',
        '""',
        "\t",
        "\n",
        "\r",
        "\0",
        "\x1b",
        "\x85",
        "\u2028",
        "\ufeff",
        "\ud800",
        "{like: {like: P}}",
        "{: }",
    ],
    *["  ", "\n  ", "\n- ", ": ", "- - ", "9" * 400, "x" * 2000, "A" * 130, "(" * 60, "-" * 90, "'" * 70],
]


def by_characters(dice: Dice, text: str) -> str:
    """Characters lost, doubled, swapped; strange ones put in."""
    for _ in range(dice.randint(1, 4)):
        at, to = dice.randrange(len(text) + 1), dice.randrange(len(text) + 1)
        at, to = min(at, to), min(max(at, to), at + dice.choice((0, 1, 1, 5, 40)))
        middle = dice.choice(
            ("", text[at:to] * 2, dice.choice(TOKENS), text[at:to][::-1], chr(dice.randrange(0x250)))
        )
        text = text[:at] + middle + text[to:]
    return text


def by_lines(dice: Dice, text: str) -> str:
    """Lines lost, doubled, moved, indented."""
    lines = text.split("\n")
    for _ in range(dice.randint(1, 3)):
        at, to = dice.randrange(len(lines)), dice.randrange(len(lines))
        done = dice.randrange(5)
        if done == 0:
            del lines[at]
        elif done == 1:
            lines.insert(to, lines[at])
        elif done == 2:
            lines[at], lines[to] = lines[to], lines[at]
        elif done == 3:
            lines[at] = " " * dice.randint(1, 4) + lines[at]
        else:
            lines[at] = lines[at].strip()
        lines = lines or [""]
    return "\n".join(lines)


def by_nodes(dice: Dice, text: str) -> str:
    """Values of the tree exchanged, among them and with those of another case."""
    root = tree(text)
    other = _nodes(tree(dice.choice(list(ALL.values()))))
    for _ in range(dice.randint(1, 3)):
        node = dice.choice([one for one in _nodes(root) if not isinstance(one, Scalar)])
        value = deepcopy(dice.choice([*other, Scalar(dice.choice(TOKENS), False, (1, 1))]))
        if isinstance(node, Mapping):
            key = dice.choice([*node.items, dice.choice(list(ALL_KEYS))])
            node.items[key] = value
            if dice.random() < 0.2:
                del node.items[key]
        elif isinstance(node, Sequence) and node.items:
            node.items[dice.randrange(len(node.items))] = value
    return document(root)


def _nodes(node: Node) -> list[Node]:
    if isinstance(node, Scalar):
        return [node]
    inner = node.items.values() if isinstance(node, Mapping) else node.items
    return [node, *[found for value in inner for found in _nodes(value)]]


ALL_KEYS = {
    key
    for text in ALL.values()
    for node in _nodes(tree(text))
    if isinstance(node, Mapping)
    for key in node.items
}


@pytest.mark.parametrize("mutate", [by_characters, by_lines, by_nodes])
def test_no_mutation_ends_otherwise_than_in_a_case_or_a_refusal(mutate: Callable[[Dice, str], str]) -> None:
    dice = Dice(20240229)
    texts = list(ALL.values())
    end = time.process_time() + SECONDS
    read, refused = 0, 0
    while time.process_time() < end:
        text = mutate(dice, dice.choice(texts))
        refusal = _refusal(text + "\n", {})
        read, refused = read + (refusal is None), refused + (refusal is not None)
        for problem in refusal.problems if refusal else ():
            assert 1 <= problem.line <= len(text.splitlines()) + 2
            assert problem.column >= 1
            assert problem.message
            assert str(problem).isprintable()
    assert read > 20
    assert refused > 200


@pytest.mark.parametrize("seed", range(3))
def test_no_setting_ends_otherwise_than_in_a_case_or_a_refusal(seed: int) -> None:
    """Paths of the case's own marks, cut and mixed, with strange values."""
    dice = Dice(seed)
    text = dice.choice(list(ALL.values()))
    paths = list(load(text).marks)
    for _ in range(400):
        steps = ".".join(dice.choice(paths) for _ in range(dice.choice((1, 1, 2)))).split(".")
        path = ".".join(dice.sample(steps, dice.randint(1, len(steps))) if dice.random() < 0.5 else steps)
        value = dice.choice([dice.choice(TOKENS), "30", 3.5, float("nan"), float("inf"), "2 mm"])
        refusal = _refusal(text, {path: value})
        assert refusal is None or all(str(problem).isprintable() for problem in refusal.problems)


def _refusal(text: str, settings: dict[str, str | float]) -> CaseError | None:
    try:
        load(text, settings)
    except CaseError as error:
        return error
    return None
