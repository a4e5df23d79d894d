"""Depth that follows a motion."""

from __future__ import annotations

import copy
import pickle

import pytest

import dymsum
from dymsum import ContinuousDepth, ContinuousDepthOptions, Discontinuity, Meeting, Rotation, solids

BOX = solids.box(-1, -1, -1, 1, 1, 1)


def _pair(smoothing: float, **more: float) -> ContinuousDepth:
    return ContinuousDepth(BOX, BOX, ContinuousDepthOptions(smoothing_length=smoothing, **more))


def test_over_an_edge_the_direction_turns_and_does_not_jump() -> None:
    smooth, sharp = _pair(2), _pair(0)
    found, exact = [], []
    for k in range(41):
        at = (1 + 0.02 * min(k, 25), 0, 1.5 - 0.03 * max(k - 25, 0))
        found.append(smooth.query(at))
        exact.append(sharp.query(at))
        assert smooth.euclidean_squared() == sharp.euclidean_squared()
    assert [row.discontinuity for row in found[1:]] == [Discontinuity.none] * 40
    assert {row.branch for row in found} == {1}
    assert sum(row.discontinuity == Discontinuity.fold for row in exact) == 1
    assert all(a.depth >= b.depth - 1e-12 for a, b in zip(found, exact))


def test_meetings_and_witnesses() -> None:
    pair = _pair(1)
    assert pair.query((2, 0, 0)).meeting == Meeting.touching
    assert pair.query((3, 0, 0)).meeting == Meeting.apart
    found = pair.query((1.5, 0.25, 0), Rotation.about((0, 0, 1), 0.1))
    assert found.meeting == Meeting.overlapping
    assert found.witness_p.x == pytest.approx(found.witness_q.x + found.depth * found.normal.x)
    assert found.work.local_sums > 0


def test_a_patch_answers_alone() -> None:
    pair = _pair(1)
    pair.query((1.5, 0, 0))
    patch = pair.patch()
    assert patch.covers((1.51, 0.01, 0))
    assert patch.at((1.51, 0.01, 0)).depth == pytest.approx(pair.query((1.51, 0.01, 0)).depth)
    with pytest.raises(ValueError):
        patch.at((float("nan"), 0, 0))


def test_errors() -> None:
    for options, code in [
        (ContinuousDepthOptions(smoothing_length=-1), "out_of_range"),
        (ContinuousDepthOptions(smoothing_length=float("nan")), "not_finite"),
        (ContinuousDepthOptions(inflation=0.5), "out_of_range"),
    ]:
        with pytest.raises(dymsum.Error) as refused:
            ContinuousDepth(BOX, BOX, options)
        assert refused.value.code.name == code
    with pytest.raises(dymsum.Error):
        ContinuousDepth(BOX, dymsum.Mesh())
    pair = _pair(1)
    with pytest.raises(RuntimeError):
        pair.euclidean_squared()
    with pytest.raises(dymsum.Error):
        pair.query((float("inf"), 0, 0))


def test_copies_begin_anew() -> None:
    pair = _pair(1)
    pair.query((1.5, 0, 0))
    for other in (pickle.loads(pickle.dumps(pair)), copy.copy(pair)):
        assert other.smoothing_length() == 1
        assert other.query((1.5, 0, 0)).discontinuity == Discontinuity.entered
    pair.forget()
    assert pair.query((1.5, 0, 0)).discontinuity == Discontinuity.entered
