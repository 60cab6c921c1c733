"""What is known while a file is read: problems, places, units, and the names met so far."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from icsolve.case import Coordinates, Mark
from icsolve.read.document import Mapping, Node, Scalar, Sequence, is_null
from icsolve.read.names import is_name, why_no_name
from icsolve.read.problems import Problems, nearest, shown, suggestion
from icsolve.read.syntax import missing_space
from icsolve.units import Unit

if TYPE_CHECKING:
    from icsolve.case.profiles import Touch

RESERVED: tuple[str, ...] = ()
"""Keys of later versions."""


class Reading:
    """The state of reading one case; sections read into values and leave here what others need.

    ``links`` are the links of the joints, in order of first mention, None where the joints can't be
    read at all; ``used`` the points that something needs, each with the place of its first use;
    ``given`` the points that coordinates, lengths, angles or guides involve (``measured``: lengths and
    angles, ``on_guides``: each guide), ``centroids`` those of others by their point; ``hidden`` the points
    that a load or centre gives by coordinates; ``kinds`` the kind of each load by its name. ``axes`` are
    those along which a force has components, ``couples`` those about which a couple has. ``profiled`` are the
    links under ``profile``, ``touches`` the contacts whose places the profiles give, ``noticed`` sentences on
    what may be a slip.
    """

    axes = "xy"
    couples = ""

    def __init__(self, problems: Problems, targets: dict[str, Unit], shown_units: dict[str, str]) -> None:
        self.problems = problems
        self.targets = targets
        self.shown_units = shown_units
        self.marks: dict[str, Mark] = {}
        self.links: dict[str, Mark] | None = None
        self.used: dict[str, Mark] = {}
        self.given: set[str] = set()
        self.measured: set[str] = set()
        self.on_guides: list[str] = []
        self.centroids: dict[str, tuple[str, ...]] = {}
        self.hidden: dict[str, Coordinates] = {}
        self.kinds: dict[str, str] = {}
        self.joint_number = 0
        self.profiled: set[str] = set()
        self.noticed: list[str] = []
        self.touches: list[tuple[Touch, Mark]] = []

    def refuse(self, mark: Mark, message: str) -> None:
        """Note a problem."""
        self.problems.refuse(mark, message)

    def mapping(self, node: Node, what: str, form: str) -> Mapping | None:
        """The node as a mapping; None, with the reason noted, where it is something else."""
        if type(node) is Mapping:
            return node
        if is_null(node):
            self.refuse(node.mark, f"{what} has no value; write {form}")
        elif type(node) is Scalar and missing_space(node.text.split(" ")[0]):
            said = f"{what} is read as one text, {shown(node.text)}"
            self.refuse(node.mark, f"{said}; write a space after each colon")
        else:
            self.refuse(node.mark, f"{what} should be a mapping, {form}")
        return None

    def name(self, node: Node, what: str) -> str | None:
        """The node's text as a name."""
        if type(node) is not Scalar:
            self.refuse(node.mark, f"{what} should be one name")
        elif is_null(node) or not node.text:
            self.refuse(node.mark, f"{what} has no value")
        elif not is_name(node.text):
            self.refuse(node.mark, f"{shown(node.text)} is not a name: {why_no_name(node.text)}")
        else:
            return node.text
        return None

    def point(self, node: Node, what: str) -> str | None:
        """The name of a point that is needed; that something gives it is checked at the end."""
        name = self.name(node, what)
        if name is not None:
            self.used.setdefault(name, node.mark)
        return name

    def link(self, node: Node, what: str) -> str | None:
        """The name of a link that a joint has."""
        name = self.name(node, what)
        if name is None or self.knows_link(name):
            return name
        self.refuse(node.mark, f"no joint has a link '{name}'{suggestion(name, self.links or ())}")
        return None

    def knows_link(self, name: str) -> bool:
        """Whether a joint has that link; True where the joints could not be read."""
        return self.links is None or name in self.links

    def names(self, node: Node, what: str, form: str) -> list[Scalar] | None:
        """The items of a list of names, checked as names."""
        if type(node) is not Sequence:
            self.refuse(node.mark, f"{what} should be a list, as in {form}")
            return None
        good = [item for item in node.items if self.name(item, f"each of {what}") is not None]
        return [item for item in good if type(item) is Scalar] if len(good) == len(node.items) else None

    def check_keys(self, node: Mapping, allowed: Iterable[str], what: str) -> None:
        """Refuse keys that have no meaning here; what is likely meant is taken as said."""
        for key in list(node.items):
            if key not in allowed:
                self.unknown_key(key, node.keys[key], allowed, what)
                self.take_for(node, key, allowed)

    def take_for(self, node: Mapping, key: str, allowed: Iterable[str]) -> None:
        """Put the value of a strange key under the one that is likely meant."""
        meant = nearest(key, allowed)
        if meant and meant not in node.items:
            node.items[meant], node.keys[meant] = node.items[key], node.keys[key]

    def unknown_key(self, key: str, mark: Mark, allowed: Iterable[str], what: str) -> None:
        """Refuse a key: not yet supported, or unknown, with a suggestion."""
        if key in RESERVED:
            self.refuse(mark, f"'{key}' is not yet supported")
        else:
            self.refuse(mark, f"{what} has no key {shown(key)}{suggestion(key, allowed)}")

    def text(self, node: Node, what: str) -> str:
        """Free text: a title, a source."""
        if type(node) is not Scalar:
            self.refuse(node.mark, f"{what} should be a text")
            return ""
        if not node.text.replace("\n", " ").isprintable():
            self.refuse(node.mark, f"{what} has a control character; delete it")
        return node.text.strip()
