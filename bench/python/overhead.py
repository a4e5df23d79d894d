"""What the way through Python costs: `./run bench python`. Times are medians of runs on this machine, now.

`--coordinates KIND|all`: on shapes in such coordinates (off_grid.py). `--off-grid`: nothing but the table of kinds, which
the default run ends with; with `--results FOLDER` it goes into off-the-grid.md.

The overhead of a call is what a call costs whose C++ work is next to nothing (a count, a pose far away), and that of an
item what an item of such a batch costs. Of other calls both are shown: the call, and the same as an item of a batch.
"""

from __future__ import annotations

import argparse
import os
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import numpy

import dymsum
import off_grid
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


def calls(kind: str | None) -> None:
    print("Calls")
    square, other = (off_grid.of_kind(r, kind) for r in (shapes.rectangle(0, 0, 1, 1), shapes.rectangle(5, 5, 6, 6)))
    queries = ObstacleQueries(CspaceObstacle(off_grid.of_kind(shapes.rectangle(-1, -0.2, 1, 0.2), kind), square))
    far = (1e3, 1e3, 0.5)
    for what, work in [
        ("region.vertex_count()", square.vertex_count),
        ("region.parts[0].outer, a view", lambda: square.parts[0].outer),
        ("contains(P, Q, z), 4 + 4 edges", lambda: dymsum.contains(square, other, (9, 9))),
        ("queries.contains of a pose far away", lambda: queries.contains(far)),
        ("queries.clearance at one box", lambda: queries.clearance(far)),
        ("Orientation.of(1, 2)", lambda: Orientation.of(1, 2)),
    ]:
        line(
            what,
            1e6 * per_call(work),
            "us",
            "asked of the overhead: at most 2 us" if "far away" in what or "()" in what else "",
        )
    line("nfp of two squares, a whole sum", 1e6 * per_call(lambda: dymsum.nfp(square, other), 2000), "us")
    ring = numpy.array(off_grid.of_kind(shapes.disc(100, 1), kind).parts[0].outer)
    line("Region of an array of 100 vertices", 1e6 * per_call(lambda: Region(ring), 2000), "us")


def random_poses(count: int, low: float, high: float) -> numpy.ndarray:
    random = numpy.random.default_rng(1)
    return numpy.column_stack([random.uniform(low, high, (count, 2)), random.uniform(-3.14, 3.14, count)])


def batches(kind: str | None) -> None:
    print(f"Items of batches ({os.cpu_count()} cores)")
    rod = off_grid.of_kind(shapes.rectangle(-1.5, -0.25, 1.5, 0.25), kind)
    queries = ObstacleQueries(CspaceObstacle(rod, off_grid.of_kind(shapes.grate(4, 2, 1, 6), kind)))
    near, far = random_poses(1_000_000, -3, 10), random_poses(1_000_000, 1e3, 2e3)
    empty = seconds(lambda: queries.contains_each(far, threads=1)) / len(far)
    line("contains_each, far away, 1 thread: all that is not geometry", 1e6 * empty, "us/item", "asked: at most 0.3 us")
    for threads in (1, 2):
        each = len(near) / seconds(lambda: queries.contains_each(near, threads=threads), 3)
        line(f"contains_each at a rod among posts, {threads} thread(s)", each / 1e6, "1e6/s", "asked: 1 (1e6 a second)")
    some = near[:20_000]
    line(
        "clearance_each there, 1 thread",
        1e6 * seconds(lambda: queries.clearance_each(some, threads=1), 3) / len(some),
        "us/item",
    )
    one = 1e6 * seconds(lambda: [queries.clearance(p) for p in some[:5000].tolist()], 3) / 5000
    line("clearance of single poses", one, "us/call")
    points = numpy.random.default_rng(2).uniform(-1, 3, (1_000_000, 2))
    square = off_grid.of_kind(shapes.rectangle(0, 0, 1, 1), kind)
    each = len(points) / seconds(lambda: dymsum.contains_each(square, square, points, threads=1), 3)
    line("contains_each in P (+) Q, 4 + 4 edges, 1 thread", each / 1e6, "1e6/s")


