"""The schema and the reader agree: on every valid case, and on cases with something broken in their shape."""

from __future__ import annotations

import json
import random
from collections.abc import Iterator
from pathlib import Path

import pytest

from corpus import ALL
from draft07 import valid
from icsolve.errors import CaseError
from icsolve.read import joints, keys, load, profiles
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.schema import FORMS, schema
from shell import exit_status
from sizes import FULL, sampled
from trees import document, tree, typed

SCHEMA = schema()
CASES = sorted((Path(__file__).parent.parent / "cases").rglob("*.yaml"))
TEMPLATES = sorted((Path(__file__).parent.parent / "icsolve" / "manual" / "templates").glob("*.yaml"))
NAMED = {"points", "lengths", "angles", "near", "links", "loads", "profile", "expect"}


def reads(text: str) -> bool:
    """Whether the reader takes a text."""
    try:
        load(text)
    except CaseError:
        return False
    return True


@pytest.mark.parametrize("name", ALL)
def test_a_case_that_reads_fits_the_schema(name: str) -> None:
    assert reads(ALL[name])
    assert valid(typed(tree(ALL[name])), SCHEMA)


@pytest.mark.parametrize("path", [*CASES, *TEMPLATES], ids=lambda path: path.stem)
def test_shipped_cases_read_and_fit_the_schema(path: Path) -> None:
    case = load(path)
    assert case.joints or (case.space and case.space.joints)
    assert valid(typed(tree(path.read_text(encoding="utf-8"))), SCHEMA)


def test_it_is_a_schema_of_the_draft_that_editors_know() -> None:
    assert SCHEMA["$schema"] == "http://json-schema.org/draft-07/schema#"
    assert not valid(5, SCHEMA)
    assert not valid({}, SCHEMA)


def properties(schema: object) -> Iterator[tuple[str, dict[str, object]]]:
    """Every key that the schema knows, at any depth."""
    if isinstance(schema, dict):
        for name, form in schema.get("properties", {}).items():
            if "description" in form or form.keys() - {"type", "not"}:  # not a condition on another key
                yield name, form
        for part in schema.values():
            yield from properties(part)
    elif isinstance(schema, list):
        for part in schema:
            yield from properties(part)


def test_every_key_has_its_description() -> None:
    found = list(properties(SCHEMA))
    assert [name for name, form in found if len(str(form.get("description", ""))) < 8] == []
    assert len(found) >= 180
    kinds = [*SCHEMA["definitions"]["joint"]["oneOf"], *SCHEMA["definitions"]["load"]["oneOf"]]
    assert all(kind["description"] for kind in kinds)


def table() -> Iterator[keys.Key]:
    """Every key of the table that the reader reads by."""
    for value in (value for table in (keys, joints, profiles) for value in vars(table).values()):
        for entry in value.values() if isinstance(value, dict) else ():
            if isinstance(entry, keys.EntryKind):
                yield entry.own
                yield from entry.keys.values()
            elif isinstance(entry, keys.Key):
                yield entry


def test_every_form_of_the_table_has_its_shape_and_none_is_idle() -> None:
    assert {key.form for key in table()} == set(FORMS)


