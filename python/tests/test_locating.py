"""Points in planar sums: batches located in the sum, exact numbers, prepared sums."""

from __future__ import annotations

import pickle
import time
from fractions import Fraction as F

import numpy
import pytest

import dymsum
from dymsum import Semantics, SumLocator, SumOptions, shapes

P, Q = shapes.random_polygon(30, 1, 4), shapes.star(7, 0.1, 0.2)
EVERY = [Semantics.closed, Semantics.open, Semantics.regular]


@pytest.mark.parametrize("semantics", EVERY)
def test_a_batch_equals_single_points(semantics: Semantics) -> None:
    points = numpy.random.default_rng(3).uniform(-1.5, 1.5, (20000, 2))
    inside = dymsum.contains_each(P, Q, points, semantics)
    assert inside[:300].tolist() == [dymsum.contains(P, Q, point, semantics) for point in points[:300]]
    assert (dymsum.contains_each(P, Q, points, semantics, threads=1) == inside).all()
    assert inside[-3:].tolist() == dymsum.contains_each(P, Q, points[-3:], semantics).tolist()
    locator = SumLocator(dymsum.minkowski_sum(P, Q, SumOptions(semantics=semantics)), semantics)
    assert (locator.contains_each(points) == inside).all()
    assert 1000 < inside.sum() < 19000


def test_exact_vertices_of_a_sum() -> None:
    sum = dymsum.minkowski_sum(P, Q)
    vertices = [sum.exact(vertex) for vertex in sum.parts[0].outer.vertices]
    assert any(x.denominator.bit_count() > 1 for x, _ in vertices), "no vertex that doubles do not hold"
    assert dymsum.contains_each(P, Q, vertices).all()
    assert not dymsum.contains_each(P, Q, vertices, Semantics.open).any()
    leftmost = min(vertices)
    assert dymsum.contains(P, Q, leftmost)
    assert not dymsum.contains(P, Q, (leftmost.x - F(1, 10**40), leftmost.y))
    locator = SumLocator(sum)
    assert locator.contains(leftmost) and locator.contains_rational(leftmost)


def test_tight_features_are_left_out_of_the_open_sum() -> None:
    plate = dymsum.Region([[(0, 0), (9, 0), (9, 9), (0, 9)], [(3, 3), (3, 5), (7, 5), (7, 3)]])
    peg = shapes.rectangle(-1, -1, 1, 1)
    way = [(x, 4) for x in numpy.linspace(4, 6, 5)]
    asked = numpy.array([*way, (numpy.nextafter(6, 7), 4), (5, numpy.nextafter(4, 5))])
    expected = [False] * 5 + [True] * 2
    many = numpy.repeat(asked, 5000, axis=0)
    assert dymsum.contains_each(plate, peg, asked, Semantics.open).tolist() == expected
    assert (dymsum.contains_each(plate, peg, many, Semantics.open) == numpy.repeat(expected, 5000)).all()
    assert dymsum.contains_each(plate, peg, many).all()


def test_a_locator_of_an_inner_fit_and_of_a_frame() -> None:
    fit = SumLocator(dymsum.erode(shapes.rectangle(0, 0, 3, 2), shapes.rectangle(0, 0, 1, 2)))
    assert fit.contains_each([(0, 0), (1.5, 0), (2, 0), (2.5, 0), (1, 1)]).tolist() == [True, True, True, False, False]
    moving = dymsum.ScalingSum(shapes.star(5, 1, 2), shapes.rectangle(0, 0, 1, 1))
    moving.set(F(5, 3))
    frame = SumLocator(moving.sum())
    assert frame.contains((0, 0)) and not frame.contains((5, 0))


def test_a_locator_is_pickled_and_keeps_no_reference() -> None:
    locator = SumLocator(dymsum.nfp(P, Q), Semantics.closed)
    points = numpy.random.default_rng(5).uniform(-1.5, 1.5, (50, 2))
    assert (pickle.loads(pickle.dumps(locator)).contains_each(points) == locator.contains_each(points)).all()


def test_nothing_and_no_place() -> None:
    square = shapes.rectangle(0, 0, 1, 1)
    for count in (1, 5000):
        odd = numpy.array([(numpy.nan, 0), (numpy.inf, 1), (0, -numpy.inf), (1e308, 0)] * count)
        assert not dymsum.contains_each(square, square, odd).any()
        assert not dymsum.contains_each(square, dymsum.Region(), odd).any()
    for empty in (numpy.zeros((0, 2)), [], numpy.zeros((0, 2), int)):
        assert dymsum.contains_each(square, square, empty).shape == (0,)
    with pytest.raises(dymsum.Error) as raised:
        dymsum.contains_each(square, dymsum.scaled(square, 2.0**1010, 2.0**1010), [(0, 0)])
    assert raised.value.code == dymsum.ErrorCode.unsupported_operand


def test_a_million_points() -> None:
    """The bound is loose, for busy machines: one by one they took minutes."""
    star, gear = shapes.star(60, 1, 4), shapes.gear(40, 3, 4)
    points = numpy.random.default_rng(7).uniform(-9, 9, (10**6, 2))
    begin = time.monotonic()
    inside = dymsum.contains_each(star, gear, points)
    assert time.monotonic() - begin < 10
    assert 0.3 < inside.mean() < 0.9
