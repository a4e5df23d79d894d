"""Which files come in, and which results go out: a survey of solids as people make them.

`./run bench files [--solids N] [--meshes N] [--seed N] [--limit SECONDS] [--keep FOLDER] [--results FOLDER]`. N solids are made by one to five Boolean
operations of boxes, cylinders and spheres in doubles, turned and moved at random; N meshes have the defects that exporters leave. Each
is written in double and in single precision, read back by the command line, grown by a ball, offset outward and inward, opened, and
the results are written. What was written is read by another program (manifold3d), which has to find it closed and oriented, with the
volume that the command line told, and by the command line itself, which looks for crossings. It fails where a promise is broken:
99 of 100 files accepted or repaired; every result written; every one found sound; 99 of 100 within 1e-12 of the size from the exact
result. The environment's DYMSUM is the command line.
"""

import argparse
import collections
import json
import math
import os
import pathlib
import random
import struct
import subprocess
import sys
import tempfile

import manifold3d
import numpy

DYMSUM = os.path.abspath(os.environ.get("DYMSUM", "dymsum"))
ACCEPTED = 0.99
NEAR, MOSTLY = 1e-12, 0.99  # of the size; of the results

INTRODUCTION = """Solids made by one to five Boolean operations of boxes, cylinders and spheres in doubles, and meshes with the
defects that exporters leave, each in double and in single precision: which of them are accepted, with `--repair` or without, and
which results are written and found sound by another program. What is written is rounded: how far it is at most from the exact
result, as a fraction of its size, the command line tells. Of every tenth file: what writing takes in time of a processor, the
command with `-o` less the command without, over what the result itself takes. This page: `./run bench files --results docs/results`.
"""


def single(x):
    return struct.unpack("f", struct.pack("f", x))[0]


# ---- shapes -------------------------------------------------------------------------------------------------------------------------


