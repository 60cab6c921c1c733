"""One number of a case replaced before it is read: ``angles.AB`` = 30."""

from __future__ import annotations

from collections.abc import Iterable
from collections.abc import Mapping as Named

from icsolve.case import Mark
from icsolve.read.document import Mapping, Node, Scalar, Sequence
from icsolve.read.joints import JOINTS, NAMES, unlike
from icsolve.read.keys import LOADS
from icsolve.read.names import Problems, joint_names, parts, shown, suggestion

PATH_FORM = "a path is like angles.AB, lengths.AB, points.D.x, loads.P, loads.P.angle or joints.B.mu"
"""How the number at a path is written, here and where one is varied."""


def like(path: str, known: Iterable[str]) -> str:
    """What a path is like; and those that are meant, which end so or are nearly the same."""
    there = list(known)
    ended = " or ".join(f"'{one}'" for one in there if one.endswith(f".{path}"))
    return PATH_FORM + (f"; did you mean {ended}?" if ended else suggestion(path, there))


_SECTIONS = ("points", "lengths", "angles", "near", "loads", "joints", "profile", "motion", "links")


def apply(root: Mapping, settings: Named[str, str | float], problems: Problems) -> None:
    """Put each value at its path in the tree; a path that the case does not have is refused."""
    for path, value in settings.items():
        try:
            text = value if isinstance(value, str) else repr(float(value))
        except (TypeError, ValueError):
            kind = type(value).__name__
            problems.refuse((1, 1), f"cannot set {shown(path)}: a value is a number or a text, not a {kind}")
            continue
        except OverflowError:
            problems.refuse((1, 1), f"cannot set {shown(path)}: the number is larger than any double")
            continue
        if text != "unknown":
            _forget(root, path)
        wrong = _set(root, path, text)
        if wrong:
            section = root.keys.get(path.partition(".")[0])
            problems.refuse(section or (1, 1), f"cannot set {shown(path)}: {wrong}")


def _forget(root: Mapping, path: str) -> None:
    """Leave out what is expected of a datum that is no longer to find."""
    section, _, name = path.partition(".")
    expected, data = root.items.get("expect"), root.items.get(section)
    if section not in ("angles", "lengths") or type(expected) is not Mapping or type(data) is not Mapping:
        return
    old = data.items.get(_key(data, section, name) or "")
    if type(old) is Mapping or (type(old) is Scalar and old.text == "unknown"):
        for key in [key for key in expected.items if key.startswith(f"{section}.")]:
            if _key(data, section, key.partition(".")[2]) == _key(data, section, name):
                del expected.items[key], expected.keys[key]


def _set(root: Mapping, path: str, text: str) -> str:
    """What is wrong with the path; '' where the value is set."""
    section, *steps = path.split(".")
    if section == "gravity" and not steps:
        return _put(root, "gravity", text)
    if section not in _SECTIONS:
        sections = {name: root.items.get(name) for name in _SECTIONS}
        return like(path, (f"{s}.{k}" for s, n in sections.items() if type(n) is Mapping for k in n.items))
    node = root.items.get(section)
    if node is None:
        return f"the case has no '{section}'"
    if section == "motion":
        return _of_motion(node, steps, text)
    if not steps:
        return PATH_FORM
    if section == "joints":
        return _of_joint(node, steps, text)
    if type(node) is not Mapping:
        return f"'{section}' is not a mapping"
    if section == "profile":
        return _of_profile(node, steps, text)
    return _of_named(node, section, steps, text)


def _put(mapping: Mapping, key: str, text: str) -> str:
    """Replace or add a value; a list or mapping is not replaced by one number."""
    mark: Mark = mapping.keys.get(key, mapping.mark)
    old = mapping.items.get(key)
    if type(old) is Sequence:
        return "there is a list there, not one number"
    mapping.keys.setdefault(key, mark)
    mapping.items[key] = Scalar(text, True, old.mark if old is not None else mark)
    return ""


