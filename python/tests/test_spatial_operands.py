"""Results of solids as operands: closed sets, unrounded, wherever a mesh is taken."""

from __future__ import annotations

from fractions import Fraction

import pytest

import dymsum
from dymsum import solids

ELL = solids.prism([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)], 1)
CUBE = solids.box(0, 0, 0, 1, 1, 1)
WEDGE = dymsum.Mesh(([(0, 0, 0), (7, 0, 0), (0, 5, 0), (0, 0, 3)], [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]))
CRUMB = solids.box(0, 0, 0, 0.25, 0.25, 0.25)


def test_positions_without_room_count_in_the_next_sum() -> None:
    fit = dymsum.erode(ELL, CUBE)
    assert fit.volume() == 0 and len(fit.tight_segments) == 2
    again = dymsum.minkowski_sum(fit, CUBE)
    assert again.volume_exact() == 5
    assert again == dymsum.opening(ELL, CUBE).solid
    assert dymsum.minkowski_sum(CUBE, fit) == again
    assert dymsum.minkowski_sum(dymsum.parse_solid_sum(dymsum.solid_sum_to_json(fit), "fit"), CUBE) == again
    regular = dymsum.SpatialOptions(semantics=dymsum.Semantics.regular)
    assert len(dymsum.minkowski_sum(fit, CUBE, regular).faces) == 0


def test_results_in_fractions_are_operands() -> None:
    fit = dymsum.erode(WEDGE, CRUMB)
    with pytest.raises(dymsum.Error):
        dymsum.as_mesh(fit)
    rest = dymsum.difference(WEDGE, fit)
    assert rest.volume_exact() + fit.volume_exact() == Fraction(7 * 5 * 3, 6)
    assert len(dymsum.difference(fit, WEDGE).faces) == 0
    assert dymsum.united([rest, fit]).volume_exact() == Fraction(7 * 5 * 3, 6)
    assert dymsum.intersection([fit, WEDGE]) == dymsum.intersection(fit, WEDGE)
    assert len(dymsum.symmetric_difference(fit, fit).faces) == 0
    assert dymsum.contains(fit, CRUMB, (Fraction(1, 3), 1, 1))
    assert not dymsum.contains(fit, CRUMB, (7, 5, 3))
    assert list(dymsum.contains_each(fit, CRUMB, [(0, 0, 0), (8, 0, 0)])) == [True, False]
    assert dymsum.check_set(fit, fit).equal()
    assert dymsum.closing(fit, CRUMB).solid == fit


def test_what_is_no_operand_is_refused() -> None:
    fit = dymsum.erode(ELL, CUBE)
    with pytest.raises(dymsum.Error, match="both operands have parts without volume"):
        dymsum.erode(fit, fit)
    with pytest.raises(TypeError):
        dymsum.minkowski_sum(fit, dymsum.shapes.rectangle(0, 0, 1, 1))
