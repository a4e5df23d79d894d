"""What mypy --strict has to say about uses of the package: nothing, but for the lines that end in "wrong"."""

from fractions import Fraction

import numpy
from numpy.typing import NDArray

import dymsum
from dymsum import CspaceObstacle, ObstacleQueries, PlanarSum, Point, Region, SumOptions, shapes, solids

square: list[tuple[float, float]] = [(0, 0), (1, 0), (1, 1), (0, 1)]
region = Region(square)
sum_: PlanarSum = dymsum.minkowski_sum(square, region, SumOptions(semantics=dymsum.Semantics.open))
area: Fraction = sum_.area_exact()
at: NDArray[numpy.float64] = sum_.parts[0].outer.at
first: Point = sum_.parts[0].outer.vertices[0].at
spatial: dymsum.SpatialSum = dymsum.minkowski_sum(solids.box(0, 0, 0, 1, 1, 1), solids.cone(5, 1, 1))
gear: Region = shapes.gear(5, 1, 2)
queries = ObstacleQueries(CspaceObstacle(gear, "POLYGON((9 0, 10 0, 10 1, 9 0))"))
free: NDArray[numpy.bool_] = queries.free_each([(0, 0, 0), (1, 2, 3)])
distances: NDArray[numpy.float64] = queries.clearance_each(numpy.zeros((5, 3))).distance
try:
    dymsum.nfp(gear, gear)
except dymsum.Error as error:
    code: dymsum.ErrorCode = error.code
    line: int | None = error.evidence.line
found = dymsum.plan(CspaceObstacle(gear, gear), (9, 9, 0), (10, 10, 1))
if found.reason is not None:
    text: str = found.reason.text

table = dymsum.NfpTable(dymsum.TableInput([dymsum.TableItem("gear", gear, [0, Fraction(45, 2)])]))
answer: dymsum.TableAnswer | None = dymsum.compute_table(table, dymsum.TableOptions(threads=2)).answers[0]
wkb: bytes = answer.wkb if answer else b""

grown: dymsum.DiscSet = dymsum.GrowingDisc(gear).sum_at(Fraction(1, 2))
covered: dymsum.Measured = dymsum.area(grown)
plain: float = dymsum.area(gear)
event: dymsum.DiscSet = dymsum.GrowingDisc(gear).closed_at(dymsum.DiscRadius.at_event(0))
features = dymsum.ShapeFeatures(gear, dymsum.FeatureOptions(dymsum.Concavity.hybrid1))
corner: Fraction = dymsum.decompose(features, dymsum.DecomposeOptions(0.5)).pieces[0].outer[0].x
minimum: int | None = features.bars()[features.lasting(1, to=3)[0]].minimum

dymsum.nfp(gear, 5)  # wrong
volume: str = dymsum.volume(solids.box(0, 0, 0, 1, 1, 1))  # wrong
SumOptions(engine="fast")  # wrong
sum_.nothing  # wrong
