"""The table of keys: what may stand in a case, of what form, and what it means.

The reader reads each entry by it (form, dimension, bound, what ties its keys) and words its refusals by it;
the JSON Schema is written from it, and the paths of ``--set`` follow it.
"""

from __future__ import annotations

from icsolve.tuples import NamedTuple


class Key(NamedTuple):
    """One key: what it means (the end of "needs 'at': ..."), of which form, and whether it must stand there.

    ``form`` is a name of `icsolve.read.schema.FORMS`; ``dimension`` and ``bound`` are those of its number.
    """

    says: str
    form: str = "name"
    needed: bool = False
    dimension: str = ""
    bound: str = ""


class Rule(NamedTuple):
    """What ties keys of one entry to one another, and what is said where that is broken.

    ``needs``: where the first stands, so do the others. ``one``, ``at most one``, ``any``: how many stand
    there. ``direction``: one of them; none where the entry's own key has components. Without ``says`` the key
    that is missing is told with its meaning.
    """

    kind: str
    keys: tuple[str, ...]
    says: str = ""


class EntryKind(NamedTuple):
    """One kind of joint, load or profile: its own key, and those that it takes besides."""

    says: str
    own: Key
    keys: dict[str, Key]
    instead: str = ""
    """of a joint that only the plane has: what stands for it in space"""
    key: str = ""
    """its own key, where that is not the kind's name"""
    ties: tuple[Rule, ...] = ()
    """what ties its keys to one another"""


def needed(key: Key, says: str = "") -> Key:
    """The same key where it must stand there."""
    return key._replace(needed=True, says=says or key.says)


def quantity_key(says: str, dimension: str, bound: str = "") -> Key:
    """The key of a number of a dimension, which may be left out."""
    return Key(says, "number" if dimension == "number" else "quantity", False, dimension, bound)


SECTIONS = {
    "icsolve": Key("the version of the format, 1", "version", True),
    "title": Key("what the mechanism is", "text"),
    "source": Key("where the problem stands: book, chapter, figure", "text"),
    "reconstructed": Key("what was not given and had to be reconstructed; shown to every reader", "text"),
    "units": Key("what bare numbers are in, m and N by default, as in {length: in, force: lbf}", "units"),
    "ground": Key("the link that is the frame, where that is not link 1"),
    "gravity": Key("9.81 m/s^2 by default, along -y", "gravity", False, "acceleration", "not negative"),
    "points": Key("coordinates by point, as in {A: [0, 0]}", "points"),
    "lengths": Key("the distance between two points, as in {AB: 1}", "lengths"),
    "angles": Key("directions of pairs and angles at the middle of triples, as in {AB: 60}", "angles"),
    "near": Key("roughly where points lie: picks the way to assemble, as in {C: [3.5, 2.4]}", "near"),
    "links": Key(
        "further points that links carry, and masses, as in {3: [G, H]} or {3: {mass: 2 kg, centre: G}}",
        "links section",
    ),
    "joints": Key("what joins the links, a list as in [{pin: [1, 2], at: A}]", "joints", True),
    "loads": Key("forces and torques, as in {P: {force: 100, link: 4, at: E, angle: 180}}", "loads"),
    "profile": Key(
        "shapes of cams and followers, as in {2: {circle: C, radius: 40}, 3: {flat: G, along: 0}}", "profile"
    ),
    "motion": Key("a given motion, as in {link: 2, speed: 12 rad/s}, where rates are asked", "motion"),
    "dynamic": Key("whether the inertia forces of the motion are among the loads: yes or no", "truth"),
    "expect": Key("published values, as in {T12: 29.67 ccw}", "expect"),
    "tolerance": Key("how far a student's answer may lie: 1%, 3 sf, 0.5 N, {drawing: 0.02 in}", "tolerance"),
    "variables": Key("numbers that are others for each student", "variables"),
}

UNITS = {
    "length": Key("the unit of bare lengths, m by default", "unit"),
    "force": Key("the unit of bare forces, N by default", "unit"),
    "torque": Key("the unit of bare torques, force times length by default", "unit"),
}

