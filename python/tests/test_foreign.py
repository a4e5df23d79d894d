"""Objects of other classes: what they raise is raised by the call, and what they say of themselves is not believed."""

from __future__ import annotations

import resource
import subprocess
import sys
from collections.abc import Sequence
from typing import Any, Callable

import numpy
import pytest

import dymsum
from dymsum import SumLocator, shapes, solids

SQUARE, BOX = shapes.rectangle(0, 0, 1, 1), solids.box(0, 0, 0, 1, 1, 1)
LOCATOR = SumLocator(dymsum.minkowski_sum(SQUARE, SQUARE))


class Mine(Exception):
    """Of nobody else."""


class Makes:
    """An array, or nothing but an exception."""

    def __init__(self, error: type[BaseException]) -> None:
        self._error = error

    def __array__(self, dtype: Any = None, copy: Any = None) -> Any:
        raise self._error("here")


class Iterates:
    """The same, by iteration."""

    def __init__(self, error: type[BaseException]) -> None:
        self._error = error

    def __len__(self) -> int:
        return 3

    def __getitem__(self, index: int) -> Any:
        raise self._error("here")

    def __iter__(self) -> Any:
        raise self._error("here")


CALLS: dict[str, Callable[[Any], Any]] = {
    "Region": dymsum.Region,
    "a hole": lambda x: dymsum.Region([[(0, 0), (9, 0), (0, 9)], x]),
    "the second operand": lambda x: dymsum.nfp(SQUARE, x),
    "one of both overloads": lambda x: dymsum.minkowski_sum(x, BOX),
    "before another that is refused": lambda x: dymsum.nfp(x, object()),
    "union_of": lambda x: dymsum.union_of([SQUARE, x]),
    "nfp_each": lambda x: dymsum.nfp_each([(SQUARE, x)]),
    "Part": dymsum.Part,
    "vertices of a mesh": lambda x: dymsum.volume((x, [(0, 1, 2)])),
    "vertices of MeshData": lambda x: dymsum.MeshData(x, []),
    "positions": lambda x: dymsum.contains_each(SQUARE, SQUARE, x),
    "positions in space": lambda x: dymsum.contains_each(BOX, BOX, x),
    "a locator's": LOCATOR.contains_each,
    "points": dymsum.convex_hull,
    "moves": lambda x: dymsum.depth_batch_arrays(dymsum.SolidDepth(BOX, BOX), x),
}


@pytest.mark.parametrize("error", [ValueError, TypeError, RuntimeError, KeyError, Mine, KeyboardInterrupt])
@pytest.mark.parametrize("kind", [Makes, Iterates])
@pytest.mark.parametrize("name", CALLS)
def test_what_they_raise_is_raised_by_the_call(name: str, kind: Any, error: type[BaseException]) -> None:
    with pytest.raises(error, match="here"):
        CALLS[name](kind(error))
        pytest.fail("the call returned")


class Ring(Sequence[Any]):
    """It says that it is longer than memory."""

    def __init__(self, items: list[Any]) -> None:
        self._items = items

    def __len__(self) -> int:
        return 10**9

    def __getitem__(self, index: Any) -> Any:
        return self._items[index]


def test_a_length_that_is_no_length() -> None:
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    corners, steep = [(0, 0), (1, 0), (0, 1)], [(0.0, 0.0), (0.5, 0.5)]
    assert dymsum.Region(Ring(corners)) == dymsum.Region(corners)
    assert dymsum.Region(Ring([Ring(list(at)) for at in corners])) == dymsum.Region(corners)
    assert dymsum.Region([corners, Ring([(0.25, 0.25), (0.25, 0.5), (0.5, 0.25)])]).hole_count() == 1
    assert LOCATOR.contains_each(Ring(steep)).tolist() == [True, True]
    assert len(dymsum.union_of(Ring([SQUARE])).parts) == 1
    assert len(dymsum.nfp_each(Ring([Ring([SQUARE, SQUARE])]))) == 1
    faces = Ring([Ring(list(face)) for face in BOX.faces])
    assert dymsum.volume((BOX.vertices, faces)) == 1
    assert dymsum.TableItem("a", SQUARE, Ring([0, 90])).degrees == [0, 90]
    assert dymsum.twice_area(Ring(corners)) == 1
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 200_000


class Array:
    """It makes an array."""

    def __init__(self, values: Any) -> None:
        self._values = numpy.asarray(values, float)

    def __array__(self, dtype: Any = None, copy: Any = None) -> Any:
        return self._values


def test_what_makes_an_array_is_one() -> None:
    corners = [(0, 0), (1, 0), (0, 1)]
    assert dymsum.Region(Array(corners)) == dymsum.Region(corners)
    assert dymsum.contains_each(SQUARE, SQUARE, Array([(1, 1), (3, 3)])).tolist() == [True, False]
    assert dymsum.volume((Array(BOX.vertices), BOX.faces)) == 1


def test_a_sum_of_others_has_no_hash() -> None:
    ball = solids.geodesic_sphere(2, 1)
    boxes, balls = (dymsum.SolidRotationEvents(one, one, (0, 0, 1)) for one in (BOX, ball))
    with pytest.raises(ValueError, match="other operands"):
        boxes.combinatorial_hash(balls.at(dymsum.AxisTurn.of(1)))
    with pytest.raises(ValueError, match="other operands"):
        boxes.combinatorial_hash(dymsum.minkowski_sum(ball, ball))


def test_answers_of_another_table_are_refused() -> None:
    ell, bar = dymsum.TableItem("a", shapes.letter_l(3, 3, 1), [0, 90]), dymsum.TableItem("b", SQUARE, [0, 90])
    one, other = (dymsum.NfpTable(dymsum.TableInput(list(items))) for items in ((ell, bar), (bar, ell)))
    result = dymsum.compute_table(one)
    assert dymsum.table_rows(one, result, True)
    for call in (
        lambda: dymsum.table_rows(other, result, True),
        lambda: dymsum.table_geometry(other, result),
        lambda: dymsum.table_manifest(other, result, "", b""),
    ):
        with pytest.raises(ValueError, match="another table"):
            call()


SECOND = """
try:
    import _interpreters as interpreters
except ImportError:
    import _xxsubinterpreters as interpreters
{before}
other = interpreters.create()
code = '''
try:
    import dymsum
except ImportError as error:
    print("refused:", error)
else:
    dymsum.nfp([(0, 0), (1, 0), (0, 1)], [(0, 0), (1, 0), (0, 1)])
    print("imported")
'''
(getattr(interpreters, "run_string", None) or interpreters.exec)(other, code)
interpreters.destroy(other)
print("still here")
"""


@pytest.mark.parametrize("before", ["", "import dymsum"])
def test_a_second_interpreter_is_refused(before: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", SECOND.format(before=before)], capture_output=True, text=True, timeout=120
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "refused:" in done.stdout and done.stdout.endswith("still here\n")
