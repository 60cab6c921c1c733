"""Contacts found on profiles: against closed forms of cams, which are named with their sources.

R. L. Norton, Design of Machinery, ch. 8; J. J. Uicker, G. R. Pennock and J. E. Shigley, Theory of Machines
and Mechanisms, ch. 5-6. Lengths in mm and loads of 100; tolerances are a few roundings of the figure's size
unless a test says otherwise.
"""

from __future__ import annotations

import math
import re
from dataclasses import replace
from random import Random

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from cams import HEAD, sliding, swinging, table
from icsolve.answer import Answer
from icsolve.cams.contact_search import places_of
from icsolve.cams.curve import crosses_itself, placed
from icsolve.cams.pieces import spline
from icsolve.case import Motion
from icsolve.case.profiles import points_of
from icsolve.errors import CaseError, SceneError, Status
from icsolve.numbers.roots import zero_between
from icsolve.read import load
from icsolve.read.profiles import PROFILES as KEYS
from icsolve.solve import solve
from icsolve.solve.stability import with_stability
from icsolve.sweep.find_by_scenes import Query
from icsolve.sweep.find_on_record import find
from icsolve.sweep.varied_numbers import with_numbers
from sizes import MORE, few
from texts import PAGES

E, R, ROLLER = 20.0, 40.0, 10.0
ANGLES = st.floats(-180.0, 180.0).map(lambda x: round(x, 6))
OFFSETS = st.floats(-15.0, 15.0).map(lambda x: round(x, 6))
CIRCLE = "{circle: C, radius: 40}"


def torque(answer: Answer) -> float:
    return float(answer.answers["T12"].value)


# --- eccentric circle (Norton, sect. 8.1; Uicker, sect. 5.2) --------------------------------------


@given(ANGLES)
@settings(max_examples=few(40))
def test_flat_follower_on_an_eccentric_circle_is_in_simple_harmonic_motion(degrees: float) -> None:
    """s = r + e sin(theta), so T = P e cos(theta); the face is touched at e cos(theta) from the axis."""
    answer = solve(sliding(CIRCLE, "{flat: B, along: 0}", degrees=degrees), rates=True)
    angle = math.radians(degrees)
    assert answer.points["B"][1] == pytest.approx(R + E * math.sin(angle), abs=1e-12)
    assert torque(answer) == pytest.approx(100.0 * E * math.cos(angle), abs=1e-9)
    (touching,) = answer.touching
    assert touching.at == pytest.approx((E * math.cos(angle), R + E * math.sin(angle)), abs=1e-12)
    assert (touching.normal, touching.pressure_angle) == pytest.approx((90.0, 0.0), abs=1e-12)
    assert touching.force == pytest.approx(100.0, rel=1e-12)


@given(ANGLES, OFFSETS, st.sampled_from([ROLLER, 0.0]))
@settings(max_examples=few(40))
def test_roller_and_knife_edge_on_an_eccentric_circle(degrees: float, offset: float, roller: float) -> None:
    """The trace point moves on a circle of r + r_roller about C:
    y = e sin(theta) + root, tan(phi) = (e cos(theta) - offset) / root, with
    root = sqrt((r + rr)^2 - (e cos(theta) - offset)^2)."""
    follower = f"{{roller: B, radius: {roller!r}}}" if roller else "{knife: B}"
    answer = solve(sliding(CIRCLE, follower, degrees=degrees, offset=offset))
    angle = math.radians(degrees)
    across = E * math.cos(angle) - offset
    root = math.sqrt((R + roller) ** 2 - across**2)
    assert answer.points["B"][1] == pytest.approx(E * math.sin(angle) + root, abs=1e-11)
    rate = E * math.cos(angle) + across * E * math.sin(angle) / root
    assert torque(answer) == pytest.approx(100.0 * rate, abs=1e-8)
    (touching,) = answer.touching
    assert touching.pressure_angle == pytest.approx(math.degrees(math.atan2(abs(across), root)), abs=1e-10)


@given(ANGLES, OFFSETS)
@settings(max_examples=few(25))
def test_pressure_angle_of_a_translating_roller_follower(degrees: float, offset: float) -> None:
    """Norton, eq. 8.31: tan(phi) = (ds/dtheta - eps) / (s + sqrt(Rp^2 - eps^2)); here the whole height stands
    below, and ds/dtheta is the torque over the force. The sign of eps is that of a cam that turns ccw."""
    answer = solve(sliding(CIRCLE, "{roller: B, radius: 10}", degrees=degrees, offset=offset))
    tangent = (torque(answer) / 100.0 - offset) / answer.points["B"][1]
    (touching,) = answer.touching
    assert touching.pressure_angle == pytest.approx(math.degrees(math.atan(abs(tangent))), abs=1e-9)


