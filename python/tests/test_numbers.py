"""Numbers are taken exactly or refused: none is rounded, and what is no number is told so."""

from __future__ import annotations

from fractions import Fraction as F
from typing import Any

import numpy
import pytest

import dymsum
from dymsum import ErrorCode

TRIANGLE = [(0, 0), (1, 0), (0, 1)]
VERTICES = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
TINY = F(1, 10**40)


@pytest.mark.parametrize(
    ("at", "inside"), [((F(1, 3), F(5, 3)), True), ((F(1, 3), F(5, 3) + TINY), False), ((F(1, 3), F(1, 3)), True)]
)
def test_check_translation_tells_exact_positions_of_the_plane(at: tuple[F, F], inside: bool) -> None:
    robot = dymsum.negated(TRIANGLE)
    check = dymsum.check_translation(robot, TRIANGLE, at, at, dymsum.Orientation(), dymsum.Touching.forbidden)
    assert check.free is not inside


@pytest.mark.parametrize("x", [F(1, 3), 2**53 + 1, 10**400, numpy.longdouble(1) / 3])
def test_coordinates_that_no_double_holds(x: Any) -> None:
    for ring in ([(0, 0), (x, 0), (0, x)], [(0, 0.5), (x, 0), (0, x)]):
        with pytest.raises(dymsum.Error) as caught:
            dymsum.Region(ring)
        assert caught.value.code == ErrorCode.unsupported_operand
    with pytest.raises(dymsum.Error):
        dymsum.Mesh(([(0, 0, x), *VERTICES[1:]], FACES))


@pytest.mark.parametrize("x", [F(1, 2), 2**60, numpy.longdouble(3), numpy.float32(0.1)])
def test_coordinates_that_doubles_hold(x: Any) -> None:
    assert dymsum.Region([(0, 0), (x, 0), (0, x)]).parts[0].outer[1, 0] == x


def test_arrays_that_are_no_plain_numbers() -> None:
    hidden = numpy.ma.array(TRIANGLE, mask=[[0, 0], [1, 1], [0, 0]], dtype=float)
    for ring in (hidden, list(hidden), numpy.array(TRIANGLE, complex), numpy.array(TRIANGLE, "M8[D]")):
        with pytest.raises(TypeError):
            dymsum.Region(ring)
