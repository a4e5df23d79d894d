"""Files that other programs write and read: trimesh's .glb, and .3mf taken apart by Python's own libraries."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import numpy
import pytest

import dymsum
from dymsum import Mesh, MeshFormat, solids

trimesh = pytest.importorskip("trimesh")


def test_glb_of_trimesh_stands_where_its_scene_places_it() -> None:
    scene = trimesh.Scene()
    box = trimesh.creation.box((1, 2, 4))
    turned = numpy.array([[0, -1, 0, 3], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], dtype=float)
    scene.add_geometry(box)
    scene.add_geometry(trimesh.creation.icosphere(1, 0.5), transform=turned)
    data = dymsum.parse_mesh(scene.export(file_type="glb"), MeshFormat.glb)
    mesh = Mesh.create(data)
    assert mesh.shell_count() == 2
    # y up in the file: (x, y, z) of the scene is (x, -z, y) here
    low, high = scene.bounds
    assert mesh.vertices.min(axis=0) == pytest.approx([low[0], -high[2], low[1]], abs=1e-6)
    assert mesh.vertices.max(axis=0) == pytest.approx([high[0], -low[2], high[1]], abs=1e-6)
    assert float(dymsum.volume(mesh)) == pytest.approx(scene.volume, rel=1e-6)


@pytest.mark.parametrize("path", ["a.3mf", "a.3mf.gz"])
def test_3mf_holds_the_triangles(path: str, tmp_path: Path) -> None:
    sphere = solids.geodesic_sphere(3, 0.1)
    dymsum.write_mesh(sphere, tmp_path / path)
    assert dymsum.read_mesh(tmp_path / path) == sphere.data
    with zipfile.ZipFile(io.BytesIO(dymsum.format_mesh(sphere, MeshFormat.three_mf))) as archive:
        assert archive.testzip() is None
        assert set(archive.namelist()) == {"[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"}
        root = ElementTree.fromstring(archive.read("3D/3dmodel.model"))
    core = {"m": "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"}
    at = [[float(v.attrib[c]) for c in "xyz"] for v in root.iterfind(".//m:vertex", core)]
    faces = [[int(t.attrib[c]) for c in ("v1", "v2", "v3")] for t in root.iterfind(".//m:triangle", core)]
    other = trimesh.Trimesh(at, faces, process=False)
    assert other.is_watertight and other.is_winding_consistent
    assert other.volume == pytest.approx(float(dymsum.volume(sphere)))
