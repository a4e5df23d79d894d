"""From and to the objects of other packages; shapely and trimesh are imported only where they are asked for."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence, Set
from typing import TYPE_CHECKING, Any, Protocol, Union

import numpy
import numpy.typing

from . import _core

if TYPE_CHECKING:
    import shapely  # type: ignore[import-untyped, unused-ignore]
    import trimesh


class HasGeoInterface(Protocol):
    """shapely's geometries, rows of geopandas, and others."""

    @property
    def __geo_interface__(self) -> Any: ...


class HasFaces(Protocol):
    """trimesh's meshes, and others."""

    @property
    def vertices(self) -> Any: ...

    @property
    def faces(self) -> Any: ...


class HasGeometry(Protocol):
    """trimesh's scenes."""

    @property
    def geometry(self) -> Any: ...

    @property
    def graph(self) -> Any: ...


RegionLike = Union[
    _core.Region, _core.RegionData, str, HasGeoInterface, Mapping[str, Any], Sequence[Any], "numpy.typing.NDArray[Any]"
]
"""What a Region is made from: see Region."""

MeshLike = Union[_core.Mesh, _core.MeshData, HasFaces, HasGeometry, tuple[Any, Any]]
"""What a Mesh is made from: see Mesh."""


def _plain(value: Any) -> Any:
    """A list of what another class iterates over, the array of what makes one; all else as it is. What such an object
    raises is raised, and what it says of its length is not believed."""
    kind = type(value)
    if kind in _PLAIN or isinstance(value, _NO_LISTS) or hasattr(value, "shape"):
        return value
    if hasattr(kind, "__array__"):
        return numpy.asarray(value)
    return [item for item in value] if hasattr(kind, "__iter__") and hasattr(kind, "__len__") else value


_PLAIN = {list, tuple, float, int, numpy.ndarray}
_NO_LISTS = (str, bytes, bytearray, memoryview, Mapping, Set, list, tuple, numpy.generic)


def _plain_rows(value: Any) -> Any:
    """The same of a list and of its items."""
    value = _plain(value)
    if isinstance(value, (list, tuple)) and not _PLAIN.issuperset(map(type, value)):
        return [_plain(item) for item in value]
    return value


def _depth(value: Any) -> int:
    """How deep sequences are nested up to the first number; an array of shape (n, 2) has depth 2."""
    value = _plain(value)
    shape = getattr(value, "shape", None)
    if shape is not None and getattr(value, "dtype", None) != object:
        return len(shape)
    if isinstance(value, numpy.ndarray):  # of objects: numbers, or rings of several lengths
        return value.ndim + (_depth(value.flat[0]) if value.size > 0 else 0)
    if not isinstance(value, (list, tuple)):
        return 0
    # Rings and parts may be empty: the first that is not tells.
    if len(value) == 0:
        return 1
    return 1 + _depth(next((item for item in value if not isinstance(item, (list, tuple)) or len(item) > 0), value[0]))


def _is_vertices_and_faces(value: Any) -> bool:
    if not isinstance(value, (tuple, list)) or len(value) != 2:
        return False
    vertices = _plain(value[0])
    if getattr(vertices, "shape", None) == (0, 3):
        return True
    try:
        return len(vertices) > 0 and len(_plain(vertices[0])) == 3 and _depth(vertices) == 2
    except (TypeError, KeyError, IndexError):
        return False


def _is_scene(value: Any) -> bool:
    return hasattr(value, "geometry") and hasattr(value, "graph") and hasattr(value, "dump")


#: Their geometry as other packages take it is rounded.
_ROUNDED = (_core.PlanarSum, _core.DiscSet)


def kind(value: Any) -> str:
    """ "region" or "mesh" where one can be made of the value, else ""."""
    if isinstance(value, _ROUNDED):  # by its own functions alone, which say so
        return ""
    if isinstance(value, (str, Mapping, _core.Region, _core.RegionData)) or hasattr(value, "__geo_interface__"):
        return "region"
    if _is_scene(value) or (hasattr(value, "vertices") and hasattr(value, "faces")):
        return "mesh"
    if _is_vertices_and_faces(value):
        return "mesh"
    if isinstance(value, (list, tuple)) and len(value) == 0:
        return "region"
    return "region" if 2 <= _depth(value) <= 4 else ""


def _is_masked(value: Any) -> bool:
    return isinstance(value, numpy.ma.MaskedArray) or (
        isinstance(value, (list, tuple)) and numpy.ma.MaskedArray in set(map(type, value))
    )


