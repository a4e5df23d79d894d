"""Solids: meshes of other packages, sums, motion, depths."""

from __future__ import annotations

import copy
import pickle
from fractions import Fraction
from typing import Any

import numpy
import pytest
import trimesh

import dymsum
from dymsum import ConvexSum, ErrorCode, Mesh, MeshData, Rotation, SolidPose, SpatialOptions, solids

VERTICES = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
BOX = solids.box(0, 0, 0, 1, 2, 3)
U_PRISM = solids.prism([(0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (1, 1), (1, 3), (0, 3)], 1)


@pytest.mark.parametrize(
    "source",
    [
        (VERTICES, FACES),
        [VERTICES, FACES],
        (numpy.array(VERTICES, dtype=float), numpy.array(FACES)),
        (numpy.array(VERTICES, dtype=numpy.float32), numpy.array(FACES, dtype=numpy.uint32)),
        trimesh.Trimesh(VERTICES, FACES, process=False),
        MeshData(VERTICES, FACES),
    ],
)
def test_one_tetrahedron_from_many_sources(source: Any) -> None:
    mesh = Mesh(source)
    assert mesh.triangles.tolist() == [list(f) for f in FACES]
    assert dymsum.minkowski_sum(source, BOX).volume() == dymsum.minkowski_sum(mesh, BOX).volume()
    assert dymsum.volume(source) == dymsum.volume(mesh) == 1 / 6


def test_trimesh_there_and_back() -> None:
    back = U_PRISM.to_trimesh()
    assert back.is_watertight and back.volume == pytest.approx(7)
    assert Mesh(back).canonical() == U_PRISM.canonical()
    sum = dymsum.minkowski_sum(U_PRISM, BOX)
    assert sum.to_trimesh().volume == pytest.approx(sum.volume())
    assert dymsum.minkowski_sum(BOX, BOX).to_trimesh().is_watertight


def test_views_of_meshes() -> None:
    vertices = solids.box(0, 0, 0, 1, 2, 3).vertices
    assert vertices.shape == (8, 3) and not vertices.flags.writeable
    assert vertices.max() == 3


@pytest.mark.parametrize(
    ("vertices", "faces", "code"),
    [
        (VERTICES, FACES[:3], ErrorCode.not_closed),
        (VERTICES, [*FACES[:3], (1, 2, 9)], ErrorCode.bad_index),
        (VERTICES, numpy.array([(0, 2, -1)]), ErrorCode.bad_index),
        ([*VERTICES[:3], (0, 0, float("nan"))], FACES, ErrorCode.not_finite),
    ],
)
def test_errors_of_meshes(vertices: Any, faces: Any, code: ErrorCode) -> None:
    with pytest.raises(dymsum.Error) as raised:
        Mesh((vertices, faces))
    assert raised.value.code == code


def test_repair_and_hull_of_meshes() -> None:
    mended = dymsum.repair(([*VERTICES, (9, 9, 9)], FACES))
    assert mended.report.unused_vertices == 1 and mended.mesh == Mesh((VERTICES, FACES))
    assert dymsum.convex_hull(VERTICES) == Mesh((VERTICES, FACES))
    assert 0 < dymsum.hulled(U_PRISM).report.deviation <= 2
    error = dymsum.convexity_error(U_PRISM)
    assert error is not None and error.code == ErrorCode.not_convex and dymsum.convexity_error(BOX) is None
    thin = Mesh.with_thin_parts(MeshData([(0, 0, 0), (1, 1, 1)], [(0, 1)]))
    assert thin.has_thin_parts() and pickle.loads(pickle.dumps(thin)).has_thin_parts()


def test_files_of_meshes(tmp_path: Any) -> None:
    path = str(tmp_path / "box.ply")
    assert dymsum.write_mesh(BOX, path) > 0
    assert Mesh.create(dymsum.read_mesh(path)) == BOX
    text = dymsum.format_mesh(BOX, dymsum.MeshFormat.off)
    assert Mesh(dymsum.parse_mesh(text, dymsum.MeshFormat.off)) == BOX
    assert BOX.to_glb()[:4] == b"glTF" and dymsum.minkowski_sum(BOX, U_PRISM).to_glb()[:4] == b"glTF"
    coloured = dymsum.format_glb(
        BOX, dymsum.GlbLook(colours=[dymsum.FaceColour((1, 0, 0), [0])], notes=[("name", "box")])
    )
    assert b'"name"' in coloured


def test_pictures_of_solids() -> None:
    for solid in (BOX, U_PRISM, Mesh(), dymsum.minkowski_sum(BOX, U_PRISM), dymsum.minkowski_sum(BOX, BOX)):
        svg = solid._repr_svg_()
        assert svg.startswith("<svg") and svg.endswith("</svg>") and "nan" not in svg
    assert BOX._repr_svg_().count("<polygon") == 6


def test_sums_of_solids() -> None:
    sum = dymsum.minkowski_sum(U_PRISM, BOX, SpatialOptions(threads=1))
    assert sum == dymsum.minkowski_sum(BOX, U_PRISM)
    assert sum.volume() == float(sum.volume_exact()) and isinstance(sum.volume_exact(), Fraction)
    assert sum.exact(0) == tuple(map(Fraction, sum.vertices[0]))
    with pytest.raises(IndexError):
        sum.exact(10**6)
    assert dymsum.minkowski_sum([BOX, BOX, BOX]).volume() == 27 * 6
    assert dymsum.as_mesh(sum).vertices.shape[1] == 3
    assert dymsum.predict_cost(U_PRISM, BOX).bytes > 0
    slot = dymsum.erode(solids.box(0, 0, 0, 3, 3, 1), solids.box(0, 0, 0, 1, 1, 1))
    assert len(slot.tight_faces) == 1
    assert dymsum.slice_of_sum(BOX, BOX, 1).section.area_exact() == 8
    assert dymsum.opening(U_PRISM, solids.box(0, 0, 0, 1, 1, 1)).solid.volume() == 7
    grown = dymsum.offset(BOX, 0.5, 0.1)
    assert grown.high <= 0.5 and grown.solid.volume() > 6


def test_contains_of_solids() -> None:
    points = [(0, 0, 0), (1, 2, 3), (2, 4, 6), (2, 4, 7)]
    inside = dymsum.contains_each(BOX, BOX, points)
    assert inside.tolist() == [True, True, True, False] == [dymsum.contains(BOX, BOX, p) for p in points]
    exact = [(Fraction(1, 3), Fraction(1, 3), Fraction(1, 3))]
    assert dymsum.contains_each(BOX, BOX, exact).tolist() == [True]


def test_a_solid_that_turns() -> None:
    sum = ConvexSum(solids.rod(18, 9, 0.5, 3), dymsum.negated(solids.box(-1, -1, -1, 1, 1, 1)))
    buffers = dymsum.SolidBuffers()
    step = Rotation.about((1, 2, 3), 0.05)
    for _ in range(4):
        sum.set(step * sum.p_pose().rotation)
        solid = sum.solid()
        solid.write(buffers)
    assert buffers.positions.dtype == numpy.float32 and buffers.positions.shape[1] == 3
    assert buffers.triangles.shape[0] >= solid.facet_count
    assert numpy.allclose(buffers.positions, solid.positions)
    assert sum.sum().volume_exact() == sum.volume_exact()
    whole = sum.sum()
    contact = whole.vertex_contacts[0]
    assert whole.is_convex() and sum.exact(ConvexSum.Vertex(contact.p.a, contact.q.a)) == whole.exact(0)
    assert len(sum.changed_facets()) == sum.facet_count().changed > 0
    assert len(whole.rounded_mesh().faces) >= len(whole.faces) and whole.rounded_hull().report.deviation < 1e-12
    depth = sum.depth((0.75, 0, 0))
    assert depth.inside and depth.depth > 0 and float(depth.depth_squared) == pytest.approx(depth.depth**2)
    with pytest.raises(ValueError, match="."):
        sum.depth((float("nan"), 0, 0))
    for again in (pickle.loads(pickle.dumps(sum)), copy.copy(sum)):
        assert again.sum() == sum.sum()
    assert pickle.loads(pickle.dumps(sum.sum())) == sum.sum()
    third = ConvexSum(dymsum.minkowski_sum(BOX, BOX), BOX)
    assert third.volume_exact() == 27 * 6 and pickle.loads(pickle.dumps(third)).volume_exact() == 27 * 6


def test_poses_in_a_batch() -> None:
    random = numpy.random.default_rng(1)
    quaternions = random.normal(size=(40, 4))
    p, q = solids.ellipsoid(8, 5, 1, 2, 3), solids.box(-1, -1, -1, 1, 1, 1)
    arrays = dymsum.pose_batch_arrays(p, q, quaternions, dymsum.BatchOptions(threads=2))
    records = dymsum.pose_batch(p, q, [Rotation.nearest(*row) for row in quaternions])
    assert arrays.facets.tolist() == [r.facets for r in records]
    assert arrays.depth.tolist() == [r.depth.depth for r in records]
    for k in range(0, 40, 13):
        sum = ConvexSum(p, q)
        sum.set(SolidPose(Rotation.nearest(*quaternions[k])))
        one = sum.sum()
        assert one.volume() == pytest.approx(arrays.volume[k], rel=1e-11) and len(one.faces) == arrays.facets[k]


def test_depth_of_convex_solids() -> None:
    cube = solids.box(0, 0, 0, 2, 2, 2)
    depth = dymsum.penetration_depth(cube, cube, q_moved_by=(1.5, 0, 0))
    assert depth.depth_squared == Fraction(1, 4) and depth.direction == (1, 0, 0)
    with pytest.raises(dymsum.Error) as raised:
        dymsum.penetration_depth(U_PRISM, cube)
    assert raised.value.code == ErrorCode.not_convex


@pytest.mark.parametrize("make", [
    lambda: dymsum.minkowski_sum(U_PRISM, BOX),
    lambda: dymsum.minkowski_sum([BOX, BOX]),
    lambda: dymsum.erode(solids.box(0, 0, 0, 3, 3, 1), solids.box(0, 0, 0, 1, 1, 1)),
    lambda: dymsum.posed_sum(BOX, BOX, SolidPose(Rotation.of(1, 2, 3, 4))),
    lambda: dymsum.minkowski_sum([BOX, BOX, BOX]),
])  # fmt: skip
def test_sums_of_solids_are_pickled(make: Any) -> None:
    sum = make()
    assert pickle.loads(pickle.dumps(sum)) == sum


def test_meshes_are_pickled() -> None:
    for mesh in (BOX, U_PRISM, Mesh()):
        assert pickle.loads(pickle.dumps(mesh)) == mesh
    assert pickle.loads(pickle.dumps(BOX.data)) == BOX.data


def test_cancelled() -> None:
    with pytest.raises(dymsum.Error) as raised:
        dymsum.minkowski_sum(U_PRISM, U_PRISM, SpatialOptions(progress=lambda stage, share: False))
    assert raised.value.code == ErrorCode.cancelled


def test_scenes_of_trimesh() -> None:
    box = trimesh.creation.box((1, 2, 3))
    scene = trimesh.Scene()
    scene.add_geometry(box, geom_name="a")
    scene.add_geometry(box, geom_name="b", transform=trimesh.transformations.translation_matrix((5, 0, 0)))
    mesh = dymsum.Mesh(scene)
    assert len(mesh.vertices) == 16 and mesh.vertices.max(axis=0).tolist() == [5.5, 1, 1.5]
    assert dymsum.minkowski_sum(scene, BOX).volume() == 2 * dymsum.minkowski_sum(box, BOX).volume()
    assert dymsum.Mesh(trimesh.Scene()) == dymsum.Mesh()
    scene.add_geometry(box, geom_name="c", transform=trimesh.transformations.translation_matrix((0.5, 0, 0)))
    with pytest.raises(dymsum.Error):
        dymsum.Mesh(scene)  # two of them cross
    with pytest.raises(TypeError, match="scene with PointCloud 'dust'"):
        dymsum.Mesh(trimesh.Scene({"dust": trimesh.PointCloud([(0, 0, 0)])}))


def test_meshes_of_nothing() -> None:
    assert dymsum.Mesh((numpy.zeros((0, 3)), numpy.zeros((0, 3), int))) == dymsum.Mesh()
    assert dymsum.Mesh(trimesh.Trimesh()) == dymsum.Mesh()


def test_exact_results_are_read_back(tmp_path: Any) -> None:
    ell = solids.prism([(0, 0), (3, 0.1), (3, 1), (1.1, 1.3), (1, 3), (0, 3)], 1)
    total = dymsum.minkowski_sum(ell, solids.prism([(0, 0), (1, 0.3), (0.2, 0.7)], 0.4))
    file = tmp_path / "x.json"
    file.write_text(total.to_json())
    assert dymsum.names_solid_sum(file) and not dymsum.names_sum(file)
    read = dymsum.read_solid_sum(file)
    assert read == total and read.to_json() == dymsum.solid_sum_to_json(total)
    assert dymsum.begins_like_solid_sum(total.to_json())
    assert pickle.loads(pickle.dumps(read)) == total
    assert dymsum.minkowski_sum(read, BOX) == dymsum.minkowski_sum(total, BOX)
    tool = solids.box(0, 0, 0, 0.25, 0.5, 0.25)
    assert dymsum.opening(read, tool).solid == dymsum.minkowski_sum(dymsum.erode(total, tool), tool)
    assert dymsum.closing(read, tool).solid == dymsum.erode(dymsum.minkowski_sum(total, tool), tool)
    assert dymsum.offset(read, 0.5, 0.1).solid.volume() > total.volume()
    with pytest.raises(dymsum.Error) as malformed:
        dymsum.parse_solid_sum(total.to_json().replace('"shells":1', '"shells":2'))
    assert malformed.value.code == ErrorCode.malformed
