"""Unions of very many no-fit polygons beside Clipper2, GEOS and CGAL, and sums of sums beside single sums of as many segments.

A part of `./run bench boolean` (boolean.py). The no-fit polygons are those of random pieces, rounded to multiples of 2^-20, at random
positions in a square that they cover three times.
"""

import json
import math
import random
import statistics
import subprocess
import time

import pyclipr
import shapely

import cgal_regions

GRID = 2**20
COVERS = 3


def piece(vertices, roughness, seed):
    r = random.Random(seed)
    ring = []
    for k in range(vertices):
        radius = 1 + roughness * r.uniform(-1, 1)
        ring.append((radius * math.cos(2 * math.pi * k / vertices), radius * math.sin(2 * math.pi * k / vertices)))
    return [(round(x * GRID) / GRID, round(y * GRID) / GRID) for x, y in ring]


def wkt(ring):
    return "POLYGON((" + ", ".join(f"{x!r} {y!r}" for x, y in (*ring, ring[0])) + "))"


def asked(arguments):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True)
    if done.returncode not in (0, 4):
        raise SystemExit(f"{arguments[:3]}: {done.stderr}")
    return done.stdout


def no_fit_polygons(dymsum, folder, count, vertices):
    """Rings: the outer ones of no-fit polygons of 25 pieces and one that moves."""
    kinds = 25
    moving = folder / "moving.wkt"
    moving.write_text(wkt(piece(vertices, 0.4, 99)))
    shapes = []
    for k in range(kinds):
        fixed = folder / "fixed.wkt"
        fixed.write_text(wkt(piece(vertices, 0.4, k)))
        shape = shapely.from_wkt(asked([dymsum, "nfp", fixed, moving, "--semantics", "regular", "-o", "-"]))
        largest = max(getattr(shape, "geoms", [shape]), key=lambda p: p.area)
        ring = [(round(x * GRID) / GRID, round(y * GRID) / GRID) for x, y in largest.exterior.coords[:-1]]
        shapes.append([v for i, v in enumerate(ring) if v != ring[i - 1]])
    side = math.sqrt(count * statistics.mean(shapely.Polygon(s).area for s in shapes) / COVERS)
    r = random.Random(count)
    rings = []
    for k in range(count):
        x, y = (round(r.uniform(0, side) * GRID) / GRID for _ in range(2))
        rings.append([(a + x, b + y) for a, b in shapes[k % kinds]])
    return rings


def least(runs, call):
    times = []
    for _ in range(runs):
        begin = time.perf_counter()
        value = call()
        times.append(time.perf_counter() - begin)
    return min(times) * 1e3, value


def ours(dymsum, folder, rings, runs):
    files = []
    for k, ring in enumerate(rings):
        files.append(folder / f"n{k}.wkt")
        files[-1].write_text(wkt(ring))
    report = json.loads(asked([dymsum, "union", *files, "--json", "--repeat", runs]))
    return report["time_ms"]["min"], float(report["area"])


def clipper(rings, runs, scale):
    def clipped():
        engine = pyclipr.Clipper()
        engine.scaleFactor = scale
        engine.addPaths(rings, pyclipr.Subject, False)
        return engine.execute(pyclipr.Union, pyclipr.FillRule.NonZero)

    ms, paths = least(runs, clipped)
    return ms, sum(shapely.Polygon(p).area * (1 if shapely.LinearRing(p).is_ccw else -1) for p in paths if len(p) > 2)


def geos(rings, runs):
    polygons = [shapely.Polygon(ring) for ring in rings]
    ms, made = least(runs, lambda: shapely.union_all(polygons))
    return ms, made.area


def unions(dymsum, folder, runs, scale):
    """The lines of the table, the ratios to Clipper2, GEOS and CGAL, and how many areas are apart."""
    lines = ["| no-fit polygons | vertices | dymsum ms | Clipper2 ms | GEOS ms | CGAL ms | Clipper2 / dymsum | GEOS / dymsum | CGAL / dymsum |",
             "|---|---|---|---|---|---|---|---|---|"]
    ratios, apart = {"Clipper2": [], "GEOS": [], "CGAL": []}, 0
    for count, vertices in ((100, 20), (1000, 10), (1000, 40), (10000, 20)):
        rings = no_fit_polygons(dymsum, folder, count, vertices)
        times = runs if count < 10000 else 1
        mine, area = ours(dymsum, folder, rings, times)
        row = {"Clipper2": clipper(rings, times, scale), "GEOS": geos(rings, times),
               "CGAL": cgal_regions.measured(folder, "union", rings, [], 1) if count < 10000 else None}
        for who, found in row.items():
            if found:
                ratios[who].append(found[0] / mine)
                apart += abs(area - found[1]) > 1e-6 * area
        cells = [f"{found[0]:.1f}" if found else "" for found in row.values()] + [f"{found[0] / mine:.2f}" if found else "" for found in row.values()]
        lines.append(f"| {count} | {sum(map(len, rings))} | {mine:.1f} | " + " | ".join(cells) + " |")
        print(lines[-1], flush=True)
    return lines, ratios, apart


def sums_of_sums(dymsum, folder, runs):
    """Lines of a table: (P + Q) + R by the exact P + Q, and the single sum of a region as large (P + Q, rounded) with R."""
    lines = ["| vertices of P, Q, R | vertices of P + Q | sum of the sum, ms | single sum, ms | ratio |", "|---|---|---|---|---|"]
    for vertices, roughness in ((10, 0.4), (30, 0.4), (100, 0.05), (100, 0.4)):
        files = []
        for k in range(3):
            files.append(folder / f"s{k}.wkt")
            files[-1].write_text(wkt(piece(vertices, roughness, 7 * k + vertices)))
        asked([dymsum, "sum", *files[:2], "--semantics", "regular", "-o", folder / "pq.json", "-o", folder / "pq.wkt"])
        both = [json.loads(asked([dymsum, "sum", folder / name, files[2], "--json", "--repeat", runs])) for name in ("pq.json", "pq.wkt")]
        nested, single = (report["time_ms"]["min"] for report in both)
        lines.append(f"| {vertices} | {both[0]['inputs'][0]['vertices']} | {nested:.3f} | {single:.3f} | {nested / single:.2f} |")
        print(lines[-1], flush=True)
    return lines
