"""CGAL's Polygon_set_2 with exact constructions, by the program made of bench/versus/cgal_regions.cpp: CGAL_REGIONS of the environment.
Without it there are no times of CGAL."""

import os
import subprocess


def written(path, rings):
    path.write_text("\n".join(" ".join(f"{x!r} {y!r}" for x, y in ring) for ring in rings) + "\n")
    return path


def measured(folder, verb, first, second, runs):
    """The least milliseconds and the area, of lists of rings; one run where that takes more than half a second."""
    program = os.environ.get("CGAL_REGIONS")
    if not program:
        return None
    files = [written(folder / f"{name}.txt", rings) for name, rings in (("first", first), ("second", second))]

    def run(times):
        done = subprocess.run([program, *files, verb, str(times)], capture_output=True, text=True, check=True)
        return tuple(map(float, done.stdout.split()))

    once = run(1)
    return once if once[0] > 500 or runs < 2 else min(once, run(runs))