# Joints
LINKS = Key("the two links that it joins", "two links", True)
PRESSURE_ANGLE = quantity_key("that of the teeth, such as 20", "angle", "acute")
_PITCH = quantity_key("teeth per length of the pitch circle's diameter", "pitch", "positive")
_MODULE = quantity_key("the pitch circle's diameter per tooth", "length", "positive")
HELIX = {
    "helix angle": quantity_key("the angle of the teeth with the axis, in degrees", "angle", "acute or zero"),
    "hand": Key("of the helix of the gear named first, right or left", "hand"),
    **{
        f"{section} {key}": form._replace(says=f"{form.says}, {where}")
        for section, where in (("normal", "square to the teeth"), ("transverse", "in the plane of the wheel"))
        for key, form in (
            ("pressure angle", PRESSURE_ANGLE),
            ("diametral pitch", _PITCH),
            ("module", _MODULE),
        )
    },
}
TEETH = {"pressure angle": PRESSURE_ANGLE, "diametral pitch": _PITCH, "module": _MODULE}
SECTIONS_OF_TEETH = ("", "normal ", "transverse ")
TOOTH_ANGLES = tuple(f"{section}pressure angle" for section in SECTIONS_OF_TEETH)
TOOTH_SIZES = tuple(
    f"{section}{size}" for size in ("diametral pitch", "module") for section in SECTIONS_OF_TEETH
)
TOOTH_FORM = (Rule("at most one", TOOTH_ANGLES), Rule("at most one", TOOTH_SIZES))
HELICAL = (*HELIX, "bearing span")
"""What gears take besides where their teeth are helical."""


_AXIS = "x, y, z, -z, components such as [0, 3, 4], or two points [A, B]"


def _axis(says: str) -> Key:
    """A direction in space, which must stand there."""
    return Key(f"{says}: {_AXIS}", "axis", True)


_CENTRE = Key("the point through which its force acts", "name", True)


def _bearing(says: str, axis: str) -> EntryKind:
    return EntryKind(says, LINKS, {"at": _CENTRE, "axis": _axis(axis)})


SPACE_JOINTS = {
    "ball": EntryKind("a spherical joint: it carries a force and no couple", LINKS, {"at": _CENTRE}),
    "radial": _bearing("a bearing that carries force square to its axis only", "the direction of the shaft"),
    "thrust": _bearing("a bearing that carries force along its axis too", "the direction of the shaft"),
    "hinge": _bearing(
        "a hinge: it carries a force, and couples square to its axis",
        "the direction about which its links turn",
    ),
    "weld": EntryKind("a rigid joint: it carries a force and a couple", LINKS, {"at": _CENTRE}),
    "gears": EntryKind(
        "a mesh of gears with parallel axes",
        LINKS,
        {
            "teeth": Key(
                "the number of teeth of each gear, as in [31, 57]; one number where the mate is not shown",
                "count or counts",
                True,
                "number",
            ),
            "at": Key(
                "the centre of each wheel, as in [G, H]; one point where the mate is not shown",
                "centres",
                True,
            ),
            "axis": _axis("the direction of the shafts"),
            "toward": Key("where the mate lies, seen from the centre of the gear", "axis or point"),
            **TEETH,
            **HELIX,
        },
        ties=(
            *TOOTH_FORM,
            Rule("needs", ("helix angle", "hand")),
            Rule("needs", ("hand", "helix angle")),
        ),
    ),
}
"""Joints in space."""

# Loads
_LINK = Key("the link that it acts on", "link", True)
_PLACE = Key("its point, or [x, y]", "place", True)
_AGAINST = Key("the link that takes the opposite, in place of the frame", "link")
_SENSE = Key("the sense in which it is positive, ccw or cw", "sense")
_FREE = Key("its length without load", "quantity", True, "length", "not negative")
_SPEED = Key(
    "the angular speed at which the power is transmitted, such as 1500 rpm", "quantity", True, "angular speed"
)
DIRECTION = {
    "angle": quantity_key("its direction in degrees, counterclockwise from +x", "angle"),
    "toward": Key("a point toward which it acts"),
    "away": Key("a point away from which it acts"),
    "slope": Key("its direction by run and rise, as in [-3, 4]", "slope", False, "number"),
}
"""One of these gives a force of the plane its direction."""
_DIRECTED = Rule("direction", tuple(DIRECTION), "{what} needs its direction: angle, toward, away or slope")
_TURNS_WITH = Key("the link with which its direction turns in a sweep; else it stays", "link")


def _size(what: str, dimension: str, form: str = "load", bound: str = "") -> Key:
    return Key(what, form, True, dimension, bound)


