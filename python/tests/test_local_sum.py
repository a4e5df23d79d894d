"""Local sums from Python: the values of the library, engines that agree, errors, pickling."""

from __future__ import annotations

import pickle
from fractions import Fraction

import numpy
import pytest

import dymsum
from dymsum import ClipBall, ClipBox, LocalEngine, LocalOptions, LocalPart, LocalSum, solids

BOX = solids.box(-1, -1, -1, 1, 1, 1)
ANGLE = solids.prism([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)], 1.0)


def test_a_corner_of_a_cube() -> None:
    part = LocalSum(BOX, BOX).in_(ClipBox((1, 1, 1), (3, 3, 3)))
    assert part.where == LocalPart.Where.crossed
    assert part.boundary.shells == 1 and len(part.boundary.faces) == 3
    assert part.boundary.exact(len(part.boundary.vertices) - 1) == (Fraction(2), Fraction(2), Fraction(2))
    assert part.box == ClipBox((1, 1, 1), (3, 3, 3)) and part.work.facets > 0


def test_engines_agree_while_solids_turn() -> None:
    sums = [LocalSum(ANGLE, BOX, LocalOptions(engine)) for engine in (LocalEngine.updated, LocalEngine.hierarchy, LocalEngine.brute)]
    for k in range(5):
        pose = dymsum.SolidPose(dymsum.Rotation.about((1, 2, 3), 0.02 * k))
        place = ClipBox(numpy.array([0.5, 0.5, -0.5]) + 0.1 * k, (3, 3, 2))
        parts = [sum.in_(place, pose) for sum in sums]
        assert parts[0] == parts[1] == parts[2] and parts[0].where == LocalPart.Where.crossed
        assert sums[0].in_(ClipBall((2, 2, 1), 0.5), pose) == sums[2].in_(ClipBall((2, 2, 1), 0.5), pose)
    assert sums[0].facet_count() == sums[2].facet_count() > 0


def test_balls_touch_exactly() -> None:
    sum = LocalSum(BOX, BOX)
    assert len(sum.in_(ClipBall((0, 0, 3), 1)).boundary.faces) == 1
    assert sum.in_(ClipBall((0, 0, 3), numpy.nextafter(1, 0))).where == LocalPart.Where.outside
    assert dymsum.bounding_box(ClipBall((1, 2, 3), 1)) == ClipBox((0, 1, 2), (2, 3, 4))


def test_errors() -> None:
    sum = LocalSum(BOX, BOX)
    for place in (ClipBox((0, 0, 0), (1, 0, 1)), ClipBall((0, 0, 0), 0)):
        with pytest.raises(dymsum.Error) as raised:
            sum.in_(place)
        assert raised.value.code == dymsum.ErrorCode.out_of_range
    with pytest.raises(TypeError):
        sum.in_(3)  # type: ignore[call-overload]


def test_pickled_and_copied() -> None:
    sum = LocalSum(ANGLE, BOX, LocalOptions(threads=1, progress=lambda stage, share: None))
    place, pose = ClipBall((2, 2, 1), 0.5), dymsum.SolidPose(dymsum.Rotation.about((1, 0, 0), 0.1))
    part = sum.in_(place, pose)
    assert pickle.loads(pickle.dumps(part)) == part
    assert pickle.loads(pickle.dumps(sum)).in_(place, pose) == part
    with pytest.raises(TypeError):
        pickle.dumps(part.boundary)
