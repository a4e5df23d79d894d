"""Repairs by name, coordinates on a grid, curves and joined lines."""

from __future__ import annotations

import pytest

import dymsum
from dymsum import MeshRepairKind, MeshRepairOptions, RegionRepairKind, RegionRepairOptions


def test_repairs_of_regions_are_chosen_and_have_positions() -> None:
    clockwise = [(0, 0), (0, 3), (4, 0)]
    repaired = dymsum.repair(clockwise, RegionRepairOptions())
    assert repaired.log.kinds() == [RegionRepairKind.reversed_rings]
    assert repaired.log.marks[0].at == (0, 0)
    assert repaired.region.area() == 6
    with pytest.raises(dymsum.Error):
        dymsum.repair(clockwise, RegionRepairOptions(kinds=[RegionRepairKind.empty_rings]))
    assert len(dymsum.all_region_repairs()) == 6


def test_loose_walls_and_nested_bodies() -> None:
    box = dymsum.solids.box(0, 0, 0, 1, 1, 1).data
    walled = dymsum.MeshData(
        [*box.vertices, (0.5, 0, 0), (0.5, 1, 0), (0.5, 1, 1)], [*(list(face) for face in box.faces), [8, 9, 10]]
    )
    repaired = dymsum.repair_with_union(walled, dymsum.Fill.nonzero, MeshRepairOptions())
    assert repaired.log.kinds() == [MeshRepairKind.loose_walls]
    assert repaired.mesh.volume() == 1
    with pytest.raises(dymsum.Error):
        dymsum.repair_with_union(walled, dymsum.Fill.nonzero, MeshRepairOptions(kinds=[MeshRepairKind.holes]))
    assert dymsum.NestedShells.solid != dymsum.NestedShells.cavity


def test_coordinates_are_snapped() -> None:
    noisy = [(0, 0), (0.1 + 0.2, 0), (0.3, 0.1), (0, 0.1)]
    noise = dymsum.coordinate_noise(noisy)
    assert noise is not None
    assert noise.grid.to_string() == "1e-1"
    done = dymsum.snapped(noisy, dymsum.coordinate_grid("0.1"))
    assert done.report.moved == 1
    assert dymsum.coordinate_noise(done.data) is None


def test_curves_and_joined_lines() -> None:
    options = dymsum.ReadOptions(curves=dymsum.CurveOptions(error=1e-3, bound=dymsum.CurveBound.outside))
    shape = dymsum.parse_shapes("<svg><circle r='1'/></svg>", dymsum.RegionFormat.svg, "disc", options)[0]
    assert shape.curves == 1
    assert 3.14159265 < dymsum.Region(shape.data).area() < 3.15
    lines = dymsum.RegionData(polylines=[[(0, 0), (1, 0)], [(1, 0.01), (0, 1), (0, 0)]])
    joined = dymsum.joined_chains(lines, 0.1)
    assert joined.report.rings == 1
    assert dymsum.Region(joined.data).area() > 0
