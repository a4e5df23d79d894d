"""Regions that are not known exactly, and robustness of answers."""

from __future__ import annotations

from fractions import Fraction

import pytest

import dymsum
from dymsum import Holds, Tolerance, Uncertain, shapes

SLOT, PEG = shapes.rectangle(0, 0, 20, 40), shapes.rectangle(0, 0, 20, 10)


def test_variants_have_what_all_and_what_some_have() -> None:
    list_of = Uncertain.of_variants([shapes.rectangle(0, 0, 2, 2), shapes.rectangle(1, 0, 3, 2)])
    assert list_of.inner.area_exact() == 2 and list_of.outer.area_exact() == 6
    assert list_of.doubtful().area_exact() == 4
    assert len(list_of.variants) == 2 and not list_of.exact() and list_of.error == 0
    made = dymsum.minkowski_sum(list_of, shapes.rectangle(0, 0, 1, 1))
    assert isinstance(made, Uncertain)
    assert made.inner.area_exact() == 6 and made.outer.area_exact() == 12
    # Any shape that is a region is taken, also as rows of points.
    assert dymsum.nfp(list_of, [(0, 0), (1, 0), (0, 1)]).outer.area() == 11.5


def test_iso_fits_hold_for_all_some_and_none() -> None:
    hole = Uncertain.of_band(SLOT, Tolerance(0.0105, 0))
    for upper, lower, expected in ((-0.0035, -0.01, "for_all"), (0.0075, 0.001, "for_some"), (0.0175, 0.011, "for_none")):
        fit = dymsum.fits_anywhere(hole, Uncertain.of_band(PEG, Tolerance(upper, lower)))
        assert fit.answer.holds.name == expected
        assert (fit.common is None) == (expected != "for_all")
        assert (fit.answer.yes is None) == (expected == "for_none")
    answer = dymsum.fits_at(hole, PEG, (Fraction(1, 300), 5)).holds
    assert answer is Holds.for_some


def test_answers_name_the_variants_that_decide() -> None:
    part = Uncertain.of_variants([shapes.rectangle(0, 0, 1, 1), shapes.rectangle(0, 0, 2, 1)])
    answer = dymsum.contains(part, [(0, 0), (1, 0), (0, 1)], (2.5, 0))
    assert answer.holds is Holds.for_some and (answer.yes.q, answer.yes.p, answer.no.p) == (0, 1, 0)
    band = Uncertain.of_band(shapes.rectangle(0, 0, 1, 1), Tolerance(0.5, 0))
    overlap = dymsum.collides(band, shapes.rectangle(0, 0, 1, 1), (1.25, 0))
    assert overlap.yes.p == dymsum.VariantPair.kOuter and overlap.no.p == dymsum.VariantPair.kInner
    bounds = dymsum.clearance(band, shapes.rectangle(0, 0, 1, 1), (1.25, 0))
    assert (bounds.least_signed(), bounds.most_signed()) == (-0.25, 0.25)
    assert bounds.most.distance.squared == Fraction(1, 16)


def test_pairs_come_from_zones_rounding_scales_and_angles() -> None:
    unit = shapes.rectangle(0, 0, 1, 1)
    corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    boxes = Uncertain.of_boxes(unit, [(x - 0.125, y - 0.125, x + 0.125, y + 0.125) for x, y in corners])
    assert boxes.outer.area_exact() == Fraction(25, 16) and boxes.inner.area_exact() == Fraction(9, 16)
    assert Uncertain.of_discs(unit, [0.125] * 4).outer.area() < 25 / 16
    assert not Uncertain.of_rounding(unit).exact() and Uncertain.of_rounding(unit, 0).exact()
    scales = Uncertain.of_scales(unit, 1, 2)
    assert (scales.inner.area_exact(), scales.outer.area_exact()) == (1, 4)
    half, none = dymsum.Orientation.parse("1"), dymsum.Orientation()
    assert Uncertain.of_angles(unit, none, half, 0.01).outer.area() > 2
    assert Uncertain.between(unit, unit).exact()
    with pytest.raises(dymsum.Error) as raised:
        Uncertain.between(unit, shapes.rectangle(0, 0, 1, 0.5))
    assert raised.value.code.name == "out_of_range"