def turned(region: Region, quarters: int) -> Region:
    theta = Orientation.nearest(quarters * numpy.pi / 4)
    return dymsum.rotated_sum(region, "POINT(0 0)", theta).rounded()


def table(path: Path, kind: str | None) -> None:
    parts = []
    for shape in dymsum.read_shapes(str(path)):
        try:
            region = off_grid.of_kind(dymsum.repair(shape.data).region, kind)
        except dymsum.Error as error:
            print(f"  {shape.name} left out: {error}")
            continue
        parts += [turned(region, k) for k in range(8)]
    pairs = [(a, b) for a in parts[::8] for b in parts]
    print(f"Table of {path.name}: {len(pairs)} no-fit polygons, 8 orientations")
    times = [seconds(lambda: dymsum.nfp_each(pairs, threads=threads), 3) for threads in (1, 2)]
    line("one thread", 1e6 * times[0] / len(pairs), "us/pair")
    line("two threads", 1e6 * times[1] / len(pairs), "us/pair")
    line("one thread / two threads", times[0] / times[1], "", "asked: at least 1.7, on two free cores")
    single = seconds(lambda: [dymsum.nfp(a, b) for a, b in pairs], 3)
    line("single calls in a loop", 1e6 * single / len(pairs), "us/pair")
    rivals(pairs)


def clipper_sum(a: numpy.ndarray, b: numpy.ndarray) -> float:
    """The area that Clipper's sum of A and -B has, as users call it: coordinates times 1000 as integers."""
    import pyclipper

    paths = pyclipper.MinkowskiSum(
        (-1000 * b).round().astype(int).tolist(), (1000 * a).round().astype(int).tolist(), True
    )
    return sum(pyclipper.Area(path) for path in paths) / 1e6


def shapely_sum(a: Region, b: Region) -> float:
    """The area of the union of the sums of triangles, by shapely."""
    import shapely

    def triangles(region: Region) -> list[numpy.ndarray]:
        pieces = shapely.constrained_delaunay_triangles(region.to_shapely()).geoms
        return [numpy.array(piece.exterior.coords)[:3] for piece in pieces]

    others = [-t for t in triangles(b)]
    hulls = [
        shapely.MultiPoint((s[:, None] + t[None]).reshape(-1, 2)).convex_hull for s in triangles(a) for t in others
    ]
    return float(shapely.unary_union(hulls).area)


def rivals(pairs: list[tuple[Region, Region]]) -> None:
    """The same pairs by what people call from Python today; how often their area, of rounded input, is off by 1 %."""
    some = pairs[:: max(1, len(pairs) // 40)]
    rings = [(numpy.array(a.parts[0].outer), numpy.array(b.parts[0].outer)) for a, b in some]
    areas = [nfp.area() for nfp in dymsum.nfp_each(some)]
    ours = seconds(lambda: dymsum.nfp_each(some, threads=1)) / len(some)
    for name, work in [
        ("pyclipper", lambda: [clipper_sum(a, b) for a, b in rings]),
        ("shapely", lambda: [shapely_sum(a, b) for a, b in some]),
    ]:
        try:
            theirs = work()
        except (ImportError, AttributeError) as error:
            print(f"  no {name}: {error}")
            continue
        each = seconds(work, 3) / len(some)
        wrong = sum(abs(x - y) > 0.01 * y for x, y in zip(theirs, areas))
        line(f"{name}, {wrong} of {len(some)} areas wrong", 1e6 * each, "us/pair", f"{each / ours:.0f} times ours")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--coordinates", choices=(*off_grid.KINDS, "all"))
    parser.add_argument("--off-grid", action="store_true")
    parser.add_argument("--results", type=Path)
    options = parser.parse_args()
    kinds = off_grid.KINDS if options.coordinates == "all" else (options.coordinates,)
    for kind in () if options.off_grid else kinds:
        print(f"Coordinates: {kind}" if kind else "")
        calls(kind)
        batches(kind)
        data = Path(__file__).parents[3] / "shared" / "data" / "nesting"
        for name in ("swim.json", "shirts.json"):
            if (data / name).exists():
                table(data / name, kind)
    if options.off_grid or options.coordinates is None:
        if options.results:
            off_grid.write_section(options.results)
        else:
            off_grid.section()


if __name__ == "__main__":
    main()
