"""What coordinates cost: commands on the same shapes on a grid, in decimals, in single precision, with the noise of cosines, turned.

`./run bench coordinates [--only WORD] [--runs N] [--limit SECONDS] [--results FOLDER]`. Every command is run as a process, once for
every kind of coordinates and as often as --runs says; its processor time is the least of its runs, less what `dymsum --version` takes.
It fails where a promise is broken: a command that costs more than 5 times the grid's, ends otherwise than on the grid or runs into
the limit; a mean over all commands of a kind above 2; more than 1.5 times the grid's memory. The environment's DYMSUM is the command
line to ask.
"""

import argparse
import json
import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile

DYMSUM = os.path.abspath(os.environ.get("DYMSUM", "dymsum"))
KINDS = ("grid", "decimals", "digits10", "single", "noise", "turned", "turned_far")
WORST, MEAN, MEMORY = 5.0, 2.0, 1.5
# Shorter times are noise: a ratio is to at least this many seconds, and megabytes.
LEAST_SECONDS, LEAST_MEGABYTES = 0.02, 20.0

INTRODUCTION = """The same shapes, the same commands, other coordinates: multiples of 2^-20 (`grid`), four and ten decimals, single
precision, the doubles that sines and cosines give (`noise`), turned by 30 degrees about two axes in doubles, and that far from the
origin. Printed are processor seconds, and in brackets how many times those of the grid. This page:
`./run bench coordinates --results docs/results`, which fails where a command costs more than 5 times the grid's, the mean of a kind
is more than 2, or memory is more than 1.5 times.
"""


def single(x):
    return struct.unpack("f", struct.pack("f", x))[0]


ROUND = {"grid": lambda x: round(x * 2**20) / 2**20, "decimals": lambda x: round(x, 4), "digits10": lambda x: round(x, 10),
         "single": single}


def as_kind(points, kind):
    """Points (x, y) or (x, y, z) as that kind of coordinates has them."""
    c, s = math.cos(math.radians(30)), math.sin(math.radians(30))
    result = []
    for point in points:
        p = list(point)
        if kind.startswith("turned"):
            p[0], p[1] = c * p[0] - s * p[1], s * p[0] + c * p[1]
            if len(p) == 3:
                p[1], p[2] = c * p[1] - s * p[2], s * p[1] + c * p[2]
        if kind == "turned_far":
            p = [a + 1e5 / 3 for a in p]
        result.append(tuple(ROUND.get(kind, float)(a) for a in p))
    return result


def torus(n, m, large, small):
    points, faces = [], []
    for i in range(n):
        for j in range(m):
            a, b = 2 * math.pi * i / n, 2 * math.pi * j / m
            radius = large + small * math.cos(b)
            points.append((radius * math.cos(a), radius * math.sin(a), small * math.sin(b)))
            corner = [i * m + j, (i + 1) % n * m + j, (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m]
            faces += [corner[:3], [corner[0], *corner[2:]]]
    return points, faces


def prism(ring, height, triangles):
    n = len(ring)
    points = [(x, y, 0.0) for x, y in ring] + [(x, y, height) for x, y in ring]
    faces = [t[::-1] for t in triangles] + [[k + n for k in t] for t in triangles]
    for i in range(n):
        j = (i + 1) % n
        faces += [[i, j, j + n], [i, j + n, i + n]]
    return points, faces


def cylinder(n, radius, height):
    ring = [(radius * math.cos(2 * math.pi * i / n), radius * math.sin(2 * math.pi * i / n)) for i in range(n)]
    return prism(ring, height, [[0, i, i + 1] for i in range(1, n - 1)])


def gear(n, inner, outer):
    steps = ((0, inner), (0.25, outer), (0.5, outer), (0.75, inner))
    return [(r * math.cos(2 * math.pi * (i + f) / n), r * math.sin(2 * math.pi * (i + f) / n)) for i in range(n) for f, r in steps]


def comb(n):
    ring = [(0, 0), (2 * n - 1, 0)]
    for i in range(n - 1, -1, -1):
        ring += [(2 * i + 1, 3), (2 * i, 3)] + ([(2 * i, 1), (2 * i - 1, 1)] if i else [])
    return [(float(x), float(y)) for x, y in ring]


ELL = prism([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)], 1.0, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]])
SOLIDS = {"torus": torus(16, 8, 2, 0.7), "ring": torus(12, 6, 1, 0.3), "ell": ELL, "rod": cylinder(24, 0.5, 2.0)}
REGIONS = {"gear": gear(30, 8, 10), "pinion": gear(13, 2, 3), "comb": comb(20), "small_comb": comb(7)}

