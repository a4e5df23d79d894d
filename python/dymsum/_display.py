"""Pictures of solids for notebooks: triangles in an orthographic view as SVG text; no network, no plot library."""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from . import _core

#: From where one looks: from the front, the right and above.
_TOWARDS = numpy.array([0.48, -0.72, 0.5])
_MOST_TRIANGLES = 20_000
_WIDTH = 480.0


def _axes() -> tuple[NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64]]:
    towards = _TOWARDS / numpy.linalg.norm(_TOWARDS)
    right = numpy.cross([0.0, 0.0, 1.0], towards)
    right /= numpy.linalg.norm(right)
    return right, numpy.cross(towards, right), towards


def _triangles(data: _core.MeshData) -> NDArray[numpy.uint32]:
    """Fans of the faces: enough for a picture of convex ones and of triangles."""
    rows = [(face[0], face[k], face[k + 1]) for face in data.faces for k in range(1, len(face) - 1)]
    return numpy.array(rows, dtype=numpy.uint32).reshape(-1, 3)


def picture(points: NDArray[numpy.float64], triangles: NDArray[numpy.uint32]) -> str:
    """The faces that look this way, those far away first."""
    right, up, towards = _axes()
    corners = points[triangles]
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = numpy.linalg.norm(normals, axis=1)
    facing = numpy.divide(normals @ towards, lengths, out=numpy.zeros_like(lengths), where=lengths > 0)
    seen = numpy.flatnonzero(facing > 0)
    seen = seen[numpy.argsort((corners[seen].mean(axis=1) @ towards))][-_MOST_TRIANGLES:]
    flat = numpy.stack([corners @ right, -(corners @ up)], axis=2)
    low = flat.reshape(-1, 2).min(axis=0, initial=numpy.inf) if len(flat) else numpy.zeros(2)
    size = (flat.reshape(-1, 2).max(axis=0) - low) if len(flat) else numpy.ones(2)
    scale = (_WIDTH - 20) / max(float(size.max()), 5e-324)
    lines = []
    for index in seen:
        shade = 95 + int(150 * facing[index])
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in (flat[index] - low) * scale + 10)
        fill = f"rgb({shade * 6 // 10},{shade * 8 // 10},{shade})"
        lines.append(f'<polygon points="{path}" fill="{fill}" stroke="{fill}" stroke-width="0.5"/>')
    height = float(size[1]) * scale + 20
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH:.0f} {height:.0f}" width="{_WIDTH:.0f}">'
    return head + "".join(lines) + "</svg>"


def solid_svg(solid: _core.Mesh | _core.SpatialSum) -> str:
    """A picture of a solid."""
    if isinstance(solid, _core.Mesh):
        return picture(solid.vertices, solid.triangles)
    data = solid.drawn().mesh
    return picture(data.vertices, _triangles(data))


def solid_glb(solid: _core.Mesh | _core.SpatialSum) -> bytes:
    """The bytes of a .glb file, as other viewers show it."""
    if isinstance(solid, _core.Mesh):
        return _core.format_mesh(solid, _core.MeshFormat.glb)
    data = solid.drawn().mesh
    return _core.format_mesh(data, _core.MeshFormat.glb)
