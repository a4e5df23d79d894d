"""Nesting instances and tables of no-fit polygons."""

from __future__ import annotations

import _thread
import hashlib
import json
import pickle
from fractions import Fraction
from pathlib import Path

import pytest
import shapely

import dymsum
from dymsum import ErrorCode, NfpTable, TableBin, TableInput, TableItem, TableOptions, TableRow, compute_table, shapes

ELL, BAR, ROOM = shapes.letter_l(3, 3, 1), shapes.rectangle(0, 0, 2, 1), shapes.rectangle(0, 0, 4, 3)
INSTANCE = """{"name": "two", "items": [
  {"id": "ell", "demand": 2, "shape": {"type": "simple_polygon", "data": [[0,0],[3,0],[3,1],[1,1],[1,3],[0,3]]}},
  {"id": "bar", "allowed_orientations": [0, 0.1],
   "shape": {"type": "rectangle", "data": {"x_min": 0, "y_min": 0, "width": 2, "height": 1}}}],
  "bins": [{"id": "sheet", "shape": {"type": "rectangle", "data": {"x_min": 0, "y_min": 0, "width": 4, "height": 3}}}],
  "strip_height": 3}"""


def small(degrees: list[float]) -> NfpTable:
    items = [TableItem("ell", ELL, degrees), TableItem("bar", BAR, degrees)]
    return NfpTable(TableInput(items, [TableBin("room", ROOM)], strip_height=3))


def test_an_instance_is_read(tmp_path: Path) -> None:
    file = tmp_path / "two.json"
    file.write_text(INSTANCE)
    read = dymsum.read_nesting_instance(str(file))
    assert (read.name, read.strip_height, [item.name for item in read.items]) == ("two", 3, ["ell", "bar"])
    assert [item.demand for item in read.items] == [2, 1]
    assert [item.degrees for item in read.items] == [None, [0, Fraction(1, 10)]]
    assert dymsum.Region(read.items[0].shape) == ELL and dymsum.Region(read.bins[0].shape) == ROOM
    copy = pickle.loads(pickle.dumps(dymsum.parse_nesting_instance(INSTANCE, "here")))
    assert repr(copy) == repr(read)
    with pytest.raises(dymsum.Error) as raised:
        dymsum.parse_nesting_instance('{"items": 5}', "here")
    assert raised.value.code == ErrorCode.malformed and raised.value.evidence.file == "here"


def test_rows_are_what_single_calls_say() -> None:
    table = small([0, 45, 90])
    result = compute_table(table)
    parts = [ELL, BAR]
    assert len(table.rows) == 4 * 5 + 2 * 3 + 2 * 3
    for row in table.rows:
        answer, theta = result.answers[row.answer], table.angles[row.angle].orientation
        assert answer is not None and answer.status == dymsum.TableAnswer.Status.done and answer.error is None
        if row.kind == TableRow.Kind.strip_fit:
            assert row.fixed == TableRow.kNone and answer.strip is not None and answer.wkb == b""
            continue
        if row.kind == TableRow.Kind.nfp:
            sum = dymsum.cspace_slice(parts[row.moving], parts[row.fixed], theta)
        else:
            sum = dymsum.rotated_erode(ROOM, parts[row.moving], theta)
        assert answer.strip is None
        assert (answer.vertices, answer.tight_segments) == (sum.vertex_count(), len(sum.tight_segments))
        area = float(sum.area())
        assert shapely.area(shapely.from_wkb(answer.wkb)) == pytest.approx(area, rel=1e-14, abs=1e-14)


def test_a_turned_fit_is_the_fit_of_the_turned_part() -> None:
    quarter = dymsum.Orientation.of(1, 1)
    fit = dymsum.rotated_erode(ROOM, BAR, quarter)
    assert fit.area_exact() == dymsum.erode(ROOM, [(-1, 0), (0, 0), (0, 2), (-1, 2)]).area_exact() == 3
    assert pickle.loads(pickle.dumps(fit)) == fit


def test_texts_are_the_same_bytes_for_any_shards(tmp_path: Path) -> None:
    table = small([0, 30, 90])
    whole = compute_table(table, TableOptions(threads=2))
    for shard in (3, 1, 2):
        part = compute_table(table, TableOptions(shard=shard, shards=3, threads=1, store=str(tmp_path)))
        assert part.work.computed == part.work.tasks
    merged = compute_table(table, TableOptions(store=str(tmp_path), compute=False))
    assert merged.work.store_files == 3 and merged.work.refused_files == []
    rows, geometry = dymsum.table_rows(table, whole, False), dymsum.table_geometry(table, whole)
    assert isinstance(geometry, bytes)
    assert (dymsum.table_rows(table, merged, False), dymsum.table_geometry(table, merged)) == (rows, geometry)
    for line in map(json.loads, rows.splitlines()):
        if line["kind"] != "strip_fit":
            shapely.from_wkb(geometry[line["offset"] : line["offset"] + line["bytes"]])
    manifest = dymsum.table_manifest(table, whole, rows, geometry)
    assert hashlib.sha256(geometry).hexdigest() in manifest and hashlib.sha256(rows.encode()).hexdigest() in manifest


