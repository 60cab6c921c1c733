"""A record that is replayed: many rows on arrays, one row that comes again and again as Python."""

from __future__ import annotations

import gc
from random import Random

import numpy as np
import pytest

from icsolve.bench.full_turn import FOUR_BAR_CASE, SLIDER_CRANK_CASE
from icsolve.numbers.record import Op, Record, Traced
from icsolve.numbers.replay import SOON, Code
from icsolve.read import load
from icsolve.sweep import sweep
from icsolve.sweep.program import RowRequest, compile_sweep, setting_of
from sizes import sampled


@sampled(2)
@pytest.mark.parametrize("seed", range(20))
def test_a_row_alone_has_the_bits_that_it_has_among_others(seed: int) -> None:
    """Also when it was run so often that it goes as Python; and what is divided by zero as well."""
    rng = Random(seed)
    record = Record()
    values = [record.input(f"x{n}", rng.uniform(-2.0, 2.0)) for n in range(4)]
    inputs = [value.index for value in values]
    for _ in range(40):
        a, b = rng.choice(values), rng.choice(values)
        made = rng.choice(
            [
                *(a + b, a - b, a * b, a / (b if b is not a else 2.0), -a, record.sqrt(a * a + b * b)),
                *(record.angle(a, b) if a is not b else a, *record.turned(90.0 * a), record.nearest(a)),
            ]
        )
        values += [made] if isinstance(made, Traced) else []
    code = Code(record, [value.index for value in values])
    rows = [[rng.choice((0.0, 1.0, -2.0, rng.uniform(-9.0, 9.0))) for _ in inputs] for _ in range(SOON + 40)]
    together = Code(record, code.wanted).table(
        {k: np.array(column) for k, column in zip(inputs, zip(*rows, strict=True), strict=True)}, len(rows)
    )
    for n, row in enumerate(rows):
        alone = code.table({k: np.array([x]) for k, x in zip(inputs, row, strict=True)}, 1)
        assert np.array_equal(alone[:, 0], together[:, n], equal_nan=True), n


@sampled(2)
@pytest.mark.parametrize("text", [FOUR_BAR_CASE, SLIDER_CRANK_CASE], ids=["four-bar", "slider-crank"])
def test_a_sweep_that_is_no_longer_kept_leaves_nothing_to_the_garbage_collector(text: str) -> None:
    """A record and its numbers do not keep one another: families of thousands of mechanisms would have the
    collector run time and again, a tenth of their time."""
    crank = next(line for line in text.splitlines() if line.startswith("lengths"))
    cases = [load(text.replace(crank, crank.replace("AB: 1", f"AB: 1.0{k:02d}"))) for k in range(1, 91)]
    for case in cases[:5]:  # imports what it needs
        sweep(case, {"angles.AB": np.linspace(60.0, 80.0, 5)})
    gc.collect()
    gc.disable()
    try:
        for case in cases[5:]:  # more than are kept
            sweep(case, {"angles.AB": np.linspace(60.0, 80.0, 5)})
        assert gc.collect() == 0
    finally:
        gc.enable()


@pytest.mark.parametrize("text", [FOUR_BAR_CASE, SLIDER_CRANK_CASE], ids=["four-bar", "slider-crank"])
def test_a_place_as_written_that_no_row_needs_is_not_on_the_record(text: str) -> None:
    """Of links whose lengths the case gives these alone matter: no root is taken of what is the same in every
    row, as the place of a pin as written would have it."""
    record = compile_sweep(setting_of(load(text), ["angles.AB"], []), RowRequest()).record
    roots = [node for node in record.nodes if node.op == Op.SQRT]
    assert roots and all(node.row for node in roots)
