"""What is welded together is one body, whichever of its pieces a joint names: the frame, a cam, a follower.

Cases of the library are told once more with a further link, which is welded to one of their own and has its
joints: nothing may change.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import icsolve
from icsolve import Case
from icsolve.draw.words import description, line_words
from icsolve.explain import explain
from icsolve.page.live import live_of
from icsolve.page.motion import inputs
from icsolve.read.document import Mapping, Scalar, Sequence
from icsolve.report.derivation.known import known_of
from icsolve.solve.positions import rest_of
from library import FILES
from sizes import sampled
from trees import document, tree

PIECE = "piece"
KINDS = ("pin", "slide", "slot", "roll", "contact", "weld")
TEXTS = {name: path.read_text() for name, path in FILES.items()}
RESTING = [name for name in FILES if name.startswith("equilibrium/")]
CAMS = [name for name, text in TEXTS.items() if "profile:" in text]
OTHERS = [name for name, text in TEXTS.items() if "axis:" not in text and "screw:" not in text]


def in_two(name: str, link: str) -> Case:
    """A case with the joints of a link on a further one that is welded to it; what a profile gives stays."""
    root: Any = tree(TEXTS[name])
    root.items.pop("expect", None)
    joints = root.items["joints"].items
    for joint in joints:
        for kind in KINDS:
            if kind in joint.items and not (kind == "contact" and "at" not in joint.items):
                named = joint.items[kind].items
                named[:] = [one._replace(text=PIECE) if one.text == link else one for one in named]
    pair = [Scalar(text, True, root.mark) for text in (link, PIECE)]
    joints.append(Mapping({"weld": Sequence(pair, root.mark)}, {}, root.mark))
    return icsolve.load(document(root))


def told(case: Case) -> tuple[list[object], list[float]]:
    """What is found of a case, but for the names of its links: words, and numbers."""
    found = icsolve.solve(case)
    words: list[object] = [(name, one.sense, one.value is None) for name, one in found.answers.items()]
    numbers = [one.value for one in found.answers.values() if one.value is not None]
    numbers += [end for one in found.answers.values() for end in one.holds or () if end is not None]
    for position in found.positions or ():
        words.append(position.stability)
        numbers += [value for _, value in sorted(position.at.items())]
    words += [one.pressure_angle is None for one in found.touching]
    numbers += [one.pressure_angle for one in found.touching if one.pressure_angle is not None]
    return words, numbers


def assert_alike(case: Case, other: Case) -> None:
    """That two cases are answered alike, to what the rounding of a figure that is read anew leaves."""
    (words, numbers), (others, values) = told(case), told(other)
    assert words == others
    assert values == pytest.approx(numbers, rel=1e-12, abs=1e-12)


@sampled(8, "name")
@pytest.mark.parametrize("name", [name for name in OTHERS if name not in RESTING + CAMS])
def test_answers_are_those_of_a_frame_in_one_piece(name: str) -> None:
    case = icsolve.load(FILES[name])
    assert_alike(case, in_two(name, case.ground))


@sampled(4)
@pytest.mark.parametrize("name", RESTING)
def test_positions_are_those_of_a_frame_in_one_piece(name: str) -> None:
    case = icsolve.load(FILES[name])
    assert_alike(case, in_two(name, case.ground))


@sampled(4)
@pytest.mark.parametrize("which", ["frame", "cam", "follower"])
@pytest.mark.parametrize("name", CAMS)
def test_a_cam_its_follower_and_their_frame_may_each_be_of_two_pieces(name: str, which: str) -> None:
    case = icsolve.load(FILES[name])
    assert case.profiles is not None
    cam, follower = case.profiles.shapes
    other = in_two(name, {"frame": case.ground, "cam": cam, "follower": follower}[which])
    assert_alike(case, other)
    turn = {cam: np.array([0.0, 7.0, 40.0])}
    first, second = (icsolve.sweep(one, drive=turn, want=("answers", "status")) for one in (case, other))
    assert list(first.status) == list(second.status)
    for load, values in first.answers.items():
        assert second.answers[load] == pytest.approx(values, rel=1e-9, nan_ok=True)


@sampled(12, "name")
@pytest.mark.parametrize("name", [name for name in OTHERS if name not in RESTING])
def test_what_is_welded_to_the_frame_is_not_told_to_move(name: str) -> None:
    case = icsolve.load(FILES[name])
    other = in_two(name, case.ground)
    if not known_of(case).structure:
        counted = [description(known_of(one)).partition(" and the frame")[0] for one in (case, other)]
        assert counted[0] == counted[1]
        assert f"The frame is link {case.ground}, with link {PIECE} welded to it; " in explain(other)


@sampled(3)
@pytest.mark.parametrize("name", [name for name in OTHERS if "slot:" in TEXTS[name] and name not in RESTING])
def test_a_centre_is_found_by_the_same_normals(name: str) -> None:
    """Of the joint that is written, whichever piece bears its name, and with no roller that is none."""
    case = icsolve.load(FILES[name])
    one, two = known_of(case), known_of(in_two(name, case.ground))
    if one.answer is None:
        return
    assert two.answer is not None
    found = {frozenset(pair): centre for pair, centre in two.answer.centres.items()}
    for pair, centre in one.answer.centres.items():
        other = found[frozenset(pair)]
        normals = [n for n, line in enumerate(centre.lines) if len(line) == 1]
        others = [n for n, line in enumerate(other.lines) if len(line) == 1]
        assert [line_words(one, centre.lines, n) for n in normals] == [
            line_words(two, other.lines, n) for n in others
        ]
        for n in others:
            assert {*other.lines[n][0]} == {*pair}


@sampled(12, "name")
@pytest.mark.parametrize("name", [name for name in OTHERS if name not in RESTING + CAMS])
def test_a_page_is_moved_as_with_a_frame_in_one_piece(name: str) -> None:
    """By the same link; links are dragged about the frame's pins, and along its guides."""
    case = icsolve.load(FILES[name])
    one, two = known_of(case, reactions=True), known_of(in_two(name, case.ground), reactions=True)
    assert inputs(one) == inputs(two)
    first, second = live_of(one), live_of(two)
    assert (first is None) == (second is None)
    if first is not None and second is not None:
        for key in ("moves", "turning"):
            assert first.data[key] == second.data[key]
        assert first.data["rails"].keys() == second.data["rails"].keys()


def test_a_link_that_is_welded_to_the_frame_is_refused_as_the_frame_is() -> None:
    name = "linkages/four_bar.yaml"
    case = in_two(name, icsolve.load(FILES[name]).ground)
    refused = []
    for link in (case.ground, PIECE):
        with pytest.raises(icsolve.SceneError) as caught:
            rest_of(case, link)
        refused.append((caught.value.status, caught.value.message.replace(link, "")))
    assert refused[0] == refused[1]
