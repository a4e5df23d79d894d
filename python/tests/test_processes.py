"""Other processes: operands and answers pickled, forked and spawned."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
from fractions import Fraction
from typing import Any, Callable

import pytest

import dymsum
from dymsum import shapes, solids

P, Q = shapes.star(7, 1, 2), shapes.letter_u(3, 3, 1)
A, B = solids.geodesic_sphere(1, 1), solids.prism([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)], 1.0)


def planar(pair: tuple[dymsum.Region, dymsum.Region]) -> tuple[dymsum.PlanarSum, list[bool]]:
    """A sum, with what it answers on several threads."""
    points = [(x / 7, y / 7) for x in range(-40, 40, 3) for y in range(-40, 40, 3)] * 20
    return dymsum.nfp(*pair), dymsum.contains_each(*pair, points, threads=2).tolist()


def spatial(pair: tuple[dymsum.Mesh, dymsum.Mesh]) -> dymsum.SpatialSum:
    return dymsum.minkowski_sum(*pair)


forks = pytest.mark.skipif(sys.platform == "win32", reason="there is no fork")


@forks
@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_regions_and_meshes_in_other_processes(method: Any) -> None:
    here = planar((P, Q)), planar((Q, P)), spatial((A, B))  # its threads are not there after a fork
    with multiprocessing.get_context(method).Pool(2) as pool:
        there = pool.map_async(planar, [(P, Q), (Q, P)]).get(60)
        solid = pool.apply_async(spatial, ((A, B),)).get(60)
    assert there == list(here[:2])
    assert solid == here[2]


def status_of_child(child: Callable[[], bool]) -> int:
    """0 where what runs in a forked process is true; a signal where it crashes, or takes too long."""
    pid = os.fork()
    if pid == 0:
        signal.alarm(30)
        os._exit(0 if child() else 1)
    return os.waitpid(pid, 0)[1]


def moved(kind: Any, sum: Any, steps: range) -> bool:
    """Whether the sums on the way are those of one thread."""
    alone = kind(P, Q)
    for k in steps:
        at = Fraction(100 + k, 100) if kind is dymsum.ScalingSum else dymsum.Orientation.of(k, 100)
        sum.set(at)
        alone.set(at)
        if sum.sum() != alone.sum():
            return False
    return True


@forks
@pytest.mark.parametrize("kind", [dymsum.ScalingSum, dymsum.RotatingSum])
def test_a_forked_child_has_a_sum_that_makes_windows_ahead(kind: Any) -> None:
    """The thread that makes them is not there."""
    sums = [kind(P, Q, dymsum.MovingOptions(threads=2)) for _ in range(2)]
    for k in range(5):
        assert all(moved(kind, sum, range(8 * k, 8 * k + 8)) for sum in sums)
        further = range(8 * k + 8, 8 * k + 16)

        def child() -> bool:
            sums.pop()  # destroyed
            return moved(kind, sums[0], further) and not sums.clear()

        assert status_of_child(child) == 0
        assert moved(kind, sums[0], further), "the parent's goes on"


@forks
def test_a_forked_child_destroys_a_sum_that_another_thread_moves() -> None:
    """That thread is not there, and has left the sum half done."""
    asked, forked = threading.Event(), threading.Event()
    sums: list[Any] = []

    def wait(stage: str, share: float) -> None:
        if sums:
            asked.set()
            forked.wait(30)

    sums.append(dymsum.ScalingSum(P, Q, dymsum.MovingOptions(progress=wait)))
    other = threading.Thread(target=sums[0].set, args=(Fraction(3, 2),))
    other.start()
    assert asked.wait(30)

    def child() -> bool:
        with pytest.raises(RuntimeError, match="another thread"):
            sums[0].set(2)
        return not sums.clear()

    status = status_of_child(child)
    forked.set()
    other.join()
    assert status == 0
    sums[0].set(2)
