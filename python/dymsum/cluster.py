"""Tables of no-fit polygons on clusters: the shards of one table as tasks of Dask or of Ray.

Every worker computes shards into one folder that all of them see, and what is finished stays there whatever becomes of
the worker. The table is then made of the folder: the same bytes as one process makes. See docs/guide/clusters.md.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any, NamedTuple, Optional, Protocol, Union

from . import _core
from ._core import NfpTable, TableBin, TableInput, TableItem, TableOptions, TableResult, TableWork
from ._errors import Error

Orientations = Union[int, Sequence[Union[Fraction, float]], None]
"""How many equally spaced ones, or degrees; None: those that the instance allows."""


class DaskClient(Protocol):
    """What is used of distributed.Client."""

    def submit(self, function: Callable[..., Any], /, *arguments: Any, **options: Any) -> Any: ...

    def gather(self, futures: Any, /) -> Any: ...

    def cancel(self, futures: Any, /) -> Any: ...


class ShardedTable(NamedTuple):
    """A table, its answers, and what was done for each shard."""

    table: NfpTable
    result: TableResult
    shards: list[TableWork]


class TableOf(NamedTuple):
    """Which table of an instance: what every worker makes again from the file."""

    instance_file: str
    orientations: Orientations = None
    repair: bool = False
    angle_error: float = 1e-9

    def make(self) -> NfpTable:
        """The table. Raises Error for instances that cannot be read and shapes that are not valid; ValueError for an
        item that may take any orientation where none are given."""
        instance = _core.read_nesting_instance(self.instance_file)
        given = _degrees(self.orientations)
        items = []
        for item in instance.items:
            degrees = item.degrees if given is None else given
            if degrees is None:
                raise ValueError(f"{self.instance_file}: item {item.name} may take any orientation: give some")
            items.append(TableItem(item.name, self._region(item.shape, f"#{item.name}"), degrees))
        bins = [TableBin(bin.name, self._region(bin.shape, f", bin {bin.name}")) for bin in instance.bins]
        return NfpTable(TableInput(items, bins, instance.strip_height, self.angle_error))

    def _region(self, shape: _core.RegionData, place: str) -> _core.Region:
        try:
            return _core.repair(shape).region if self.repair else _core.Region.create(shape)
        except Error as error:
            raise Error(error.code, f"{self.instance_file}{place}: {error.message}", error.evidence) from None


def _degrees(orientations: Orientations) -> Optional[list[Fraction]]:
    if orientations is None:
        return None
    if isinstance(orientations, int):
        if not 1 <= orientations <= 3600:
            raise ValueError(f"{orientations} orientations: they are 1 to 3600")
        return [Fraction(360 * k, orientations) for k in range(orientations)]
    return [Fraction(degrees) for degrees in orientations]


_last: list[tuple[object, NfpTable]] = []


def _table(of: TableOf) -> NfpTable:
    """of.make(), kept for the next shard of the same file."""
    status = Path(of.instance_file).stat()
    key = (of, status.st_mtime_ns, status.st_size)
    if not _last or _last[0][0] != key:
        _last[:] = [(key, of.make())]
    return _last[0][1]


def compute_shard(of: TableOf, store: str, shard: int, shards: int, threads: int = 1) -> TableWork:
    """Computes shard `shard` of `shards`, from 1 on, into the folder `store`: what one task does. Shards can be
    repeated, and computed at the same time: what the folder has is not computed again."""
    return _core.compute_table(_table(of), TableOptions(threads=threads, shard=shard, shards=shards, store=store)).work


def merge(table: NfpTable, store: str) -> TableResult:
    """The answers that the folder has. Raises RuntimeError where some are missing."""
    result = _core.compute_table(table, TableOptions(store=store, compute=False))
    missing = sum(answer is None for answer in result.answers)
    if missing:
        raise RuntimeError(f"{store}: {missing} of {len(result.answers)} answers are missing")
    return result


def _sharded(
    instance_file: Union[str, Path],
    store: Union[str, Path],
    shards: int,
    work: Callable[[TableOf, str, Iterable[int]], Sequence[TableWork]],
    options: dict[str, Any],
) -> ShardedTable:
    """All shards by `work`, then the table. Paths are absolute: workers have working directories of their own. What
    is wrong with the instance is raised here, before there is any task."""
    if shards < 1:
        raise ValueError(f"{shards} shards")
    of = TableOf(str(Path(instance_file).absolute()), **options)
    if not isinstance(of.orientations, (int, type(None))):
        of = of._replace(orientations=tuple(of.orientations))
    folder = str(Path(store).absolute())
    table = of.make()
    done = work(of, folder, range(1, shards + 1))
    return ShardedTable(table, merge(table, folder), list(done))


def table_with_dask(
    client: DaskClient,
    instance_file: Union[str, Path],
    store: Union[str, Path],
    shards: int,
    *,
    threads: int = 1,
    retries: int = 3,
    **table: Any,
) -> ShardedTable:
    """The table of an instance, its shards computed by the workers of a dask.distributed client.

    `instance_file` and the folder `store` have one path on all machines. `table` are orientations (a count or degrees),
    repair and angle_error. A shard whose worker dies goes to another one, and is begun where that one was killed; Dask
    gives up, with KilledWorker, after `distributed.scheduler.allowed-failures` of them. A shard that raises is tried
    `retries` times more.
    """

    def work(of: TableOf, folder: str, numbers: Iterable[int]) -> Sequence[TableWork]:
        futures = [
            client.submit(compute_shard, of, folder, i, shards, threads, pure=False, retries=retries) for i in numbers
        ]
        try:
            return list(client.gather(futures))
        except BaseException:
            client.cancel(futures)
            raise

    return _sharded(instance_file, store, shards, work, table)


def table_with_ray(
    instance_file: Union[str, Path],
    store: Union[str, Path],
    shards: int,
    *,
    threads: int = 1,
    retries: int = 3,
    **table: Any,
) -> ShardedTable:
    """The same by the workers of Ray, which ray.init has connected to. A shard whose worker dies, or which raises, is
    tried `retries` times more; then Ray raises ray.exceptions.WorkerCrashedError, or what the task raised."""
    ray: Any = importlib.import_module("ray")
    task = ray.remote(num_cpus=threads, max_retries=retries, retry_exceptions=True)(compute_shard)

    def work(of: TableOf, folder: str, numbers: Iterable[int]) -> Sequence[TableWork]:
        references = [task.remote(of, folder, i, shards, threads) for i in numbers]
        try:
            return list(ray.get(references))
        except BaseException:
            for reference in references:
                ray.cancel(reference)
            raise

    return _sharded(instance_file, store, shards, work, table)
