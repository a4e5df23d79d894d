"""Wrong answers of others, and ours to the same question: one function a case, `gallery.py CASE` runs one, without CASE all.

Every true answer follows from the statement of its case by hand. The environment's DYMSUM is the command line to ask.
"""

import json
import os
import subprocess
import sys
import tempfile
from fractions import Fraction

DYMSUM = os.environ.get("DYMSUM", "dymsum")


INTRODUCTION = """What widely used systems answer to questions whose answers follow by hand, and what dymsum answers. One of them:
`./run bench gallery CASE`; this page: `./run bench gallery --results docs/results`. Paths through walls are in [ompl.md](ompl.md).
Systems that round to a grid, or that leave out what has no area, say so in their documents; for a part that exactly fits that is
the wrong answer all the same.
"""


def dymsum(*arguments):
    """The JSON report of a command."""
    done = subprocess.run([DYMSUM, *map(str, arguments), "--json"], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 4):
        raise RuntimeError(done.stderr)
    return json.loads(done.stdout)


def ring(points):
    return json.dumps([list(p) for p in points])


def square(side):
    return [(0, 0), (side, 0), (side, side), (0, side)]


BOX_FACES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]


def box(low, high):
    (a, b, c), (d, e, f) = low, high
    return [(a, b, c), (d, b, c), (d, e, c), (a, e, c), (a, b, f), (d, b, f), (d, e, f), (a, e, f)], BOX_FACES


def ell(scale, move=(0, 0, 0)):
    """The box 2 by 2 by 1 without one of its quarters: volume 3."""
    outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    low = [(scale * x + move[0], scale * y + move[1], move[2]) for x, y in outline]
    high = [(x, y, scale + move[2]) for x, y, _ in low]
    walls = [(k, (k + 1) % 6, 6 + (k + 1) % 6, 6 + k) for k in range(6)]
    return low + high, [tuple(range(5, -1, -1)), tuple(range(6, 12)), *walls]


def triangles(faces, vertices):
    import numpy as np
    import shapely
    import shapely.ops
    result = []
    for face in faces:
        points = np.array([vertices[v] for v in face], dtype=float)
        flat = np.ptp(points, axis=0).argmin()
        keep = [axis for axis in range(3) if axis != flat]
        index = {tuple(points[k][keep]): face[k] for k in range(len(face))}
        polygon = shapely.Polygon(points[:, keep])
        normal = sum(np.cross(points[k], points[(k + 1) % len(face)]) for k in range(len(face)))
        for piece in shapely.ops.triangulate(polygon):
            if not polygon.contains(piece.representative_point()):
                continue
            corner = [index[c] for c in list(piece.exterior.coords)[:3]]
            a, b, c = (np.array(vertices[v], dtype=float) for v in corner)
            result.append(corner if np.dot(np.cross(b - a, c - a), normal) > 0 else corner[::-1])
    return result


def off_file(solid):
    vertices, faces = solid
    file = tempfile.NamedTemporaryFile("w", suffix=".off", delete=False)
    with file:
        file.write(f"OFF\n{len(vertices)} {len(faces)} 0\n")
        file.writelines(" ".join(map(repr, map(float, v))) + "\n" for v in vertices)
        file.writelines(" ".join(map(str, (len(f), *f))) + "\n" for f in faces)
    return file.name


def clipper_hole():
    """A square of side 10 plus a square of side 1 is the square of side 11: area 121."""
    import pyclipper
    paths = pyclipper.MinkowskiSum(square(1), square(10), True)
    theirs = sum(abs(pyclipper.Area(p)) * (1 if pyclipper.Orientation(p) else -1) for p in paths)
    ours = dymsum("sum", ring(square(10)), ring(square(1)))["area"]
    return "Clipper (pyclipper)", f"area {theirs:g}, in {len(paths)} rings", f"area {ours:g}", ours == 121 != theirs


def clipper_tight_fit():
    """A peg as wide as its slot goes in along a line: the no-fit polygon has that line inside."""
    import pyclipper
    slot = [(0, 0), (40, 0), (40, 40), (30, 40), (30, 10), (10, 10), (10, 40), (0, 40)]
    peg = [(0, 0), (20, 0), (20, 10), (0, 10)]
    paths = pyclipper.MinkowskiSum([(-x, -y) for x, y in peg], slot, True)
    inside = [p for p in paths if not pyclipper.Orientation(p)]
    ours = dymsum("nfp", ring(slot), ring(peg))
    segments = ours["tight"]["segments"]
    return "Clipper (pyclipper)", f"no free place inside: {len(inside)} holes", f"{segments} free segment", segments == 1


