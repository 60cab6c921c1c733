"""Variables that only scale the loads: one solution serves all their values."""

from __future__ import annotations

from collections.abc import Mapping

from icsolve.case import Case, Load, Mark, Number
from icsolve.read.document import Mapping as Tree
from icsolve.read.document import Node, Scalar, Sequence, parse
from icsolve.read.formula import names_in, replaced
from icsolve.read.problems import Problems
from icsolve.sense import unit_of
from icsolve.units import converted, parse_unit, split_quantity

_KINDS = ("force", "torque", "weight", "mass", "spring")


class Magnitudes:
    """The numbers of loads in which variables stand; ``names`` are the variables that stand nowhere else."""

    def __init__(self, text: str, case: Case) -> None:
        root = parse(text, Problems(case.path))
        assert type(root) is Tree
        numbers = _load_numbers(root)
        self._texts = {name: node.text for name, node in numbers.items()}
        inside = {name for written in self._texts.values() for name in names_in(written)}
        self.names = frozenset(inside - _elsewhere(root, {node.mark for node in numbers.values()}))
        self._units = {load.name: unit_of(load, case) for load in case.loads if load.name in self._texts}
        self._written = [(load.name, number_of(load)) for load in case.loads]

    def loads(self, values: Mapping[str, str]) -> dict[str, float]:
        """The numbers of the loads that depend on variables, in case units."""
        found = {}
        for name, written in self._texts.items():
            parts = split_quantity(replaced(written, values))
            assert parts is not None
            numeral, unit = parts
            own = parse_unit(self._units[name])
            found[name] = converted(numeral, parse_unit(unit), own) if unit else float(numeral.digits)
        return found

    def factor(self, base: Mapping[str, str], values: Mapping[str, str]) -> float | None:
        """By what all known loads are larger than with other values; None where they do not grow alike."""
        old, new = self.loads(base), self.loads(values)
        ratios = set()
        for name, written in self._written:
            before = old.get(name, written)
            if before is None:
                continue
            after = new.get(name, before)
            if before == 0.0 or after == 0.0:
                return None
            ratios.add(after / before)
        return ratios.pop() if len(ratios) == 1 else None


def number_of(load: Load) -> float | None:
    """A load's own known number; 1 of a vector, which no variable scales."""
    value = getattr(load, "value", None)
    if isinstance(value, Number):
        return value.value
    return 1.0 if hasattr(load, "x") else None


def _load_numbers(root: Tree) -> dict[str, Scalar]:
    """The numbers of loads in which variables stand, as written."""
    section = root.items.get("loads")
    found = {}
    for name, node in section.items.items() if type(section) is Tree else ():
        for kind in _KINDS:
            value = node.items.get(kind) if type(node) is Tree else None
            if type(value) is Scalar and names_in(value.text):
                found[name] = value
    return found


def _elsewhere(root: Tree, within: set[Mark]) -> set[str]:
    """Variables that stand outside these places; titles and the like do not count."""
    free = ("title", "source", "reconstructed", "variables")
    found: set[str] = set()
    stack: list[Node] = [node for key, node in root.items.items() if key not in free]
    while stack:
        node = stack.pop()
        if type(node) is Scalar:
            found |= set() if node.mark in within else set(names_in(node.text))
        elif type(node) is Tree:
            stack.extend(node.items.values())
        elif type(node) is Sequence:
            stack.extend(node.items)
    return found
