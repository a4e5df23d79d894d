"""How well a table of no-fit polygons divides among worker processes: `./run bench clusters [INSTANCE.json ...]`.

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
from dymsum import NfpTable, Region, TableInput, TableItem, TableOptions, compute_table, shapes

Times = NDArray[numpy.float64]
SHARDS_PER_WORKER = 8


class Instance(NamedTuple):
    name: str
    path: str  #: "": random polygons
    copies: int


class Fixed(NamedTuple):
    """Seconds of a row."""

    plan: float
    read: float


def seconds(work: Callable[[], object], clock: Callable[[], float] = time.process_time) -> float:
    """Of processor time, but for other clocks."""
    begin = clock()
    work()
    return clock() - begin


def shapes_of(instance: Instance) -> list[Region]:
    if not instance.path:
        return [shapes.random_polygon(100 + 11 * k, 0, k) for k in range(10)]
    return [dymsum.repair(item.shape).region for item in dymsum.read_nesting_instance(instance.path).items]


def table_of(instance: Instance, orientations: int, copies: int) -> NfpTable:
    """Copy k of an item is 1 + k / 64 times as large: all pairs differ."""
    degrees = [Fraction(360 * k, orientations) for k in range(orientations)]
    items = []
    for n, shape in enumerate(shapes_of(instance)):
        for k in range(copies):
            scale = 1 + k / 64
            items.append(TableItem(f"{n}/{k}", dymsum.repair(dymsum.scaled(shape, scale, scale)).region, degrees))
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


def shard_of(job: tuple[int, int, str]) -> tuple[int, float]:
    """Which worker computed the shard, in which processor time."""
    return os.getpid(), seconds(lambda: compute_table(_table, TableOptions(1, job[0], job[1], store=job[2])))


def measured(workers: int, shards: int, what: tuple[Any, ...]) -> tuple[float, float]:
    """Processor time of the busiest worker, and seconds by the clock, of all shards, each handed to the next idle
    worker; the workers have planned the table before."""
    with multiprocessing.get_context("spawn").Pool(workers, begin_worker, what) as pool, tempfile.TemporaryDirectory() as store:
        while len(set(pool.map(ready, [0.2] * workers, chunksize=1))) < workers:
            pass
        jobs = [(i, shards, store) for i in range(1, shards + 1)]
        begin = time.perf_counter()
        busy: dict[int, float] = {}
        for worker, took in pool.imap_unordered(shard_of, jobs, chunksize=1):
            busy[worker] = busy.get(worker, 0) + took
        return max(busy.values()), time.perf_counter() - begin


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


def measured_table(what: tuple[Any, ...], runs: int) -> str:
    ways = [(1, 1), (2, 2), (2, 2 * SHARDS_PER_WORKER)]
    found: list[list[tuple[float, float]]] = [[] for _ in ways]
    for _ in range(runs):  # by turns: the machine may be busy with other things
        for way, into in zip(ways, found):
            into.append(measured(*way, what))
    busy, clock = ([min(run[k] for run in runs_of) for runs_of in found] for k in (0, 1))
    text = "| workers | shards | processor time of the busiest, s | efficiency by it | clock, s | efficiency by the clock |\n"
    text += "|---|---|---|---|---|---|\n"
    for k, (workers, shards) in enumerate(ways):
        by_busy, by_clock = busy[0] / busy[k] / workers, clock[0] / clock[k] / workers
        text += f"| {workers} | {shards} | {busy[k]:.2f} | {by_busy:.2f} | {clock[k]:.2f} | {by_clock:.2f} |\n"
    return text


def efficiency(times: Times, fixed: Fixed, workers: int, shards: int, costs: bool) -> float:
    """Of `shards` by `workers`, against one process that computes the table at once and merges nothing."""
    alone = float(times.sum())
    took = simulated(times, workers, shards, fixed.read if costs and shards > 1 else 0)
    if not costs:
        return alone / took / workers
    plan, read = fixed.plan * len(times), fixed.read * len(times)
    merge = plan + read if shards > 1 else 0
    return (plan + alone) / (plan + took + merge) / workers


def simulated_table(times: Times, fixed: Fixed) -> str:
    text = "| workers | static | dynamic | static, with planning and reading | dynamic, with these |\n|---|---|---|---|---|\n"
    for workers in (1, 2, 3, 4, 6, 8, 12, 16):
        shards = (workers, SHARDS_PER_WORKER * workers if workers > 1 else 1)
        cells = [f"{efficiency(times, fixed, workers, n, costs):.3f}" for costs in (False, True) for n in shards]
        text += f"| {workers} | " + " | ".join(cells) + " |\n"
    return text


def section(instance: Instance, options: argparse.Namespace) -> str:
    """What is said of an instance."""
    table = table_of(instance, options.orientations, 1)
    times = recorded(table)
    at_once = min(seconds(lambda: compute_table(table, TableOptions(1))) for _ in range(5))
    what = (instance, options.orientations, instance.copies)
    compared = measured_table(what, options.runs)
    drawn = numpy.random.default_rng(options.seed).choice(times, options.pairs)
    fixed = fixed_costs(what)
    return f"""## {instance.name}

