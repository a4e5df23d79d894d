"""Commands of every suite, asked of this program and of an earlier one: what a change costs.

`./run bench pairs --base COMMIT [--only WORD] [--runs N] [--limit RATIO] [--results FOLDER]`. Every command runs on one core, in
turns, as a process of its own. Its cost is instructions in user space where `perf` counts them, which other programs on the machine do
not disturb, else the least processor time of the runs, of which short commands have five times as many. What the program takes to start is part of it. Results are compared: the
files that are written, byte for byte, and the reports, less times and versions. It fails where a result differs or a command costs
more than --limit times (1.05) the earlier program's. The environment's DYMSUM and DYMSUM_BASE are the two programs; shapes of
DYMSUM_DATA, or of ../shared/data beside the checkout, are asked too where they are present.
"""

import argparse
import json
import math
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "coordinates"))
import coordinates  # noqa: E402

PROGRAMS = {"base": os.path.abspath(os.environ.get("DYMSUM_BASE", "")), "now": os.path.abspath(os.environ.get("DYMSUM", "dymsum"))}
CORE = ["taskset", "-c", "0"] if shutil.which("taskset") else []
SHORT = 0.3  # processor seconds
# Keys of a report that say how, not what.
HOW = re.compile(r"_ms$|^time|^stages$|^version$|^work$|^rungs$|signs$|memory|^candidates$|^nodes$|^inputs$")

COMMANDS = {
    "planar": [
        "sum comb.wkt small_comb.wkt --repeat 100", "nfp comb.wkt comb.wkt --repeat 50", "sum gear.wkt pinion.wkt --repeat 400",
        "sum big_comb.wkt comb.wkt --repeat 3", "sum star.wkt star.wkt --repeat 30", "erode plate.wkt small_comb.wkt --repeat 1000",
        "sum comb.wkt small_comb.wkt -o out.json -o out.wkt -o out.svg", "contains comb.wkt small_comb.wkt --at 0.5,0.5 --repeat 2000",
        "sum planar/dog.poly planar/bird.poly --repeat 200", "sum planar/monkey.poly planar/star.poly --repeat 50",
        "sum planar/neuron.poly planar/egg.poly --repeat 50"],
    "scaling": [
        "scale gear.wkt pinion.wkt --sweep 1:1.5:0.001", "scale comb.wkt small_comb.wkt --sweep 0.5:1.5:0.002",
        "scale comb.wkt small_comb.wkt --range 1:9/8", "scale-range gear.wkt pinion.wkt --inside",
        "scale planar/dog.poly planar/bird.poly --sweep 0.5:1.5:0.002", "scale star.wkt star.wkt --range 1:33/32"],
    "rotating": ["rotate comb.wkt small_comb.wkt --steps 1000", "rotate gear.wkt pinion.wkt --steps 1000",
                 "rotate planar/dog.poly planar/bird.poly --steps 360"],
    "cspace": ["cspace small_comb.wkt comb.wkt", "cspace pinion.wkt gear.wkt", "cspace small_comb.wkt small_comb.wkt -o out.glb",
               "slice pinion.wkt gear.wkt --tan-half 1/3 --repeat 200", "path pinion.wkt comb.wkt --from=-20,-20,0 --to=60,20,1",
               "angles small_comb.wkt comb.wkt --at 5,2"],
    "convex": ["sum ball.off ball.off --repeat 20", "sum box.off rod.off --repeat 1000", "sum ball.off rod.off -o out.off",
               "sum box.off box.off -o out.stl", "rotate ball.off rod.off --steps 360", "rotate box.off rod.off --steps 2000",
               "scale ball.off rod.off --sweep 0.5:1.5:0.01"],
    "solid": ["sum torus.off ring.off --repeat 5", "sum ell.off rod.off --repeat 50", "nfp ell.off ell.off --repeat 50",
              "erode big_box.off ring.off --repeat 40", "sum torus.off ring.off -o out.off", "sum torus.off ring.off -o out.stl",
              "offset ell.off --by 0.1 --tolerance 0.02 -o out.off", "slice torus.off ring.off --z 0.25",
              "sum big_torus.off ring.off", "local-sum torus.off ring.off --ball 2.5,0,0.25,0.3",
              "sum solid/bunny-128.off solid/bunny-26.obj --repeat 20", "sum solid/gc_fox.off solid/tm_tube.off",
              "sum solid/tm_plate_holes.off solid/tm_round.off -o out.off"],
    "moving-solids": ["rotate torus.off ring.off --steps 60", "rotate ell.off ell.off --steps 360",
                      "rotate solid/gc_bob_small.off solid/tm_tube.off --steps 20", "scale torus.off ring.off --range 1:33/32",
                      "rotate ell.off ell.off --events --axis 1,2,3 --range 0deg:5deg", "scale ell.off rod.off --sweep 1:1.5:0.01"],
    "depth": ["depth torus.off ring.off --move 0.5,0.25,0", "depth ball.off ball.off --move 0.5,0.25,0 --repeat 50",
              "depth ell.off rod.off --track track.csv --smoothing 0.25 -o out.csv", "depth comb.wkt small_comb.wkt --move 3,1 --repeat 50",
              "clearance pinion.wkt comb.wkt --at=5,8,0.5 --repeat 20"],
    "nesting": ["nfp-table nesting/swim.json --repair --threads 1", "nfp-table nesting/shirts.json --repair --threads 1"],
    "growing": ["disc comb.wkt --radius 0.4 -o out.wkt --repeat 200", "features comb.wkt", "decompose comb.wkt -o out.json",
                "disc planar/monkey.poly --radius 3", "features planar/bird.poly"],
    "files": ["convert big_torus.off out.stl", "convert big_torus.off out.obj", "info big_torus.off", "convert star.wkt out.dxf",
              "convert planar/neuron.poly out.geojson", "hull torus.off out.off", "info comb.wkt"],
    "start": ["--version", "sum --help"],
}