def shapely_tight_fit():
    """The same with the slot as three boxes, of which each sum is a box: in their union the peg at (1, 2) overlaps."""
    import shapely
    walls = [(0, 0, 1, 4), (0, 0, 4, 1), (3, 0, 4, 4)]
    no_fit = shapely.union_all([shapely.box(a - 2, b - 1, c, d) for a, b, c, d in walls])
    overlaps = no_fit.contains(shapely.Point(1, 2))
    slot = [(0, 0), (4, 0), (4, 4), (3, 4), (3, 1), (1, 1), (1, 4), (0, 4)]
    segments = dymsum("nfp", ring(slot), ring([(0, 0), (2, 0), (2, 1), (0, 1)]))["tight"]["segments"]
    return "shapely (union of boxes)", f"(1, 2) inside: {overlaps}", f"{segments} free segment", segments == 1 and overlaps


def manifold_sum(a, b):
    import manifold3d
    import numpy as np

    def solid(s):
        vertices, faces = s
        return manifold3d.Manifold(manifold3d.Mesh(np.array(vertices, dtype=np.float32),
                                                   np.array(triangles(faces, vertices), dtype=np.uint32)))
    return solid(a).minkowski_sum(solid(b)).volume()


def manifold_moved():
    """L + cube has the volume 16 wherever the cube lies; here at (10, 0, 0)."""
    cube = box((10, 0, 0), (11, 1, 1))
    theirs = manifold_sum(ell(1), cube)
    ours = dymsum("sum", off_file(ell(1)), off_file(cube))["volume"]
    return "Manifold", f"volume {theirs:g}", f"volume {ours:g}", ours == 16 and abs(theirs - 16) > 1e-3


def manifold_small():
    """A + B = B + A: an eighth of L plus five times L, and five times L plus an eighth of L, are one solid."""
    small, large = ell(0.125), ell(5)
    theirs = manifold_sum(small, large), manifold_sum(large, small)
    ours = [dymsum("sum", off_file(a), off_file(b))["volume"] for a, b in ((small, large), (large, small))]
    same = ours[0] == ours[1]
    return ("Manifold", f"volumes {theirs[0]:g} and {theirs[1]:g}", f"volumes {ours[0]:g} and {ours[1]:g}",
            same and abs(theirs[0] - theirs[1]) > 1e-3)


def fcl_distance(a, b):
    import fcl
    import numpy as np

    def model(s):
        vertices, faces = s
        bvh = fcl.BVHModel()
        tris = np.array(triangles(faces, vertices))
        bvh.beginModel(len(vertices), len(tris))
        bvh.addSubModel(np.array(vertices, dtype=float), tris)
        bvh.endModel()
        return fcl.CollisionObject(bvh)
    request, result = fcl.DistanceRequest(enable_signed_distance=True), fcl.DistanceResult()
    return fcl.distance(model(a), model(b), request, result)


def fcl_overlap():
    """Two cubes of side 2 overlap by 0.5: the penetration depth is 0.5."""
    a, b = box((0, 0, 0), (2, 2, 2)), box((1.5, 0.25, 0.125), (3.5, 2.25, 2.125))
    theirs = fcl_distance(a, b)
    ours = dymsum("depth", off_file(a), off_file(b))["depth"]
    return "FCL (meshes)", f"signed distance {theirs:g}", f"depth {ours:g}", ours == 0.5 and abs(theirs + 0.5) > 1e-3


def fcl_inside():
    """A cube of side 1 in the middle of one of side 3 has to move by 2 to be outside."""
    a, b = box((0, 0, 0), (3, 3, 3)), box((1, 1, 1), (2, 2, 2))
    theirs = fcl_distance(a, b)
    ours = dymsum("depth", off_file(a), off_file(b))["depth"]
    return "FCL (meshes)", f"signed distance {theirs:+g}: apart", f"depth {ours:g}", ours == 2 and theirs > 0