@given(ANGLES)
@settings(max_examples=few(40))
def test_oscillating_flat_follower_on_an_eccentric_circle(degrees: float) -> None:
    """The face through D is tangent to the disk: psi = gamma - asin(r / DC), gamma the direction of DC."""
    answer = solve(swinging(CIRCLE, "{flat: D, along: [D, E]}", degrees=degrees), rates=True)
    angle, d = math.radians(degrees), 120.0
    x, y = E * math.cos(angle) - d, E * math.sin(angle)
    apart, gamma = math.hypot(x, y), math.atan2(y, x)
    psi = gamma - math.asin(R / apart)
    assert answer.points["E"] == pytest.approx((d + 100 * math.cos(psi), 100 * math.sin(psi)), abs=1e-10)
    vx, vy = -E * math.sin(angle), E * math.cos(angle)
    turning = (x * vy - y * vx) / apart**2
    shrinking = R * (x * vx + y * vy) / (apart**2 * math.sqrt(apart**2 - R**2))
    rate = turning + shrinking
    assert answer.rates is not None and answer.rates["3"] == pytest.approx(rate, abs=1e-11)
    assert torque(answer) == pytest.approx(-100.0 * rate, abs=1e-8)
    assert answer.touching[0].pressure_angle == pytest.approx(0.0, abs=1e-9)


@given(ANGLES)
@settings(max_examples=few(40))
def test_oscillating_roller_follower_is_a_four_bar_whose_coupler_is_the_common_normal(degrees: float) -> None:
    """The equivalent linkage A-C-E-D (Uicker, sect. 1.11) has CE = r + r_roller."""
    answer = solve(swinging(CIRCLE, "{roller: E, radius: 10}", degrees=degrees), rates=True)
    near = answer.points["E"]
    linkage = load(
        f"{HEAD}points: {{A: [0, 0], D: [120, 0]}}\nlengths: {{AC: 20, CE: 50, ED: 100}}\n"
        f"angles: {{AC: {degrees!r}}}\nnear: {{E: [{near[0]!r}, {near[1]!r}]}}\n"
        "joints:\n  - {pin: [1, 2], at: A}\n  - {pin: [2, 4], at: C}\n  - {pin: [4, 3], at: E}\n"
        "  - {pin: [3, 1], at: D}\n"
        "loads:\n  M: {torque: 100, link: 3}\n  T12: {torque: unknown, link: 2}\n"
    )
    assert torque(answer) == pytest.approx(torque(solve(linkage)), abs=1e-8)
    x, y = solve(linkage).points["C"]
    between = math.atan2(near[1] - y, near[0] - x) - math.atan2(near[1], near[0] - 120.0)
    pressure = abs(90.0 - abs(math.degrees(math.remainder(between, 2.0 * math.pi))))
    assert answer.touching[0].pressure_angle == pytest.approx(pressure, abs=1e-9)


def test_the_force_in_a_contact_has_the_pressure_angle_of_the_rollers_centre() -> None:
    answer = solve(swinging(CIRCLE, "{roller: E, radius: 10}"), reactions=True)
    (touching,), reactions = answer.touching, answer.reactions
    assert reactions is not None
    assert touching.pressure_angle is not None
    assert touching.pressure_angle > 1.0
    assert dict(reactions["F23"].parts)["pressure angle"] == touching.pressure_angle


# --- polygons and arcs ----------------------------------------------------------------------------

SQUARE = "{polygon: [[50, 0], [0, 50], [-50, 0], [0, -50]]}"


def turned_square(degrees: float) -> tuple[str, list[tuple[float, float]]]:
    angles = [math.radians(degrees + 90.0 * k) for k in range(4)]
    corners = [(50.0 * math.cos(a), 50.0 * math.sin(a)) for a in angles]
    return f"{{polygon: [{', '.join(f'[{x!r}, {y!r}]' for x, y in corners)}]}}", corners


@given(st.floats(1.0, 89.0).filter(lambda a: abs(a - 45.0) > 1e-3))
@settings(max_examples=few(30))
def test_flat_face_on_a_polygon_rests_on_its_highest_corner(degrees: float) -> None:
    """The corner's normals are a range; the face chooses its own: T = P x of the corner."""
    profile, corners = turned_square(degrees)
    answer = solve(sliding(profile, "{flat: B, along: 0}"))
    x, y = max(corners, key=lambda p: p[1])
    assert answer.points["B"][1] == pytest.approx(y, abs=1e-12)
    assert torque(answer) == pytest.approx(100.0 * x, abs=1e-9)
    (touching,) = answer.touching
    assert (touching.on, touching.normal, touching.at) == ("corner", 90.0, pytest.approx((x, y), abs=1e-12))