def _of_named(section: Mapping, name: str, steps: list[str], text: str) -> str:
    key = _key(section, name, steps[0])
    if key is None:
        return _missing(section, name, steps[0])
    node = section.items[key]
    if name in ("points", "near"):
        return _axis(node, steps[1:], text, f"{name}.{key}")
    if name == "loads":
        return _of_load(node, steps[1:], text, f"{name}.{key}")
    if name == "links":
        if type(node) is Mapping and steps[1:] in (["mass"], ["inertia"]):
            return _put(node, steps[1], text)
        return f"a mass is set as links.{key}.mass, a moment of inertia as links.{key}.inertia"
    return _put(section, key, text) if len(steps) == 1 else PATH_FORM


def _missing(section: Mapping, name: str, key: str) -> str:
    turned = _same(section, parts(key)[::-1]) if name == "angles" else None
    if turned is not None:
        return f"the case gives the angle {turned}, which is not {key}; set angles.{turned}"
    return f"the case has no {key} under '{name}'{suggestion(key, section.items)}"


def _key(section: Mapping, name: str, key: str) -> str | None:
    """The key as the file writes it: ``A-B`` for ``AB``, and of a length also ``BA``."""
    if key in section.items or name not in ("lengths", "angles"):
        return key if key in section.items else None
    names = parts(key)
    found = _same(section, names)
    return found or (_same(section, names[::-1]) if name == "lengths" else None)


def _same(section: Mapping, names: tuple[str, ...]) -> str | None:
    return next((key for key in section.items if parts(key) == names), None)


def _axis(node: Node, steps: list[str], text: str, path: str) -> str:
    if type(node) is not Sequence or len(node.items) not in (2, 3):
        return "it is not given by its coordinates"
    axes = "xyz"[: len(node.items)]
    if len(steps) != 1 or steps[0] not in tuple(axes):
        return f"a coordinate is set as {' or '.join(f'{path}.{axis}' for axis in axes)}"
    index = axes.index(steps[0])
    node.items[index] = Scalar(text, True, node.items[index].mark)
    return ""


def _of_load(node: Node, steps: list[str], text: str, path: str) -> str:
    if type(node) is not Mapping:
        return "the load is not a mapping"
    kind = next((key for key in LOADS if key in node.items), None)
    if kind is None:
        return "the load has no number"
    value = node.items[kind]
    if not steps:
        return _put(node, kind, text)
    if type(value) is Mapping and steps == ["times"]:
        return _put(value, "times", text)
    if type(value) is Sequence and steps in (["0"], ["1"]):  # the two ends of a load per length
        steps = ["xy"[int(steps[0])]]
    if type(value) is Sequence and steps in (["x"], ["y"], ["z"]):
        return _axis(value, steps, text, path)
    if steps[0] in ("at", "slope", "to", "along") and steps[0] in node.items and len(steps) == 2:
        return _axis(node.items[steps[0]], steps[1:], text, f"{path}.{steps[0]}")
    return (
        _put(node, steps[0], text)
        if len(steps) == 1 and steps[0] not in LOADS
        else f"{PATH_FORM}; did you mean '{path}'?"
    )


def _inside(node: Node | None, step: str) -> Node | None:
    """What stands under a key, or at a place of a list."""
    if type(node) is Mapping:
        return node.items.get(step)
    place = int(step[:6]) if step.isascii() and step.isdigit() else -1
    return node.items[place] if type(node) is Sequence and 0 <= place < len(node.items) else None


def _of_profile(section: Mapping, steps: list[str], text: str) -> str:
    """A number of a profile: its radius or direction, one of an arc, a radius of a table."""
    link, *rest = steps
    node: Node | None = section.items.get(link)
    if node is None:
        return f"the case has no profile of link {link}{suggestion(link, section.items)}"
    if rest[:1] == ["radii"]:
        rest = ["radii", ".".join(rest[1:])]
    *way, last = rest or [""]
    for step in way:
        node = _inside(node, step)
    numbers = [key for key in node.items if key != "turns"] if type(node) is Mapping else []
    if type(node) is not Mapping or last not in numbers:
        return f"a number of a profile is set as profile.2.radius{suggestion(last, numbers)}"
    return _put(node, last, text)