def test_a_new_case_leads_editors_to_the_schema(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    exit_status("new", "four-bar", "-o", str(tmp_path / "mine.yaml"))
    line = (tmp_path / "mine.yaml").read_text().splitlines()[1]
    assert line == f"# yaml-language-server: $schema={SCHEMA['$id']}"
    assert json.loads((tmp_path / SCHEMA["$id"]).read_text()) == SCHEMA
    assert SCHEMA["$id"] in capsys.readouterr().err


def places(node: Node, path: tuple[str | int, ...] = ()) -> Iterator[tuple[Node, tuple[str | int, ...]]]:
    """Every list and mapping of a tree, with the keys that lead to it."""
    if isinstance(node, Scalar):
        return
    yield node, path
    if isinstance(node, Mapping):
        for key, value in node.items.items():
            yield from places(value, (*path, key))
    else:
        for index, value in enumerate(node.items):
            yield from places(value, (*path, index))


def is_named(path: tuple[str | int, ...]) -> bool:
    """Whether a mapping is a section whose keys are names."""
    return len(path) == 1 and path[0] in NAMED


def broken(text: str) -> Iterator[tuple[str, Mapping]]:
    """The case with one thing wrong in its shape: a strange key, a lost key, a list for a number."""
    for _, path in places(tree(text)):
        root = tree(text)
        node = next(found for found, at in places(root) if at == path)
        if isinstance(node, Mapping):
            if not is_named(path):
                node.items["zzz"] = Scalar("1", True, (1, 1))
                yield f"zzz in {path}", root
            for key in list(node.items):
                root, node = fresh(text, path)
                assert isinstance(node, Mapping)
                node.items[key] = Sequence([Sequence([], (1, 1))], (1, 1))
                yield f"[[]] for {key} in {path}", root
        elif path not in (("joints",), ("motion",)):
            node.items.append(Mapping({"zzz": Scalar("1", True, (1, 1))}, {"zzz": (1, 1)}, (1, 1)))
            yield f"a mapping in {path}", root


def fresh(text: str, path: tuple[str | int, ...]) -> tuple[Mapping, Node]:
    """The tree again, and its node at a path."""
    root = tree(text)
    return root, next(found for found, at in places(root) if at == path)


@sampled(3)
@pytest.mark.parametrize("name", ALL)
def test_both_refuse_a_broken_shape(name: str) -> None:
    for what, root in broken(ALL[name]):
        assert not valid(typed(root), SCHEMA), f"the schema takes {what}"
        assert not reads(document(root)), f"the reader takes {what}"


def lost(text: str) -> Iterator[tuple[str, Mapping]]:
    """The case without one key."""
    for node, path in places(tree(text)):
        if isinstance(node, Mapping) and not is_named(path):
            for key in node.items:
                root, place = fresh(text, path)
                assert isinstance(place, Mapping)
                del place.items[key]
                yield f"{key} of {path}", root


@sampled(3)
@pytest.mark.parametrize("name", ALL)
def test_a_lost_key_that_the_schema_misses_is_refused_by_the_reader(name: str) -> None:
    for what, root in lost(ALL[name]):
        if not valid(typed(root), SCHEMA):
            assert not reads(document(root)), f"the schema alone refuses the case without {what}"


WORDS = [
    "unknown",
    "0",
    "-1",
    "1e3",
    "A",
    "3 kg",
    "cw",
    "true",
    "[1, 2]",
    "[A, B]",
    "{like: T}",
    "",
    "1,5",
    "N*m",
]


ROUNDS = 400 if FULL else 20


@sampled(3)
@pytest.mark.parametrize("name", ALL)
def test_what_the_schema_refuses_the_reader_refuses(name: str) -> None:
    """Values put at random in place of others (seeded)."""
    dice = random.Random(name)
    refused = 0
    for _ in range(ROUNDS):
        root = tree(ALL[name])
        node = dice.choice([found for found, _ in places(root)])
        value = tree(f"v: {dice.choice(WORDS)}").items["v"]
        if isinstance(node, Mapping):
            node.items[dice.choice(list(node.items))] = value
        elif node.items:
            node.items[dice.randrange(len(node.items))] = value
        if not valid(typed(root), SCHEMA):
            refused += 1
            assert not reads(document(root)), document(root)
    assert refused > ROUNDS // 8


SECTIONS = {
    "plane": {
        "icsolve": "1",
        "points": "{A: [0, 0], B: [1, 0]}",
        "joints": "[{pin: [1, 2], at: A}]",
        "loads": "{P: {force: 3, link: 2, at: B, angle: 90}, T: {torque: unknown, link: 2}}",
    },
    "space": {
        "icsolve": "1",
        "points": "{A: [0, 0, 0], B: [1, 0, 0]}",
        "joints": "[{weld: [1, 2], at: A}]",
        "loads": "{P: {force: 3, link: 2, at: B, along: z}}",
    },
}


@pytest.mark.parametrize("section", keys.SECTIONS)
@pytest.mark.parametrize("of", SECTIONS)
def test_every_section_is_read_or_refused(of: str, section: str) -> None:
    """What makes no sense under it never passes in silence."""
    assert reads("\n".join(f"{key}: {value}" for key, value in SECTIONS[of].items()))
    assert not reads("\n".join(f"{k}: {v}" for k, v in {**SECTIONS[of], section: "[[[]]]"}.items()))
