"""Planar local sums from Python: the values of the library, engines that agree, errors, pickling."""

from __future__ import annotations

import pickle
from fractions import Fraction

import pytest

import dymsum
from dymsum import LocalEngine, PlanarBox, PlanarDisc, PlanarLocalOptions, PlanarLocalPart, PlanarLocalSum, shapes

SQUARE = shapes.rectangle(-1, -1, 1, 1)
GEAR, STAR = shapes.gear(9, 2, 3), shapes.star(7, 0.75, 1.5)


def test_a_corner_of_a_square() -> None:
    part = PlanarLocalSum(SQUARE, SQUARE).in_(PlanarBox((1, 1), (3, 3)))
    assert part.where == PlanarLocalPart.Where.crossed
    assert len(part.edges) == 2 and len(part.vertices) == 3 and not part.tight_segments and not part.tight_points
    assert part.exact(2) == (Fraction(2), Fraction(2)) and part.box == PlanarBox((1, 1), (3, 3))
    assert {(edge.from_, edge.to) for edge in part.edges} == {(1, 2), (2, 0)}
    assert dymsum.part_svg(part).startswith("<svg")
    with pytest.raises(IndexError):
        part.exact(3)


def test_engines_agree_while_regions_turn() -> None:
    sums = [PlanarLocalSum(GEAR, STAR, PlanarLocalOptions(engine)) for engine in (LocalEngine.updated, LocalEngine.hierarchy, LocalEngine.brute)]
    for k in range(6):
        pose, other = dymsum.PlanarPose(dymsum.Orientation.of(k, 90)), dymsum.PlanarPose(dymsum.Orientation.of(-1, 7), (2, Fraction(1, 3)))
        for place in (PlanarBox((1, 1), (4, 3)), PlanarDisc((2, 2), 1)):
            parts = [sum.in_(place, pose, other) for sum in sums]
            assert parts[0] == parts[1] == parts[2]


def test_discs_touch_exactly() -> None:
    sum = PlanarLocalSum(SQUARE, SQUARE)
    assert len(sum.in_(PlanarDisc((0, 3), 1)).edges) == 1
    assert sum.in_(PlanarDisc((0, 3), 1 - 2**-53)).where == PlanarLocalPart.Where.outside
    assert dymsum.bounding_box(PlanarDisc((1, 2), 1)) == PlanarBox((0, 1), (2, 3))


def test_errors_and_pickling() -> None:
    sum = PlanarLocalSum(SQUARE, SQUARE)
    for place in (PlanarBox((0, 0), (1, 0)), PlanarDisc((0, 0), 0)):
        with pytest.raises(dymsum.Error) as raised:
            sum.in_(place)
        assert raised.value.code == dymsum.ErrorCode.out_of_range
    part = PlanarLocalSum(GEAR, STAR).in_(PlanarDisc((2, 3), 1))
    assert pickle.loads(pickle.dumps(part)) == part
    assert pickle.loads(pickle.dumps(sum)).in_(PlanarDisc((2, 2), 1)) == sum.in_(PlanarDisc((2, 2), 1))
