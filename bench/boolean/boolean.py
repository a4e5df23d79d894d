"""Boolean operations of two regions beside Clipper2 (pyclipr), GEOS (shapely) and CGAL's exact Polygon_set_2, on six kinds of coordinates.

`./run bench boolean [--runs N] [--large] [--results FOLDER]`. Times are of the operation alone, in process, the least of the runs: what
`dymsum union --repeat N --json` reports, and what a call of the others takes, with their results as they give them. Clipper2 rounds
its input to multiples of 1e-9; dymsum's and CGAL's results are exact, and all areas are compared. CGAL is asked on the grid and on turned
coordinates. Unions of up to 10,000 no-fit polygons, and sums of sums, have tables of their own (unions.py). Solids are beside Manifold, which computes in
doubles, and CGAL's corefinement with exact constructions, where that is installed; volumes are compared. The environment's DYMSUM is the
command line to ask. `--solids` runs these alone.
"""

import argparse
import json
import math
import os
import pathlib
import random
import statistics
import struct
import subprocess
import tempfile
import time

import pyclipr
import shapely

import cgal_regions
import solids
import unions

DYMSUM = os.path.abspath(os.environ.get("DYMSUM", "dymsum"))
SCALE = 10**9
OPERATIONS = {"union": (shapely.union, pyclipr.Union), "intersect": (shapely.intersection, pyclipr.Intersection),
              "subtract": (shapely.difference, pyclipr.Difference)}


def of_kind(kind, x, y):
    if kind == "grid":
        return round(x * 2**20) / 2**20, round(y * 2**20) / 2**20
    if kind == "decimals":
        return round(x, 4), round(y, 4)
    if kind == "single":
        return tuple(struct.unpack("f", struct.pack("f", v))[0] for v in (x, y))
    if kind == "noise":
        return x + (6.1e-17 if x == 0 else 0), y + (6.1e-17 if y == 0 else 0)
    c, s = math.cos(math.pi / 6), math.sin(math.pi / 6)
    far = 0 if kind == "turned" else 1e5 / 3
    return c * x - s * y + far, s * x + c * y + far


def without_repeated(ring):
    """Coordinates of few digits are equal here and there."""
    return [v for k, v in enumerate(ring) if v != ring[k - 1]]


def coast(n, x, y, seed):
    """A rough closed line: about a tenth of its vertices meet that of another one beside it."""
    r = random.Random(seed)
    radius = [1 + 0.02 * r.uniform(-1, 1) for _ in range(n)]
    return [(x + q * math.cos(2 * math.pi * k / n), y + q * math.sin(2 * math.pi * k / n)) for k, q in enumerate(radius)]


def star(spikes, x, y, turn):
    corners = 2 * spikes
    return [(x + q * math.cos(2 * math.pi * k / corners + turn), y + q * math.sin(2 * math.pi * k / corners + turn))
            for k, q in ((k, 1 if k % 2 == 0 else 0.4) for k in range(corners))]


def comb(teeth, x, y):
    points = [(x, y), (x + 2 * teeth - 1, y)]
    for k in reversed(range(teeth)):
        points += [(x + 2 * k + 1, y + 10), (x + 2 * k, y + 10)]
        if k > 0:
            points += [(x + 2 * k, y + 1), (x + 2 * k - 1, y + 1)]
    return points


def pairs(large):
    for n in (10, 100, 1000, 10000) + ((100000,) if large else ()):
        yield f"coasts of {n}", coast(n, 0, 0, n), coast(n, 0.4, 0.1, n + 1)
    for spikes in (10, 100, 1000):
        yield f"stars of {spikes} spikes", star(spikes, 0, 0, 0), star(spikes, 0.03, 0.01, 1 / spikes)
    for teeth in (5, 50, 200):
        crossed = [(y, x) for x, y in reversed(comb(teeth, 0, 0))]
        yield f"crossed combs of {teeth}", comb(teeth, 0, 0), crossed
        yield f"combs of {teeth}, half a tooth on", comb(teeth, 0, 0), comb(teeth, 1, 0)


def least(runs, call):
    times = []
    for _ in range(runs):
        begin = time.perf_counter()
        value = call()
        times.append(time.perf_counter() - begin)
    return min(times) * 1e3, value


def ours(folder, verb, a, b, runs):
    files = []
    for name, ring in (("a", a), ("b", b)):
        files.append(folder / f"{name}.wkt")
        files[-1].write_text("POLYGON((" + ", ".join(f"{x!r} {y!r}" for x, y in (*ring, ring[0])) + "))")
    done = subprocess.run([DYMSUM, verb, *files, "--json", "--repeat", str(runs)], capture_output=True, text=True)
    if done.returncode not in (0, 4):
        raise SystemExit(f"dymsum {verb}: {done.stderr}")
    report = json.loads(done.stdout)
    return report["time_ms"]["min"], float(report["area"])


