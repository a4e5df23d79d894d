"""What the coordinates of the same shapes cost through Python: the section "python" of docs/results/off-the-grid.md."""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy

import dymsum
from dymsum import CspaceObstacle, ObstacleQueries, Part, Region, RegionData

sys.path.append(str(Path(__file__).parents[1] / "coordinates"))
from coordinates import REGIONS, as_kind  # noqa: E402

KINDS = ("grid", "decimals", "single", "noise", "turned")

INTRODUCTION = """Calls from Python on one thread, at their medians of processor time: no-fit polygons, positions in the obstacle of all orientations
(made before). Kinds are those of [coordinates.md](coordinates.md): *noise* are the doubles that sines and cosines give. Pyclipper: of coordinates
times 1000 as integers. Compared: areas with the grid's, as far as the kind rounds shapes; Pyclipper's are not compared.
"""


def of_kind(region: Region, kind: str | None) -> Region:
    """The same shape in coordinates of a kind; dymsum.Error where rounding spoils it."""
    if kind is None:
        return region
    ring = lambda points: numpy.array(as_kind(numpy.asarray(points).tolist(), kind))
    parts = [Part(ring(part.outer), [ring(hole) for hole in part.holes]) for part in region.parts]
    return Region(RegionData(parts))


def pyclipper_sum(a: Region, b: Region) -> None:
    import pyclipper

    rings = [(1000 * sign * numpy.array(r.parts[0].outer)).round().astype(int).tolist() for sign, r in ((1, a), (-1, b))]
    pyclipper.MinkowskiSum(rings[1], rings[0], True)


def timed(work: Callable[[], object]) -> float:
    """Seconds of processor time of a call, of as many as take 4 ms."""
    begin, calls = time.process_time(), 0
    while calls == 0 or time.process_time() - begin < 0.004:
        work()
        calls += 1
    return (time.process_time() - begin) / calls


class Case:
    """A call on shapes of one kind: the size of its result, an area to compare (or None) and the opponent (or None)."""

    def __init__(self, work: Callable[[], object], size: int, area: float | None, rival: Callable[[], object] | None):
        self.work, self.size, self.area, self.rival = work, size, area, rival
        self.seconds: list[float] = []


def nfp_case(a: Region, b: Region) -> Case:
    made = dymsum.nfp(a, b)
    return Case(lambda: dymsum.nfp(a, b), made.vertex_count(), made.area(), lambda: pyclipper_sum(a, b))


def contains_case(robot: Region, obstacle: Region) -> Case:
    queries = ObstacleQueries(CspaceObstacle(robot, obstacle))
    random = numpy.random.default_rng(1)
    poses = numpy.column_stack([random.uniform(-15, 15, (10_000, 2)), random.uniform(-3.14, 3.14, 10_000)])
    return Case(lambda: queries.contains_each(poses, threads=1), len(poses), None, None)


CASES = {
    "nfp of gear 30 and gear 13": ("gear", "pinion", nfp_case),
    "nfp of comb 20 and comb 7": ("comb", "small_comb", nfp_case),
    "nfp of comb 20 with itself": ("comb", "comb", nfp_case),
    "10,000 positions, comb 7 among the teeth of comb 20": ("small_comb", "comb", contains_case),
}


def of_points(name: str, kind: str) -> Region:
    return Region(numpy.array(as_kind(REGIONS[name], kind)))


def rows(name: str) -> list[str]:
    """A row for each kind, which are measured by turns."""
    p, q, make = CASES[name]
    cases = {kind: make(of_points(p, kind), of_points(q, kind)) for kind in KINDS}
    for case in cases.values():
        case.work()
    for _ in range(7):
        for case in cases.values():
            case.seconds.append(timed(case.work))
    lines = []
    grid = cases["grid"]
    for kind, case in cases.items():
        took = statistics.median(case.seconds)
        ratio = statistics.median(a / b for a, b in zip(case.seconds, grid.seconds))
        each, grid_each = took / case.size, statistics.median(grid.seconds) / grid.size
        cells = [name, kind, f"{1e3 * took:.3f}", f"{ratio:.2f}", str(case.size), f"{1e6 * each:.3f}", f"{each / grid_each:.2f}"]
        try:
            theirs = timed(case.rival) if case.rival else None
        except ImportError:
            theirs = None
        cells += [f"{1e3 * theirs:.3f}", f"{theirs / took:.1f}"] if theirs else ["-", "-"]
        if case.area is None:
            cells.append("-")
        else:
            cells.append("equal" if abs(case.area - grid.area) <= 1e-3 * grid.area else "DIFFERENT")
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def section() -> str:
    head = ["input", "coordinates", "ms", "times the grid", "result", "us each", "times the grid", "Pyclipper ms", "/ ours", "compared"]
    lines = ["## python", "", INTRODUCTION, "| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    for name in CASES:
        lines += rows(name)
        print("\n".join(lines[-len(KINDS) :]), flush=True)
    return "\n".join(lines) + "\n"


def write_section(folder: Path) -> None:
    """In the place of the page's section of that name, or at its end."""
    text = section()
    page = folder / "off-the-grid.md"
    before, _, after = page.read_text(encoding="utf-8").partition("## python\n") if page.exists() else ("", "", "")
    following = after.find("\n## ")
    page.write_text(before.rstrip("\n") + "\n\n" + text + (after[following:] if following >= 0 else ""), encoding="utf-8")
