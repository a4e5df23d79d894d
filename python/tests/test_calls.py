"""Long calls: threads, progress, interrupts; and tables in parallel."""

from __future__ import annotations

import _thread
import threading
import time
from fractions import Fraction
from typing import Any

import numpy
import pytest

import dymsum
from dymsum import ErrorCode, SumOptions, shapes

ROUND = dymsum.solids.geodesic_sphere(1, 8)
ROD, WALL = shapes.rectangle(-1, -0.25, 1, 0.25), shapes.gear(8, 2, 3)
CREEPING = numpy.linspace((-9, 0, 0), (-9, 1, 1), 10**6)
LARGE = [shapes.random_polygon(1500, 0, seed) for seed in (1, 2)]


def table(count: int) -> list[tuple[dymsum.Region, dymsum.Region]]:
    parts = [shapes.random_polygon(12 + 3 * k, 0, k) for k in range(count)]
    return [(a, b) for a in parts for b in parts]


def test_a_table_equals_single_polygons() -> None:
    pairs = table(5)
    for threads in (1, 2, 0):
        assert dymsum.nfp_each(pairs, threads=threads) == [dymsum.nfp(a, b) for a, b in pairs]


def test_a_table_of_other_packages_shapes() -> None:
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    sums = dymsum.nfp_each([(square, "POLYGON((0 0, 2 0, 2 2, 0 2, 0 0))")] * 3)
    assert [s.area_exact() for s in sums] == [9, 9, 9]


def test_errors_in_a_table() -> None:
    small = shapes.rectangle(0, 0, 1, 1)
    far = dymsum.translated(dymsum.scaled(small, 2.0**1010, 2.0**1010), 0, 0)
    with pytest.raises(dymsum.Error):
        dymsum.nfp_each([(small, small), (far, small)])
    answers = dymsum.nfp_each([(small, small), (far, small)], return_errors=True)
    assert isinstance(answers[0], dymsum.PlanarSum) and isinstance(answers[1], dymsum.Error)
    assert answers[1].code == ErrorCode.unsupported_operand


def test_progress_of_a_table() -> None:
    seen: list[tuple[str, float]] = []
    dymsum.nfp_each(table(3), SumOptions(progress=lambda stage, share: seen.append((stage, share))))
    assert seen and all(0 <= share <= 1 for _, share in seen)
    with pytest.raises(dymsum.Error) as raised:
        dymsum.nfp_each(table(3), SumOptions(progress=lambda stage, share: False))
    assert raised.value.code == ErrorCode.cancelled


def test_contains_each_equals_contains() -> None:
    p, q = shapes.random_polygon(30, 1, 4), shapes.star(5, 0.1, 0.2)
    points = numpy.random.default_rng(2).uniform(-1.5, 1.5, (400, 2))
    inside = dymsum.contains_each(p, q, points, threads=2)
    assert inside.tolist() == [dymsum.contains(p, q, point) for point in points]
    assert 10 < inside.sum() < 390


def test_others_run_meanwhile() -> None:
    counted = 0
    done = threading.Event()

    def count() -> None:
        nonlocal counted
        while not done.is_set():
            counted += 1
            time.sleep(0.0005)

    other = threading.Thread(target=count)
    other.start()
    sum = dymsum.minkowski_sum(*LARGE)
    at_end = counted
    done.set()
    other.join()
    assert sum.vertex_count() > 100
    assert at_end > 3, "the GIL was kept"


def interrupt_soon() -> threading.Timer:
    timer = threading.Timer(0.1, _thread.interrupt_main)
    timer.start()
    return timer


def endless() -> list[tuple[dymsum.Region, dymsum.Region]]:
    return [(LARGE[0], LARGE[1])] * 2000


@pytest.mark.parametrize("threads", [1, 2])
def test_keyboard_interrupt_of_a_table(threads: int) -> None:
    timer = interrupt_soon()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        dymsum.nfp_each(endless(), threads=threads)
    timer.join()
    assert time.monotonic() - begin < 20


@pytest.mark.parametrize(
    "work",
    [
        lambda: dymsum.CspaceObstacle(shapes.random_polygon(60, 0, 1), shapes.random_polygon(200, 3, 2)),
        lambda: dymsum.fit_range(shapes.random_polygon(60, 0, 1), shapes.random_polygon(120, 0, 2)),
        lambda: dymsum.ScalingSum(shapes.random_polygon(100, 0, 1), shapes.gear(20, 0.5, 1)).events(
            Fraction(1, 1000), 1000
        ),
        lambda: [dymsum.contains_each(*LARGE, numpy.zeros((10**6, 2)), threads=2) for _ in range(20)],
        lambda: dymsum.contains_each(ROUND, ROUND, numpy.random.default_rng(1).uniform(-2, 2, (10**6, 3))),
        lambda: dymsum.check_path(ROD, WALL, CREEPING),
        lambda: dymsum.check_motion(
            ROD, WALL, (-9, 0, 0), (-4.001, 0, 0.001), dymsum.MotionOptions(resolution=0, most_poses=2**62)
        ),
        lambda: dymsum.SumLocator(dymsum.minkowski_sum(*LARGE)).contains_each(numpy.zeros((2 * 10**7, 2)), threads=1),
    ],
)
def test_keyboard_interrupt_of_long_calls(work: Any) -> None:
    timer = interrupt_soon()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        work()
        work()
        time.sleep(1)
    timer.join()
    assert time.monotonic() - begin < 20


def test_one_thread_at_a_time_moves_a_sum() -> None:
    sum = dymsum.ScalingSum(*LARGE)
    refused: list[RuntimeError] = []

    def move() -> None:
        for k in range(3):
            try:
                sum.set(1 + k / 7)
            except RuntimeError as error:
                refused.append(error)

    threads = [threading.Thread(target=move) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all("another thread" in str(error) for error in refused)
    sum.set(1)
    assert sum.sum() == dymsum.minkowski_sum(*LARGE)


def test_values_are_shared_by_threads() -> None:
    pairs = table(4)
    expected = [dymsum.nfp(a, b) for a, b in pairs]
    answers: dict[int, list[dymsum.PlanarSum]] = {}

    def work(k: int) -> None:
        answers[k] = [dymsum.nfp(a, b) for a, b in pairs]

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(answers[k] == expected for k in range(4))