def star(n):
    return [((10 if k % 2 == 0 else 4) * math.cos(math.pi * k / n), (10 if k % 2 == 0 else 4) * math.sin(math.pi * k / n)) for k in range(2 * n)]


def ball(n, m):
    points = [(0.0, 0.0, -1.0)]
    for j in range(1, m):
        b = math.pi * j / m - math.pi / 2
        points += [(math.cos(b) * math.cos(2 * math.pi * i / n), math.cos(b) * math.sin(2 * math.pi * i / n), math.sin(b)) for i in range(n)]
    points.append((0.0, 0.0, 1.0))
    at = lambda j, i: 1 + (j - 1) * n + i % n  # noqa: E731
    faces = [[0, at(1, i + 1), at(1, i)] for i in range(n)] + [[len(points) - 1, at(m - 1, i), at(m - 1, i + 1)] for i in range(n)]
    for j in range(1, m - 1):
        for i in range(n):
            faces += [[at(j, i), at(j, i + 1), at(j + 1, i + 1)], [at(j, i), at(j + 1, i + 1), at(j + 1, i)]]
    return points, faces


def write_shapes(folder, kind):
    coordinates.SOLIDS |= {"ball": ball(16, 8), "box": coordinates.prism([(0, 0), (2, 0), (2, 1), (0, 1)], 1.5, [[0, 1, 2], [0, 2, 3]]),
                           "big_box": coordinates.prism([(0, 0), (9, 0), (9, 9), (0, 9)], 9.0, [[0, 1, 2], [0, 2, 3]]),
                           "big_torus": coordinates.torus(48, 24, 4, 1.5)}
    coordinates.REGIONS |= {"big_comb": coordinates.comb(150), "star": star(40), "plate": [(0, 0), (60, 0), (60, 30), (0, 30)]}
    coordinates.write_shapes(folder, kind)


def what(report):
    """A report less what says how it was found."""
    if isinstance(report, dict):
        return {key: what(value) for key, value in report.items() if not HOW.search(key)}
    return [what(value) for value in report] if isinstance(report, list) else report


class Run:
    """One command of one program: exit code, cost, what it reported and wrote."""

    def __init__(self, program, command, folder, counts):
        for old in folder.glob("out.*"):
            old.unlink()
        words = command.split()
        asked = [program, *words, *(["--json"] if "--" != words[0][:2] and "--help" not in words else [])]
        counter = folder / "count.txt"
        prefix = ["perf", "stat", "-x,", "-e", "instructions:u", "-o", str(counter)] if counts else []
        with tempfile.TemporaryFile("w+") as output:
            process = subprocess.Popen(prefix + CORE + asked, cwd=folder, stdout=output, stderr=subprocess.DEVNULL)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = self.code = os.waitstatus_to_exitcode(status)
            output.seek(0)
            text = output.read()
        self.cost = usage.ru_utime + usage.ru_stime
        if counts:
            self.cost = next(float(line.split(",")[0]) / 1e6 for line in counter.read_text().splitlines() if "instructions" in line)
        self.files = {path.name: path.read_bytes() for path in folder.glob("out.*")}
        try:
            self.report = what(json.loads(text))
        except ValueError:
            self.report = None


