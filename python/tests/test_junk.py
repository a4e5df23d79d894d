"""Whatever is handed in, something is raised or returned: nothing crashes."""

from __future__ import annotations

import inspect
import itertools
import math
from typing import Any, Iterator

import numpy

import dymsum

JUNK: list[Any] = [
    None,
    0,
    -1,
    2**70,
    math.nan,
    math.inf,
    "",
    "POINT(1 2)",
    [],
    (),
    [[]],
    [[[]]],
    [(0, 0)],
    [[(0, 0), (1, 0), (0, 1)], 5],
    [("a", "b")],
    b"",
    object(),
    {},
    {"type": "Polygon"},
    {"type": "Polygon", "coordinates": [[[0, 0], [1, 1], [1, 0], [0, 1]]]},
    numpy.zeros((3, 2)),
    numpy.zeros((0, 3)),
    numpy.zeros(5),
    numpy.full((2, 3), numpy.nan),
    ([(0, 0, 0)], [(0, 9)]),
    ([], []),
    dymsum.Region(),
    dymsum.Mesh(),
    dymsum.MeshData([(0, 0, 0)], [[7]]),
    dymsum.RegionData([dymsum.Part([(0, 0)])]),
    dymsum.Orientation(),
    dymsum.Rotation(),
]
#: Files are not written, and what is asked on the terminal is not read.
LEFT_OUT = {"write_file", "write_mesh", "read_shapes", "read_region_data", "read_mesh", "read_obstacle", "read_family"}
EXPECTED = (dymsum.Error, TypeError, ValueError, IndexError, OverflowError, AttributeError, KeyError, RuntimeError)


def samples() -> list[Any]:
    """Objects whose methods are called too."""
    box, unit = dymsum.solids.box(0, 0, 0, 1, 1, 1), dymsum.shapes.rectangle(0, 0, 1, 1)
    obstacle = dymsum.CspaceObstacle(unit, unit)
    sum = dymsum.nfp(unit, unit)
    convex = dymsum.ConvexSum(box, box)
    features = dymsum.ShapeFeatures(dymsum.shapes.letter_u(4, 4, 1))
    made = [
        unit,
        box,
        sum,
        obstacle,
        convex,
        sum.parts[0].outer,
        dymsum.ObstacleQueries(obstacle),
        dymsum.minkowski_sum(box, box),
        convex.solid(),
        dymsum.ScalingSum(unit, unit),
        dymsum.RotatingSum(unit, unit),
        dymsum.ScalingFamily(unit, unit, 1, 2),
        dymsum.RotationFamily(unit, unit),
        dymsum.SolidScalingFamily(box, box, 1, 2),
        dymsum.SolidRotationFamily(box, box, (0, 0, 1)),
        dymsum.fit_range(unit, unit),
        dymsum.GrowingDisc(unit),
        dymsum.GrowingDisc(unit).sum_at(1),
        features,
        dymsum.decompose(features),
        dymsum.SolidDepth(box, box),
        dymsum.PlanarDepth(unit, unit),
        dymsum.LocalSum(box, box),
        dymsum.ContinuousDepth(box, box),
        dymsum.PlanarLocalSum(unit, unit),
    ]
    JUNK.extend(
        [sum, sum.parts[0].outer.vertices[0], dymsum.nfp(unit, dymsum.shapes.disc(9, 1)).parts[0].outer.vertices[7]]
    )
    JUNK.extend([obstacle, dymsum.CspaceObstacle(dymsum.shapes.disc(9, 1), unit).patches()[3], dymsum.SolidBuffers()])
    JUNK.extend([made[-7], features, dymsum.DiscRadius.at_event(3)])
    return made


def callables() -> Iterator[tuple[str, Any]]:
    for scope in (dymsum, dymsum.shapes, dymsum.solids):
        for name, value in list(vars(scope).items()):
            own = getattr(value, "__module__", "").startswith("dymsum")
            if callable(value) and own and not name.startswith("_") and name not in LEFT_OUT:
                yield name, value
            if inspect.isclass(value) and own:
                for member in list(vars(value)):
                    if not member.startswith("__") and callable(getattr(value, member)):
                        yield f"{name}.{member}", getattr(value, member)


def test_junk() -> None:
    raised = answered = 0
    methods = [(name, getattr(value, name)) for value in samples() for name in dir(value) if not name.startswith("__")]
    for name, function in [*callables(), *((name, method) for name, method in methods if callable(method))]:
        # Generators of shapes have no bound on their counts.
        few = (
            [x for x in JUNK if not (isinstance(x, int) and x > 100)]
            if str(getattr(function, "__module__", "")).endswith(("shapes", "solids"))
            else JUNK
        )
        for arguments in itertools.chain(
            ((),), ((x,) for x in few), itertools.product(few[::2], repeat=2), ((x, x, x) for x in few)
        ):
            try:
                function(*arguments)
                answered += 1
            except EXPECTED:
                raised += 1
    assert raised > 10_000 and answered > 100
