"""Sums of solids of any shape that follow poses."""

from __future__ import annotations

import copy
import pickle
from fractions import Fraction

import pytest

import dymsum
from dymsum import (
    ErrorCode,
    FrameMode,
    MovingSolidOptions,
    MovingSolidSum,
    Rotation,
    Scale,
    Semantics,
    SolidPose,
    posed_sum,
    posed_sums,
    shapes,
    solids,
)

ELL, BOX = solids.prism(shapes.letter_l(3, 2, 1).parts[0].outer, 1), solids.box(0, 0, 0, 1, 1, 1)


def turned(k: int) -> SolidPose:
    return SolidPose(Rotation.of(200, k, 2 * k, k))


@pytest.mark.parametrize("mode", [FrameMode.automatic, FrameMode.window, FrameMode.rebuild])
def test_every_frame_is_the_sum_from_scratch(mode: FrameMode) -> None:
    sum = MovingSolidSum(ELL, ELL, MovingSolidOptions(mode=mode))
    assert sum.sum() == dymsum.minkowski_sum(ELL, ELL) and sum.p_pose() == sum.q_pose() == SolidPose()
    assert sum.changes().appeared == []
    rebuilt = []
    for k in range(1, 6):
        work = sum.set(turned(k), turned(-k))
        assert work.facets == sum.work().facets > 0
        rebuilt.append(work.rebuilt)
        assert sum.sum() == posed_sum(ELL, ELL, turned(k), turned(-k))
        assert (sum.p_pose(), sum.q_pose()) == (turned(k), turned(-k))
    assert all(rebuilt) if mode == FrameMode.rebuild else not rebuilt[-1]


@pytest.mark.parametrize("threads", [1, 2])
def test_sums_at_scattered_poses_come_in_their_order(threads: int) -> None:
    options = MovingSolidOptions(threads=threads)
    of_p, of_q = [turned(7 * k % 30) for k in range(9)], [turned(-k) for k in range(9)]
    sums = posed_sums(ELL, ELL, of_p, of_q, options)
    assert sums == [posed_sum(ELL, ELL, p, q) for p, q in zip(of_p, of_q)]
    assert pickle.loads(pickle.dumps(sums[4])) == sums[4]
    assert posed_sums(ELL, BOX, of_p) == [posed_sum(ELL, BOX, p) for p in of_p]
    assert posed_sums(ELL, BOX, []) == []
    with pytest.raises(dymsum.Error) as error:
        posed_sums(ELL, BOX, of_p, of_q[:2])
    assert error.value.code == ErrorCode.out_of_range


def test_changes_of_a_quarter_turn() -> None:
    sum = MovingSolidSum(ELL, BOX)
    whole = len(sum.sum().faces)
    sum.set(turned(3))
    changes = sum.changes()
    assert len(sum.sum().faces) > whole and changes.appeared and changes.disappeared
    assert changes.shells == 0
    sum.set(turned(3))
    assert sum.changes().appeared == sum.changes().disappeared == sum.changes().changed == []


def test_scales_of_both() -> None:
    sum = MovingSolidSum(BOX, BOX)
    half, double = Scale(Fraction(1, 2)), Scale(2)
    sum.set(SolidPose(scale=[half, half, half]), SolidPose(scale=[double, half, half]))
    assert sum.sum().volume() == 2.5
    with pytest.raises(dymsum.Error) as raised:
        MovingSolidSum(BOX, BOX, MovingSolidOptions(threads=-1))
    assert raised.value.code == ErrorCode.out_of_range


def test_options_and_copies() -> None:
    options = MovingSolidOptions(Semantics.open, tight=False, threads=2)
    sum = MovingSolidSum(ELL, BOX, options)
    assert sum.options.semantics == Semantics.open and not sum.options.tight and sum.options.threads == 2
    sum.set(turned(2))
    for again in (pickle.loads(pickle.dumps(sum)), copy.deepcopy(sum)):
        assert again.sum() == sum.sum() and again.p_pose() == turned(2) and again.options.threads == 2
    assert pickle.loads(pickle.dumps(sum.sum())) == sum.sum()
    kept = sum.sum()
    sum.set(turned(9))
    assert kept == posed_sum(ELL, BOX, turned(2), options=options) != sum.sum()