@given(st.floats(1.0, 89.0).filter(lambda a: abs(a - 45.0) > 1e-3))
@settings(max_examples=few(30))
def test_knife_edge_on_the_edge_of_a_polygon(degrees: float) -> None:
    """On the edge that the line x = 0 crosses from above: ds/dtheta = -s tan(slope)."""
    answer = solve(sliding(turned_square(degrees)[0], "{knife: B}"))
    middle = math.radians(degrees + 45.0)
    height = 50.0 * math.cos(math.pi / 4.0) / math.sin(middle)
    assert answer.points["B"][1] == pytest.approx(height, abs=1e-10)
    assert torque(answer) == pytest.approx(-100.0 * height / math.tan(middle), abs=1e-8)
    assert answer.touching[0].on == "edge"
    assert answer.touching[0].normal == pytest.approx(math.degrees(middle), abs=1e-10)


def test_roller_over_the_corner_of_a_polygon_turns_about_it() -> None:
    """Its centre is at the roller's radius from the corner; the normal lies between those of the edges."""
    answer = solve(sliding(SQUARE, "{roller: B, radius: 10}", offset=3.0))
    assert answer.points["B"][1] == pytest.approx(50.0 + math.sqrt(100.0 - 9.0), abs=1e-12)
    assert answer.touching[0].on == "corner"
    assert answer.touching[0].normal == pytest.approx(math.degrees(math.acos(0.3)), abs=1e-12)


def test_knife_edge_on_a_corner_is_refused_with_the_range_of_normals() -> None:
    said = r"normals go from 45 to 135 deg.*Give the contact a `normal`"
    with pytest.raises(SceneError, match=said) as found:
        solve(sliding(SQUARE, "{knife: B}"))
    assert found.value.status == Status.UNSUPPORTED


@pytest.mark.parametrize("normal", [45.0, 80.0, 135.0])
def test_knife_edge_on_a_corner_takes_a_given_normal_of_the_range(normal: float) -> None:
    """The follower's speed along the normal is the corner's: T = P y / tan(normal) of the corner (0, y)."""
    answer = solve(sliding(SQUARE, "{knife: B}", more=f", normal: {normal}"))
    assert torque(answer) == pytest.approx(-100.0 * 50.0 / math.tan(math.radians(normal)), abs=1e-9)


def test_knife_edge_on_a_corner_refuses_a_normal_beside_the_range() -> None:
    with pytest.raises(SceneError, match="the normal 30 is not one of them"):
        solve(sliding(SQUARE, "{knife: B}", more=", normal: 30"))


def test_flat_face_on_an_edge_is_refused() -> None:
    profile = "{polygon: [[30, 30], [-30, 30], [-30, -30], [30, -30]]}"
    with pytest.raises(SceneError, match="lies on the profile along a line") as found:
        solve(sliding(profile, "{flat: B, along: 0}"))
    assert found.value.status == Status.UNSUPPORTED


def test_roller_in_a_hollow_corner_is_refused() -> None:
    profile = "{polygon: [[40, 40], [0, 10], [-40, 40], [-40, -40], [40, -40]]}"
    with pytest.raises(SceneError, match="touches the profile at two places at once"):
        solve(sliding(profile, "{roller: B, radius: 10}"))


TANGENT = math.degrees(math.acos(25.0 / 40.0))
DISK_CAM = (
    f"{{arcs: [{{centre: A, radius: 40, from: {60.0 + TANGENT!r}, to: {60.0 - TANGENT!r}}},"
    f" {{centre: C, radius: 15, from: {60.0 - TANGENT!r}, to: {60.0 + TANGENT!r}}}]}}"
)
"""Circles of 40 about A and of 15 about C, 40 away in the direction of 60 degrees, and their tangents."""


def test_flat_follower_on_tangent_arcs() -> None:
    """The support function of a disk about C: r2 + AC sin(theta); T = P AC cos(theta)."""
    answer = solve(sliding(DISK_CAM, "{flat: B, along: 0}", degrees=60.0, e=40.0))
    assert answer.points["B"][1] == pytest.approx(40.0 * math.sin(math.pi / 3.0) + 15.0, abs=1e-10)
    assert torque(answer) == pytest.approx(100.0 * 40.0 * 0.5, abs=1e-8)
    assert answer.touching[0].on == "arc of radius 15"