def turned(points, rng):
    """Turned about a random axis, scaled and moved, in doubles."""
    q = numpy.array([rng.gauss(0, 1) for _ in range(4)])
    w, x, y, z = q / numpy.linalg.norm(q)
    matrix = numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                          [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                          [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    return points @ matrix.T


def arrays(manifold):
    mesh = manifold.to_mesh64()
    return numpy.array(mesh.vert_properties, dtype=float)[:, :3], [tuple(map(int, t)) for t in mesh.tri_verts]


def some_body(rng):
    kind = rng.randrange(3)
    if kind == 0:
        body = manifold3d.Manifold.cube([rng.uniform(0.5, 2) for _ in range(3)], True)
    elif kind == 1:
        body = manifold3d.Manifold.cylinder(rng.uniform(0.5, 2), rng.uniform(0.3, 0.9), -1, rng.choice((12, 24, 36)), True)
    else:
        body = manifold3d.Manifold.sphere(rng.uniform(0.4, 1), rng.choice((12, 16, 24)))
    if rng.random() < 0.6:
        body = body.rotate([rng.uniform(0, 360) for _ in range(3)])
    return body.translate([rng.uniform(-0.7, 0.7) for _ in range(3)])


def some_solid(rng):
    """One to five operations; what is left is not empty."""
    while True:
        solid = some_body(rng)
        for _ in range(rng.randint(1, 5)):
            other, operation = some_body(rng), rng.random()
            solid = solid + other if operation < 0.45 else solid - other if operation < 0.85 else solid ^ other
        if not solid.is_empty() and solid.volume() > 0.05:
            return arrays(solid)


def box(x, y, z, dx=1.0, dy=1.0, dz=1.0):
    points = [(x + i * dx, y + j * dy, z + k * dz) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return numpy.array(points), [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def cylinder(n, radius, height):
    return arrays(manifold3d.Manifold.cylinder(height, radius, -1, n))


def ball(n, radius):
    return arrays(manifold3d.Manifold.sphere(radius, n))


def joined(*bodies):
    points, faces = [], []
    for p, f in bodies:
        faces += [tuple(v + len(points) for v in face) for face in f]
        points += [tuple(q) for q in p]
    return numpy.array(points), faces


def moved(body, x=0.0, y=0.0, z=0.0):
    return body[0] + numpy.array([x, y, z]), body[1]


def base(rng):
    return rng.choice((lambda: box(0, 0, 0, 1, rng.uniform(0.5, 2), 1), lambda: cylinder(rng.choice((8, 20)), 0.6, 1.3), lambda: ball(12, 0.8)))()


# ---- the defects of exporters -------------------------------------------------------------------------------------------------------


def soup(rng):
    points, faces = base(rng)
    return points[[v for f in faces for v in f]], [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(len(faces))]


def turned_faces(rng):
    points, faces = base(rng)
    return points, [f[::-1] if rng.random() < 0.2 else f for f in faces]


def turned_shell(rng):
    points, faces = base(rng)
    return points, [f[::-1] for f in faces]


def t_junctions(rng):
    """An edge gets a vertex in one of its two triangles: near its middle, as rounding leaves it."""
    points, faces = base(rng)
    points, faces = [tuple(p) for p in points], list(faces)
    for _ in range(3):
        k = rng.randrange(len(faces))
        a, b, c = faces[k]
        points.append(tuple((numpy.array(points[a]) + numpy.array(points[b])) / 2))
        faces[k] = (a, len(points) - 1, c)
        faces.append((len(points) - 1, b, c))
    return numpy.array(points), faces


def needles(rng):
    """Triangles without an area, or nearly so, between the halves of split edges."""
    points, faces = t_junctions(rng)
    edges = {(f[k], f[(k + 1) % 3]) for f in faces for k in range(3)}
    for a, b in sorted(edges):
        if (b, a) in edges:
            continue
        middle = [v for v in range(len(points)) if (a, v) in edges and (v, b) in edges and (v, a) not in edges
                  and numpy.linalg.norm(numpy.cross(points[b] - points[a], points[v] - points[a])) < 1e-9]
        if middle:
            faces = faces + [(b, middle[0], a)]
            edges |= {(b, middle[0]), (middle[0], a), (a, b)}
    return points, faces


def duplicate_faces(rng):
    points, faces = base(rng)
    k = rng.randrange(len(faces))
    return points, faces + [faces[k], faces[k][::-1]]


def unused_vertices(rng):
    points, faces = base(rng)
    return numpy.vstack([points, [[9, 9, 9], [8, 8, 8]]]), faces


def cracks(rng):
    """Every triangle has vertices of its own, some of them off by 1e-9 of the size."""
    points, faces = soup(rng)
    points = points.copy()
    for v in range(len(points)):
        if rng.random() < 0.1:
            points[v] += numpy.array([rng.uniform(-1e-9, 1e-9) for _ in range(3)])
    return points, faces


def polygons(rng):
    """Polygons that are plane but for rounding."""
    n = rng.choice((6, 12))
    ring = [(math.cos(2 * math.pi * k / n), math.sin(2 * math.pi * k / n)) for k in range(n)]
    points = numpy.array([(x, y, z) for z in (0.0, 1.0) for x, y in ring])
    faces = [tuple(range(n))[::-1], tuple(range(n, 2 * n))] + [(k, (k + 1) % n, n + (k + 1) % n, n + k) for k in range(n)]
    return turned(points, rng), faces


def overlapping(rng):
    return joined(base(rng), moved(base(rng), rng.uniform(0.2, 0.8), rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3)))


def turned_overlapping(rng):
    points, faces = overlapping(rng)
    return turned(points, rng), faces


def many_overlapping(rng):
    return joined(*(moved(base(rng), rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)) for _ in range(5)))


def sharing_a_face(rng):
    return joined(box(0, 0, 0), box(1, 0, 0, rng.uniform(0.5, 2)))


def sharing_part_of_a_face(rng):
    return joined(box(0, 0, 0), box(1, 0.25, rng.uniform(-0.5, 0.5), 1, 0.5, 1))


def sharing_an_edge(rng):
    return joined(box(0, 0, 0), box(1, 1, 0, 1, 1, rng.uniform(0.5, 2)))


def touching_edge_on_face(rng):
    points, faces = box(0, 0, 0)
    c = math.sqrt(0.5)
    other = numpy.array([(c * (x - y), c * (x + y), z) for x, y, z in points]) + numpy.array([2 - 1 + c, 0.5 - c, 0])
    return joined((points, faces), (other, faces))


def nested(rng):
    return joined(box(0, 0, 0, 3, 3, 3), moved(ball(12, 0.8), 1.5, 1.5, 1.5))


def cavity(rng):
    points, faces = moved(ball(12, 0.8), 1.5, 1.5, 1.5)
    return joined(box(0, 0, 0, 3, 3, 3), (points, [f[::-1] for f in faces]))


def crossing_itself(rng):
    """A tube whose end is pushed through its own side."""
    points, faces = cylinder(16, 0.5, 4)
    points = points.copy()
    for p in points:
        if p[2] > 2:
            p[0] += 3 * (p[2] - 2)
            p[2] -= 2.2 * (p[2] - 2)
    top = points[:, 0] > 3
    points[top, 0] -= rng.uniform(5.2, 5.8)
    return points, faces


def membrane(rng):
    """A wall inside a box, as halves of a part leave it."""
    points, faces = box(0, 0, 0)
    points = numpy.vstack([points, [[0.5, 0, 0], [0.5, 1, 0], [0.5, 1, 1], [0.5, 0, 1]]])
    return points, faces + [(8, 9, 10), (8, 10, 11)]


def small_hole(rng):
    points, faces = ball(24, 1)
    k = rng.randrange(len(faces))
    return points, faces[:k] + faces[k + 1:]


DEFECTS = (soup, turned_faces, turned_shell, t_junctions, needles, duplicate_faces, unused_vertices, cracks, polygons, overlapping, turned_overlapping,
           many_overlapping, sharing_a_face, sharing_part_of_a_face, sharing_an_edge, touching_edge_on_face, nested, cavity, crossing_itself, membrane,
           small_hole)


# ---- files --------------------------------------------------------------------------------------------------------------------------


def write_off(path, points, faces):
    lines = ["OFF", f"{len(points)} {len(faces)} 0", *("%r %r %r" % tuple(map(float, p)) for p in points)]
    path.write_text("\n".join(lines + ["%d %s" % (len(f), " ".join(map(str, f))) for f in faces]) + "\n")


def write_stl(path, points, faces):
    """Binary, single precision; polygons are fanned."""
    triangles = [(f[0], f[k - 1], f[k]) for f in faces for k in range(2, len(f))]
    data = bytearray(80) + struct.pack("<I", len(triangles))
    for t in triangles:
        data += struct.pack("<12fH", 0, 0, 0, *(c for v in t for c in points[v]), 0)
    path.write_bytes(bytes(data))


def read_off(path):
    """Behind the vertices of a face there may be its colour."""
    lines = [line.split() for line in path.read_text().splitlines() if line.strip() and not line.startswith("#")]
    n, m = int(lines[1][0]), int(lines[1][1])
    points = numpy.array([[float(c) for c in line[:3]] for line in lines[2:2 + n]]).reshape(n, 3)
    return points, [[int(v) for v in line[1:1 + int(line[0])]] for line in lines[2 + n:2 + n + m]]


def deviation(report, path):
    """How far a file is at most from the exact result, as a fraction of its size; where nothing is told, nearest doubles did."""
    points, _ = read_off(path)
    if not len(points):
        return 0.0
    size = float((points.max(axis=0) - points.min(axis=0)).max())
    return report["rounding"]["distance"] / size if "rounding" in report else math.sqrt(3) * 2**-53 * float(abs(points).max()) / size


def verdict_of_another_program(path, volume):
    """What manifold3d says against a file: nothing where it is closed, oriented, and of that volume."""
    points, faces = read_off(path)
    if not faces:
        return None if volume == 0 else "empty"
    triangles = [(f[0], f[k - 1], f[k]) for f in faces for k in range(2, len(f))]
    solid = manifold3d.Manifold(manifold3d.Mesh64(points, numpy.array(triangles, dtype=numpy.uint64)))
    if solid.status() != manifold3d.Error.NoError:
        # It wants two triangles an edge: surfaces that touch themselves are counted by their edges.
        edges = collections.Counter((t[k], t[(k + 1) % 3]) for t in triangles for k in range(3))
        if any(edges[b, a] != n for (a, b), n in edges.items()):
            return str(solid.status())
    signed = sum(float(numpy.dot(points[a], numpy.cross(points[b], points[c]))) for a, b, c in triangles) / 6
    if abs(signed - volume) > 1e-9 * max(1, abs(volume)):
        return f"volume {signed}, told {volume}"
    return None


def run(arguments, folder, limit):
    try:
        done = subprocess.run([DYMSUM, *arguments], cwd=folder, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None, f"more than {limit} s", ""
    return done.returncode, (done.stderr.strip().splitlines() or [""])[-1][:160], done.stdout


def processor_time(arguments, folder):
    """Of the command, the least of three runs."""
    least = math.inf
    for _ in range(3):
        process = subprocess.Popen([DYMSUM, *arguments], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, _, used = os.wait4(process.pid, 0)
        least = min(least, used.ru_utime + used.ru_stime)
    return least


# Every result is written, and the command's report told as JSON.
COMMANDS = {
    "sum with a ball": ("sum", "{}", "ball.off"),
    "offset by 0.1": ("offset", "{}", "--by", "0.1", "--tolerance", "0.02"),
    "offset by -0.1": ("offset", "{}", "--by", "-0.1", "--tolerance", "0.02"),
    "opening": ("opening", "{}", "ball.off"),
}


class Survey:
    def __init__(self, folder, options):
        self.folder, self.options = folder, options
        self.files = collections.Counter()
        self.accepted = collections.Counter()
        self.tried = collections.Counter()
        self.written = collections.Counter()
        self.sound = collections.Counter()
        self.deviations = collections.defaultdict(list)
        self.writing = collections.defaultdict(list)
        self.against = []

    def take(self, group, name, points, faces):
        for precision, extension in (("double", "off"), ("single", "stl")):
            file = f"{name}.{extension}"
            (write_off if extension == "off" else write_stl)(self.folder / file, points, faces)
            self.look(f"{group}, {precision}", file)

    def look(self, group, file):
        self.files[group] += 1
        code, complaint, _ = run(["info", file, "--repair"], self.folder, self.options.limit)
        if code != 0:
            self.against.append(f"{group}: {file} refused: {complaint}")
            return
        self.accepted[group] += 1
        for verb, words in COMMANDS.items():
            self.tried[group, verb] += 1
            out = self.folder / f"{file}.{words[0]}_{'_'.join(words[2:4])}.off".replace("--", "")
            arguments = [word.format(file) for word in words] + ["--repair", "--json", "-o", out.name]
            code, complaint, text = run(arguments, self.folder, self.options.limit)
            if code == 4 and not out.exists():  # nothing is left
                self.written[group, verb] += 1
                self.sound[group, verb] += 1
                continue
            if code != 0 or not out.exists():
                self.against.append(f"{group}: {' '.join(arguments)}: {code}, {complaint}")
                continue
            self.written[group, verb] += 1
            report = json.loads(text)
            self.deviations[group].append(deviation(report, out))
            if self.files[group] % 10 == 1:
                alone = processor_time(arguments[:-2], self.folder)
                written = max(processor_time(arguments, self.folder) - alone, 1e-4)
                self.writing[group].append(written / max(report["time_ms"]["median"] / 1000, 1e-4))
            wrong = verdict_of_another_program(out, report["volume"])
            if wrong is None:
                code, complaint, _ = run(["info", out.name], self.folder, self.options.limit)
                wrong = None if code == 0 else complaint
            if wrong is not None:
                self.against.append(f"{group}: {' '.join(arguments)} is not sound: {wrong}")
                continue
            self.sound[group, verb] += 1
            if not self.options.keep:
                out.unlink()

    def table(self):
        head = ["| files | number | accepted | " + " | ".join(f"{verb}: written, sound" for verb in COMMANDS) + " |",
                "|---" * (3 + len(COMMANDS)) + "|"]
        rows = [f"| {group} | {n} | {self.accepted[group]} | " +
                " | ".join(f"{self.written[group, verb]}, {self.sound[group, verb]} of {self.tried[group, verb]}" for verb in COMMANDS) + " |"
                for group, n in self.files.items()]
        return head + rows + ["", "| files | results | from the exact one, median | p99 | largest | within 1e-12 |", "|---" * 6 + "|",
                              *(self.deviation_row(group) for group in self.files if self.deviations[group]), "",
                              "| files | results | writing over the result's time, geometric mean | median | worst |", "|---" * 5 + "|",
                              *(self.writing_row(group) for group in self.files if self.writing[group])]

    def writing_row(self, group):
        ratios = sorted(self.writing[group])
        mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
        return f"| {group} | {len(ratios)} | {mean:.2f} | {ratios[len(ratios) // 2]:.2f} | {ratios[-1]:.1f} |"

    def deviation_row(self, group):
        all_of_them = sorted(self.deviations[group])
        n = len(all_of_them)
        near = sum(d <= NEAR for d in all_of_them)
        return f"| {group} | {n} | {all_of_them[n // 2]:.1e} | {all_of_them[min(n - 1, 99 * n // 100)]:.1e} | {all_of_them[-1]:.1e} | {near} |"

    def broken(self):
        lines = [f"{group}: {self.accepted[group]} of {n} accepted" for group, n in self.files.items() if self.accepted[group] < ACCEPTED * n]
        for (group, verb), n in self.tried.items():
            if self.written[group, verb] < n:
                lines.append(f"{group}, {verb}: {self.written[group, verb]} of {n} written")
            if self.sound[group, verb] < self.written[group, verb]:
                lines.append(f"{group}, {verb}: {self.sound[group, verb]} of {self.written[group, verb]} sound")
        for group, deviations in self.deviations.items():
            near = sum(d <= NEAR for d in deviations)
            if near < MOSTLY * len(deviations):
                lines.append(f"{group}: {near} of {len(deviations)} within {NEAR} of the size")
        return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--solids", type=int, default=200)
    parser.add_argument("--meshes", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--limit", type=int, default=120, help="seconds of a command")
    parser.add_argument("--keep", type=pathlib.Path, help="a folder for the files")
    parser.add_argument("--results", type=pathlib.Path, help="the folder for files.md")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as top:
        folder = options.keep or pathlib.Path(top)
        folder.mkdir(parents=True, exist_ok=True)
        write_off(folder / "ball.off", *ball(8, 0.1))
        survey = Survey(folder, options)
        print(f"seed {options.seed}")
        for k in range(options.solids):
            survey.take("Boolean results", f"solid_{k}", *some_solid(random.Random(f"{options.seed} solid {k}")))
        for k in range(options.meshes):
            defect = DEFECTS[k % len(DEFECTS)]
            survey.take("exporters' meshes", f"{defect.__name__}_{k}", *defect(random.Random(f"{options.seed} mesh {k}")))
    broken = survey.broken()
    verdict = ["No promise is broken."] if not broken else ["Broken promises:", "", *(f"- {line}" for line in broken)]
    table = survey.table()
    print("\n".join([*table, "", *verdict, "", *survey.against]))
    if options.results:
        some = [f"- {line}" for line in survey.against[:40]]
        page = ["# Files", "", INTRODUCTION, f"Seed {options.seed}.", "", *table, "", *verdict, "", *(["What was refused, first:", "", *some, ""] if some else [])]
        (options.results / "files.md").write_text("\n".join(page))
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