COMMANDS = {
    "sum of tori": "sum torus.off ring.off",
    "and written": "sum torus.off ring.off -o out.off",
    "in single precision": "sum torus.off ring.off -o out.stl",
    "L with rod": "sum ell.off rod.off -o out.off",
    "L with itself": "nfp ell.off ell.off -o out.off",
    "erosion": "erode torus.off ring.off",
    "offset": "offset ell.off --by 0.1 --tolerance 0.02 -o out.off",
    "offset inward": "offset rod.off --by -0.1 --tolerance 0.02 -o out.off",
    "slice": "slice torus.off ring.off --z 0.25",
    "depth": "depth torus.off ring.off --move 0.5,0.25,0",
    "local sum": "local-sum torus.off ring.off --ball 2.5,0,0.25,0.3",
    "track": "depth ell.off rod.off --track track.csv --smoothing 0.25 -o out.csv",
    "solid turns": "rotate torus.off ring.off --steps 60",
    "events of scales": "scale torus.off ring.off --range 1:33/32",
    "events of a turn": "rotate ell.off ell.off --events --axis 1,2,3 --range 0deg:5deg",
    "plane: sum": "sum comb.wkt small_comb.wkt --repeat 20",
    "plane: with itself": "nfp comb.wkt comb.wkt --repeat 20",
    "plane: written": "sum comb.wkt small_comb.wkt -o out.wkt",
    "plane: scales": "scale gear.wkt pinion.wkt --sweep 1:1.5:0.01",
    "plane: events of scales": "scale comb.wkt small_comb.wkt --range 1:9/8",
    "plane: turns": "rotate comb.wkt small_comb.wkt --steps 200",
    "plane: obstacle": "cspace small_comb.wkt comb.wkt",
    "plane: obstacle of gears": "cspace pinion.wkt gear.wkt",
    "plane: path": "path pinion.wkt comb.wkt --from=-20,-20,0 --to=60,20,1",
    "plane: disc": "disc comb.wkt --radius 0.4 -o out.wkt",
    "plane: features": "features comb.wkt",
    "plane: pieces": "decompose comb.wkt -o out.json",
}


def write_shapes(folder, kind):
    folder.mkdir(parents=True, exist_ok=True)
    for name, (points, faces) in SOLIDS.items():
        lines = [f"OFF\n{len(points)} {len(faces)} 0", *("%r %r %r" % p for p in as_kind(points, kind)), *("3 %d %d %d" % tuple(f) for f in faces)]
        (folder / f"{name}.off").write_text("\n".join(lines) + "\n")
    for name, ring in REGIONS.items():
        points = as_kind(ring, kind)
        (folder / f"{name}.wkt").write_text("POLYGON((" + ",".join("%r %r" % p for p in [*points, points[0]]) + "))\n")
    (folder / "track.csv").write_text("".join("%r,%r,%r\n" % (0.5 + 0.02 * i, 0.3, 0.1 + 0.01 * i) for i in range(20)))


class Run:
    """One command, ended or stopped at the limit: code, processor seconds, megabytes, the last line of its complaint."""

    def __init__(self, command, folder, limit):
        with tempfile.TemporaryFile("w+") as errors:
            process = subprocess.Popen([DYMSUM, *command.split()], cwd=folder, stdout=subprocess.DEVNULL, stderr=errors,
                                       preexec_fn=lambda: limit_processor(limit))
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            errors.seek(0)
            self.complaint = (errors.read().strip().splitlines() or [""])[-1][:150]
        self.folder = folder
        self.code = "limit" if process.returncode < 0 else process.returncode
        self.seconds = usage.ru_utime + usage.ru_stime
        self.megabytes = usage.ru_maxrss / 1024


def limit_processor(seconds):
    import resource
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))


def events_of(command, folder):
    """How many events or critical angles the command's report has, 0 for a command without."""
    text = subprocess.run([DYMSUM, *command.split(), "--json"], cwd=folder, capture_output=True, text=True).stdout
    report = json.loads(text) if text else {}
    return report.get("angles") or (len(report["events"]) if isinstance(report.get("events"), list) else 0)


