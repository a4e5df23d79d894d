"""Results wherever regions are taken: sums of sums, erosions of results, openings, exact results read back."""

from __future__ import annotations

import pathlib
import pickle
from fractions import Fraction

import pytest

import dymsum
from dymsum import Region, Semantics, SumOptions, shapes

P = Region([(0, 0), (7, 1), (5, 3), (8, 8), (4, 4), (1, 7)])
Q = Region([(0, 0), (3, -1), (4, 9), (2, 9)])
R = Region([(0, 0), (1, 0), (0, 2)])


def _regular() -> SumOptions:
    options = SumOptions()
    options.semantics = Semantics.regular
    return options


def test_sums_are_associative() -> None:
    left = dymsum.minkowski_sum(dymsum.minkowski_sum(P, Q), R)
    right = dymsum.minkowski_sum(P, dymsum.minkowski_sum(Q, R))
    assert len((left ^ right).parts) == 0
    assert dymsum.minkowski_sum([P, Q, R]) == left
    assert pickle.loads(pickle.dumps(left)) == left
    assert pickle.loads(pickle.dumps(dymsum.minkowski_sum([P, Q, R]))) == left
    with pytest.raises(dymsum.Error):
        dymsum.minkowski_sum([])


def test_openings_lie_inside_and_closings_around() -> None:
    opened, closed = dymsum.opening(P, R), dymsum.closing(P, R)
    assert len((opened - P).parts) == 0 and len((P - closed).parts) == 0
    assert dymsum.opening(opened, R, _regular()) == dymsum.opening(P, R, _regular())
    fit = dymsum.erode(P, R)
    assert dymsum.minkowski_sum(fit, R) == opened
    assert pickle.loads(pickle.dumps(opened)) == opened and pickle.loads(pickle.dumps(closed)) == closed


def test_contains_takes_results() -> None:
    both = dymsum.minkowski_sum(P, Q)
    assert dymsum.contains(both, R, (0, 0)) and dymsum.contains(both, R, (Fraction(1, 3), Fraction(1, 3)))
    assert not dymsum.contains(both, R, (-1, 0)) and not dymsum.contains(both, R, (Fraction(-1, 3), 0))


def test_exact_results_are_read_back(tmp_path: pathlib.Path) -> None:
    fit = dymsum.opening(P, R)
    file = tmp_path / "fit.json"
    dymsum.write_file(str(file), fit.to_json())
    assert dymsum.names_sum(file) and dymsum.begins_like_sum(fit.to_json())
    read = dymsum.read_sum(file)
    assert read == fit and dymsum.parse_sum(fit.to_json()) == fit
    assert dymsum.minkowski_sum(read, Q) == dymsum.minkowski_sum(fit, Q)
    assert pickle.loads(pickle.dumps(read)) == fit
    with pytest.raises(dymsum.Error):
        dymsum.parse_sum('{"parts":[]}')
    with pytest.raises(dymsum.Error):
        dymsum.read_sum(tmp_path / "none.json")
