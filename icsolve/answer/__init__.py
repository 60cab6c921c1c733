"""The answer of a scene: frozen values, and the object that ``--json`` prints."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, overload

from icsolve.case import Case, Pair, is_named
from icsolve.errors import SceneError
from icsolve.tuples import NamedTuple, TypeVar, cached_property, dataclass, field

if TYPE_CHECKING:
    from icsolve.answer.bodies import FrictionFound, Reactions, Spatial, Tension, Touching, Witness
    from icsolve.answer.equilibrium import EquilibriumPosition, Stiffness


class Found(NamedTuple):
    """The value of an unknown load, in case units.

    ``sense`` is in words (``ccw``, ``at 210 deg``, ``pull``; empty for a zero). ``error`` bounds
    the absolute rounding error; None where no bound is proven, and ``why`` says so.
    """

    value: float
    unit: str
    sense: str
    error: float | None = None
    why: str = ""
    holds: tuple[float, float] | None = None
    """with friction and no motion: the range in which it holds; infinite where no value moves it"""
    self_locking: bool = False
    components: tuple[float, float] | None = None
    """of a force of unknown direction, whose ``value`` is its size"""

    @property
    def direction(self) -> float | None:
        """Where a force of unknown direction acts, degrees in [0, 360)."""
        if self.components is None:
            return None
        return math.degrees(math.atan2(self.components[1], self.components[0])) % 360.0


def by_load(answers: Mapping[str, Found]) -> dict[str, Found]:
    """The same by the loads of the case: of a force of unknown direction, ``P.x`` and ``P.y``."""
    found: dict[str, Found] = {}
    for name, one in answers.items():
        if one.components is None:
            found[name] = one
            continue
        for axis, value, degrees in zip("xy", one.components, (0, 90), strict=True):
            sense = f"at {degrees + (0 if value > 0.0 else 180)} deg" if value else ""
            found[f"{name}.{axis}"] = one._replace(value=value, sense=sense, components=None)
    return found


class Centre(NamedTuple):
    """A relative instant centre.

    ``kind`` is ``at`` (``place`` has x and y in case units), ``toward`` (at infinity; ``place`` has
    the direction in degrees, in [0, 180)), ``undefined`` or ``undetermined`` (``why`` says why).
    ``by`` is how it was found: ``inspection`` (a joint), ``given``, ``construction`` (Kennedy, by the
    two ``lines``) or ``loop equations``. Each line is named by the centres it joins, or by the
    joint whose common normal it is (one pair).
    """

    pair: Pair
    kind: str
    place: tuple[float, ...] = ()
    by: str = ""
    lines: tuple[tuple[Pair, ...], ...] = ()
    why: str = ""
    error: float | None = None


class Term(NamedTuple):
    """One term of the power equation, for the motion in which the equation is printed.

    ``factor`` is power per unit of the load (its velocity or angular velocity ratio), in case
    units; ``value`` the load (None for the unknown before it was found); ``power`` their product.
    ``words`` names link, point and what the factor is.
    """

    load: str
    link: str
    value: float
    unit: str
    factor: float
    power: float
    unknown: bool
    words: str


K = TypeVar("K")
V = TypeVar("V")


class Refused(NamedTuple):
    """What cannot be made."""

    refusal: SceneError

    def __call__(self) -> Any:
        """Say why."""
        raise self.refusal


class Deferred(Mapping[K, V]):
    """A mapping that is made when it is first looked into: what nobody reads costs nothing."""

    def __init__(self, make: Callable[[], Mapping[K, V]]) -> None:
        self._make = make

    @cached_property
    def _made(self) -> Mapping[K, V]:
        try:
            return self._make()
        except KeyError as fault:  # which `in` and `get` would take for a key that is not there
            raise RuntimeError(f"what was put off failed: {fault!r}") from fault

    def __getitem__(self, key: K) -> V:
        return self._made[key]

    def __iter__(self) -> Iterator[K]:
        return iter(self._made)

    def __len__(self) -> int:
        return len(self._made)

    def __repr__(self) -> str:
        return repr(self._made)

    def __reduce__(self) -> tuple[type, tuple[object]]:
        """What is sent to another process is made, or refused there as it would be here."""
        try:
            return dict, (dict(self._made),)
        except SceneError as refusal:
            return Deferred, (Refused(refusal),)


class Later(Sequence[V]):
    """A sequence that is made when it is first looked into."""

    def __init__(self, make: Callable[[], Sequence[V]]) -> None:
        self._make = make

    @cached_property
    def _made(self) -> Sequence[V]:
        return self._make()

    @overload
    def __getitem__(self, index: int) -> V: ...

    @overload
    def __getitem__(self, index: slice) -> Sequence[V]: ...

    def __getitem__(self, index: int | slice) -> V | Sequence[V]:
        return self._made[index]

    def __len__(self) -> int:
        return len(self._made)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and tuple(self) == tuple(other)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return repr(self._made)

    def __reduce__(self) -> tuple[type, tuple[tuple[V, ...]]]:
        """What is sent to another process is made."""
        return tuple, (tuple(self._made),)


class AboutToMove(NamedTuple):
    """An end of a range in which friction holds: the answer as of a given motion, with its reactions, and
    ``way``, 1.0 where that is the motion in which rates are told, -1.0 where it is the opposite one."""

    way: float
    answer: Answer


@dataclass(frozen=True, eq=False, repr=False)
class Answer:
    """All that was found of one case.

    ``points`` are in case units; ``rates`` in rad/s (or scaled, see the format) and ``velocities``
    in length units a second, both None unless asked; a string in them says why it is undetermined.
    ``notes`` are sentences for the reader; ``skipped`` what was not examined; ``steps`` names the
    steps of the plan that ran.
    """

    case: Case
    answers: Mapping[str, Found] = field(default_factory=dict)
    centres: Mapping[Pair, Centre] = field(default_factory=dict)
    rates: dict[str, float | str] | None = None
    velocities: Mapping[tuple[str, str], tuple[float, float] | str] | None = None
    accelerations: Mapping[tuple[str, str], tuple[float, float] | str] | None = None
    """of points on links, case length/s^2, where inertia forces are among the loads; None else"""
    angular_accelerations: Mapping[str, float | str] | None = None
    """of links, rad/s^2"""
    points: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    terms: Sequence[Term] = ()
    advantage: float | None = None
    """unknown / known where there is one of each: the mechanical advantage (or its like)"""
    mobility: int | None = None
    notes: Sequence[str] = ()
    skipped: Sequence[str] = ()
    steps: Sequence[str] = ()
    errors: Mapping[str, Mapping[Any, Any]] = field(default_factory=dict)
    """bounds on the errors of ``points``, ``rates``, ``velocities``, ``accelerations`` and
    ``angular_accelerations``, by kind and in the shape of these; those of centres stand with them"""
    sensitivities: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    """derivative of every unknown load by every number of the case, by its path"""
    status: str = "ok"
    reactions: Reactions | None = None
    """the force of each link on each other, by the names of the format; None unless asked"""
    tensions: tuple[Tension, ...] = ()
    """the pulls of ropes, where reactions were asked"""
    witnesses: tuple[Witness, ...] = ()
    """the unknown loads by power and by free bodies, where reactions were asked"""
    friction: FrictionFound | None = None
    about_to_move: Sequence[AboutToMove] = ()
    """the ends of a range in which friction holds, at which it begins to move; they stay in their process"""
    touching: tuple[Touching, ...] = ()
    """the contacts that profiles gave"""
    positions: tuple[EquilibriumPosition, ...] | None = None
    """where it rests, of a case with an unknown datum of the figure; None of any other"""
    stability: str | None = None
    """of the position as written, where it was asked; with its stiffness, or why there is none"""
    stiffness: Stiffness | None = None
    why_no_stiffness: str = ""
    spatial: Spatial | None = None
    """reactions and points of a case in space, which has no others"""
    holds_still: bool | None = None
    """whether friction holds loads that are all known; None of others, and where that is open"""
    scene: object = None
    """the solved scene, which `scene_of` has for pictures and explanations; it stays in its own process"""

    def __repr__(self) -> str:
        """The unknown loads; the fields of a whole answer would fill a page."""
        found = [f"{name} = {one.holds or one.value} {one.unit}" for name, one in self.answers.items()]
        return f"<Answer {self.case.name}: {', '.join(found) or self.status}>"

    @property
    def shown_points(self) -> dict[str, tuple[float, float]]:
        """The points that have a name in the case."""
        return {name: place for name, place in self.points.items() if is_named(name)}

    def __getstate__(self) -> dict[str, Any]:
        """What is sent to another process."""
        return {**self.__dict__, "scene": None, "about_to_move": ()}

    def to_dict(self) -> dict[str, Any]:
        """The JSON object of the format (``icsolve/solve/1``)."""
        from icsolve.answer.as_json import to_dict

        return to_dict(self)
