"""What people expect of a Python package: extents and comparison of results, paths, keywords, degrees, names."""

from __future__ import annotations

import inspect
import math
import pickle
import pkgutil
from fractions import Fraction as F
from pathlib import Path
from typing import Any

import numpy
import pytest

import dymsum
from dymsum import Error, Orientation, Rotation, TableOptions, shapes, solids

SQUARE, BOX, BALL = shapes.rectangle(0, 0, 1, 1), solids.box(0, 0, 0, 1, 2, 3), solids.geodesic_sphere(1, 1)
BOW = [(0, 0), (1, 1), (1, 0), (0, 1)]


def test_regions_and_sums_have_extents() -> None:
    gear = shapes.gear(7, 1, 2)
    sum = dymsum.minkowski_sum(gear, shapes.star(5, 1, 2))
    corners = [sum.exact(v) for part in sum.parts for v in part.outer.vertices]
    assert gear.area() == dymsum.area(gear) and gear.bounds() == dymsum.bounds(gear)
    assert sum.bounds() == [
        float(side(at[k] for at in corners)) for side in (min, max) for k in (0, 1)
    ]
    touching = dymsum.erode(shapes.rectangle(0, 0, 3, 1), SQUARE)
    assert touching.bounds() == [0, 0, 2, 0] and touching.area() == 0
    assert dymsum.erode(SQUARE, gear).bounds() == [0, 0, 0, 0]
    disc = dymsum.GrowingDisc(SQUARE).sum_at(1)
    assert disc.bounds() == [-1, -1, 2, 2] and disc.area() == pytest.approx(5 + math.pi)


def test_meshes_and_sums_of_solids_have_extents() -> None:
    assert (BOX.volume(), BOX.area(), BOX.bounds()) == (6, 22, [0, 0, 0, 1, 2, 3])
    ell = solids.prism([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)], 1)
    for sum in (dymsum.minkowski_sum(ell, BALL), dymsum.minkowski_sum(BOX, BALL)):
        corners = [sum.exact(v) for v in range(len(sum.vertices))]
        assert sum.bounds() == [float(side(at[k] for at in corners)) for side in (min, max) for k in (0, 1, 2)]
    assert dymsum.SpatialSum.bounds(dymsum.erode(BALL, BOX)) == [0] * 6


def test_results_are_geometry_to_others() -> None:
    shapely = pytest.importorskip("shapely.geometry")
    sum = dymsum.nfp(shapes.letter_u(4, 4, 1), [(0, 0), (2, 0), (2, 1), (0, 1)])
    disc = dymsum.GrowingDisc(SQUARE).sum_at(1)
    assert shapely.shape(sum.__geo_interface__).area == sum.area() == 30
    assert shapely.shape(disc.__geo_interface__).area == pytest.approx(disc.area(), rel=1e-2)
    assert dymsum.nfp(sum, SQUARE).area() > sum.area()  # exactly, as it is
    with pytest.raises(TypeError):
        dymsum.nfp(disc, SQUARE)  # type: ignore[call-overload, arg-type, unused-ignore]
    for rounded in (sum, disc):  # never rounded by the way
        with pytest.raises(TypeError):
            dymsum.Region(rounded)  # type: ignore[arg-type, unused-ignore]


def own(kind: Any, name: str) -> bool:
    return getattr(kind, name) is not getattr(object, name)


def test_all_classes_have_a_repr() -> None:
    kinds = [(name, kind) for name, kind in vars(dymsum).items() if inspect.isclass(kind) and name in dymsum.__all__]
    assert len(kinds) > 100
    assert [name for name, kind in kinds if not own(kind, "__repr__")] == []


VALUES = "Region RegionData Part Mesh MeshData PlanarSum SpatialSum DiscSet DiscRadius Scale Orientation Rotation AxisTurn"


@pytest.mark.parametrize("name", VALUES.split())
def test_values_are_compared(name: str) -> None:
    assert own(getattr(dymsum, name), "__eq__")


