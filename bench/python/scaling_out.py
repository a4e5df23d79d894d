"""How well a table of no-fit polygons divides among worker processes: `scaling_out.py INSTANCE.json`.

Measured: the times of all tasks of the instance, one by one; one and two worker processes on a table of scaled copies
of its items, with a store on this machine's disk; what planning and reading a store take. Simulated: 1 to 16 workers
with as many pairs as asked for, whose times are drawn from the recorded ones, and whose fixed costs are the measured
ones, in proportion to rows. Nothing is known here of networks and of folders that machines share.
"""

from __future__ import annotations

import argparse
import heapq
import multiprocessing
import os
import statistics
import tempfile
import time
from collections.abc import Callable
from fractions import Fraction
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

import dymsum
from dymsum import NfpTable, TableInput, TableItem, TableOptions, compute_table

Times = NDArray[numpy.float64]
SHARDS_PER_WORKER = 8


class Fixed(NamedTuple):
    """Seconds of a row."""

    plan: float
    read: float


def seconds(work: Callable[[], object]) -> float:
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def table_of(path: str, orientations: int, copies: int) -> NfpTable:
    """Copy k of an item is 1 + k / 64 times as large: all pairs differ."""
    degrees = [Fraction(360 * k, orientations) for k in range(orientations)]
    items = []
    for item in dymsum.read_nesting_instance(path).items:
        shape = dymsum.repair(item.shape).region
        for k in range(copies):
            scale = 1 + k / 64
            items.append(TableItem(f"{item.name}/{k}", dymsum.repair(dymsum.scaled(shape, scale, scale)).region, degrees))
    return NfpTable(TableInput(items))


def recorded(table: NfpTable) -> Times:
    """Seconds of every task, alone on one thread: medians of three, less those of a shard without tasks."""
    count = table.task_count()
    one = lambda shard, shards: seconds(lambda: compute_table(table, TableOptions(1, shard, shards)))
    nothing = statistics.median(one(count + 1, count + 1) for _ in range(101))
    return numpy.array([max(0.0, statistics.median(one(t, count) for _ in range(3)) - nothing) for t in range(1, count + 1)])


_table: Any = None


def begin_worker(*what: Any) -> None:
    global _table
    _table = table_of(*what)


def ready(seconds: float) -> int:
    """Busy for a while, so that every worker gets one of these."""
    time.sleep(seconds)
    return os.getpid()


def shard_of(job: tuple[int, int, str]) -> float:
    return seconds(lambda: compute_table(_table, TableOptions(1, job[0], job[1], store=job[2])))


def measured(workers: int, shards: int, what: tuple[Any, ...]) -> float:
    """Seconds of all shards, each handed to the next idle worker; the workers have planned the table before."""
    with multiprocessing.get_context("spawn").Pool(workers, begin_worker, what) as pool, tempfile.TemporaryDirectory() as store:
        while len(set(pool.map(ready, [0.2] * workers, chunksize=1))) < workers:
            pass
        jobs = [(i, shards, store) for i in range(1, shards + 1)]
        return seconds(lambda: list(pool.imap_unordered(shard_of, jobs, chunksize=1)))


def fixed_costs(what: tuple[Any, ...]) -> Fixed:
    table = table_of(*what)
    rows = len(table.rows)
    plan = statistics.median(seconds(lambda: NfpTable(table.input)) for _ in range(3))
    with tempfile.TemporaryDirectory() as store:
        compute_table(table, TableOptions(store=store))
        read = statistics.median(seconds(lambda: compute_table(table, TableOptions(store=store, compute=False))) for _ in range(3))
    return Fixed(plan / rows, read / rows)


def simulated(times: Times, workers: int, shards: int, read: float) -> float:
    """Seconds of list scheduling: shard i has every so many-th task; each idle worker takes the next shard, reads what
    the shards that were finished by then have left in the store, and computes its own."""
    idle = [0.0] * workers
    finished: list[tuple[float, int]] = []
    in_store = 0
    for i in range(shards):
        own = times[i::shards]
        now = heapq.heappop(idle)
        while finished and finished[0][0] <= now:
            in_store += heapq.heappop(finished)[1]
        end = now + in_store * read + float(own.sum())
        heapq.heappush(finished, (end, len(own)))
        heapq.heappush(idle, end)
    return max(idle)


def print_measured(what: tuple[Any, ...], runs: int) -> None:
    print("| workers | shards | seconds, measured | efficiency |\n|---|---|---|---|")
    ones: list[float] = []
    both: dict[int, list[float]] = {2: [], 2 * SHARDS_PER_WORKER: []}
    for _ in range(runs):  # by turns: the machine may be busy with other things
        ones.append(measured(1, 1, what))
        for shards, found in both.items():
            found.append(measured(2, shards, what))
    print(f"| 1 | 1 | {min(ones):.2f} | 1.00 |")
    for shards, found in both.items():
        print(f"| 2 | {shards} | {min(found):.2f} | {min(ones) / min(found) / 2:.2f} |")


def print_simulated(times: Times, fixed: Fixed) -> None:
    rows = len(times)
    plan, merge, alone = fixed.plan * rows, (fixed.plan + fixed.read) * rows, float(times.sum())
    print(f"{rows} pairs: {alone:.1f} s of computing; planning {plan:.2f} s, merging (planning and reading) {merge:.2f} s")
    print("| workers | static: one shard each | dynamic: 8 shards each | static, with planning and merging | dynamic, with these |")
    print("|---|---|---|---|---|")
    for workers in (1, 2, 3, 4, 6, 8, 12, 16):
        cells = []
        for costs in (False, True):
            for shards in (workers, SHARDS_PER_WORKER * workers):
                if workers == 1:
                    cells.append("1.00")
                    continue
                took = simulated(times, workers, shards, fixed.read if costs else 0)
                whole, parts = (plan + alone, plan + took + merge) if costs else (alone, took)
                cells.append(f"{whole / parts / workers:.2f}" if costs else f"{whole / parts / workers:.4f}")
        print(f"| {workers} | " + " | ".join(cells) + " |")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("instance")
    parser.add_argument("--orientations", type=int, default=8)
    parser.add_argument("--pairs", type=int, default=10**6)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--copies", type=int, default=4, help="of every item, in what is measured [4]")
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    table = table_of(options.instance, options.orientations, 1)
    times = recorded(table)
    print(f"{os.path.basename(options.instance)}, {options.orientations} orientations: {len(times)} tasks, "
          f"mean {1e3 * times.mean():.3f} ms, median {1e3 * numpy.median(times):.3f}, largest {1e3 * times.max():.3f}\n")
    what = (options.instance, options.orientations, options.copies)
    print_measured(what, options.runs)
    print(f"\nSimulated, drawn with seed {options.seed}:")
    print_simulated(numpy.random.default_rng(options.seed).choice(times, options.pairs), fixed_costs(what))


if __name__ == "__main__":
    main()
