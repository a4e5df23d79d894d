"""Positions, and answers of batches, as named tuples."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

import numpy
from numpy.typing import NDArray


class Point(NamedTuple):
    """A position in the plane, in the unit of the coordinates."""

    x: float = 0.0
    y: float = 0.0


class Point3(NamedTuple):
    """A position in space, in the unit of the coordinates."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0


class Configuration(NamedTuple):
    """A point of configuration space; theta in radians."""

    x: float = 0.0
    y: float = 0.0
    theta: float = 0.0


class RationalPoint(NamedTuple):
    """An exact position in the plane."""

    x: Fraction = Fraction(0)
    y: Fraction = Fraction(0)


class RationalPoint3(NamedTuple):
    """An exact position in space."""

    x: Fraction = Fraction(0)
    y: Fraction = Fraction(0)
    z: Fraction = Fraction(0)


class Clearances(NamedTuple):
    """Answers of ObstacleQueries.clearance_each for n configurations, as for Clearance."""

    distance: NDArray[numpy.float64]  #: (n)
    error: NDArray[numpy.float64]  #: (n)
    patch: NDArray[numpy.uint32]  #: (n)
    nearest: NDArray[numpy.float64]  #: (n, 3): x, y, theta


class DepthRows(NamedTuple):
    """Answers of depth_batch_arrays for n translations, as for SolidDistance."""

    meeting: NDArray[numpy.uint8]  #: (n): values of Meeting
    distance: NDArray[numpy.float64]  #: (n)
    direction: NDArray[numpy.float64]  #: (n, 3): of the first shortest move; zero where there is none
    ways: NDArray[numpy.uint32]  #: (n): how many shortest moves
    complete: NDArray[numpy.bool_]  #: (n)
    at_least: NDArray[numpy.float64]  #: (n)


class PoseReports(NamedTuple):
    """Answers of pose_batch_arrays for n rotations, as for PoseReport."""

    facets: NDArray[numpy.uint64]  #: (n)
    volume: NDArray[numpy.float64]  #: (n)
    support: NDArray[numpy.float64]  #: (n, 3)
    depth: NDArray[numpy.float64]  #: (n)
    direction: NDArray[numpy.float64]  #: (n, 3)
    inside: NDArray[numpy.bool_]  #: (n)
