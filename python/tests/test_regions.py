"""Regions from and to what other packages have, and the errors on the way."""

from __future__ import annotations

import json
import pickle
from fractions import Fraction
from typing import Any

import numpy
import pytest
import shapely

import dymsum
from dymsum import ErrorCode, Region, RegionData

SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]
HOLE = [(1, 1), (1, 2), (2, 2), (2, 1)]


@pytest.mark.parametrize(
    "source",
    [
        SQUARE,
        [list(p) for p in SQUARE],
        numpy.array(SQUARE, dtype=float),
        numpy.array(SQUARE, dtype=numpy.int32),
        numpy.asfortranarray(numpy.array(SQUARE, dtype=float)),
        numpy.array(SQUARE, dtype=float).repeat(2, axis=0)[::2],
        "POLYGON((0 0, 0 4, 4 4, 4 0, 0 0))",
        shapely.box(0, 0, 4, 4),
        shapely.box(0, 0, 4, 4).reverse(),
        {"type": "Polygon", "coordinates": [[*SQUARE, SQUARE[0]]]},
        RegionData([dymsum.Part(SQUARE)]),
        Region(SQUARE),
    ],
)
def test_one_square_from_many_sources(source: Any) -> None:
    region = Region(source)
    assert region == dymsum.shapes.rectangle(0, 0, 4, 4)
    assert dymsum.area(source) == 16
    assert dymsum.minkowski_sum(source, source).area_exact() == 64


def test_depth_of_lists_tells_rings_and_parts() -> None:
    assert Region([SQUARE, HOLE]).hole_count() == 1
    far = [(10, 0), (11, 0), (10, 1)]
    assert len(Region([[SQUARE, HOLE], [far]]).parts) == 2
    assert Region([]).empty() and not Region()


@pytest.mark.parametrize(
    "geometry",
    [
        shapely.Polygon(SQUARE, [HOLE]),
        shapely.MultiPolygon([shapely.box(0, 0, 1, 1), shapely.box(3, 0, 4, 1)]),
        shapely.LineString([(0, 0), (1, 2), (3, 1)]),
        shapely.MultiLineString([[(0, 0), (1, 2)], [(5, 5), (6, 6)]]),
        shapely.Point(3, 4),
        shapely.MultiPoint([(0, 0), (1, 1)]),
        shapely.GeometryCollection(
            [shapely.box(0, 0, 1, 1), shapely.LineString([(5, 5), (6, 6)]), shapely.Point(9, 9)]
        ),
        shapely.LinearRing(SQUARE),
    ],
)
def test_shapely_there_and_back(geometry: Any) -> None:
    region = Region(geometry)
    back = region.to_shapely()
    assert shapely.equals(back, geometry) or back.equals(geometry)
    assert Region(back) == region
    assert Region(json.loads(json.dumps(region.__geo_interface__))) == region


def test_empty_geometries() -> None:
    assert Region(shapely.Polygon()).empty()
    assert Region().to_shapely().is_empty


def test_coordinates_of_shapely_are_not_rounded() -> None:
    odd = 0.1 + 0.2
    region = Region(shapely.Polygon([(0, 0), (odd, 1e-300), (1 / 3, 7.0)]))
    assert region.parts[0].outer.tolist() == [[0.0, 0.0], [odd, 1e-300], [1 / 3, 7.0]]


def test_arrays_are_views_that_keep_their_region() -> None:
    region = Region([SQUARE, HOLE])
    outer = region.parts[0].outer
    assert outer.shape == (4, 2) and outer.dtype == numpy.float64 and not outer.flags.writeable
    assert outer.base is not None and numpy.shares_memory(outer, region.parts[0].outer)
    hole = region.parts[0].holes[0]
    del region
    assert outer.tolist() == [list(map(float, p)) for p in SQUARE]
    assert hole.tolist() == [list(map(float, p)) for p in HOLE]


def test_rings_may_end_where_they_began() -> None:
    closed = [[*SQUARE, SQUARE[0]], [*HOLE, HOLE[0]]]
    assert Region(closed) == Region([SQUARE, HOLE])
    assert Region(numpy.array(closed[0], float)).vertex_count() == len(SQUARE)


