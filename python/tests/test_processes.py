"""Other processes: operands and answers pickled, forked and spawned."""

from __future__ import annotations

import multiprocessing
import sys
from typing import Any

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


@pytest.mark.skipif(sys.platform == "win32", reason="there is no fork")
@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_regions_and_meshes_in_other_processes(method: Any) -> None:
    here = planar((P, Q)), planar((Q, P)), spatial((A, B))  # its threads are not there after a fork
    with multiprocessing.get_context(method).Pool(2) as pool:
        there = pool.map_async(planar, [(P, Q), (Q, P)]).get(60)
        solid = pool.apply_async(spatial, ((A, B),)).get(60)
    assert there == list(here[:2])
    assert solid == here[2]