def test_robustness_has_its_witness() -> None:
    unit = shapes.rectangle(0, 0, 1, 1)
    free = dymsum.robustness_of_free(unit, unit, (4, 5))
    assert free.holds and free.squared == Fraction(25, 4) and free.radius == 2.5
    assert free.ways[0].contacts[0].p.index == 2
    fit = dymsum.robustness_of_fit(shapes.rectangle(0, 0, 10, 6), unit, (Fraction(1, 3), 2))
    assert fit.squared == Fraction(1, 36)
    best = dymsum.most_robust_fit(shapes.rectangle(0, 0, 10, 6), unit)
    assert best.fits and best.exact and best.radius == best.at_most == 1.25
    rows = dymsum.fit_stack(shapes.rectangle(0, 0, 10, 6), [Tolerance(0.5, 0)], unit, [Tolerance(0, -0.25)], (3, 1)).rows
    assert [(row.nominal, row.least, row.most) for row in rows] == [(1, 1, 1.75), (3, 3, 3.75), (4, 4, 4.75), (6, 6, 6.75)]
    with pytest.raises(ValueError):
        dymsum.robustness_of_free(unit, unit, (float("nan"), 0))


def test_solids_have_pairs_and_three_valued_answers() -> None:
    box = dymsum.solids.box
    slot = box(0, 0, 0, 4, 4, 4)
    pegs = dymsum.UncertainSolid.of_variants([box(0, 0, 0, 4, 1, 1), box(0, 0, 0, 4.5, 1, 1)])
    assert pegs.inner.volume_exact() == 4 and pegs.outer.volume_exact() == Fraction(9, 2)
    assert pegs.doubtful().volume_exact() == Fraction(1, 2) and len(pegs.variants) == 2
    fit = dymsum.fits_anywhere(slot, pegs)
    assert isinstance(fit, dymsum.UncertainSolidFit) and fit.answer.holds is Holds.for_some and fit.common is None
    assert (fit.answer.yes.q, fit.answer.no.q) == (0, 1)
    assert dymsum.fits_at(slot, pegs, (0, Fraction(1, 3), 0)).holds is Holds.for_some
    assert dymsum.fits_at(slot, pegs, (1, 0, 0)).holds is Holds.for_none
    assert dymsum.collides(slot, pegs, (4, 0, 0)).holds is Holds.for_none
    assert dymsum.contains(slot, pegs, (8.25, 0, 0)).holds is Holds.for_some
    bounds = dymsum.clearance(slot, pegs, (-4.75, 0, 0))
    assert (bounds.least_signed(), bounds.most_signed()) == (0.25, 0.75)
    total = dymsum.minkowski_sum(pegs, box(0, 0, 0, 1, 1, 1))
    assert isinstance(total, dymsum.UncertainSolid)
    assert total.inner.volume_exact() == 20 and total.outer.volume_exact() == 22
    assert dymsum.difference(slot, pegs).inner.volume_exact() == 60
    # A mesh of another package is taken, and a position that is not finite is refused.
    with pytest.raises(ValueError, match="not finite"):
        dymsum.collides(slot, pegs, (float("nan"), 0, 0))


def test_solids_come_from_bands_boxes_and_rounding() -> None:
    cube = dymsum.solids.box(0, 0, 0, 1, 1, 1)
    band = dymsum.UncertainSolid.of_band(cube, Tolerance(0.25, -0.25), within=0.03125)
    assert band.error == 0.03125 and band.inner.volume() < 1 < band.outer.volume()
    zones = dymsum.UncertainSolid.of_boxes(cube, [(*v, *v) for v in cube.vertices])
    assert zones.exact()
    rounded = dymsum.UncertainSolid.of_rounding(cube)
    assert not rounded.exact() and repr(rounded) == "UncertainSolid(between two sets)"
    both = dymsum.UncertainSolid.between(band.inner, band.outer)
    assert both.outer == band.outer
    with pytest.raises(dymsum.Error, match="does not lie in"):
        dymsum.UncertainSolid.between(dymsum.solids.box(5, 0, 0, 6, 1, 1), cube)
