"""Numbers are taken exactly or refused: none is rounded, and what is no number is told so."""

from __future__ import annotations

from fractions import Fraction as F
from typing import Any

import numpy
import pytest

import dymsum
from dymsum import ErrorCode, Scale, shapes, solids

TRIANGLE = [(0, 0), (1, 0), (0, 1)]
VERTICES = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
TINY = F(1, 10**40)


def test_solids_contain_exact_positions() -> None:
    solid = (VERTICES, FACES)
    edge, beyond = (F(1, 3), F(1, 3), F(4, 3)), (F(1, 3), F(1, 3), F(4, 3) + TINY)
    for p in (solid, dymsum.Mesh(solid)):
        assert dymsum.contains_each(p, p, [edge, beyond]).tolist() == [True, False]
        assert dymsum.contains_each(p, p, numpy.array([edge, beyond], object)).tolist() == [True, False]
        assert dymsum.contains(p, p, edge) and not dymsum.contains(p, p, beyond)


def test_the_plane_takes_exact_positions() -> None:
    halves = [(F(1, 2), F(3, 2)), (F(1, 2), F(7, 4))]
    assert dymsum.contains_each(TRIANGLE, TRIANGLE, halves).tolist() == [True, False]
    assert dymsum.contains(TRIANGLE, TRIANGLE, halves[0]) and not dymsum.contains(TRIANGLE, TRIANGLE, halves[1])
    third = (F(1, 3), F(5, 3))
    beyond = (third[0], third[1] + TINY)
    for corners in ([third, beyond], [beyond]):
        assert dymsum.contains_each(TRIANGLE, TRIANGLE, corners).tolist() == [at is third for at in corners]
    assert dymsum.contains(TRIANGLE, TRIANGLE, third) and not dymsum.contains(TRIANGLE, TRIANGLE, beyond)
    assert not dymsum.contains(TRIANGLE, TRIANGLE, third, dymsum.Semantics.open)


@pytest.mark.parametrize(
    ("at", "inside"), [((F(1, 3), F(5, 3)), True), ((F(1, 3), F(5, 3) + TINY), False), ((F(1, 3), F(1, 3)), True)]
)
def test_check_translation_tells_exact_positions_of_the_plane(at: tuple[F, F], inside: bool) -> None:
    robot = dymsum.negated(TRIANGLE)
    check = dymsum.check_translation(robot, TRIANGLE, at, at, dymsum.Orientation(), dymsum.Touching.forbidden)
    assert check.free is not inside


@pytest.mark.parametrize(
    "faces",
    [
        numpy.array(FACES, float),
        numpy.array(FACES, float) + 0.5,
        *([bad, *FACES[1:]] for bad in [(0, 2, -1), (0, 2, 2**32 + 1), (0, 2, 2**80), (0, 2, "1"), (0.0, 2.0, 1.0)]),
        [(0, 2, float("nan")), *FACES[1:]],
        numpy.array([(0, 2, 2**32 + 1), *FACES[1:]]),
    ],
)
def test_indices_of_faces_are_integers(faces: Any) -> None:
    with pytest.raises(dymsum.Error) as caught:
        dymsum.volume((VERTICES, faces))
    assert caught.value.code == ErrorCode.bad_index
    assert caught.value.face == 0


def test_faces_that_are_no_lists() -> None:
    for faces in (None, ["021", "013"], 5):
        with pytest.raises(TypeError):
            dymsum.MeshData(VERTICES, faces)
    assert dymsum.volume((VERTICES, [numpy.array(face, "u1") for face in FACES])) == 1 / 6


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
        with pytest.raises(TypeError):
            dymsum.Part(ring)


def test_fields_say_what_they_refuse() -> None:
    assert dymsum.ScaledCopy(F(3, 2), (1, 1)).scale == Scale(1.5)
    assert dymsum.ScaledCopy(2, (1, 1)).at == (1, 1)
    with pytest.raises(dymsum.Error):
        dymsum.ScaledCopy(-1)
    for make in (
        lambda: dymsum.ScaledCopy("x"),  # type: ignore[arg-type, unused-ignore]
        lambda: dymsum.Contact(None),
        lambda: dymsum.Waypoint("x", "y"),
        lambda: dymsum.FaceColour(1),
        lambda: dymsum.GlbLook(1),
        lambda: dymsum.Contact(p="x"),
    ):
        with pytest.raises(TypeError):
            make()


OPTIONS = "SumOptions MovingOptions SpatialOptions PlanOptions ObstacleOptions BatchOptions ObstacleMeshOptions TableOptions"


@pytest.mark.parametrize("name", OPTIONS.split())
def test_progress_is_taken_back(name: str) -> None:
    options = getattr(dymsum, name)(progress=lambda stage, share: None)
    options.progress = None
    assert options.progress is None


@pytest.mark.parametrize(
    "make", [lambda: shapes.star(5, 1, 2).data, lambda: shapes.star(5, 1, 2).parts[0], lambda: solids.box(0, 0, 0, 1, 1, 1).data]
)
def test_lists_are_not_hashed(make: Any) -> None:
    assert make() == make()
    with pytest.raises(TypeError, match="unhashable"):
        hash(make())