def differences(base, now):
    """What the two runs did otherwise, in words."""
    found = [] if base.code == now.code else [f"ends with {now.code}, before with {base.code}"]
    found += [f"{name} differs" for name in sorted(base.files | now.files) if base.files.get(name) != now.files.get(name)]
    if isinstance(base.report, dict) and isinstance(now.report, dict):
        shared = base.report.keys() & now.report.keys()
        found += [f"`{key}` differs" for key in sorted(shared) if base.report[key] != now.report[key]]
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--base", help="the commit of the earlier program")
    parser.add_argument("--only", default="", help="commands or suites with this word")
    parser.add_argument("--kind", default="grid", choices=coordinates.KINDS, help="kind of coordinates")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--limit", type=float, default=1.05, help="the ratio above which a command is named")
    parser.add_argument("--results", type=pathlib.Path, help="the folder for pairs.md")
    options = parser.parse_args()
    data = pathlib.Path(os.environ.get("DYMSUM_DATA", pathlib.Path(__file__).resolve().parents[3] / "shared" / "data"))
    counts = shutil.which("perf") is not None and "not supported" not in subprocess.run(
        ["perf", "stat", "-e", "instructions:u", "true"], capture_output=True, text=True).stderr
    unit = "million instructions" if counts else "processor seconds"
    rows, broken, ratios = [], [], {}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_shapes(folder, options.kind)
        for part in ("planar", "solid", "nesting"):
            if (data / part).is_dir():
                (folder / part).symlink_to((data / part).resolve())
        for suite, commands in COMMANDS.items():
            for command in commands:
                files = [word for word in command.split() if "/" in word and "." in word]
                if options.only not in suite + " " + command or not all((folder / f).exists() for f in files if f.split("/")[0] in ("planar", "solid", "nesting")):
                    continue
                runs = {who: [] for who in PROGRAMS}
                wanted = 1 if counts else options.runs
                while len(runs["now"]) < wanted:
                    for who, program in PROGRAMS.items():
                        runs[who].append(Run(program, command, folder, counts))
                    if not counts and len(runs["now"]) == 1 and runs["now"][0].cost < SHORT:
                        wanted *= 5
                cost = {who: min(run.cost for run in done) for who, done in runs.items()}
                ratio = cost["now"] / max(cost["base"], 1e-9)
                ratios.setdefault(suite, []).append(ratio)
                other = differences(runs["base"][0], runs["now"][0])
                rows.append(f"| {suite} | `{command}` | {cost['base']:.6g} | {cost['now']:.6g} | {ratio:.3f} | {'; '.join(other)} |")
                print(rows[-1], flush=True)
                broken += [f"`{command}`: {fault}" for fault in other]
                broken += [f"`{command}`: {ratio:.3f} times the cost"] if ratio > options.limit else []
    if not ratios:
        sys.exit("no command has that word in it")
    means = [f"| {suite} | {len(r)} | {math.exp(statistics.mean(map(math.log, r))):.3f} | {min(r):.3f} | {max(r):.3f} |" for suite, r in ratios.items()]
    every = [ratio for some in ratios.values() for ratio in some]
    means.append(f"| all | {len(every)} | {math.exp(statistics.mean(map(math.log, every))):.3f} | {min(every):.3f} | {max(every):.3f} |")
    page = ["# What a change costs", "", f"Commands of every suite, asked of this program and of that of `{options.base}`, on coordinates of the kind `{options.kind}`: {unit}. "
            f"This page: `./run bench pairs --base {options.base} --results docs/results`.", "", "| suite | commands | geometric mean | least | most |", "|---|---|---|---|---|",
            *means, "", f"| suite | command | {options.base} | now | ratio | results |", "|---|---|---|---|---|---|", *rows, "", "Above the limit, or otherwise than before:", "",
            *([f"- {fault}" for fault in broken] or ["- nothing"]), ""]
    print("\n".join(means + broken))
    if options.results:
        (options.results / "pairs.md").write_text("\n".join(page))
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()
