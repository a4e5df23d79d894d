"""What the way through Python costs: `./run bench python`. Times are medians of runs on this machine, now.

Overhead is measured, not derived: calls whose C++ work is a few nanoseconds (a count, a truth value of a trivial
question), less nothing; items of batches, less what the same items cost on one C++ thread where the library has a batch
of its own.
"""

from __future__ import annotations

import os
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import numpy

import dymsum
from dymsum import CspaceObstacle, ObstacleQueries, Orientation, Region, shapes


def seconds(work: Callable[[], object], runs: int = 7) -> float:
    times = []
    for _ in range(runs):
        begin = time.perf_counter()
        work()
        times.append(time.perf_counter() - begin)
    return statistics.median(times)


def per_call(work: Callable[[], object], calls: int = 20_000) -> float:
    """Seconds of one call, less that of an empty loop."""

    def repeated() -> None:
        for _ in range(calls):
            work()

    return (seconds(repeated) - seconds(lambda: [None for _ in range(calls)])) / calls


def line(what: str, value: float, unit: str, asked: str = "") -> None:
    print(f"  {what:<64} {value:>10.3f} {unit:<10} {asked}")


def calls() -> None:
    print("Calls")
    square, other = shapes.rectangle(0, 0, 1, 1), shapes.rectangle(5, 5, 6, 6)
    queries = ObstacleQueries(CspaceObstacle(shapes.rectangle(-1, -0.2, 1, 0.2), square))
    far = (1e3, 1e3, 0.5)
    for what, work in [
        ("region.vertex_count()", square.vertex_count),
        ("region.parts[0].outer, a view", lambda: square.parts[0].outer),
        ("contains(P, Q, z), 4 + 4 edges", lambda: dymsum.contains(square, other, (9, 9))),
        ("queries.contains((x, y, theta)), far away", lambda: queries.contains(far)),
        ("queries.clearance(...), one box", lambda: queries.clearance(far)),
        ("Orientation.of(1, 2)", lambda: Orientation.of(1, 2)),
    ]:
        line(what, 1e6 * per_call(work), "us", "asked of the overhead: at most 2 us")
    line("nfp of two squares, a whole sum", 1e6 * per_call(lambda: dymsum.nfp(square, other), 2000), "us")
    ring = numpy.array(shapes.disc(100, 1).parts[0].outer)
    line("Region of an array of 100 vertices", 1e6 * per_call(lambda: Region(ring), 2000), "us")


def random_poses(count: int, low: float, high: float) -> numpy.ndarray:
    random = numpy.random.default_rng(1)
    return numpy.column_stack([random.uniform(low, high, (count, 2)), random.uniform(-3.14, 3.14, count)])


def batches() -> None:
    print(f"Items of batches ({os.cpu_count()} cores)")
    rod = shapes.rectangle(-1.5, -0.25, 1.5, 0.25)
    queries = ObstacleQueries(CspaceObstacle(rod, shapes.grate(4, 2, 1, 6)))
    near, far = random_poses(1_000_000, -3, 10), random_poses(1_000_000, 1e3, 2e3)
    empty = seconds(lambda: queries.contains_each(far, threads=1)) / len(far)
    line("contains_each, far away, 1 thread: all that is not geometry", 1e6 * empty, "us/item", "asked: at most 0.3 us")
    for threads in (1, 2):
        each = len(near) / seconds(lambda: queries.contains_each(near, threads=threads), 3)
        line(f"contains_each at a rod among posts, {threads} thread(s)", each / 1e6, "1e6/s", "asked: 1 (1e6 a second)")
    some = near[:20_000]
    line("clearance_each there, 1 thread", 1e6 * seconds(lambda: queries.clearance_each(some, threads=1), 3) / len(some), "us/item")
    one = 1e6 * seconds(lambda: [queries.clearance(p) for p in some[:5000].tolist()], 3) / 5000
    line("clearance of single poses", one, "us/call")
    points = numpy.random.default_rng(2).uniform(-1, 3, (1_000_000, 2))
    square = shapes.rectangle(0, 0, 1, 1)
    each = len(points) / seconds(lambda: dymsum.contains_each(square, square, points, threads=1), 3)
    line("contains_each in P (+) Q, 4 + 4 edges, 1 thread", each / 1e6, "1e6/s")


def turned(region: Region, quarters: int) -> Region:
    theta = Orientation.nearest(quarters * numpy.pi / 4)
    return dymsum.rotated_sum(region, "POINT(0 0)", theta).rounded()


def table(path: Path) -> None:
    parts = []
    for shape in dymsum.read_shapes(str(path)):
        region = dymsum.repair(shape.data).region
        parts += [turned(region, k) for k in range(8)]
    pairs = [(a, b) for a in parts[::8] for b in parts]
    print(f"Table of {path.name}: {len(pairs)} no-fit polygons, 8 orientations")
    times = [seconds(lambda: dymsum.nfp_each(pairs, threads=threads), 3) for threads in (1, 2)]
    line("one thread", 1e6 * times[0] / len(pairs), "us/pair")
    line("two threads", 1e6 * times[1] / len(pairs), "us/pair")
    line("one thread / two threads", times[0] / times[1], "", "asked: at least 1.7, on two free cores")
    single = seconds(lambda: [dymsum.nfp(a, b) for a, b in pairs], 3)
    line("single calls in a loop", 1e6 * single / len(pairs), "us/pair")


def main() -> None:
    calls()
    batches()
    data = Path(__file__).parents[3] / "shared" / "data" / "nesting"
    for name in ("swim.json", "shirts.json"):
        if (data / name).exists():
            table(data / name)


if __name__ == "__main__":
    main()
