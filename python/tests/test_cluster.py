"""Tables on clusters of two worker processes, of which one is killed on the way."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import dymsum
from dymsum import cluster, shapes

ITEMS, SHARDS = 10, 4


def instance(folder: Path, items: int) -> Path:
    """Polygons of 150 vertices: some seconds of work."""
    file = folder / "instance.json"
    listed = [
        f'{{"id": {k}, "shape": {{"type": "simple_polygon", "data": {shapes.random_polygon(150, 0, k).parts[0].outer.tolist()}}}}}'
        for k in range(items)
    ]
    file.write_text(f'{{"items": [{", ".join(listed)}]}}')
    return file


def texts(table: dymsum.NfpTable, result: dymsum.TableResult) -> tuple[str, str, bytes]:
    rows, geometry = dymsum.table_rows(table, result, True), dymsum.table_geometry(table, result)
    return rows, dymsum.table_manifest(table, result, rows, geometry), geometry


def writer_in(store: Path) -> int | None:
    """A process that has a file of the folder open which has answers already."""
    for entry in Path("/proc").glob("[0-9]*/fd/*"):
        try:
            target = Path(os.readlink(entry))
        except OSError:
            continue
        if target.parent == store and target.suffix == ".nfpt" and target.stat().st_size > 4096:
            return int(entry.parts[2])
    return None


class Killer(threading.Thread):
    """Kills the first worker that has answers, and keeps how many were there before."""

    def __init__(self, store: Path) -> None:
        super().__init__()
        self.store = store
        self.killed: int | None = None

    def run(self) -> None:
        end = time.monotonic() + 60
        while self.killed is None and time.monotonic() < end:
            worker = writer_in(self.store)
            if worker is not None and worker != os.getpid():
                os.kill(worker, signal.SIGKILL)
                self.killed = worker
            time.sleep(0.005)


def check(folder: Path, compute: Callable[..., cluster.ShardedTable]) -> None:
    file, store = instance(folder, ITEMS), folder / "store"
    store.mkdir()
    killer = Killer(store)
    killer.start()
    made = compute(file, store, SHARDS, orientations=[0, 90, 30])
    killer.join()
    assert killer.killed is not None, "no worker was killed"
    assert sum(work.tasks for work in made.shards) == made.table.task_count()
    # What the killed worker had finished was found by the one that took its shard.
    assert 0 < sum(work.computed for work in made.shards) < made.table.task_count()
    alone = cluster.TableOf(str(file), (0, 90, 30)).make()
    assert texts(made.table, made.result) == texts(alone, dymsum.compute_table(alone))
    again = compute(file, store, 3, orientations=[0, 90, 30])
    assert sum(work.computed for work in again.shards) == 0


def test_dask(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, local_directory=str(tmp_path)) as two,
        distributed.Client(two) as client,
    ):
        check(tmp_path, lambda *what, **table: cluster.table_with_dask(client, *what, **table))


@pytest.mark.cluster
def test_ray(tmp_path: Path) -> None:
    ray: Any = pytest.importorskip("ray")
    ray.init(num_cpus=2, include_dashboard=False, logging_level="error")
    try:
        check(tmp_path, cluster.table_with_ray)
    finally:
        ray.shutdown()


def test_what_is_wrong_is_raised_before_there_are_tasks(tmp_path: Path) -> None:
    file = instance(tmp_path, 1)
    client: Any = None
    with pytest.raises(ValueError, match="any orientation"):
        cluster.table_with_dask(client, file, tmp_path / "store", 2)
    with pytest.raises(ValueError, match="0 orientations"):
        cluster.table_with_dask(client, file, tmp_path / "store", 2, orientations=0)
    with pytest.raises(dymsum.Error, match="none.json"):
        cluster.table_with_dask(client, tmp_path / "none.json", tmp_path / "store", 2, orientations=8)
    file.write_text('{"items": [{"id": "bow", "shape": {"type": "simple_polygon", "data": [[0,0],[1,1],[1,0],[0,1]]}}]}')
    with pytest.raises(dymsum.Error, match="instance.json#bow") as raised:
        cluster.TableOf(str(file), 4).make()
    assert raised.value.code == dymsum.ErrorCode.self_crossing


def test_a_folder_without_all_shards_is_no_table(tmp_path: Path) -> None:
    of = cluster.TableOf(str(instance(tmp_path, 3)), 1)
    work = cluster.compute_shard(of, str(tmp_path / "store"), 1, 2)
    assert work.tasks == work.computed > 0
    with pytest.raises(RuntimeError, match="are missing"):
        cluster.merge(of.make(), str(tmp_path / "store"))