def test_sets_with_arcs_are_compared() -> None:
    one, other = dymsum.GrowingDisc(SQUARE), dymsum.GrowingDisc(SQUARE)
    assert one.sum_at(1) == other.sum_at(1) and one.sum_at(1) != one.sum_at(2)


def test_paths_are_text_or_paths(tmp_path: Path) -> None:
    region, mesh = tmp_path / "a.wkt", tmp_path / "b.off"
    dymsum.write_file(region, SQUARE.wkt)
    dymsum.write_mesh(BOX, mesh)
    assert dymsum.region_format(region) == dymsum.RegionFormat.wkt and dymsum.mesh_format(mesh) == dymsum.MeshFormat.off
    assert dymsum.names_region(region) and dymsum.written_path(region) == str(region)
    dymsum.check_writable(region)
    for path in (region, str(region)):
        assert dymsum.read_shapes(path)[0].data == dymsum.read_region_data(path)
    assert dymsum.Mesh(dymsum.read_mesh(mesh)) == dymsum.Mesh(dymsum.read_mesh(str(mesh))) == BOX
    obstacle = dymsum.CspaceObstacle(SQUARE, SQUARE)
    dymsum.write_file(tmp_path / "c.obstacle", dymsum.format_obstacle(obstacle))
    assert len(dymsum.read_obstacle(tmp_path / "c.obstacle").patches()) == len(obstacle.patches())
    with pytest.raises(Error) as caught:
        dymsum.read_nesting_instance(tmp_path / "d.json")
    assert caught.value.evidence.file == str(tmp_path / "d.json")
    options = TableOptions(store=tmp_path)
    assert options.store == str(tmp_path)
    options.store = tmp_path / "e"
    assert pickle.loads(pickle.dumps(options)).store == str(tmp_path / "e")
    for wrong in (5, None, b"a.wkt"):
        with pytest.raises(TypeError):
            dymsum.read_shapes(wrong)  # type: ignore[arg-type, unused-ignore]


def test_keywords_of_the_guide() -> None:
    queries = dymsum.ObstacleQueries(dymsum.CspaceObstacle(SQUARE, SQUARE))
    poses = [(5, 5, 0)]
    assert queries.contains_each(poses=poses, threads=1).tolist() == [False]
    assert queries.free_each(poses=poses).tolist() == [True]
    assert queries.clearance_each(poses=poses, weight=1).distance > 0
    assert len(dymsum.nfp_each(pairs=[(SQUARE, SQUARE)], threads=1)) == 1
    assert dymsum.contains_each(p=SQUARE, q=SQUARE, positions=[(1, 1)], threads=1).tolist() == [True]
    assert dymsum.contains_each(p=BOX, q=BOX, positions=[(1, 1, 1)]).tolist() == [True]
    pair = dymsum.SolidDepth(BOX, BOX)
    assert dymsum.depth_batch_arrays(pair=pair, moves=[(0, 0, 0)]).distance.tolist() == [1]
    assert dymsum.pose_batch_arrays(p=BOX, q=BOX, quaternions=[(1, 0, 0, 0)]).facets.tolist() == [6]


def test_angles_in_degrees() -> None:
    for quarters, turn in enumerate(["0", "1", "inf", "-1"]):
        for whole in (-360000, 0, 720):
            assert Orientation.of_degrees(90 * quarters + whole) == Orientation.parse(turn)
    assert Orientation.of_degrees(30).radians() == pytest.approx(math.pi / 6, abs=1e-15)
    assert Orientation.of_degrees(F(45, 2)).degrees() == pytest.approx(22.5, abs=1e-13)
    assert abs(Orientation.of_degrees(30, error=0.01).degrees() - 30) <= math.degrees(0.01)
    assert Orientation.of_degrees(F(1, 3)).degrees() == pytest.approx(1 / 3, abs=1e-13)
    with pytest.raises(Error):
        Orientation.of_degrees(math.inf)
    assert Rotation.about_degrees((0, 0, 1), -90) == Rotation.of(1, 0, 0, -1)
    assert Rotation.about_degrees((0, 0, 1), 120).degrees() == pytest.approx(120, abs=1e-6)
    assert dymsum.AxisTurn.nearest_degrees((0, 0, 1), 90).t() == 1
    assert dymsum.AxisTurn.of(1).degrees((0, 0, 1)) == 90