def test_roller_follower_on_the_flank_of_tangent_arcs() -> None:
    """On a straight flank at a distance h from A with the normal direction n: B . n = h + rr
    (Uicker, sect. 5.8: tangent cam), so s = (40 + rr) / sin(n) and ds/dtheta = -s / tan(n)."""
    answer = solve(sliding(DISK_CAM, "{roller: B, radius: 10}", degrees=60.0, e=40.0))
    n = math.radians(60.0 + TANGENT)
    height = 50.0 / math.sin(n)
    assert answer.touching[0].on == "line between arcs"
    assert answer.points["B"][1] == pytest.approx(height, abs=1e-10)
    assert torque(answer) == pytest.approx(-100.0 * height / math.tan(n), abs=1e-7)
    assert answer.touching[0].pressure_angle == pytest.approx(abs(90.0 - math.degrees(n)), abs=1e-10)


# --- radius against angle -------------------------------------------------------------------------


def harmonic(degrees: float) -> float:
    """Two lifts of simple harmonic motion to a turn."""
    return 45.0 - 5.0 * math.cos(2.0 * math.radians(degrees))


def cycloidal(degrees: float) -> float:
    """Rise and fall of 20 mm by the cycloidal law, half a turn each (Norton, eq. 8.12a)."""
    part = degrees % 360.0 / 180.0
    part = part if part <= 1.0 else 2.0 - part
    return 40.0 + 20.0 * (part - math.sin(2.0 * math.pi * part) / (2.0 * math.pi))


def slope(law: object, degrees: float) -> float:
    """dr/dtheta, by central differences good to 1e-9."""
    assert callable(law)
    h = 1e-3
    return float(law(degrees + h) - law(degrees - h)) / (2.0 * math.radians(h))


@pytest.mark.parametrize(("law", "order"), [(harmonic, 2.9), (cycloidal, 1.8)])
def test_spline_converges_to_the_law_that_it_samples(law: object, order: float) -> None:
    """A knife edge over the axis rides at r(90 - theta), and T = -P dr/dtheta. The cubic spline's slopes
    converge with the third power of the step at least (de Boor, ch. V), where the law is that smooth; the
    cycloidal law's acceleration has a corner at both ends of its rise."""
    assert callable(law)
    errors = []
    for n in (12, 24, 48, 96):
        profile = table([(360.0 * k / n, law(360.0 * k / n)) for k in range(n)])
        answer = solve(sliding(profile, "{knife: B}", degrees=40.0, e=10.0))
        errors.append(abs(torque(answer) / 100.0 + slope(law, 50.0)))
        assert answer.touching[0].pressure_angle == pytest.approx(
            math.degrees(math.atan2(abs(torque(answer)) / 100.0, answer.points["B"][1])), abs=1e-9
        )
    assert errors[-1] < 1e-3
    assert math.log2(errors[0] / errors[-1]) / 3.0 > order


@pytest.mark.parametrize("degrees", [-130.0, -20.0, 10.0, 77.0])
def test_flat_follower_on_the_profile_that_its_own_lift_cuts(degrees: float) -> None:
    """The envelope of the face (Uicker, eq. 5.42): the contact lies at (s', s) in the face's own axes, so the
    profile has the radius hypot(s, s') at alpha + atan(s' / s); the follower then lifts by s again."""
    pairs = []
    for k in range(180):
        alpha = 2.0 * k
        s, rate = harmonic(alpha), slope(harmonic, alpha)
        pairs.append((alpha + math.degrees(math.atan2(rate, s)), math.hypot(s, rate)))
    answer = solve(sliding(table(pairs), "{flat: B, along: 0}", degrees=degrees, e=10.0))
    assert answer.points["B"][1] == pytest.approx(harmonic(90.0 - degrees), abs=1e-6)
    assert torque(answer) == pytest.approx(-100.0 * slope(harmonic, 90.0 - degrees), abs=1e-3)


def test_what_interpolation_leaves_open_is_said_and_shrinks() -> None:
    said = []
    for n in (12, 48):
        profile = table([(360.0 * k / n, harmonic(360.0 * k / n)) for k in range(n)])
        answer = solve(sliding(profile, "{knife: B}", e=10.0))
        (note,) = (note for note in answer.notes if "periodic cubic spline" in note)
        assert f"through {n} radii" in note
        said.append(float(re.search(r"would lie up to ([\d.e-]+) away", note)[1]))  # type: ignore[index]
        real = abs(answer.points["B"][1] - harmonic(50.0))
        assert real <= said[-1]
    assert said[1] < 0.1 * said[0]


def test_radii_that_turn_clockwise_are_the_mirror_image() -> None:
    pairs = [(30.0 * k, 40.0 + 8.0 * math.sin(math.radians(30.0 * k)) ** 2 + k % 3) for k in range(12)]
    ccw = solve(sliding(table(pairs), "{knife: B}", degrees=90.0, e=10.0))
    cw = solve(sliding(table(pairs).replace("radii", "turns: cw, radii"), "{knife: B}", degrees=90.0, e=10.0))
    assert cw.points["B"] == pytest.approx(ccw.points["B"], abs=1e-12)
    assert torque(cw) == pytest.approx(-torque(ccw), abs=1e-9)


