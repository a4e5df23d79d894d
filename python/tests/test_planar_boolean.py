"""Boolean operations of regions and results, and rings filled by winding number."""

from __future__ import annotations

import pickle
from fractions import Fraction

import pytest

import dymsum
from dymsum import Fill, Region, Semantics, SumOptions, shapes

A, B = shapes.rectangle(0, 0, 2, 2), shapes.rectangle(1, 1, 3, 3)


def _with(semantics: Semantics) -> SumOptions:
    options = SumOptions()
    options.semantics = semantics
    return options


def test_operators_are_regularized_operations() -> None:
    assert (A | B).area_exact() == 7
    assert (A & B).area_exact() == 1
    assert (A - B).area_exact() == 3
    assert (A ^ B).area_exact() == 6
    beside = shapes.rectangle(2, 0, 4, 2)
    assert len((A & beside).parts) == 0 and len((A & beside).segments) == 0
    assert len(dymsum.intersection(A, beside).segments) == 1
    assert len((A - A).segments) == 0 and len(dymsum.difference(A, A).segments) == 4


def test_results_are_operands_without_rounding() -> None:
    up, down = Region([(0, 0), (7, 1), (1, 7)]), Region([(6, 6), (-1, 5), (5, -1)])
    spike = Region([(3, -2), (4, 9), (2, 9)])
    both = up & down
    cut = both - spike
    assert (cut | (both & spike)) == both
    assert cut.area_exact() + (both & spike).area_exact() == both.area_exact()
    assert dymsum.united([cut, both & spike], _with(Semantics.regular)) == both
    assert pickle.loads(pickle.dumps(cut)) == cut


def test_other_results_are_operands() -> None:
    grown = dymsum.minkowski_sum(A, shapes.rectangle(0, 0, 1, 1))
    assert (grown - A).area_exact() == 5
    crossed = dymsum.union_of([[(0, 0), (7, 1), (1, 7)], [(3, -2), (4, 9), (2, 9)]])
    assert (crossed - A).area_exact() + (crossed & A).area_exact() == crossed.area_exact()


def test_what_is_a_region_elsewhere_is_an_operand() -> None:
    assert (A - "POLYGON((0 0, 1 0, 1 1, 0 1, 0 0))").area_exact() == 3
    assert dymsum.intersection([A, B, [(1, 1), (2, 1), (1, 2)]]).area_exact() == Fraction(1, 2)
    with pytest.raises(TypeError):
        A - 3
    with pytest.raises(dymsum.Error):
        dymsum.intersection([])


def test_rings_that_cross_are_filled() -> None:
    bow = [[(0, 0), (2, 2), (2, 0), (0, 2)]]
    assert dymsum.filled(bow, Fill.even_odd).area_exact() == 2
    assert dymsum.filled(bow, Fill.positive).area_exact() == 1
    again = pickle.loads(pickle.dumps(dymsum.filled(bow)))
    assert again == dymsum.filled(bow)
    made = dymsum.repair_with_fill(bow, Fill.nonzero)
    assert len(made.region.parts) == 2
    assert made.report.rings == 1 and made.report.rings_now == 2 and made.report.crossings == 1
    assert made.report.filled and made.report.changed()
    assert "1 crossing" in made.report.to_string()