{options.orientations} orientations: {len(times)} tasks, {1e3 * times.mean():.3f} ms on average, the longest {1e3 * times.max():.3f} ms; together {times.sum():.3f} s, where the whole
table at once takes {at_once:.3f} s. A row takes {1e6 * fixed.plan:.2f} us to be planned and {1e6 * fixed.read:.2f} us to be read from the store.

Measured, every item in {instance.copies} sizes:

{compared}
Simulated, {options.pairs} pairs drawn with seed {options.seed}: {drawn.sum():.1f} s of computing, {fixed.plan * options.pairs:.1f} s of planning, {fixed.read * options.pairs:.1f} s of reading once.

{simulated_table(drawn, fixed)}"""


PAGE = f"""# Tables of no-fit polygons on several workers

How many times faster w workers are than one, divided by w: written by `./run bench clusters --results docs/results`.
What is **measured** is one and two processes on one machine of {os.cpu_count()} cores, each with one thread, with a store on its disk,
from the first shard begun to the last one finished: by the clock, which is worth something on a machine that does nothing
else, and by the processor time of the busiest worker, which leaves out waiting for disk, locks and cores.
What is **simulated** is list scheduling of task times that were recorded on this machine: nothing is known there of
networks, of folders that machines share, or of memory that cores share. Recorded times are processor time.

Other work on the machine as this was written (load average): {os.getloadavg()[1]:.1f}; by the clock, figures are sound near 0 alone.

- *Static*: one shard for each worker, all begun at once. *Dynamic*: {SHARDS_PER_WORKER} for each, the next one for whoever is idle.
- *With planning and reading*: a shard reads what the store holds as it begins; every worker plans the table once, and in
  the end one process plans it and reads the store to merge. The single process does not have to.

"""


def instances(options: argparse.Namespace) -> list[Instance]:
    if options.instance:
        return [Instance(os.path.basename(path), path, options.copies) for path in options.instance]
    data = os.path.join(os.environ.get("DYMSUM_DATA", "../shared/data"), "nesting", "swim.json")
    known = [Instance("swim.json", os.path.abspath(data), 5)] if os.path.exists(data) else []
    return [*known, Instance("Random polygons of 100 to 199 vertices", "", 2)]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("instance", nargs="*", help="[swim.json in DYMSUM_DATA, and random polygons]")
    parser.add_argument("--orientations", type=int, default=8)
    parser.add_argument("--pairs", type=int, default=10**6)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--copies", type=int, default=4, help="of every item of the instances, in what is measured [4]")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--results", help="a folder: write clusters.md there")
    options = parser.parse_args()
    page = PAGE
    print(page, flush=True)
    for instance in instances(options):
        text = section(instance, options)
        print(text, flush=True)
        page += text + "\n"
    if options.results:
        with open(os.path.join(options.results, "clusters.md"), "w") as file:
            file.write(page.rstrip("\n") + "\n")


if __name__ == "__main__":
    main()
