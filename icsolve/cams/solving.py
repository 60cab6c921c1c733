"""Solve a case with profiles: its contacts are found, and then it is a case like any other."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from icsolve.answer import Answer, Deferred
from icsolve.answer.bodies import Reactions, Touching, names_of
from icsolve.cams.contact_search import found
from icsolve.cams.words import contact_said
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.tuples import replace

WHY = (
    "it is not shown that the profile is touched where it was found to be: at a corner, or where pieces meet"
)


def solve_touching(case: Case, solve: Callable[..., Answer], **options: Any) -> Answer:
    """The answer of a case with profiles: ``solve``, with these options, finds that of given contacts.

    Raises SceneError as `icsolve.solve`, and where no contact can be found.
    """
    known = found(case, enclosed=bool(options.get("bound")))
    options = {**options, "bound": known.enclosed}
    answer, reactions = _solved(known.case, solve, options)
    touching = tuple(pressed(one, known.case, reactions) for one in known.touching)
    if not known.enclosed:
        answer = _unbounded(answer)
    return replace(
        answer,
        case=case,
        sensitivities=Deferred(_no_sensitivities),
        skipped=tuple(name for name in answer.skipped if name not in known.used),
        notes=(*answer.notes, *_notes(touching)),
        touching=touching,
        reactions=_with_pressure_angles(answer.reactions, known.case, touching),
    )


def _unbounded(answer: Answer) -> Answer:
    """An answer without the errors of its numbers."""
    return replace(
        answer,
        answers={name: value._replace(error=None, why=WHY) for name, value in answer.answers.items()},
        centres=Deferred(lambda: {pair: c._replace(error=None) for pair, c in answer.centres.items()}),
        errors={},
    )


def placed(case: Case) -> Case:
    """A case whose contacts are where its profiles put them; the same case where it has no profiles, or where
    they place none."""
    if not case.touches:
        return case
    try:
        return found(case).case
    except SceneError:
        return case


def _solved(
    case: Case, solve: Callable[..., Answer], options: Mapping[str, Any]
) -> tuple[Answer, Reactions | None]:
    """The answer, and the reactions, which tell whether a contact pulls, where there are any."""
    if options.get("reactions"):
        answer = solve(case, **options)
        return answer, answer.reactions
    try:
        answer = solve(case, **{**options, "reactions": True})
    except SceneError:
        return solve(case, **options), None
    return replace(answer, reactions=None, tensions=(), witnesses=()), answer.reactions


def pressed(one: Touching, case: Case, reactions: Reactions | None) -> Touching:
    """A contact with its normal force, where the reactions determine it."""
    if reactions is None:
        return one
    name = _name(one, case, reactions)
    force = dict(reactions[name].parts).get("normal") if name else None
    return one._replace(force=force, lost=force is not None and force < 0.0)


def _name(one: Touching, case: Case, reactions: Reactions) -> str | None:
    """The name of the force in a contact, of whichever link on the other; None where there is none."""
    hidden = next(joint.at or "" for joint in case.joints if joint.only_pushes and joint.links == one.links)
    a, b = one.links
    names = (*names_of(a, b, hidden), *names_of(b, a, hidden))
    return next((name for name in names if name in reactions), None)


def _with_pressure_angles(
    reactions: Reactions | None, case: Case, touching: tuple[Touching, ...]
) -> Reactions | None:
    """The reactions with each contact's own pressure angle: of a roller, that of its centre."""
    if reactions is None:
        return None
    found = Reactions(reactions)
    for one in touching:
        if name := _name(one, case, reactions):
            angle = () if one.pressure_angle is None else (("pressure angle", one.pressure_angle),)
            others = tuple(part for part in found[name].parts if part[0] != "pressure angle")
            found[name] = found[name]._replace(parts=(*others, *angle))
    return found


def _notes(touching: tuple[Touching, ...]) -> tuple[str, ...]:
    """What is said of the contacts."""
    return (*map(contact_said, touching), *(one.note for one in touching if one.note))


def _no_sensitivities() -> dict[str, dict[str, float]]:
    raise SceneError(
        Status.UNSUPPORTED,
        "sensitivities and tolerance bands are not worked out where contacts come from profiles: give the "
        "contact its `at` and `normal`.",
    )