def best(command, folder, options):
    """The least time of several runs, and of one that runs into the limit no second."""
    result = Run(command, folder, options.limit)
    for _ in range(options.runs - 1):
        if result.seconds * 4 > options.limit:
            break
        again = Run(command, folder, options.limit)
        result.seconds = min(result.seconds, again.seconds)
    return result


class Table:
    """The rows of the page, and the promises that they break."""

    def __init__(self):
        self.rows, self.broken = [], []
        self.ratios = {kind: [] for kind in KINDS[1:]}

    def add(self, name, command, runs, start):
        grid = runs["grid"]
        cells = ["%.3f" % max(grid.seconds - start, 0)]
        for kind in KINDS[1:]:
            run = runs[kind]
            seconds = max(run.seconds - start, 0)
            ratio = max(seconds, LEAST_SECONDS) / max(grid.seconds - start, LEAST_SECONDS)
            memory = max(run.megabytes, LEAST_MEGABYTES) / max(grid.megabytes, LEAST_MEGABYTES)
            self.ratios[kind].append(ratio)
            where = f"{name}, {kind}"
            cell = f"{seconds:.3f} ({ratio:.1f})"
            if run.code != grid.code:
                cell += f" **{run.code}**"
                self.broken.append(f"{where}: ends with {run.code}, on the grid with {grid.code}: {run.complaint}")
            if ratio > WORST:
                self.broken.append(f"{where}: {ratio:.1f} times the grid's time{self.by_size(command, ratio, grid, run)}")
            if memory > MEMORY:
                self.broken.append(f"{where}: {memory:.1f} times the grid's memory, {run.megabytes:.0f} MB")
            cells.append(cell)
        self.rows.append(f"| {name}: `{command}` | " + " | ".join(cells) + " |")
        print(self.rows[-1], flush=True)

    def by_size(self, command, ratio, grid, run):
        """What the ratio is for each event that the command finds: near coincidences of turned shapes are true events."""
        counts = [events_of(command, folder) for folder in (grid.folder, run.folder)]
        return f"; {counts[1]} events where the grid has {counts[0]}, {ratio * counts[0] / counts[1]:.2f} times for each" if all(counts) else ""

    def finish(self):
        if any(not ratios for ratios in self.ratios.values()):
            sys.exit("no command has that word in it")
        means = {kind: math.exp(sum(map(math.log, ratios)) / len(ratios)) for kind, ratios in self.ratios.items()}
        plain = {kind: sum(ratios) / len(ratios) for kind, ratios in self.ratios.items()}
        self.rows.append("| mean of the ratios | | " + " | ".join("%.2f" % plain[kind] for kind in KINDS[1:]) + " |")
        self.rows.append("| their geometric mean | | " + " | ".join("%.2f" % means[kind] for kind in KINDS[1:]) + " |")
        print("\n".join(self.rows[-2:]))
        self.broken += [f"{kind}: {plain[kind]:.2f} times the grid's time in the mean" for kind in plain if plain[kind] > MEAN]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="", help="commands with this word")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--limit", type=int, default=30, help="processor seconds of a run")
    parser.add_argument("--results", type=pathlib.Path, help="the folder for coordinates.md")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as top:
        top = pathlib.Path(top)
        for kind in KINDS:
            write_shapes(top / kind, kind)
        start = min(Run("--version", top, 10).seconds for _ in range(20))
        head = ["| command | " + " | ".join(KINDS) + " |", "|---" * (len(KINDS) + 1) + "|"]
        print("\n".join(head))
        table = Table()
        for name, command in COMMANDS.items():
            if options.only in f"{name} {command}":
                table.add(name, command, {kind: best(command, top / kind, options) for kind in KINDS}, start)
        table.finish()
    verdict = ["No promise is broken."] if not table.broken else ["Broken promises:", "", *(f"- {line}" for line in table.broken)]
    print("\n" + "\n".join(verdict))
    if options.results:
        page = ["# What coordinates cost", "", INTRODUCTION, *head, *table.rows, "", *verdict, ""]
        (options.results / "coordinates.md").write_text("\n".join(page))
    return 1 if table.broken else 0


if __name__ == "__main__":
    sys.exit(main())
