"""Boolean operations of two solids beside Manifold (PyPI manifold3d, in doubles) and CGAL's corefinement with exact constructions.

A part of `./run bench boolean` (boolean.py). All take the same triangles; volumes are compared. CGAL_BOOLEAN of the environment is the
program made of bench/versus/cgal_boolean.cpp; without it there are no times of CGAL.
"""

import json
import math
import os
import statistics
import subprocess
import time

import manifold3d
import numpy

OPERATIONS = {"union": lambda a, b: a + b, "intersect": lambda a, b: a ^ b, "subtract": lambda a, b: a - b}


def pairs(large):
    make = manifold3d.Manifold
    for segments in (8, 16, 32) + ((64, 128) if large else ()):
        ball = make.sphere(1, segments)
        yield f"balls of {segments} segments", ball, ball.translate((0.7, 0.1, 0.2))
        rod = make.cylinder(3, 0.5, 0.5, segments, True)
        yield f"crossed rods of {segments}", rod, rod.rotate((90, 0, 0))
    box = make.cube((1, 1, 1), True)
    yield "boxes that share half a face", box, box.translate((1, 0.5, 0))
    yield "boxes, one turned", box, box.rotate((30, 30, 0))
    plate = make.cube((8, 8, 1), True)
    for k in range(4):
        for j in range(4):
            plate = plate - make.cylinder(2, 0.5, 0.5, 12, True).translate((2 * k - 3, 2 * j - 3, 0))
    yield "plates of 16 holes, half a pitch on", plate, plate.translate((1, 1, 0.5))


def triangles_of(manifold):
    mesh = manifold.to_mesh64()
    return numpy.array(mesh.vert_properties[:, :3], order="C"), numpy.array(mesh.tri_verts)


def write(path, points, triangles):
    lines = ["OFF", f"{len(points)} {len(triangles)} 0"]
    lines += [" ".join(repr(float(c)) for c in p) for p in points]
    lines += ["3 " + " ".join(map(str, t)) for t in triangles]
    path.write_text("\n".join(lines) + "\n")


def ours(dymsum, verb, files, runs):
    done = subprocess.run([dymsum, verb, *files, "--json", "--repeat", str(runs)], capture_output=True, text=True)
    if done.returncode not in (0, 4):
        raise SystemExit(f"dymsum {verb}: {done.stderr}")
    report = json.loads(done.stdout)
    return report["time_ms"]["min"], float(report["volume"])


def manifolds(verb, files, runs):
    meshes = [manifold3d.Mesh64(vert_properties=points, tri_verts=triangles.astype(numpy.uint64)) for points, triangles in files]
    least = math.inf
    for _ in range(runs):
        p, q = (manifold3d.Manifold(mesh) for mesh in meshes)
        p.volume(), q.volume()  # what is made lazily
        start = time.perf_counter()
        made = OPERATIONS[verb](p, q)
        volume = made.volume()
        least = min(least, (time.perf_counter() - start) * 1e3)
    return least, volume


def cgals(verb, files, runs):
    program = os.environ.get("CGAL_BOOLEAN")
    if not program:
        return None
    done = subprocess.run([program, *files, verb, str(runs)], capture_output=True, text=True)
    return tuple(map(float, done.stdout.split())) if done.returncode == 0 else None


def table(dymsum, folder, runs, large):
    """The lines of the table, a summary, and how many volumes are apart."""
    lines = ["| solids | triangles | operation | dymsum ms | Manifold ms | CGAL ms | Manifold / dymsum | CGAL / dymsum |",
             "|---|---|---|---|---|---|---|---|"]
    ratios, apart = {"Manifold": [], "CGAL": []}, 0
    for title, first, second in pairs(large):
        shapes = [triangles_of(first), triangles_of(second)]
        files = [folder / "p.off", folder / "q.off"]
        for path, shape in zip(files, shapes):
            write(path, *shape)
        for verb in OPERATIONS:
            mine, volume = ours(dymsum, verb, files, runs)
            row = {"Manifold": manifolds(verb, shapes, runs), "CGAL": cgals(verb, files, runs)}
            for who, found in row.items():
                if found:
                    ratios[who].append(found[0] / mine)
                    apart += abs(volume - found[1]) > 1e-9 * max(1, abs(volume))
            shown = [f"{found[0]:.2f}" if found else "" for found in row.values()]
            by = [f"{found[0] / mine:.2f}" if found else "" for found in row.values()]
            lines.append("| " + " | ".join([title, str(sum(len(t) for _, t in shapes)), verb, f"{mine:.2f}", *shown, *by]) + " |")
            print(lines[-1], flush=True)
    summary = [f"{who} / dymsum: geometric mean {statistics.geometric_mean(r):.2f}, worst {min(r):.2f}, best {max(r):.1f}, of {len(r)}"
               for who, r in ratios.items() if r]
    return lines, [*summary, f"volumes that differ by more than 1e-9 of themselves: {apart}"], apart