def _of_motion(node: Node, steps: list[str], text: str) -> str:
    own = _inside(node, steps[0]) if type(node) is Sequence and len(steps) == 2 else node
    if type(own) is Mapping and len(steps) == (1 if own is node else 2):
        return _put(own, steps[-1], text)
    return "a motion is set as motion.speed, or of several as motion.0.speed"


def _of_joint(node: Node, steps: list[str], text: str) -> str:
    joints = [item for item in node.items if type(item) is Mapping] if type(node) is Sequence else []
    found = [joint for joint in joints if steps[0].partition("#")[0] in _labels(joint)]
    apart = dict(zip(_told_apart(found), found, strict=True))
    if "#" in steps[0]:
        found = [apart[steps[0]]] if steps[0] in apart else []
    ropes = _of_ropes(joints, steps)
    others = [joint for joint in found if "rope" not in joint.items]
    if ropes and not any(steps[1] in joint.items for joint in others):
        if len(ropes) > 1:
            names = " or ".join(f"joints.{label}.{steps[1]}.{steps[0]}" for label in ropes)
            return f"{len(ropes)} ropes run through {steps[0]}; write {names}"
        ((numbers, point),) = ropes.values()
        return _put(numbers, point, text)
    if len(steps) == 3 and steps[1] == "at":  # of a known centre
        placed = [joint for joint in found if type(joint.items.get("at")) is Sequence]
        if len(placed) == 1:
            return _axis(placed[0].items["at"], steps[2:], text, f"joints.{steps[0]}.at")
    place = steps.pop() if len(steps) == 3 and steps[2] in ("0", "1") else ""  # of two teeth, two radii
    if len(steps) != 2:
        return "a number of a joint is set as joints.B.mu, with the point at which the joint stands"
    if not found:
        return f"no joint stands at {steps[0]}{suggestion(steps[0], [k for j in joints for k in _labels(j)])}"
    found = _of_that_key(found, steps[1])
    if len(found) > 1 and apart.get(steps[0]) in found:
        found = [apart[steps[0]]]
    if len(found) > 1:
        names = " or ".join(f"joints.{label}.{steps[1]}" for label, joint in apart.items() if joint in found)
        return f"{len(found)} joints stand at {steps[0]}; write {names}"
    both = found[0].items.get(steps[1])
    if place and type(both) is Sequence and int(place) < len(both.items):
        both.items[int(place)] = Scalar(text, True, both.items[int(place)].mark)
        return ""
    return _put(found[0], steps[1], text)


def _of_ropes(joints: list[Mapping], steps: list[str]) -> dict[str, tuple[Mapping, str]]:
    """Where ropes, by what each is called, have a number of a point: ``A-O-C.mu.O``, or ``O.mu``; its
    ``radius`` among the radii."""
    if len(steps) not in (2, 3):
        return {}
    name, key, point = steps if len(steps) == 3 else ("", steps[1], steps[0])
    ropes = [joint for joint in joints if "rope" in joint.items]
    found = {}
    for joint, label in zip(ropes, _told_apart(ropes), strict=True):
        own = joint.items.get("radii" if key == "radius" else key)
        if type(own) is Mapping and point in own.items and name in ("", label):
            found[label] = (own, point)
    return found


def _told_apart(joints: list[Mapping]) -> list[str]:
    """What each of several joints is called alone: ``2-3@B#2`` is the second of two of one name."""
    labels: list[str] = []
    for joint in joints:
        labels.append(unlike(_labels(joint)[-1], labels))
    return labels


def _of_that_key(joints: list[Mapping], key: str) -> list[Mapping]:
    """Of several joints at a point, those that have the key, or at least are of a kind that takes it."""
    having = [joint for joint in joints if key in joint.items]
    taking = [
        joint for joint in joints if any(key in JOINTS[kind].keys for kind in joint.items if kind in JOINTS)
    ]
    return having or taking or joints


def _labels(joint: Mapping) -> list[str]:
    """By what a joint can be called."""
    at = joint.items.get("at")
    kind = next((key for key in joint.items if key in NAMES), "")
    links = joint.items.get(kind)
    names = [item.text for item in links.items if type(item) is Scalar] if type(links) is Sequence else []
    return joint_names(names, at.text if type(at) is Scalar else None)
