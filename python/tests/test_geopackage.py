"""GeoPackages that Python's own SQLite makes, and what it finds in those that are written."""

import sqlite3
import struct
from pathlib import Path

import dymsum
import pytest
from dymsum import ErrorCode, Region, RegionFormat

SQUARE = Region([(0, 0), (0.1, 0), (0.1, 1 / 3), (0, 1 / 3)])
HOLED = dymsum.shapes.grate(3, 2, 0.5, 5)


def geometry(points: list[tuple[float, float]], order: str) -> bytes:
    """A polygon, with a header and its box, in a byte order."""
    little = order == "<"
    xs, ys = zip(*points)
    header = b"GP\0" + bytes([3 if little else 2]) + struct.pack(order + "i", 4326)
    box = struct.pack(order + "4d", min(xs), max(xs), min(ys), max(ys))
    ring = [*points, points[0]]
    numbers = [number for point in ring for number in point]
    return header + box + struct.pack(f"{order}BIII{len(numbers)}d", int(little), 3, 1, len(ring), *numbers)


def make(path: Path, layers: dict[str, list[bytes]]) -> None:
    with sqlite3.connect(path) as database:
        database.execute("CREATE TABLE gpkg_contents (table_name TEXT PRIMARY KEY, data_type TEXT)")
        database.execute("CREATE TABLE gpkg_geometry_columns (table_name TEXT, column_name TEXT)")
        for name, rows in layers.items():
            database.execute("INSERT INTO gpkg_contents VALUES (?, 'features')", (name,))
            database.execute("INSERT INTO gpkg_geometry_columns VALUES (?, 'shape')", (name,))
            database.execute(f'CREATE TABLE "{name}" (id INTEGER PRIMARY KEY, shape BLOB, population REAL)')
            database.executemany(f'INSERT INTO "{name}" (shape) VALUES (?)', [(row,) for row in rows])
    database.close()


def test_what_sqlite_made_is_read(tmp_path: Path) -> None:
    path = tmp_path / "map.gpkg"
    points = [(0.1, 0.0), (1 / 3, 0.0), (0.1, 1e-300)]
    far = [(x + 5, y) for x, y in points]
    make(path, {"lakes": [geometry(points, "<"), geometry(far, ">")], "a \"quoted\" layer".replace('"', "'"): []})
    assert [shape.name for shape in dymsum.read_shapes(path)] == ["lakes/1", "lakes/2"]
    assert Region(dymsum.read_region_data(f"{path}#lakes/1")) == Region(points)
    assert Region(dymsum.read_region_data(f"{path}#lakes/2")) == Region(far)
    assert len(Region(dymsum.read_region_data(f"{path}#lakes")).parts) == 2
    assert len(dymsum.parse_shapes(path.read_bytes(), RegionFormat.gpkg)) == 2
    with pytest.raises(dymsum.Error, match="or all of a layer") as raised:
        dymsum.read_region_data(path)
    assert raised.value.code == ErrorCode.malformed and "lakes (2)" in str(raised.value)


def test_wal_mode_is_read_when_all_is_written(tmp_path: Path) -> None:
    path = tmp_path / "map.gpkg"
    points = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]
    make(path, {"lakes": [geometry(points, "<")]})
    database = sqlite3.connect(path)
    database.execute("PRAGMA journal_mode = WAL")
    database.execute("INSERT INTO lakes (shape) VALUES (?)", (geometry(points, "<"),))
    database.commit()
    with pytest.raises(dymsum.Error, match="-wal holds changes") as raised:
        dymsum.read_shapes(path)
    assert raised.value.code == ErrorCode.cannot_open
    database.close()
    assert len(dymsum.read_shapes(path)) == 2


@pytest.mark.parametrize("path", ["a.gpkg", "a.gpkg.gz"])
@pytest.mark.parametrize("region", [SQUARE, HOLED], ids=["square", "holed"])
def test_what_is_written_reads_back(path: str, region: Region, tmp_path: Path) -> None:
    content = dymsum.format_region(region, RegionFormat.gpkg)
    assert isinstance(content, bytes)
    dymsum.write_file(tmp_path / path, content)
    assert Region(dymsum.read_region_data(tmp_path / path)) == region
    assert [shape.name for shape in dymsum.read_shapes(tmp_path / path)] == ["region/1"]


def test_sqlite_finds_a_sound_geopackage(tmp_path: Path) -> None:
    path = tmp_path / "a.gpkg"
    dymsum.write_file(path, dymsum.format_region(SQUARE, RegionFormat.gpkg))
    database = sqlite3.connect(path)

    def rows(statement: str) -> list[tuple[object, ...]]:
        return database.execute(statement).fetchall()

    assert rows("PRAGMA integrity_check") == [("ok",)]
    assert rows("PRAGMA foreign_key_check") == []
    assert rows("PRAGMA application_id") == [(0x47504B47,)] and rows("PRAGMA user_version") == [(10200,)]
    assert rows("SELECT srs_id FROM gpkg_spatial_ref_sys ORDER BY srs_id") == [(-1,), (0,), (4326,)]
    assert rows("SELECT min_x, min_y, max_x, max_y, srs_id FROM gpkg_contents") == [(0.0, 0.0, 0.1, 1 / 3, -1)]
    assert rows("SELECT * FROM gpkg_geometry_columns") == [("region", "geom", "POLYGON", -1, 0, 0)]
    [(fid, blob)] = rows("SELECT fid, geom FROM region")
    assert isinstance(blob, bytes) and fid == 1
    numbers = [number for vertex in [*SQUARE.parts[0].outer, SQUARE.parts[0].outer[0]] for number in vertex]
    assert blob == struct.pack(
        f"<2sBBi4dBIII{len(numbers)}d", b"GP", 0, 3, -1, 0.0, 0.1, 0.0, 1 / 3, 1, 3, 1, 5, *numbers
    )
    database.close()


def test_other_databases_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.gpkg"
    sqlite3.connect(path).execute("CREATE TABLE a (b)").connection.close()
    with pytest.raises(dymsum.Error, match="no GeoPackage with layers") as raised:
        dymsum.read_shapes(path)
    assert raised.value.code == ErrorCode.malformed and raised.value.file == str(path)
    with pytest.raises(dymsum.Error, match="SQLite database, and this is none"):
        dymsum.parse_shapes("POLYGON ((0 0, 1 0, 0 1, 0 0))", RegionFormat.gpkg)