def test_periodic_spline_goes_through_its_values_with_two_continuous_derivatives() -> None:
    places, values = [0.1, 0.9, 2.0, 3.3, 5.0], [1.0, 4.0, 2.0, 2.5, 0.5]
    found = spline(places, values, 2.0 * math.pi)
    for x, y in zip(places, values, strict=True):
        assert found.at(x)[0] == pytest.approx(y, abs=1e-14)
        before, after = found.at(x - 1e-9), found.at(x + 1e-9)
        assert before == pytest.approx(after, abs=1e-7)


@given(st.floats(-3.0, 3.0), st.floats(0.1, 3.0))
def test_zeros_are_found_to_the_last_digits(zero: float, width: float) -> None:
    def cube(x: float) -> float:
        return math.atan(x - zero) + (x - zero) ** 3

    a, b, calls = zero - width, zero + 0.7 * width, []

    def counted(x: float) -> float:
        calls.append(x)
        return cube(x)

    assert zero_between(counted, a, b, cube(a), cube(b)) == pytest.approx(zero, abs=2e-15, rel=1e-15)
    assert len(calls) <= 15  # halvings alone take 50


# --- friction, free bodies, lost contact ----------------------------------------------------------


@pytest.mark.parametrize("mu", ["", ", mu: 0.15"])
@pytest.mark.parametrize("follower", ["{flat: B, along: 0}", "{roller: B, radius: 10}", "{knife: B}"])
def test_found_contact_is_the_contact_that_is_given(follower: str, mu: str) -> None:
    """The same scene with `at` and `normal` written out has the same torque and reactions, rubbing or not;
    power and free bodies agree within their bound."""
    turning = (Motion("2", turns="ccw"),)
    case = replace(sliding(CIRCLE, follower, degrees=65.0, more=mu), motion=turning)
    answer = solve(case, reactions=True)
    (touching,) = answer.touching
    given_case = load(
        f"{HEAD}motion: {{link: 2, turns: ccw}}\npoints: {{A: [0, 0], B: [0, {answer.points['B'][1]!r}],"
        f" K: [{touching.at[0]!r}, {touching.at[1]!r}]}}\n"
        "joints:\n  - {pin: [1, 2], at: A}\n"
        f"  - {{contact: [2, 3], at: K, normal: {touching.normal!r}{mu}}}\n"
        "  - {slide: [3, 1], at: B, along: 90}\n"
        "loads:\n  P: {force: 100, link: 3, at: B, angle: -90}\n  T12: {torque: unknown, link: 2}\n"
    )
    plain = solve(given_case, reactions=True)
    assert torque(answer) == pytest.approx(torque(plain), rel=1e-12)
    assert answer.reactions is not None and plain.reactions is not None
    for one, other in zip(answer.reactions.values(), plain.reactions.values(), strict=True):
        assert (one.x, one.y, one.moment) == pytest.approx((other.x, other.y, other.moment), abs=1e-9)
    for witness in answer.witnesses:
        assert abs(witness.difference) <= witness.bound
    if mu and follower.startswith("{flat"):
        c, s = math.cos(math.radians(65.0)), math.sin(math.radians(65.0))
        # the face rubs where the disk's top goes: N mu times its height above A, and the guide takes a couple
        assert torque(answer) == pytest.approx(100.0 * (E * c + 0.15 * (R + E * s)), rel=1e-12)


def test_force_that_lifts_the_follower_loses_the_contact() -> None:
    case = sliding(CIRCLE, "{flat: B, along: 0}")
    lifted = with_numbers(case, {"loads.P.angle": 90.0})
    answer = solve(lifted)
    assert answer.touching[0].lost and answer.touching[0].force == pytest.approx(-100.0)
    assert any("is lost: its normal force would have to pull (-100)" in note for note in answer.notes)
    assert not solve(case).touching[0].lost


def test_a_contact_tells_what_was_found_of_it() -> None:
    contact = solve(sliding(CIRCLE, "{knife: B}")).to_dict()["contacts"]["2-3"]
    assert set(contact) >= {"at", "normal", "on", "pressure_angle", "force", "lost"}