_TORQUE = "its number, 'unknown', or {like: M2}"
_STIFFNESS = "its force per length, a number, 'unknown' or {like: S}"
LOADS = {
    "force": EntryKind(
        "a force",
        _size("a number, 'unknown', or two components [Fx, Fy]", "force", "load or vector"),
        {"link": _LINK, "at": _PLACE, **DIRECTION, "against": _AGAINST, "turns_with": _TURNS_WITH},
        ties=(_DIRECTED,),
    ),
    "torque": EntryKind(
        "a torque, positive counterclockwise or as it `turns`",
        _size(_TORQUE, "torque"),
        {
            "link": _LINK._replace(needed=False),
            "turns": _SENSE,
            "against": _AGAINST,
            "screw": Key("in place of a link the screw that it turns, by its two links, as in 2-3", "text"),
        },
        ties=(Rule("any", ("link", "screw"), "{what} needs 'link': the link that it acts on"),),
    ),
    "weight": EntryKind("a weight, along -y", _size(_TORQUE, "force"), {"link": _LINK, "at": _PLACE}),
    "mass": EntryKind(
        "a weight by its mass, with its unit",
        _size(_TORQUE, "mass", "load with unit", "not negative"),
        {"link": _LINK, "at": _PLACE},
    ),
    "spring": EntryKind(
        "a spring: it pulls when longer than `free`",
        _size(_STIFFNESS, "stiffness", "load", "not negative"),
        {
            "free": _FREE,
            "link": _LINK,
            "at": needed(_PLACE, "the point of its link that it is fixed to, or [x, y]"),
            "against": _AGAINST,
            "to": needed(_PLACE, "the point of its other end, or [x, y]"),
        },
    ),
    "torsion spring": EntryKind(
        "a torsion spring: it pushes its link with stiffness times (free - angle)",
        _size(
            "its torque per angle, a number, 'unknown' or {like: S}",
            "torsional stiffness",
            "load",
            "not negative",
        ),
        {
            "corner": Key(
                "the angle that it follows: ABC, at B from BA to BC; or BC, the direction from B to C",
                "corner",
                True,
            ),
            "free": Key("its angle without load, in degrees", "quantity", True, "angle"),
            "link": _LINK,
            "against": _AGAINST,
        },
        key="spring",
    ),
    "pressure": EntryKind(
        "a pressure on an area, along a line as a force",
        _size(_TORQUE, "pressure"),
        {
            "bore": quantity_key("the diameter of the cylinder", "length", "positive"),
            "rod": quantity_key("the diameter of the rod, on its side of the piston", "length", "positive"),
            "area": quantity_key("the area, as in 1963 mm^2, in place of a bore", "area", "positive"),
            "link": _LINK,
            "at": _PLACE,
            **DIRECTION,
            "against": _AGAINST,
            "turns_with": _TURNS_WITH,
        },
        ties=(
            _DIRECTED,
            Rule(
                "one", ("bore", "area"), "{what} needs its area: 'bore', the cylinder's diameter, or 'area'"
            ),
            Rule("needs", ("rod", "bore"), "'rod' of {what} goes with a 'bore'; an area is the whole one"),
        ),
    ),
    "distributed": EntryKind(
        "a force per length along a line, uniform or linear",
        _size(
            "a number, 'unknown', or those at both ends, as in [0, 200 N/m]",
            "line load",
            "load or pair",
        ),
        {
            "link": _LINK,
            "from": Key("the point where it begins", "name", True),
            "to": Key("the point where it ends", "name", True),
            **DIRECTION,
            "against": _AGAINST,
            "turns_with": _TURNS_WITH,
        },
        ties=(_DIRECTED._replace(kind="one"),),
    ),
    "power": EntryKind(
        "the torque that transmits a power at a speed",
        _size("the power, with its unit", "torque", "power"),
        {"speed": _SPEED, "link": _LINK, "turns": _SENSE, "against": _AGAINST},
    ),
}
"""Loads of the plane; the dimension of each is that of its number (of a power the torque that it makes)."""

PULLS = {
    name: LOADS[name]._replace(
        says=f"{LOADS[name].says.partition(',')[0]} that pulls the free end of a rope",
        own=LOADS[name].own._replace(form="load with unit" if name == "mass" else "load"),
        keys={"at": _PLACE._replace(says="the free end")},
        ties=(),
    )
    for name in ("force", "weight", "mass")
}
"""Loads at the free end of a rope, which gives them their direction: no link is named."""

_SPOT = Key("its point, or [x, y, z]", "spot", True)
SPACE_DIRECTION = {
    "along": Key(f"its direction: {_AXIS}", "axis"),
    "toward": Key("a point toward which it acts"),
    "away": Key("a point away from which it acts"),
}
"""One of these gives a force in space its direction."""


def _spatial(kind: EntryKind) -> EntryKind:
    """A load of the plane where points have three coordinates."""
    keys = {}
    for name, key in kind.keys.items():
        says = key.says.replace("[x, y]", "[x, y, z]")
        keys[name] = key._replace(says=says, form="spot" if key.form == "place" else key.form)
    return kind._replace(says=kind.says.replace("-y", "-z"), keys=keys)