def item_of(call: Any) -> Any:
    with pytest.raises(Error) as caught:
        call()
    assert pickle.loads(pickle.dumps(caught.value)).item == caught.value.item
    if caught.value.item is not None:
        assert str(caught.value).startswith(f"item {caught.value.item}: ")
    return caught.value.item


def test_errors_of_batches_have_the_item() -> None:
    third, plain = F(1, 3), (SQUARE, SQUARE)
    lines = "LINESTRING(0 0, 1 0)"
    assert item_of(lambda: dymsum.nfp_each([plain, plain, (SQUARE, BOW)])) == 2
    assert item_of(lambda: dymsum.nfp_each([plain, (BOW, SQUARE), plain])) == 1
    far = [(0, 0), (1e300, 0), (0, 1e-300)]
    try:
        dymsum.nfp(far, far)
    except Error:
        assert item_of(lambda: dymsum.nfp_each([plain, (far, far)], threads=2)) == 1
    assert item_of(lambda: dymsum.union_of([SQUARE, BOW])) == 1
    assert item_of(lambda: dymsum.minkowski_sum([BOX, BALL, ([(0, 0, 0)], [(0, 9)])])) == 2
    assert item_of(lambda: dymsum.convex_hull([(0, 0, 0), (1, 0, 0), (0, third, 0), (0, 0, 1)])) == 2
    assert item_of(lambda: dymsum.pose_batch_arrays(BOX, BOX, [(1, 0, 0, 0), (0, 0, 0, 0)])) == 1
    assert item_of(lambda: dymsum.Region(BOW)) is None
    assert lines and dymsum.nfp_each([]) == []
    with pytest.raises(TypeError, match="item 1 is no pair of regions"):
        dymsum.nfp_each([plain, (SQUARE, 5)])  # type: ignore[list-item, unused-ignore]
    with pytest.raises(TypeError, match="item 0 is no pair of regions"):
        dymsum.nfp_each([(SQUARE,)])  # type: ignore[list-item, unused-ignore]


GROUPS = "depths discs errors features fits meshes motions nesting regions robots solid_sums sums uncertainty".split()


def test_names_are_listed_and_grouped() -> None:
    listed = set(dymsum.__all__)
    shown = {name for name in vars(dymsum) if not name.startswith("_")}
    modules = {module.name for module in pkgutil.iter_modules(dymsum.__path__)}
    assert listed <= shown
    # Fraction was there before, cluster only where it is imported.
    assert shown - listed <= {"Fraction", "cluster"}
    grouped: set[str] = set()
    for name in GROUPS:
        group = getattr(dymsum, name)
        assert {one for one in vars(group) if not one.startswith("_")} == set(group.__all__)
        assert all(getattr(group, one) is getattr(dymsum, one) for one in group.__all__)
        assert group.__doc__ and group.__all__ == sorted(group.__all__)
        grouped |= set(group.__all__)
    assert set(GROUPS) <= modules
    assert listed - grouped == {
        *GROUPS, "MeshLike", "Rational", "RegionLike", "shapes", "solids", "to_shapely", "to_trimesh", "version",
    }
    public = {name for name in vars(dymsum._core) if not name.startswith("_")}
    assert public <= listed


@pytest.mark.parametrize("scope", [dymsum.shapes, dymsum.solids])
def test_generators_are_all_that_their_modules_have(scope: Any) -> None:
    assert {name for name in vars(scope) if not name.startswith("_")} == set(scope.__all__)


def test_numpy_counts_are_counts() -> None:
    assert shapes.disc(numpy.int32(8), numpy.float32(1)).vertex_count() == 8