@pytest.mark.parametrize(
    ("source", "code", "evidence"),
    [
        ([(0, 0), (1, 1), (1, 0), (0, 1)], ErrorCode.self_crossing, {"part": 0, "ring": 0, "x": 0.5, "y": 0.5}),
        ([(0, 0), (0, 1), (1, 0)], ErrorCode.wrong_orientation, {"part": 0, "ring": 0}),
        ([(0, 0), (1, 0), (1, 0), (0, 1)], ErrorCode.repeated_vertex, {"vertex": 1}),
        ([(0, 0), (1, 0)], ErrorCode.too_few_vertices, {"ring": 0}),
        ([(0, 0), (1, float("inf")), (0, 1)], ErrorCode.not_finite, {"vertex": 1}),
        ([SQUARE, [(9, 9), (9, 10), (10, 9)]], ErrorCode.hole_outside, {"ring": 1}),
        ("POLYGON((0 0, 1 0", ErrorCode.truncated, {"line": 1}),
    ],
)
def test_errors_have_code_and_evidence(source: Any, code: ErrorCode, evidence: dict[str, Any]) -> None:
    with pytest.raises(dymsum.Error) as raised:
        Region(source)
    assert raised.value.code == code
    for name, value in evidence.items():
        assert getattr(raised.value, name) == value == getattr(raised.value.evidence, name)
    again = pickle.loads(pickle.dumps(raised.value))
    assert again == raised.value and str(again) == str(raised.value)
    with pytest.raises(dymsum.Error):  # the same from functions with overloads for solids
        dymsum.minkowski_sum(source, SQUARE)
    with pytest.raises(dymsum.Error):
        dymsum.bounds(source)


@pytest.mark.parametrize("source", [5, None, (1, 2), [1, 2, 3], object(), [[[[[1]]]]]])
def test_other_objects_are_type_errors(source: Any) -> None:
    with pytest.raises(TypeError):
        dymsum.area(source)


def test_wrong_shapes_are_value_errors() -> None:
    with pytest.raises(ValueError, match="2 numbers a vertex"):
        Region([(0, 0, 0), (1, 0, 0), (0, 1, 0)])


def test_repair_takes_what_region_takes() -> None:
    mended = dymsum.repair(shapely.Polygon([(0, 0), (1, 0), (1, 0), (2, 0), (0, 2)]))
    assert mended.report.duplicate_vertices == 1 and mended.report.collinear_vertices == 1
    assert mended.region.vertex_count() == 3 and mended.report.changed()


def test_functions_of_regions() -> None:
    square = Region(SQUARE)
    assert dymsum.bounds(square) == [0, 0, 4, 4]
    assert dymsum.negated(square) == dymsum.shapes.rectangle(-4, -4, 0, 0)
    assert dymsum.translated(square, 1, 2) == dymsum.shapes.rectangle(1, 2, 5, 6)
    assert dymsum.scaled(square, 0.5, 2) == dymsum.shapes.rectangle(0, 0, 2, 8)
    assert dymsum.area_text(square) == "16" or dymsum.area_text(square).startswith("1.6")
    assert dymsum.grown(square, 1).at_most >= 1
    with pytest.raises(dymsum.Error) as raised:
        dymsum.grown(square, -1)
    assert raised.value.code == ErrorCode.out_of_range


def test_files(tmp_path: Any) -> None:
    path = str(tmp_path / "square.wkt")
    dymsum.write_file(path, dymsum.format_region(SQUARE, dymsum.RegionFormat.wkt))
    assert Region.create(dymsum.read_region_data(path)) == Region(SQUARE)
    assert [s.name for s in dymsum.read_shapes(path)] == ["square"] or dymsum.read_shapes(path)
    with pytest.raises(dymsum.Error) as raised:
        dymsum.read_shapes(str(tmp_path / "none.wkt"))
    assert raised.value.code == ErrorCode.cannot_open and "none.wkt" in raised.value.file


def test_pictures() -> None:
    assert Region(SQUARE)._repr_svg_().lstrip().startswith(("<svg", "<?xml"))
    sum = dymsum.minkowski_sum(SQUARE, SQUARE)
    assert "<svg" in sum._repr_svg_() and "<svg" in dymsum.draw_sum(SQUARE, SQUARE, sum)


def test_exact_numbers() -> None:
    big = Fraction(3**4000, 2**1000 + 1)
    theta = dymsum.Orientation.of(Fraction(3**2000, 2**1000 + 1))
    assert theta.tan_half() == Fraction(3**2000, 2**1000 + 1)
    check = dymsum.check_translation(SQUARE, SQUARE, (big, -big), (big, -big), dymsum.Orientation())
    assert check.at == (big, -big) and check.free
    assert dymsum.Scale(Fraction(22, 7)).exact() == Fraction(22, 7) == dymsum.Scale.of(Fraction(22, 7)).exact()
    assert dymsum.Scale(0.1).exact() == Fraction(0.1)
    for bad in (0, -1, float("nan"), float("inf")):
        with pytest.raises(dymsum.Error):
            dymsum.Scale(bad)
    with pytest.raises(dymsum.Error):
        dymsum.check_translation(SQUARE, SQUARE, (float("nan"), 0), (0, 0), dymsum.Orientation())


