"""What can be asked of a case: its unknown, or anything that ``expect`` can name."""

from __future__ import annotations

from icsolve.case import Case, LoadIs, Target
from icsolve.grade.keys import NoKeyError
from icsolve.power import is_unknown
from icsolve.read.problems import Problems
from icsolve.read.reading import Reading
from icsolve.read.targets import target_of


def unknowns(case: Case) -> tuple[str, ...]:
    """The unknown loads that a student can be asked for; those that are like another are left out."""
    return tuple(load.name for load in case.loads if is_unknown(load))


def asked_of(case: Case, what: str) -> Target:
    """The target of ``T12``, ``I24``, ``w4/w2``; of '' the only unknown.

    Raises NoKeyError, with a sentence, where it names nothing, or the case has not one unknown.
    """
    if not what:
        names = unknowns(case)
        if len(names) == 1:
            return LoadIs(names[0])
        if not names:
            raise NoKeyError(
                f"the case {case.name} has no unknown load; say what is asked, as in {case.name}:w4/w2"
            )
        asked = " or ".join(f"{case.name}:{name}" for name in names)
        raise NoKeyError(f"the case {case.name} has {len(names)} unknown loads; write {asked}")
    target = target_of(_reading(case), what, _points(case))
    if isinstance(target, str):
        raise NoKeyError(f"{case.name}: {target}")
    if isinstance(target, LoadIs) and target.load not in unknowns(case):
        raise NoKeyError(f"{case.name}: {what} is given in the case, not asked")
    return target


def canonical(case: Case, name: str, what: str) -> str:
    """The one name of a question."""
    names = unknowns(case)
    return name if not what or names == (what,) else f"{name}:{what}"


def _reading(case: Case) -> Reading:
    """What the reader of keys needs to know of a case."""
    reading = Reading(Problems(case.path), {}, {})
    reading.kinds = {load.name: "force" for load in case.loads}
    reading.links = dict.fromkeys(case.links, (1, 1))
    return reading


def _points(case: Case) -> set[str]:
    named = set(case.points) | {p for carried in case.carries.values() for p in carried}
    return {name for name in named if not name.startswith("@")}