def test_a_table_without_all_answers_is_not_written() -> None:
    table = small([0])
    part = compute_table(table, TableOptions(shard=1, shards=2))
    assert None in part.answers
    with pytest.raises(ValueError):
        dymsum.table_rows(table, part, True)


def test_records_are_pickled() -> None:
    table = small([0, 90])
    copy = pickle.loads(pickle.dumps(table))
    result = compute_table(table)
    kept = pickle.loads(pickle.dumps(result))
    assert dymsum.table_rows(copy, kept, True) == dymsum.table_rows(table, result, True)
    far = [(0, 0), (2.0**1010, 0), (0, 2.0**1010)]
    refused = compute_table(NfpTable(TableInput([TableItem("far", far, [0])]))).answers[0]
    assert refused is not None and refused.status == dymsum.TableAnswer.Status.refused
    assert isinstance(refused.error, dymsum.Error) and refused.error.code == ErrorCode.unsupported_operand
    assert pickle.loads(pickle.dumps(refused)).error == refused.error
    options = pickle.loads(pickle.dumps(TableOptions(threads=3, store="x", progress=lambda stage, share: None)))
    assert (options.threads, options.store, options.progress) == (3, "x", None)


def test_errors_of_tables(tmp_path: Path) -> None:
    with pytest.raises(dymsum.Error) as raised:
        NfpTable.create(TableInput([TableItem("ell", ELL, [])]))
    assert raised.value.code == ErrorCode.unsupported_operand
    with pytest.raises(dymsum.Error) as raised:
        compute_table(small([0]), TableOptions(shard=3, shards=2))
    assert raised.value.code == ErrorCode.out_of_range
    with pytest.raises(dymsum.Error) as raised:
        dymsum.check_writable(str(tmp_path / "nowhere" / "rows.jsonl"))
    assert raised.value.code == ErrorCode.cannot_write
    dymsum.check_writable(str(tmp_path / "rows.jsonl"))


def large() -> NfpTable:
    items = [TableItem(str(k), shapes.random_polygon(80, 0, k), [0, 30]) for k in range(40)]
    return NfpTable(TableInput(items))


def test_a_table_tells_how_far_it_is_and_stops() -> None:
    seen: list[float] = []
    compute_table(small([0]), TableOptions(progress=lambda stage, share: seen.append(share)))
    assert seen and all(0 < share <= 1 for share in seen)
    with pytest.raises(dymsum.Error) as raised:
        compute_table(large(), TableOptions(progress=lambda stage, share: False))
    assert raised.value.code == ErrorCode.cancelled


def test_planning_tells_how_far_it_is_and_stops() -> None:
    # 66 orientations whose differences are all others.
    scattered = [Fraction(360 * (k * k * k * k % 1000003), 1000003) for k in range(1, 67)]
    planned = TableInput([TableItem("bar", BAR, scattered)])
    stages: list[str] = []
    NfpTable(planned, lambda stage, share: stages.append(stage))
    assert stages
    for plan in (NfpTable, NfpTable.create):
        with pytest.raises(dymsum.Error) as raised:
            plan(planned, progress=lambda stage, share: False)
        assert raised.value.code == ErrorCode.cancelled


@pytest.mark.parametrize("threads", [1, 2])
def test_an_interrupted_table_keeps_what_is_finished(threads: int, tmp_path: Path) -> None:
    table = large()

    def interrupt(_stage: str, share: float) -> bool:
        if share > 0.1:
            _thread.interrupt_main()
        return True

    with pytest.raises(KeyboardInterrupt):
        compute_table(table, TableOptions(threads=threads, store=str(tmp_path), progress=interrupt))
    found = compute_table(table, TableOptions(store=str(tmp_path), compute=False)).answers
    assert 0 < sum(answer is not None for answer in found) < len(found)


def test_version_and_dxf() -> None:
    assert dymsum.version() == dymsum.__version__
    text = dymsum.format_region(ELL, dymsum.RegionFormat.dxf)
    assert dymsum.begins_like_dxf(text) and not dymsum.begins_like_dxf(INSTANCE)
    assert dymsum.Region(dymsum.parse_shapes(text, dymsum.RegionFormat.dxf)[0].data).canonical() == ELL.canonical()