@pytest.mark.parametrize("names", [("2", "3"), ("cam", "rod")])
@pytest.mark.parametrize(("mu", "angle"), [("", -90), ("", 90), (", mu: 0.15", -90)])
@pytest.mark.parametrize("follower", ["{flat: B, along: 10}", "{roller: B, radius: 10}", "{knife: B}"])
def test_a_contact_may_name_its_links_either_way_round(
    follower: str, mu: str, angle: int, names: tuple[str, str]
) -> None:
    """Its force, whether it is lost and its pressure angle are the same, among the reactions too."""
    cam, rod = names
    told = []
    for links in (f"{cam}, {rod}", f"{rod}, {cam}"):
        text = (
            f"{HEAD}motion: {{link: {cam}, turns: ccw}}\npoints: {{A: [0, 0], B: [4, unknown]}}\n"
            "lengths: {AC: 20}\nangles: {AC: 40}\nnear: {B: [4, 60]}\n"
            f"profile:\n  {cam}: {CIRCLE}\n  {rod}: {follower}\n"
            f"joints:\n  - {{pin: [1, {cam}], at: A}}\n  - {{contact: [{links}]{mu}}}\n"
            f"  - {{slide: [{rod}, 1], at: B, along: 90}}\n"
            f"loads:\n  P: {{force: 100, link: {rod}, at: B, angle: {angle}}}\n"
            f"  T12: {{torque: unknown, link: {cam}}}\n"
        )
        for reactions in (False, True):
            answer = solve(load(text), reactions=reactions)
            (touching,) = answer.touching
            assert touching.force is not None and touching.lost == (touching.force < 0.0) == (angle > 0)
            told.append((touching.force, touching.pressure_angle))
            if answer.reactions is not None:
                (shares,) = (s for r in answer.reactions.values() if "pressure angle" in (s := dict(r.parts)))
                told.append((shares["normal"], shares["pressure angle"]))
    for one in told[1:]:
        assert one == pytest.approx(told[0], rel=1e-12)


def test_roller_that_is_a_link_of_its_own_is_a_passive_freedom() -> None:
    alone = sliding(CIRCLE, "{roller: B, radius: 10}")
    text = (
        f"{HEAD}points: {{A: [0, 0], B: [0, unknown]}}\nlengths: {{AC: 20}}\nangles: {{AC: 40}}\n"
        "near: {B: [0, 60]}\nprofile:\n  2: {circle: C, radius: 40}\n  4: {roller: B, radius: 10}\n"
        "joints:\n  - {pin: [1, 2], at: A}\n  - {contact: [4, 2]}\n  - {pin: [3, 4], at: B}\n"
        "  - {slide: [3, 1], at: B, along: 90}\n"
        "loads:\n  P: {force: 100, link: 3, at: B, angle: -90}\n  T12: {torque: unknown, link: 2}\n"
    )
    answer = solve(load(text))
    assert torque(answer) == pytest.approx(torque(solve(alone)), rel=1e-12)
    assert answer.touching[0].pressure_angle == pytest.approx(solve(alone).touching[0].pressure_angle)


def test_follower_whose_place_is_given_must_touch() -> None:
    text = (
        f"{HEAD}points: {{A: [0, 0], C: [10, 0], B: [0, %s]}}\n"
        "profile:\n  2: {circle: C, radius: 40}\n  3: {flat: B, along: 0}\n"
        "joints:\n  - {pin: [1, 2], at: A}\n  - {contact: [2, 3]}\n  - {slide: [3, 1], at: B, along: 90}\n"
        "loads:\n  P: {force: 100, link: 3, at: B, angle: -90}\n  T12: {torque: unknown, link: 2}\n"
    )
    assert torque(solve(load(text % "40.01"))) == pytest.approx(1000.0)
    for height, words in (("42", "is 2 away from the profile"), ("37", "lies 3 inside the profile")):
        with pytest.raises(SceneError, match=words) as found:
            solve(load(text % height))
        assert found.value.status == Status.CANNOT_ASSEMBLE


# --- refusals -------------------------------------------------------------------------------------


def test_profile_that_crosses_itself_is_refused_with_its_place_in_the_file() -> None:
    case = sliding("{polygon: [[50, 0], [-50, 0], [0, 50], [0, -50]]}", "{flat: B, along: 0}")
    with pytest.raises(SceneError, match=r"profile of link 2 \(<text>:8:3\) crosses itself") as found:
        solve(case)
    assert found.value.status == Status.INCONSISTENT


def test_spline_that_falls_to_zero_is_refused() -> None:
    pairs = [(0.0, 40.0), (20.0, 1.0), (30.0, 1.0), (50.0, 40.0), (180.0, 40.0)]
    with pytest.raises(SceneError, match="falls to zero"):
        solve(sliding(table(pairs), "{knife: B}"))


def test_follower_that_never_meets_the_profile_is_refused_with_its_place_in_the_file() -> None:
    case = sliding(CIRCLE, "{knife: B}", offset=70.0)
    with pytest.raises(SceneError, match=r"\(<text>:8:3\): the knife edge never meets the profile") as found:
        solve(case)
    assert found.value.status == Status.CANNOT_ASSEMBLE