def test_integers_that_no_double_holds_are_refused() -> None:
    with pytest.raises(dymsum.Error):
        Region([(2**53 + 1, 0), (0, 1), (0, 0)])
    assert not dymsum.contains(SQUARE, SQUARE, (2**53 + 1, 0))
    assert not dymsum.contains(SQUARE, SQUARE, (2**53, 0))


TRIANGLE = [(0, 0), (1, 0), (0, 1)]


@pytest.mark.parametrize(
    ("source", "part", "ring"),
    [
        ([[TRIANGLE], []], 1, 0),
        ([[], [TRIANGLE]], 0, 0),
        ([[], TRIANGLE], 0, 0),
        ([TRIANGLE, []], 0, 1),
        ([[TRIANGLE], [[]]], 1, 0),
        ([[]], 0, 0),
        (numpy.zeros((0, 2)), 0, 0),
        (numpy.zeros((1, 0, 2)), 0, 0),
        ([numpy.zeros((0, 2))], 0, 0),
    ],
)
def test_rings_of_nothing_are_named(source: Any, part: int, ring: int) -> None:
    with pytest.raises(dymsum.Error) as raised:
        Region(source)
    assert raised.value.code == ErrorCode.too_few_vertices
    assert (raised.value.evidence.part, raised.value.evidence.ring) == (part, ring)


@pytest.mark.parametrize(
    ("source", "error"),
    [
        ([[TRIANGLE], 5], "a part is a list of rings, not int"),
        (numpy.zeros((0, 3)), "shape"),
        ([TRIANGLE, 5], "shape"),
    ],
)
def test_what_is_no_ring_is_told(source: Any, error: str) -> None:
    with pytest.raises((TypeError, ValueError), match=error):
        Region(source)


CLOSED = numpy.array([*TRIANGLE, TRIANGLE[0]], float)


@pytest.mark.parametrize(
    "coordinates",
    [
        CLOSED[None],
        [CLOSED],
        CLOSED[None].astype(numpy.float32),
        CLOSED[None].astype(numpy.int8),
        [[(numpy.float32(x), numpy.int64(y)) for x, y in CLOSED]],
        [[(Fraction(x), y) for x, y in CLOSED]],
        CLOSED[None].astype(object),
    ],
)
def test_geojson_with_numbers_of_numpy(coordinates: Any) -> None:
    shape = {"type": "Polygon", "coordinates": coordinates}
    assert Region(shape) == Region(TRIANGLE)
    collection = {"type": "GeometryCollection", "geometries": [shape]}
    feature = {"type": "Feature", "properties": {"weights": numpy.zeros(3)}, "geometry": shape}
    assert Region(collection) == Region(feature) == Region(TRIANGLE)


@pytest.mark.parametrize("far", [2**53 + 1, Fraction(1, 3), numpy.uint64(2**63 + 1)])
def test_geojson_is_not_rounded(far: Any) -> None:
    with pytest.raises(dymsum.Error) as raised:
        Region({"type": "Polygon", "coordinates": [[(far, 0), (0, 1), (0, 0), (far, 0)]]})
    assert raised.value.code == ErrorCode.unsupported_operand


@pytest.mark.parametrize(
    "empty",
    [
        shapely.Point(),
        shapely.LineString(),
        shapely.LinearRing(),
        shapely.Polygon(),
        shapely.MultiPoint(),
        shapely.MultiLineString(),
        shapely.MultiPolygon(),
        shapely.GeometryCollection(),
        shapely.GeometryCollection([shapely.Point(), shapely.Polygon()]),
        numpy.zeros((0, 3, 2)),
        [],
        {"type": "Point", "coordinates": numpy.zeros(0)},
    ],
)
def test_empty_geometries_are_the_empty_region(empty: Any) -> None:
    assert Region(empty) == Region()
    assert dymsum.minkowski_sum(SQUARE, empty).parts == []
    assert not dymsum.contains(SQUARE, empty, (0, 0))


def test_an_empty_point_in_a_collection() -> None:
    both = shapely.GeometryCollection([shapely.Point(), shapely.box(0, 0, 4, 4)])
    assert Region(both) == Region(SQUARE)
