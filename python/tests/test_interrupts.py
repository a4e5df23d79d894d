"""What is raised while arguments are read reaches the caller: Ctrl-C, what else a signal's handler raises."""

from __future__ import annotations

import signal
import time
from collections.abc import Sequence
from fractions import Fraction as F
from typing import Any, Callable, Iterator

import numpy
import pytest

import dymsum
from dymsum import ScalingSum, Scale, SumLocator, shapes, solids

SQUARE, BOX = shapes.rectangle(0, 0, 1, 1), solids.box(0, 0, 0, 1, 1, 1)
LOCATOR = SumLocator(dymsum.minkowski_sum(SQUARE, SQUARE))


class Handled(Exception):
    """As a handler raises it."""


class Raising(Sequence[Any]):
    """A shape, a ring, or a number, of which nothing can be read."""

    def __init__(self, error: BaseException) -> None:
        self._error = error

    def __len__(self) -> int:
        raise self._error

    def __getitem__(self, index: Any) -> Any:
        raise self._error

    def __float__(self) -> float:
        raise self._error

    @property
    def numerator(self) -> Any:
        raise self._error


class Geometry(Raising):
    @property
    def __geo_interface__(self) -> Any:
        raise self._error


ERRORS = [KeyboardInterrupt, SystemExit, Handled, TimeoutError, MemoryError, TypeError, ValueError]
CALLS: dict[str, Callable[[Any, Any], Any]] = {
    "Region": lambda x, g: dymsum.Region(g),
    "a sequence": lambda x, g: dymsum.Region(x),
    "minkowski_sum": lambda x, g: dymsum.minkowski_sum(SQUARE, g),
    "of solids": lambda x, g: dymsum.minkowski_sum(g, BOX),
    "union_of": lambda x, g: dymsum.union_of([SQUARE, g, SQUARE]),
    "union_of one": lambda x, g: dymsum.union_of(x),
    "nfp_each": lambda x, g: dymsum.nfp_each([(SQUARE, SQUARE), (SQUARE, g)]),
    "Part": lambda x, g: dymsum.Part([(0, 0), (1, 0), (x, 1)]),
    "holes": lambda x, g: dymsum.Part([(0, 0), (1, 0), (0, 1)], [[(0, 0), (x, 1)]]),
    "MeshData": lambda x, g: dymsum.MeshData([(0, 0, x)], []),
    "contains": lambda x, g: dymsum.contains(SQUARE, SQUARE, (x, F(1, 3))),
    "contains_each": lambda x, g: dymsum.contains_each(SQUARE, SQUARE, x),
    "numbers": lambda x, g: dymsum.contains_each(SQUARE, SQUARE, [(F(1, 3), 0), (0, x)]),
    "of solids each": lambda x, g: dymsum.contains_each(BOX, BOX, [(F(1, 3), 0, 0), (0, x, 0)]),
    "SumLocator": lambda x, g: LOCATOR.contains((x, 1)),
    "SumLocator each": lambda x, g: LOCATOR.contains_each([(F(1, 3), 0), (0, x)]),
    "check_translation": lambda x, g: dymsum.check_translation(
        SQUARE, SQUARE, (x, 0), (0, F(1, 3)), dymsum.Orientation()
    ),
    "Scale": lambda x, g: Scale(x),
    "DiscRadius": lambda x, g: dymsum.GrowingDisc(SQUARE).sum_at(x),
    "set": lambda x, g: ScalingSum(SQUARE, SQUARE).set(1, x),
    "Orientation": lambda x, g: dymsum.Orientation.of(x),
    "lasting": lambda x, g: dymsum.ShapeFeatures(SQUARE).lasting(0, to=x),
    "degrees": lambda x, g: dymsum.TableItem("a", SQUARE, [0, x]),
    "a field": lambda x, g: dymsum.ScaledCopy(x),
    "twice_area": lambda x, g: dymsum.twice_area([(0, 0), (1, 0), (x, 1)]),
}


@pytest.mark.parametrize("kind", ERRORS)
@pytest.mark.parametrize("name", CALLS)
def test_it_is_raised_as_it_is(name: str, kind: type[BaseException]) -> None:
    error = kind()
    with pytest.raises(kind) as raised:
        CALLS[name](Raising(error), Geometry(error))
    error.__traceback__ = None  # it leads back here by way of arrays, which the garbage collector does not know
    assert raised.value is error


@pytest.fixture
def alarm() -> Iterator[Callable[[float], None]]:
    def handle(number: int, frame: Any) -> None:
        raise Handled

    before = signal.signal(signal.SIGALRM, handle)
    yield lambda seconds: signal.setitimer(signal.ITIMER_REAL, seconds)
    signal.setitimer(signal.ITIMER_REAL, 0)
    signal.signal(signal.SIGALRM, before)


LONG: dict[str, Callable[[], Any]] = {
    "floats": lambda: [(k * 1e-6, 0.5) for k in range(300_000)],
    "fractions": lambda: [(F(k, 300_001), F(1, 2)) for k in range(100_000)],
    "an array": lambda: numpy.zeros((10**7, 2)),
}


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="there is no SIGALRM")
@pytest.mark.parametrize("ask", [LOCATOR.contains_each, lambda p: dymsum.contains_each(SQUARE, SQUARE, p)])
@pytest.mark.parametrize("long", LONG)
def test_long_lists_are_interrupted(alarm: Callable[[float], None], ask: Any, long: str) -> None:
    positions = LONG[long]()
    begin = time.monotonic()
    ask(positions)
    takes = time.monotonic() - begin
    for share in (0.05, 0.2, 0.4, 0.6):
        alarm(share * takes)
        with pytest.raises(Handled):
            ask(positions)
            time.sleep(5)