def test_follower_that_meets_in_several_ways_needs_near() -> None:
    case = replace(sliding(CIRCLE, "{knife: B}"), near={})
    with pytest.raises(SceneError, match=r"in 2 ways, with B at .*give `near: \{B") as found:
        solve(case)
    assert found.value.status == Status.AMBIGUOUS


WRONG = {
    "two followers": ("{circle: C, radius: 40}", "{knife: C}", 10, 5, "links 2 and 3 are both followers"),
    "two cams": ("{flat: B, along: 0}", "{circle: B, radius: 3}", 10, 5, "both have a profile of their own"),
    "unknown kind": ("circle:", "cirle:", 6, 6, "did you mean 'circle'?"),
    "no radius": (", radius: 40", "", 6, 6, "needs 'radius'"),
    "negative radius": ("radius: 40", "radius: -40", 6, 26, "should be greater than zero"),
    "two corners": ("{circle: C, radius: 40}", "{polygon: [A, C]}", 6, 16, "three or more corners"),
    "corner twice": ("{circle: C, radius: 40}", "{polygon: [A, C, C]}", 6, 16, "twice running"),
    "few radii": ("{circle: C, radius: 40}", "{about: A, zero: 0, radii: {0: 1, 9: 2}}", 6, 33, "needs 4"),
    "unused": ("[2, 3]}", "[2, 3], at: A, normal: 30}", 6, 3, "no contact uses it"),
}


@pytest.mark.parametrize("name", WRONG)
def test_bad_profiles_are_refused_at_their_place(name: str) -> None:
    text = (
        "icsolve: 1\npoints: {A: [0, 0], B: [0, unknown]}\nlengths: {AC: 20}\nangles: {AC: 60}\nprofile:\n"
        "  2: {circle: C, radius: 40}\n  3: {flat: B, along: 0}\njoints:\n  - {pin: [1, 2], at: A}\n"
        "  - {contact: [2, 3]}\n  - {slide: [3, 1], at: B, along: 90}\n"
    )
    load(text)
    old, new, line, column, words = WRONG[name]
    with pytest.raises(CaseError) as found:
        load(text.replace(old, new, 1))
    assert any((p.line, p.column) == (line, column) and words in p.message for p in found.value.problems), (
        found.value
    )


def test_curve_is_found_from_either_order_of_its_corners() -> None:
    for order in ("[[50, 0], [0, 50], [-50, 0], [0, -50]]", "[[0, -50], [-50, 0], [0, 50], [50, 0]]"):
        case = sliding(f"{{polygon: {order}}}", "{roller: B, radius: 10}", offset=5.0)
        assert case.profiles is not None
        shape = case.profiles.shapes["2"]
        curve = placed(shape, places_of(case, points_of(shape)), "it")  # type: ignore[arg-type]
        assert curve.height((0.0, 60.0))[0] == pytest.approx(10.0)
        assert curve.height((0.0, 0.0))[0] == pytest.approx(-50.0 / math.sqrt(2.0))


SECTION = PAGES["cams"]
FORMS = re.findall(r"^\| `(\d): (\{.*?\})` \|", SECTION, re.MULTILINE)


@pytest.mark.parametrize(("link", "form"), FORMS)
def test_every_form_of_a_profile_in_the_readme_is_read(link: str, form: str) -> None:
    other = "3: {flat: B, along: 0}" if link == "2" else "2: {circle: C, radius: 4}"
    case = load(
        "icsolve: 1\npoints: {A: [0, 0], B: [0, unknown], C: [1, 0], P: [1, 1], Q: [-1, 1], R: [-1, -1],"
        f" S: [1, -1]}}\nprofile:\n  {link}: {form}\n  {other}\njoints:\n  - {{pin: [1, 2], at: A}}\n"
        "  - {contact: [2, 3]}\n  - {slide: [3, 1], at: B, along: 90}\n"
    )
    assert case.profiles is not None and len(case.profiles.shapes) == 2


def test_the_readme_shows_every_kind_of_profile() -> None:
    assert {kind for kind in KEYS if any(f"{kind}:" in form for _, form in FORMS)} == KEYS.keys()


def test_a_roller_whose_centre_lies_on_a_corner_is_refused() -> None:
    text = (
        f"{HEAD}points: {{A: [0, 0], C: [10, 0], B: [0, 60]}}\n"
        "profile:\n  2: {polygon: [A, C, [5, 50]]}\n  3: {roller: A, radius: %s}\n"
        "joints:\n  - {pin: [1, 2], at: A}\n  - {contact: [2, 3]}\n  - {slide: [3, 1], at: B, along: 90}\n"
        "loads:\n  P: {force: 100, link: 3, at: B, angle: -90}\n  T12: {torque: unknown, link: 2}\n"
    )
    for radius in ("3", "1e-9"):
        with pytest.raises(SceneError):
            solve(load(text % radius))