def theirs(verb, a, b, runs):
    p, q = shapely.Polygon(a), shapely.Polygon(b)
    geos, value = least(runs, lambda: OPERATIONS[verb][0](p, q))

    def clipped():
        clipper = pyclipr.Clipper()
        clipper.scaleFactor = SCALE
        clipper.addPath(a, pyclipr.Subject, False)
        clipper.addPath(b, pyclipr.Clip, False)
        return clipper.execute(OPERATIONS[verb][1], pyclipr.FillRule.NonZero)

    clipper, paths = least(runs, clipped)
    area = sum(shapely.Polygon(path).area * (1 if shapely.LinearRing(path).is_ccw else -1) for path in paths if len(path) > 2)
    return geos, value.area, clipper, area


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--large", action="store_true", help="coasts of 100,000 vertices, too")
    parser.add_argument("--solids", action="store_true", help="solids alone")
    parser.add_argument("--results", type=pathlib.Path, help="writes boolean.md there")
    options = parser.parse_args()
    lines = ["| pair | operation | coordinates | dymsum ms | Clipper2 ms | GEOS ms | CGAL ms | Clipper2 / dymsum | GEOS / dymsum | CGAL / dymsum |",
             "|---|---|---|---|---|---|---|---|---|---|"]
    ratios = {"Clipper2": [], "GEOS": [], "CGAL": []}
    apart = 0
    with tempfile.TemporaryDirectory() as name:
        for title, first, second in pairs(options.large) if not options.solids else ():
            for kind in ("grid", "decimals", "single", "noise", "turned", "turned_far"):
                a, b = (without_repeated([of_kind(kind, *v) for v in ring]) for ring in (first, second))
                for verb in OPERATIONS:
                    mine, area = ours(pathlib.Path(name), verb, a, b, options.runs)
                    geos, geos_area, clipper, clipper_area = theirs(verb, a, b, options.runs)
                    # GEOS computes in doubles, and areas far from the origin lose digits.
                    tolerance = 1e-6 * max(1, abs(area))
                    apart += abs(area - geos_area) > tolerance or abs(area - clipper_area) > tolerance
                    ratios["Clipper2"].append(clipper / mine)
                    ratios["GEOS"].append(geos / mine)
                    cgal = None
                    if kind in ("grid", "turned"):
                        cgal = cgal_regions.measured(pathlib.Path(name), verb, [a], [b], options.runs)
                    if cgal:
                        ratios["CGAL"].append(cgal[0] / mine)
                        apart += abs(area - cgal[1]) > tolerance
                    shown, ratio = (f"{cgal[0]:.3f}", f"{cgal[0] / mine:.1f}") if cgal else ("", "")
                    lines.append(f"| {title} | {verb} | {kind} | {mine:.3f} | {clipper:.3f} | {geos:.3f} | {shown} | {clipper / mine:.2f} "
                                 f"| {geos / mine:.2f} | {ratio} |")
                    print(lines[-1], flush=True)
        if not options.solids:
            union_lines, union_ratios, unions_apart = unions.unions(DYMSUM, pathlib.Path(name), options.runs, SCALE)
            sum_lines = unions.sums_of_sums(DYMSUM, pathlib.Path(name), options.runs)
        solid_lines, solid_summary, solids_apart = solids.table(DYMSUM, pathlib.Path(name), options.runs, options.large)
    print("\n".join(solid_summary))
    if options.solids:
        return 1 if solids_apart else 0
    apart += solids_apart + unions_apart
    summary = [f"{who} / dymsum: geometric mean {statistics.geometric_mean(r):.2f}, median {statistics.median(r):.2f}, worst "
               f"{min(r):.2f}, best {max(r):.1f}, of {len(r)}" for who, r in ratios.items() if r]
    summary += [f"unions of no-fit polygons, {who} / dymsum: geometric mean {statistics.geometric_mean(r):.2f}, worst {min(r):.2f}, of {len(r)}"
                for who, r in union_ratios.items() if r]
    summary.append(f"areas that differ by more than 1e-6 of themselves: {apart}")
    print("\n".join(summary))
    if options.results:
        text = "# Boolean operations of two regions\n\n" + __doc__.split("\n\n", 1)[1].strip() + "\n\n"
        text += "\n\n".join(summary) + "\n\n" + "\n".join(lines) + "\n"
        text += "\n## Unions of many\n\n" + "\n".join(union_lines) + "\n"
        text += "\n## Sums of sums\n\n" + "\n".join(sum_lines) + "\n"
        text += "\n## Solids\n\n" + "\n\n".join(solid_summary) + "\n\n" + "\n".join(solid_lines) + "\n"
        (options.results / "boolean.md").write_text(text)
    return 1 if apart else 0


if __name__ == "__main__":
    raise SystemExit(main())