def wkt_file(*rings):
    """A file with a polygon each."""
    with tempfile.NamedTemporaryFile("w", suffix=".wkt", delete=False, encoding="utf-8") as file:
        shapes = ["((" + ", ".join(f"{x!r} {y!r}" for x, y in [*points, points[0]]) + "))" for points in rings]
        file.write("MULTIPOLYGON (" + ", ".join(shapes) + ")\n")
    return file.name


def shapely_disc_slot():
    """A disc of radius 1 goes into a slot of width 2, with its centre on a line: (8, 1) is a place for it."""
    import shapely
    part = [(0, 0), (10, 0), (10, 2), (4, 2), (4, 8), (0, 8)]
    fits = shapely.Polygon(part).buffer(-1).covers(shapely.Point(8, 1))
    ours = dymsum("disc", wkt_file(part), "--radius", 1, "--set", "erosion", "--semantics", "open")["tight"]["segments"]
    return "shapely (buffer by -1)", f"(8, 1) is one: {fits}", f"{ours} free segment", ours == 1 and not fits


def shapely_closing():
    """Two wedges, their tips 2 apart, closed by a disc of radius 2: discs from both sides touch between the tips. 2 parts."""
    import shapely
    above = [(0, 1), (8, 7), (8, 9), (-8, 9), (-8, 7)]
    below = [(x, -y) for x, y in reversed(above)]
    both = shapely.MultiPolygon([shapely.Polygon(above), shapely.Polygon(below)])
    segments = [8, 16, 64, 256]
    parts = [shapely.get_num_geometries(both.buffer(2, q).buffer(-2, q)) for q in segments]
    ours = dymsum("disc", wkt_file(above, below), "--radius", 2, "--set", "closing")["outer"]
    theirs = f"{', '.join(map(str, parts))} parts, with {', '.join(map(str, segments))} segments a quarter"
    return "shapely (buffer by 2 and by -2)", theirs, f"{ours} parts", ours == 2 and set(parts) != {2}


def shapely_split():
    """The shortest cut from the notch (3, 1) of a polygon ends inside a slanted edge and makes two pieces of it."""
    import shapely
    import shapely.ops
    notched = [(0, 0), (7, -3), (9, 4), (3, 1), (1, 4)]
    made = dymsum("decompose", wkt_file(notched))
    start, end = ([float(Fraction(v)) for v in made["cuts"][0][key]] for key in ("from", "to"))
    pieces = len(shapely.ops.split(shapely.Polygon(notched), shapely.LineString([start, end])).geoms)
    area = sum(twice_area(piece["outer"]) for piece in made["pieces"])
    exact = area == twice_area(notched)
    ours = f"{len(made['pieces'])} pieces, which tile it exactly: {exact}"
    return "shapely (ops.split)", f"{pieces} piece", ours, len(made["pieces"]) == 2 and exact and pieces == 1


def twice_area(points):
    exact = [(Fraction(x), Fraction(y)) for x, y in points]
    return sum(a * d - b * c for (a, b), (c, d) in zip(exact, exact[1:] + exact[:1]))


CASES = [clipper_hole, clipper_tight_fit, shapely_tight_fit, shapely_disc_slot, shapely_closing, shapely_split,
         manifold_moved, manifold_small, fcl_overlap, fcl_inside]


def main():
    named = [word for word in sys.argv[1:] if not word.startswith("-") and not os.path.isdir(word)]
    wanted = [c for c in CASES if not named or c.__name__ in named]
    if not wanted or set(named) - {c.__name__ for c in CASES}:
        sys.exit("cases: " + " ".join(c.__name__ for c in CASES))
    lines = ["| case | what is true | others | ours |", "|---|---|---|---|"]
    failed = 0
    for case in wanted:
        other, theirs, ours, shown = case()
        failed += not shown
        lines.append(f"| `{case.__name__}` | {case.__doc__} | {other}: {theirs} | {ours}{'' if shown else ' NOT SHOWN'} |")
    page = f"# Wrong answers\n\n{INTRODUCTION}\n" + "\n".join(lines) + "\n"
    print(page, end="")
    if "--results" in sys.argv:
        with open(os.path.join(sys.argv[sys.argv.index("--results") + 1], "gallery.md"), "w", encoding="utf-8") as file:
            file.write(page)
    sys.exit(failed)


if __name__ == "__main__":
    main()