@pytest.mark.parametrize("side", [3, 4, 7])
def test_a_line_that_meets_itself_is_told_exactly(side: int) -> None:
    """On a coarse grid corners touch lines, lines lie on each other and three points on one line."""
    rng = Random(side)
    for _ in range(300 * MORE):
        points = [(float(rng.randrange(side)), float(rng.randrange(side))) for _ in range(rng.randint(3, 7))]
        if all(a != b for a, b in zip(points, [*points[1:], points[0]], strict=True)):
            assert crosses_itself(points) != shapely.LinearRing(points).is_simple, points
    nearly = [(0.0, 0.0), (1.0, 0.1), (2.0, 0.2), (1.0, 0.1 + 2.0**-54)]  # by the last bit of a corner
    assert crosses_itself(nearly) != shapely.LinearRing(nearly).is_simple


@pytest.mark.parametrize("rubs", [False, True])
@pytest.mark.parametrize("reactions", [False, True])
def test_that_a_contact_is_lost_is_told_once(rubs: bool, reactions: bool) -> None:
    """By the contact, or by the free bodies of which friction or reactions have need."""
    mu, radius, motion = (
        (", mu: 0.15", ", radius: 12", "motion: {link: 2, turns: cw}\n") if rubs else [""] * 3
    )
    text = (
        f"{HEAD}points: {{A: [0, 0], B: [0, unknown]}}\nlengths: {{AC: 10}}\nangles: {{AC: 30}}\n"
        "near: {B: [0, 45]}\nprofile:\n  2: {circle: C, radius: 30}\n  3: {flat: B, along: 0}\n"
        f"{motion}joints:\n  - {{pin: [1, 2], at: A{mu}{radius}}}\n  - {{contact: [2, 3]{mu}}}\n"
        "  - {slide: [3, 1], at: B, along: 90}\n"
        "loads:\n  P: {force: 300, link: 3, at: B, angle: 90}\n  T12: {torque: unknown, link: 2}\n"
    )
    notes = solve(load(text), reactions=reactions).notes
    assert sum("is lost" in note for note in notes) == 1
    assert len({*notes}) == len(notes)


CAM = """icsolve: 1
units: {length: mm, force: N, torque: N*m}
points: {A: [0, 0], B: [8, unknown]}
lengths: {AC: 20}
angles: {AC: 140}
near: {B: [8, 60]}
profile: {2: {circle: C, radius: 40}, 3: {roller: B, radius: 10}}
joints: [{pin: [1, 2], at: A}, {contact: [2, 3], mu: 0.05}, {slide: [3, 1], at: B, along: 90}]
loads:
  P: {force: 500, link: 3, at: B, angle: -90}
  T: {torque: unknown, link: 2}
"""


def test_what_a_profile_leaves_open_it_fixes_where_all_loads_are_known() -> None:
    """The follower's coordinate is not to find; what rubs on the profile holds as its range says."""
    assert solve(load(CAM.replace(", mu: 0.05", "")), rates=True).rates is not None
    known = solve(load(CAM.replace(", mu: 0.05", "").replace("unknown, link", "3, link")))
    assert known.status == "ok" and known.touching and known.rates is not None
    low, high = solve(load(CAM)).answers["T"].holds or (0.0, 0.0)
    for torque, holds in ((0.99 * low, True), (1.01 * high, True), (0.99 * high, False), (1.01 * low, False)):
        assert solve(load(CAM.replace("unknown, link", f"{torque}, link"))).holds_still is holds


def test_where_a_cam_rests_is_told_by_the_sweep_that_the_refusal_names() -> None:
    text = CAM.replace(", mu: 0.05", "")
    asked = text.replace("AC: 140", "AC: unknown").replace("  T: {torque: unknown, link: 2}\n", "")
    with pytest.raises(SceneError, match=r"--drive 2=0:360:5 --find T=0`\.$"):
        solve(load(asked))
    with pytest.raises(SceneError, match="where profiles give a contact"):
        with_stability(load(text), solve(load(text)), "2")
    found = find(load(text), None, Query("value", "T", 0.0), drive={"2": [0.0, 360.0]})
    for one in found:
        written = text.replace("AC: 140", f"AC: {140 + one.at!r}").replace("unknown, link", "0, link")
        assert "those that are given balance in this position" in "".join(solve(load(written)).notes)
    assert len(found) == 2
