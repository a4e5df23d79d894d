"""Numbers are taken exactly or refused: none is rounded, and what is no number is told so."""

from __future__ import annotations

import copy
import decimal
import pickle
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


def test_arrays_of_objects() -> None:
    mixed = [[0, F(0)], [F(3, 2), 0.5], [numpy.float32(0.25), 2]]
    expected = dymsum.Region([(0, 0), (1.5, 0.5), (0.25, 2)])
    assert dymsum.Region(numpy.array(mixed, object)) == expected
    rings = numpy.empty(2, object)
    rings[:] = [numpy.array([(0, 0), (4, 0), (0, 4)]), [(1, 1), (1, F(3, 2)), (2, 1)]]
    assert len(dymsum.Region(rings).parts[0].holes) == 1
    assert dymsum.area(dymsum.minkowski_sum(numpy.array(TRIANGLE, object), TRIANGLE).rounded()) == 2
    assert dymsum.volume((numpy.array(VERTICES, object), numpy.array(FACES, object))) == 1 / 6
    with pytest.raises(dymsum.Error) as caught:
        dymsum.Region(numpy.array([(0, 0), (F(1, 3), 0), (0, 1)], object))
    assert caught.value.code == ErrorCode.unsupported_operand
    with pytest.raises(TypeError, match="no number"):
        dymsum.Region(numpy.array([(0, 0), ("1", 0), (0, 1)], object))


def test_arrays_that_are_no_plain_numbers() -> None:
    hidden = numpy.ma.array(TRIANGLE, mask=[[0, 0], [1, 1], [0, 0]], dtype=float)
    for ring in (hidden, list(hidden), numpy.array(TRIANGLE, complex), numpy.array(TRIANGLE, "M8[D]")):
        with pytest.raises(TypeError):
            dymsum.Region(ring)
        with pytest.raises(TypeError):
            dymsum.Part(ring)


NAN, INFINITE = float("nan"), float("inf")


@pytest.mark.parametrize(
    "odd", [NAN, INFINITE, -INFINITE, numpy.float32(NAN), decimal.Decimal("inf"), decimal.Decimal("nan")]
)
def test_what_is_not_finite_lies_nowhere_or_is_an_error(odd: Any) -> None:
    """Beside fractions as beside doubles."""
    locator = dymsum.SumLocator(dymsum.minkowski_sum(TRIANGLE, TRIANGLE))
    for other in (0.25, F(1, 3)):
        assert not dymsum.contains(TRIANGLE, TRIANGLE, (other, odd))
        assert not locator.contains((other, odd))
        for each in (lambda p: dymsum.contains_each(TRIANGLE, TRIANGLE, p), locator.contains_each):
            assert each([(other, odd), (other, other), (odd, other)]).tolist() == [False, True, False]
    solid, theta = (VERTICES, FACES), dymsum.Orientation()
    for call in (
        lambda: locator.contains_rational((F(1, 3), odd)),
        lambda: dymsum.contains(solid, solid, (F(1, 3), odd, 0)),
        lambda: dymsum.contains_each(solid, solid, [(F(1, 3), 0, 0), (odd, 0, F(1, 3))]),
        lambda: dymsum.contains_each(solid, solid, [(0.5, 0, 0), (odd, 0, 0)]),
        lambda: dymsum.check_translation(TRIANGLE, TRIANGLE, (F(1, 3), odd), (0, 0), theta),
        lambda: Scale(odd),
        lambda: dymsum.GrowingDisc(TRIANGLE).sum_at(odd),
        lambda: dymsum.ShapeFeatures(TRIANGLE).bridges(odd),
        lambda: dymsum.ShapeFeatures(TRIANGLE).lasting(0, to=odd),
        lambda: dymsum.TableItem("a", dymsum.Region(TRIANGLE), [0, odd]),
        lambda: dymsum.twice_area([(0, 0), (1, 0), (odd, 1)]),
    ):
        with pytest.raises(dymsum.Error) as caught:
            call()
        assert caught.value.code in (ErrorCode.not_finite, ErrorCode.bad_scale, ErrorCode.out_of_range)


def test_numbers_of_decimal_are_taken_exactly() -> None:
    assert dymsum.TableItem("a", dymsum.Region(TRIANGLE), [decimal.Decimal("0.1")]).degrees == [F(1, 10)]
    assert dymsum.TableItem("a", dymsum.Region(TRIANGLE), [decimal.Decimal("1e400")]).degrees == [10**400]


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


def test_colours_are_the_numbers_that_were_given() -> None:
    colour = dymsum.FaceColour((0.1, F(1, 4), 1), [0])
    assert colour.rgb == [0.1, 0.25, 1] and dymsum.FaceColour().rgb == [0.6, 0.75, 0.9]
    with pytest.raises(dymsum.Error):
        dymsum.FaceColour((F(1, 10), 0, 0), [0])


OPTIONS = (
    "SumOptions MovingOptions SpatialOptions PlanOptions ObstacleOptions BatchOptions ObstacleMeshOptions "
    "TableOptions MovingSolidOptions FamilyOptions SolidFamilyOptions"
)


@pytest.mark.parametrize("name", OPTIONS.split())
def test_progress_is_taken_back(name: str) -> None:
    options = getattr(dymsum, name)(progress=lambda stage, share: None)
    options.progress = None
    assert options.progress is None


@pytest.mark.parametrize("name", OPTIONS.split())
def test_copies_of_options_keep_all_fields(name: str) -> None:
    kind = getattr(dymsum, name)
    options = kind(progress=print)
    fields = [field for field in dir(options) if not field.startswith("_")]
    for field in fields:
        if isinstance(getattr(options, field), (bool, int, float)) and field != "trace":
            setattr(options, field, type(getattr(options, field))(3))
    for copied in (copy.copy(options), copy.deepcopy(options)):
        assert type(copied) is kind
        assert [getattr(copied, field) for field in fields] == [getattr(options, field) for field in fields]
        copied.progress = None
    assert options.progress is print and pickle.loads(pickle.dumps(options)).progress is None
    held = kind()
    held.progress = Progress(held)
    deep = copy.deepcopy(held)
    assert deep.progress is not held.progress and deep.progress.options is deep
    assert copy.copy(held).progress is held.progress


class Progress:
    """It leads back to the options that have it."""

    def __init__(self, options: Any) -> None:
        self.options = options

    def __call__(self, stage: str, share: float) -> None:
        pass


def test_copies_of_moving_sums_keep_their_progress() -> None:
    made = dymsum.ScalingSum(TRIANGLE, TRIANGLE, dymsum.MovingOptions(progress=print_nothing))
    assert copy.copy(made).options.progress is print_nothing
    assert copy.deepcopy(made).options.progress is print_nothing


def print_nothing(stage: str, share: float) -> None:
    pass


@pytest.mark.parametrize(
    "make", [lambda: shapes.star(5, 1, 2).data, lambda: shapes.star(5, 1, 2).parts[0], lambda: solids.box(0, 0, 0, 1, 1, 1).data]
)
def test_lists_are_not_hashed(make: Any) -> None:
    assert make() == make()
    with pytest.raises(TypeError, match="unhashable"):
        hash(make())