#: What numpy makes of numbers and what has a float, but is none.
NO_NUMBERS = (str, bytes, complex, numpy.complexfloating, numpy.datetime64, numpy.timedelta64)


def _same_double(item: Any) -> float:
    """The number as a double, which it has to be exactly."""
    if isinstance(item, NO_NUMBERS):
        raise TypeError(f"no number: {item!r}")
    return _core._double(item)


def _in_row(row: int, item: Any) -> float:
    try:
        return _same_double(item)
    except Exception as error:
        if type(error).__name__ == "Error" and getattr(error, "item", 0) is None:
            error.item = row  # type: ignore[attr-defined]
        raise


def doubles(value: Any) -> numpy.typing.NDArray[numpy.float64]:
    """The numbers of a value as a contiguous array of doubles. None is rounded: an error where one would have to be."""
    if _is_masked(value):
        raise TypeError("a masked array: fill or compress it first")
    value = _plain_rows(value)
    array = numpy.asarray(value)
    if array.dtype.kind not in "biufO":
        raise TypeError(f"no numbers but {array.dtype}")
    if array.dtype == numpy.float64:
        # Integers of lists were rounded here, those beyond 2^53 perhaps.
        if array is value or isinstance(value, numpy.ndarray) or not (numpy.abs(array) >= 2**53).any():
            return numpy.ascontiguousarray(array)
        array = numpy.asarray(value, dtype=object)
    if array.dtype.kind == "b" or array.dtype.itemsize < 8:
        return numpy.ascontiguousarray(array, dtype=numpy.float64)
    if array.dtype.kind in "iu" and (array.size == 0 or (array.max() <= 2**53 and array.min() >= -(2**53))):
        return numpy.ascontiguousarray(array, dtype=numpy.float64)
    width = array.shape[-1] if array.ndim > 1 else 1
    numbers = [_in_row(k // width, item) for k, item in enumerate(array.astype(object).ravel())]
    return numpy.array(numbers, float).reshape(array.shape)


def _rows(ring: Any, columns: int = 2) -> numpy.typing.NDArray[numpy.float64]:
    rows = doubles(ring)
    if rows.size == 0 and (rows.ndim < 2 or rows.shape[-1] in (0, columns)):
        return rows.reshape(0, columns)
    if rows.ndim != 2 or rows.shape[1] != columns:
        raise ValueError(f"{columns} numbers a vertex are needed, not an array of shape {rows.shape}")
    return rows


def _part(rings: Any) -> _core.Part:
    rings = _plain(rings)
    if not hasattr(rings, "__len__") or isinstance(rings, (str, bytes)):
        raise TypeError(f"a part is a list of rings, not {type(rings).__name__}")
    if len(rings) == 0:
        return _core.Part(numpy.empty((0, 2)))
    return _core.Part(_ring(rings[0]), [_ring(hole) for hole in rings[1:]])


def _ring(points: Any) -> numpy.typing.NDArray[numpy.float64]:
    """Of a list of points that ends where it began, as most have rings, the last one is left out."""
    rows = _rows(points)
    return rows[:-1] if len(rows) > 1 and (rows[0] == rows[-1]).all() else rows


def _one_shape(text: str, form: _core.RegionFormat, name: str) -> _core.RegionData:
    shapes = _core.parse_shapes(text, form, name)
    if len(shapes) != 1:
        raise ValueError(f"{len(shapes)} shapes where one is needed")
    return shapes[0].data


def _plain_numbers(value: Any) -> Any:
    """Coordinates, in arrays or not, as lists of doubles. None is rounded."""
    if isinstance(value, float):
        return float(value)
    if _is_masked(value):
        raise TypeError("a masked array: fill or compress it first")
    if isinstance(value, (list, tuple)):
        return [_plain_numbers(item) for item in value]
    if isinstance(value, numpy.ndarray):
        return _plain_numbers(value.tolist())
    return _same_double(value)


#: shapely's rings are GeoJSON's lines; empty points and lines have no other form there.
_OF_NOTHING = {"Point": "MultiPoint", "LineString": "MultiLineString", "LinearRing": "MultiLineString"}


def _geojson(value: Any) -> Any:
    """What of a mapping makes the shape, in numbers that JSON holds."""
    if isinstance(value, (list, tuple)):
        return [_geojson(item) for item in value]
    if not isinstance(value, Mapping):
        return value
    plain = {key: _geojson(value[key]) for key in ("type", "geometry", "geometries", "features") if key in value}
    if "coordinates" in value:
        plain["coordinates"] = _plain_numbers(value["coordinates"])
        if plain["coordinates"] == [] and plain.get("type") in _OF_NOTHING:
            plain["type"] = _OF_NOTHING[plain["type"]]
    if plain.get("type") == "LinearRing":
        plain["type"] = "LineString"
    return plain


def region_data(value: Any) -> _core.RegionData:
    """The plain lists of a value, not yet validated."""
    if isinstance(value, _core.Region):
        return value.data
    if isinstance(value, _core.RegionData):
        return value
    if isinstance(value, str):
        return _one_shape(value, _core.RegionFormat.wkt, "text")
    if hasattr(value, "__geo_interface__"):
        value = value.__geo_interface__
    if isinstance(value, Mapping):
        return _one_shape(json.dumps(_geojson(value)), _core.RegionFormat.geojson, "mapping")
    value = _plain(value)
    depth = _depth(value)
    if depth == 2:
        return _core.RegionData([_part([value])])
    if depth == 3:
        return _core.RegionData([_part(value)] if len(value) > 0 else [])
    if depth == 4:
        return _core.RegionData([_part(rings) for rings in value])
    if hasattr(value, "__len__") and len(value) == 0:
        return _core.RegionData()
    raise TypeError(f"no region can be made of {type(value).__name__}")


def region(value: Any) -> _core.Region:
    """The region of a value: see Region."""
    return value if isinstance(value, _core.Region) else _core.Region.create(region_data(value))


def _mesh_of_scene(scene: Any) -> Any:
    """All meshes of a scene where they stand, as one."""
    for name, one in scene.geometry.items():
        if not hasattr(one, "faces"):
            raise TypeError(f"no mesh can be made of a scene with {type(one).__name__} {name!r}")
    meshes = scene.dump()
    vertices = [numpy.empty((0, 3))]
    faces = [numpy.empty((0, 3), numpy.int64)]
    for one in meshes:
        faces.append(numpy.asarray(one.faces) + sum(map(len, vertices)))
        vertices.append(numpy.asarray(one.vertices))
    return numpy.concatenate(vertices), numpy.concatenate(faces)


def mesh_data(value: Any) -> _core.MeshData:
    """The plain lists of a value, not yet validated."""
    if isinstance(value, _core.Mesh):
        return value.data
    if isinstance(value, _core.MeshData):
        return value
    if _is_scene(value):
        vertices, faces = _mesh_of_scene(value)
    elif isinstance(value, (tuple, list)) and len(value) == 2:
        vertices, faces = value
    elif hasattr(value, "vertices") and hasattr(value, "faces"):
        vertices, faces = value.vertices, value.faces
    else:
        raise TypeError(f"no mesh can be made of {type(value).__name__}")
    return _core.MeshData(_rows(vertices, 3), faces)


def mesh(value: Any) -> _core.Mesh:
    """The mesh of a value: see Mesh."""
    return value if isinstance(value, _core.Mesh) else _core.Mesh.create(mesh_data(value))


def geo_interface(text: str) -> Any:
    """The geometry of a GeoJSON text, without the feature around it."""
    value = json.loads(text)
    while value["type"] in ("Feature", "FeatureCollection"):
        value = value["geometry"] if value["type"] == "Feature" else value["features"][0]
    return value


def to_shapely(source: _core.Region) -> shapely.Geometry:
    """A Polygon, LineString or Point, a Multi... of one kind, or a GeometryCollection."""
    import shapely

    polygons = [shapely.Polygon(part.outer, part.holes) for part in source.parts]
    lines = [shapely.LineString(line) for line in source.polylines]
    points = [shapely.Point(point) for point in source.points]
    kinds = [(polygons, shapely.MultiPolygon), (lines, shapely.MultiLineString), (points, shapely.MultiPoint)]
    filled = [(items, several) for items, several in kinds if items]
    if len(filled) > 1:
        return shapely.GeometryCollection(polygons + lines + points)
    if not filled:
        return shapely.Polygon()
    items, several = filled[0]
    return items[0] if len(items) == 1 else several(items)


def to_trimesh(source: _core.Mesh | _core.MeshData) -> trimesh.Trimesh:
    """Triangles, with the vertices and their order as they are. The faces of MeshData have to be triangles."""
    import trimesh

    triangles = source.triangles if isinstance(source, _core.Mesh) else numpy.array(source.faces).reshape(-1, 3)
    return trimesh.Trimesh(numpy.array(source.vertices), triangles, process=False)
