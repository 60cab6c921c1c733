"""Solve a case with profiles: its contacts are found, and then it is a case like any other."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from icsolve.answer import Answer, Deferred
from icsolve.case import Case
from icsolve.errors import SceneError, Status
from icsolve.profile.found import Touching, found
from icsolve.sentences import listed

WHY = "its contacts are found on profiles, of which no bound is proven"


def solve_touching(case: Case, **options: Any) -> Answer:
    """The answer of a case with profiles; ``options`` are those of `icsolve.solve`.

    Raises SceneError as `icsolve.solve`, and where no contact can be found.
    """
    from icsolve.solve import solve

    known = found(case)
    answer = solve(known.case, **options)
    return replace(
        answer,
        case=case,
        answers={name: value._replace(error=None, why=WHY) for name, value in answer.answers.items()},
        centres=Deferred(lambda: {pair: c._replace(error=None) for pair, c in answer.centres.items()}),
        errors={},
        sensitivities=Deferred(_no_sensitivities),
        skipped=tuple(name for name in answer.skipped if name not in known.used),
        notes=(*answer.notes, *(said for one in known.touching for said in _said(one))),
        touching=known.touching,
    )


def _no_sensitivities() -> dict[str, dict[str, float]]:
    raise SceneError(
        Status.UNSUPPORTED,
        "sensitivities and tolerance bands are not worked out where contacts come from profiles: give the "
        "contact its `at` and `normal`.",
    )


def _said(one: Touching) -> list[str]:
    x, y = one.at
    pressure = "" if one.pressure_angle is None else f", pressure angle {one.pressure_angle:.6g} deg"
    place = f"({x:.6g}, {y:.6g}), {_article(one.on)}, normal {one.normal:.6g} deg"
    said = f"links {listed(one.links)} touch at {place}{pressure}."
    return [said, one.note] if one.note else [said]


def _article(on: str) -> str:
    return f"on {'an' if on[0] in 'aeiou' else 'the' if on in ('circle', 'spline') else 'a'} {on}"
