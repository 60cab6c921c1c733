"""What a run takes of the laws that it samples."""

from __future__ import annotations

from itertools import product

from library import FILES, sample
from sizes import FULL, taken


def test_a_sample_meets_every_kind_and_no_more_trials_than_it_is_to_take() -> None:
    trials = {f"law[{a}-{b}]": {("a", a), ("b", b)} for a, b in product(range(4), range(6))}
    for one_in, count in ((1, 24), (3, 8), (4, 6), (24, 6)):
        found = taken(trials, one_in)
        assert len(found) == count
        assert {kind for name in found for kind in trials[name]} == {("a", a) for a in range(4)} | {
            ("b", b) for b in range(6)
        }
    assert taken(trials, 3) == taken(dict(reversed(trials.items())), 3)
    assert taken({"law[0]": set()}, 3) == {"law[0]"}


def test_other_laws_take_other_trials_and_together_they_take_all() -> None:
    samples = [taken({f"law {n}[{trial}]": set() for trial in range(30)}, 3) for n in range(20)]
    trials = [{name.partition("[")[2] for name in one} for one in samples]
    assert [len(one) for one in trials] == [10] * 20
    assert len(set().union(*trials)) == 30
    assert FULL or {name for n in range(40) for name in sample(FILES, 6, f"law {n}")} == {*FILES}
