"""Programs that end while other threads work, and garbage."""

from __future__ import annotations

import gc
import subprocess
import sys
import weakref
from typing import Any

import pytest

import dymsum
from dymsum import shapes

WORK = {
    "sums": "dymsum.minkowski_sum(*large)",
    "progress": "dymsum.minkowski_sum(*large, dymsum.SumOptions(progress=lambda stage, share: None))",
    "tables": "dymsum.nfp_each([tuple(large)] * 50)",
    "batches": "dymsum.contains_each(*large, numpy.zeros((10**6, 2)))",
    "conversions": "dymsum.nfp([(0, 0), (1, 0), (0, 1)], 'POLYGON((0 0, 2 0, 2 2, 0 2, 0 0))')",
    "solids": "dymsum.minkowski_sum(*solid)",
    "endless progress": "dymsum.minkowski_sum(*large, dymsum.SumOptions(progress=lambda stage, share: endless()))",
    "endless conversion": "dymsum.Region(Endless())",
    "endless number": "dymsum.translated(large[0], Number(), 0)",
}


@pytest.mark.parametrize("work", WORK)
def test_a_daemon_works_when_the_program_ends(work: str) -> None:
    program = f"""
import threading, time, numpy, dymsum
large = [dymsum.shapes.random_polygon(1500, 0, seed) for seed in (1, 2)]
solid = [dymsum.solids.prism([(0, 0), (3, 0), (3, k), (1, 1), (1, 3), (0, 3)], 1.0) for k in (0.5, 0.25)]
begun = threading.Event()
def endless():
    while True:
        time.sleep(1e-4)
class Endless:
    @property
    def __geo_interface__(self):
        endless()
class Number:
    @property
    def numerator(self):
        endless()
def work():
    while True:
        begun.set()
        {WORK[work]}
for _ in range(2):
    threading.Thread(target=work, daemon=True).start()
begun.wait()
time.sleep(0.1)
"""
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "", "")


OPTIONS = [
    dymsum.SumOptions,
    dymsum.SpatialOptions,
    dymsum.MovingOptions,
    dymsum.ObstacleOptions,
    dymsum.ObstacleMeshOptions,
    dymsum.PlanOptions,
    dymsum.BatchOptions,
    dymsum.TableOptions,
    dymsum.MovingSolidOptions,
    dymsum.FamilyOptions,
    dymsum.SolidFamilyOptions,
]


class Holder:
    """Its own method is the progress of what it holds."""

    held: Any
    sum: Any

    def progress(self, stage: str, share: float) -> None:
        pass




@pytest.mark.parametrize("kind", OPTIONS)
def test_options_with_a_progress_of_their_holder_are_collected(kind: Any) -> None:
    def made() -> weakref.ref[Holder]:
        holder = Holder()
        holder.held = kind(progress=holder.progress)
        assert holder.held.progress == holder.progress
        return weakref.ref(holder)

    seen = made()
    gc.collect()
    assert seen() is None


@pytest.mark.parametrize("kind", [dymsum.ScalingSum, dymsum.RotatingSum, dymsum.MovingSolidSum])
def test_moving_sums_with_a_progress_of_their_holder_are_collected(kind: Any) -> None:
    solid = kind is dymsum.MovingSolidSum
    p, q = (dymsum.solids.box(0, 0, 0, 1, 1, 1),) * 2 if solid else (shapes.star(5, 1, 2), shapes.disc(5, 1))

    def made(keeps_options: bool) -> weakref.ref[Holder]:
        holder = Holder()
        options = (dymsum.MovingSolidOptions if solid else dymsum.MovingOptions)(progress=holder.progress)
        holder.held = [kind(p, q, options), options if keeps_options else None]
        holder.sum = [holder.held[0].sum(), holder.held[0].options]
        assert holder.held[0].options.progress == holder.progress
        return weakref.ref(holder)

    for keeps_options in (False, True):
        seen = made(keeps_options)
        gc.collect()
        assert seen() is None


def test_a_sum_does_not_keep_the_progress_it_was_made_with() -> None:
    box = dymsum.solids.box(0, 0, 0, 1, 1, 1)

    def made() -> tuple[weakref.ref[Holder], list[Any]]:
        holder = Holder()
        planar = dymsum.SumOptions(semantics=dymsum.Semantics.open, progress=holder.progress)
        solid = dymsum.SpatialOptions(progress=holder.progress)
        star = shapes.star(5, 1, 2)
        return weakref.ref(holder), [dymsum.nfp(star, star, planar), dymsum.minkowski_sum(box, box, solid)]

    seen, sums = made()
    gc.collect()
    assert seen() is None and len(sums) == 2


def test_a_progress_in_use_stays() -> None:
    holder = Holder()
    holder.held = dymsum.SumOptions(progress=holder.progress)
    gc.collect()
    assert holder.held.progress == holder.progress
    dymsum.minkowski_sum(shapes.star(5, 1, 2), shapes.star(6, 1, 2), holder.held)
    assert holder.held.progress is not None


def test_threads_use_the_package_first_at_the_same_time() -> None:
    """Each waited for what the other one was importing, with the GIL."""
    program = """
import sys, threading, numpy, dymsum
sys.setswitchinterval(1e-6)
square, points = dymsum.shapes.rectangle(0, 0, 1, 1), numpy.zeros((3, 2))
threads = [threading.Thread(target=dymsum.contains_each, args=(square, square, points)) for _ in range(8)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
"""
    for _ in range(4):
        ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=30)
        assert (ended.returncode, ended.stderr) == (0, "")