SPACE_LOADS = {
    "force": EntryKind(
        "a force",
        _size("a number, 'unknown', or three components [x, y, z]", "force", "load or triple"),
        {"link": _LINK, "at": _SPOT, **SPACE_DIRECTION, "against": _AGAINST},
        ties=(Rule("direction", tuple(SPACE_DIRECTION), "{what} needs its direction: along, toward, away"),),
    ),
    "torque": EntryKind(
        "a torque about an axis",
        _size("a number, 'unknown', or three components [x, y, z]", "torque", "load or triple"),
        {
            "link": _LINK,
            "along": _axis("the axis of the torque, positive by the right-hand rule")._replace(needed=False),
            "against": _AGAINST,
        },
        ties=(Rule("direction", ("along",)),),
    ),
    **{name: _spatial(LOADS[name]) for name in ("weight", "mass", "spring")},
    "power": EntryKind(
        "the torque that transmits a power at a speed",
        _size("the power, with its unit", "torque", "power"),
        {
            "speed": _SPEED,
            "link": _LINK,
            "along": _axis("the axis of the rotation, positive by the right-hand rule"),
            "against": _AGAINST,
        },
    ),
}
"""Loads in space."""

_MOVES = Key("the link that moves", "link", True)
_GROWS = "how fast the speed grows, positive in its own sense; 0 by default"
_SPEED_FIRST = Rule(
    "needs", ("acceleration", "speed"), "motion with an 'acceleration' needs a 'speed', 0 where it starts"
)
MOTION_OF_LINK = EntryKind(
    "the motion of a link",
    _MOVES,
    {
        "link": _MOVES,
        "speed": quantity_key("its angular speed", "angular speed"),
        "turns": Key("the sense in which the link turns, ccw or cw", "sense"),
        "acceleration": quantity_key(_GROWS, "angular acceleration"),
    },
    ties=(
        Rule("any", ("speed", "turns"), "motion of a link needs 'speed', 'turns: ccw' or 'turns: cw'"),
        _SPEED_FIRST,
    ),
)
MOTION_OF_POINT = EntryKind(
    "the motion of a point of a link",
    _MOVES,
    {
        "point": Key("the point of the link whose speed is given", "name", True),
        "link": _MOVES,
        "speed": needed(quantity_key("the point's speed", "speed")),
        "angle": quantity_key("the direction of the point's velocity in degrees", "angle")._replace(
            needed=True
        ),
        "acceleration": quantity_key(_GROWS, "path acceleration"),
    },
    ties=(_SPEED_FIRST,),
)
MASSES = {
    "points": Key("further points that it carries, as in [G, H]", "points of a link"),
    "mass": Key("its mass, with the unit", "with unit", False, "mass", "not negative"),
    "centre": Key("its centre of mass, a point of the link, as in {mass: 2 kg, centre: G}"),
    "inertia": Key(
        "its moment of inertia about the centre of mass, with the unit",
        "with unit or 0",
        False,
        "moment of inertia",
        "not negative",
    ),
}
"""What `links:` can say of a link besides a list of points."""
MASSES_TIES = (Rule("needs", ("mass", "centre")),)
EXPECTED = {
    "value": Key("the published one", "published"),
    "toward": quantity_key("the direction in which a centre at infinity lies", "angle"),
    "holds": Key("the range in which it holds still, as in [113, 287]; null where it has no end", "ends"),
    "stability": Key("of which kind the position is: stable, unstable or neutral", "stability"),
    "within": Key("how near is near enough, as in 1% or 0.02", "width"),
    "erratum": Key("what is wrong with the published value: it is then expected not to agree", "text"),
}
EXPECTED_TIES = (Rule("one", ("value", "toward", "holds")),)
TOLERANCE = {
    "relative": Key("a share of the value, as in 1%", "percent"),
    "absolute": Key("a width, as in 0.5 N", "quantity"),
    "figures": Key("significant figures", "number"),
    "drawing": Key("the accuracy of a drawing, a length", "quantity"),
}
VARIABLE = {
    "choices": Key("the values of which each student gets one", "choices"),
    "range": Key("the lowest and the highest value, as in [100, 500]", "range"),
    "step": Key("the step from one value to the next", "number"),
}
LIKE = {
    "like": Key("the name of another load, as in {like: M2, times: -1}", "name", True),
    "times": quantity_key("how many times as large as the other load", "number"),
}
CENTROID = {"centroid": Key("the points of which it is the mean; of two, the middle", "several", True)}
UNKNOWN = {
    "unknown": Key("the range in which it is to find, as in [0, 90]", "pair", True),
    "from": Key("where in it the figure is written, as in {unknown: [0, 360], from: 30}", "quantity"),
}
"""What a datum of the figure says that is to find."""
GRAVITY = {
    "size": quantity_key("its size, 9.81 m/s^2 by default", "acceleration", "not negative"),
    "along": _axis("where weights pull to"),
}
