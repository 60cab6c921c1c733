"""The numbers of a case by their paths, and the case with some of them replaced."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from typing import Any

from icsolve.case import Case, Number, is_angle
from icsolve.errors import CaseError, Problem, SceneError, Status
from icsolve.read.names import joint_names, parts, shown, suggestion
from icsolve.read.settings import like
from icsolve.scene.sensitivity import number_at, numbers_of, parts_of
from icsolve.tuples import replace

_SECTIONS = ("points", "lengths", "angles", "joints", "profile", "loads", "motion", "gravity", "links")


def with_numbers(case: Case, values: Mapping[str, float | Number]) -> Case:
    """The case with other numbers at some paths, each as if written so (exact).

    Parameters
    ----------
    values : by path, in its canonical form (`find_number`), numbers in case units, degrees; a path that the
        case does not have is passed over
    """
    if not values:
        return case
    held = [name for name, numbers in parts_of(case).items() if not numbers.keys().isdisjoint(values)]
    return replace(case, **{name: _changed(getattr(case, name), values) for name in held}) if held else case


def _changed(value: Any, values: Mapping[str, float | Number]) -> Any:
    """A part of a case with other numbers."""
    if isinstance(value, Number):
        new = values.get(value.path)
        if new is None or isinstance(new, Number):
            return new or value
        return value._replace(value=new, half=0.0, digits=repr(new), factor=1.0, exact=None)
    if isinstance(value, dict):
        return {key: _changed(item, values) for key, item in value.items()}
    if isinstance(value, tuple):
        items = [_changed(item, values) for item in value]
        return type(value)(*items) if hasattr(value, "_fields") else tuple(items)
    return value


IN_SPACE = (
    "only a planar mechanism is swept or has a stability, and this case is in space: its points have three "
    "coordinates. Solve it position by position, with --set."
)


def refuse_space(case: Case) -> None:
    """Refuse a case in space, whatever is to be varied."""
    if case.space is not None:
        raise SceneError(Status.UNSUPPORTED, IN_SPACE)


def find_number(case: Case, path: str, refused: str = "cannot vary") -> Number:
    """The number at a path, in any of the ways in which it can be written (``lengths.BA`` for
    ``lengths.AB``). ``refused`` begins what is said where there is none.

    Raises
    ------
    CaseError
        Where there is none, with what may have been meant, or several.
    SceneError
        Where the case is in space.
    """
    refuse_space(case)
    with suppress(KeyError):
        return number_at(case, path)
    known = numbers_of(case)
    section, _, rest = path.partition(".")
    found = [number for own, number in known.items() if _means(case, own, section, rest)]
    if len(found) == 1:
        return found[0]
    if found:
        lines = " or ".join(number.path for number in found)
        why = f"{len(found)} numbers are meant by it; write {lines}"
    else:
        why = _missing(case, known, path, section, rest)
    line, column = case.marks.get(section, (1, 1))
    raise CaseError([Problem(case.path, line, column, f"{refused} {shown(path)}: {why}")])


def _means(case: Case, own: str, section: str, rest: str) -> bool:
    """Whether a path in other words is this number's: ``BA`` for a length ``AB``, a joint by its point."""
    head, _, tail = own.partition(".")
    if head != section:
        return False
    if section in ("lengths", "angles"):
        asked, given = parts(rest), parts(tail)
        return asked == given or (section == "lengths" and asked == given[::-1])
    if (
        section == "joints"
        and tail.count(".") == 2
        and tail.partition(".")[0] in (r.name for r in case.ropes)
    ):
        label, key, point = tail.split(".")
        keys = (key, key.replace("radii", "radius"))
        return rest in {way for one in keys for way in (f"{point}.{one}", f"{label}.{one}.{point}")}
    if section == "joints":
        (name, _, key), (label, _, own_key) = rest.partition("."), tail.partition(".")
        plain = label.partition("#")[0]
        names = [joint_names(joint.links, joint.at) for joint in case.joints]
        names += [joint_names(touch.links, None) for touch in case.touches]
        return key == own_key and any(plain in called and name in called for called in names)
    return False


def points_of(path: str) -> tuple[str, ...]:
    """The points that the path of a number of the figure names."""
    section, _, rest = path.partition(".")
    return (rest.partition(".")[0],) if section == "points" else parts(rest)


def _missing(case: Case, known: Mapping[str, Number], path: str, section: str, rest: str) -> str:
    """Why there is no number at a path."""
    if any(section == "variables" and variable.name == rest for variable in case.variables):
        return f"it is put in before the case is read; vary a number in which ${rest} stands, as loads.P"
    if section not in _SECTIONS:
        return like(path, known)
    if section == "angles":
        turned = [own for own in known if is_angle(own) and parts(own[7:]) == parts(rest)[::-1]]
        if turned:
            return f"the case gives {turned[0]}, which is another angle; vary that"
    if section == "loads" and any(load.name == rest for load in case.loads):
        load = next(load for load in case.loads if load.name == rest)
        several = [own for own in (f"{path}.{part}" for part in "xy01") if own in known]
        if several:
            return f"{rest} has several numbers; vary {' or '.join(several)}"
        how = "is the unknown" if getattr(load, "value", None) is None else "is like another load"
        return f"{rest} {how}, so it has no number to vary"
    alike = [own for own in known if own.startswith(f"{section}.")]
    return f"the case has no number there{suggestion(path, alike)}"


__all__ = ["find_number", "number_at", "numbers_of", "points_of", "refuse_space", "with_numbers"]
