"""Unions and other Boolean operations of solids, and the repair of surfaces that cross."""

from __future__ import annotations

import pickle
from fractions import Fraction

import pytest

import dymsum
from dymsum import Fill, MeshData, solids


def _two() -> MeshData:
    """Two boxes of size 2 that overlap in one of size 1, as one surface."""
    a, b = solids.box(0, 0, 0, 2, 2, 2), solids.box(1, 1, 1, 3, 3, 3)
    vertices = [tuple(p) for p in a.vertices] + [tuple(p) for p in b.vertices]
    faces = [list(f) for f in a.faces] + [[v + len(a.vertices) for v in f] for f in b.faces]
    return MeshData(vertices, faces)


def test_operations_of_two_solids_are_exact() -> None:
    a, b = solids.box(0, 0, 0, 2, 2, 2), solids.box(1, 1, 1, 3, 3, 3)
    assert dymsum.united([a, b]).volume_exact() == 15
    assert dymsum.intersection(a, b).volume_exact() == 1
    assert dymsum.difference(a, b).volume_exact() == 7
    assert dymsum.symmetric_difference(a, b).volume_exact() == 14
    third = dymsum.difference(a, solids.box(-1, -1, -1, 3, 3, 2 / 3))
    assert third.volume_exact() == 4 * (2 - Fraction(2 / 3))


def test_a_surface_that_crosses_is_united_by_its_fill() -> None:
    two = _two()
    assert dymsum.united(two).volume_exact() == 15
    assert dymsum.united(two, Fill.even_odd).volume_exact() == 14
    again = pickle.loads(pickle.dumps(dymsum.united(two, Fill.nonzero)))
    assert again == dymsum.united(two)
    with pytest.raises(dymsum.Error) as error:
        dymsum.united(MeshData([tuple(p) for p in two.vertices], [list(f) for f in two.faces][1:]))
    assert error.value.code == dymsum.ErrorCode.not_closed


def test_repair_says_that_it_united() -> None:
    with pytest.raises(dymsum.Error):
        dymsum.repair(_two())
    mended = dymsum.repair_with_union(_two())
    assert mended.report.united and mended.report.united_crossings == 6
    assert dymsum.volume(mended.mesh) == 15
