"""What a growing disc sees: the bars of a comb, bridges, and pieces that tile exactly."""

from __future__ import annotations

import math
import pickle
import re
from fractions import Fraction
from typing import Any

import pytest
import shapely

import dymsum
from dymsum import Cut, DecomposeOptions, ErrorCode, FeatureBar, FeatureOptions, ShapeFeatures, decompose, shapes

#: Five teeth: four notches of width 1 and depth 3.
COMB = shapes.comb(5, 2, 1, 3)
ROUGH = shapes.random_polygon(60, 2, 7)


def twice_area_of(rings: Any) -> Fraction:
    return sum((dymsum.twice_area([(x, y) for x, y in ring]) for ring in rings), Fraction(0))


def rings_of(region: dymsum.Region) -> list[Any]:
    return [ring for part in region.parts for ring in (part.outer, *part.holes)]


def test_the_barcode_of_a_comb() -> None:
    features = ShapeFeatures(COMB)
    bars = features.bars()
    assert [bar.died for bar in bars] == [FeatureBar.Death.never, FeatureBar.Death.merged] * 4
    assert all(bar.born == FeatureBar.Birth.corner and bar.vertex == bar.minimum for bar in bars)
    assert [features.event_text(event) for event in range(features.event_count())] == ["0", "1"]
    assert [(bar.birth_alpha, bar.death_alpha) for bar in bars] == [(0, math.inf), (0, 1)] * 4
    assert [bar.parent for bar in bars if bar.parent is not None] == [0, 2, 4, 6] and bars[0].concavity == 3
    assert features.lasting(0) == features.lasting(1) == [0, 2, 4, 6, 1, 3, 5, 7]
    assert features.lasting(Fraction(1001, 1000)) == [0, 2, 4, 6]
    assert features.lasting(1, from_=Fraction(1, 1000)) == [0, 2, 4, 6]
    assert features.lasting(5, 0, 5) == [0, 2, 4, 6] and features.lasting(6, 0, 5) == []


def test_bridges_of_a_comb() -> None:
    features = ShapeFeatures(COMB)
    assert [bridge.length for bridge in features.bridges(0)] == [0] * 8
    assert len(features.bridges(Fraction(1, 2))) == 8 and len(features.bridges(Fraction(3, 2))) == 4
    above = features.bridges(1000)
    assert [bridge.length for bridge in above] == [1] * 4 and not any(bridge.gap for bridge in above)
    assert all(bridge.from_.at_vertex and bridge.from_.at.y == bridge.to.at.y == 3 for bridge in above)
    assert {bridge.bar for bridge in above} == {0, 2, 4, 6} and {bridge.pocket_size for bridge in above} == {2}


def test_features_are_pickled_and_drawn() -> None:
    options = FeatureOptions(dymsum.Concavity.hybrid2, hybrid_tolerance=0.5, threads=1)
    features = ShapeFeatures(ROUGH, options)
    again = pickle.loads(pickle.dumps(features))
    assert again.bars() == features.bars() and again.region() == ROUGH
    assert again.options().concavity == dymsum.Concavity.hybrid2 and again.options().hybrid_tolerance == 0.5
    assert features._repr_svg_().count("<rect") == len(features.bars())
    assert ShapeFeatures.create(ROUGH, options).bars() == features.bars()
    assert pickle.loads(pickle.dumps(features.bars()[0])) == features.bars()[0]
    assert "<svg" in ShapeFeatures("LINESTRING(0 0, 1 0)")._repr_svg_()


@pytest.mark.parametrize("region", [COMB, ROUGH, shapes.pockets(4, 1), shapes.star(7, 1, 2)])
@pytest.mark.parametrize("persistence", [0, Fraction(1, 10), 100])
def test_pieces_tile_exactly(region: dymsum.Region, persistence: Fraction) -> None:
    made = decompose(ShapeFeatures(region), DecomposeOptions(persistence))
    pieces = [twice_area_of([piece.outer, *piece.holes]) for piece in made.pieces]
    assert min(pieces) > 0 and sum(pieces) == twice_area_of(rings_of(region))
    assert all(isinstance(x, Fraction) for x in made.pieces[0].outer[0])
    polygons = made.to_shapely()
    assert shapely.union_all(polygons, grid_size=1e-12).area == pytest.approx(dymsum.area(region))
    assert [dymsum.Region(p) for p in polygons] == dymsum.rounded(made)
    assert made.pieces[0].to_shapely().equals(polygons[0])


def test_cuts() -> None:
    features = ShapeFeatures(ROUGH)
    fine, coarse = decompose(features), decompose(features, DecomposeOptions(persistence=Fraction(1, 5)))
    assert 0 < len(coarse.cuts) < len(fine.cuts) and fine.cuts[: len(coarse.cuts)] == coarse.cuts
    assert {cut.end for cut in fine.cuts} == {Cut.End.vertex, Cut.End.edge, Cut.End.cut}
    vertices = [tuple(point) for ring in rings_of(ROUGH) for point in ring]
    assert all(vertices[cut.vertex] == tuple(map(float, cut.from_)) for cut in fine.cuts)
    assert len(decompose(ShapeFeatures(COMB)).pieces) == 6, "five teeth and what holds them: a cut resolves two notches"
    holed = "POLYGON((0 0,10 0,10 10,0 10,0 0),(2 1,2 4,3 4,3 5,5 5,5 1,2 1))"
    opened = decompose(ShapeFeatures(holed), DecomposeOptions(1.5))
    assert [cut.partner for cut in opened.cuts] == [False, True] and len(opened.pieces) == 2
    assert [made.region for made in dymsum.rounded_with_repair(opened)] == dymsum.rounded(opened)
    passing = "POLYGON((0 0,60 0,60 40,32 40,30 20,28 40,0 40,0 0),(26 4,30 12,34 4,26 4))"
    (over,) = decompose(ShapeFeatures(passing), DecomposeOptions(5)).cuts
    assert over.runs == [[(30, 20), (30, 12)], [(30, 4), (30, 0)]]
    again = pickle.loads(pickle.dumps(fine))
    assert again.cuts == fine.cuts and again.pieces == fine.pieces and again._repr_svg_() == fine._repr_svg_()
    assert fine._repr_svg_().count("<path") == len(fine.pieces) + len(fine.cuts)


@pytest.mark.parametrize("region", [shapes.comb(12, 2, 1, 3), ROUGH, shapes.pockets(4, 1), shapes.star(17, 1, 2)])
def test_neighbouring_pieces_are_drawn_in_different_colours(region: dymsum.Region) -> None:
    made = decompose(ShapeFeatures(region))
    colours = dymsum.piece_colours(made)
    drawn = re.findall('fill="(#[0-9a-f]+)" fill-rule', made._repr_svg_())
    assert len(drawn) == len(colours) == len(made.pieces) and len(set(drawn)) == max(colours) + 1 <= 6
    assert len(set(zip(colours, drawn, strict=True))) == max(colours) + 1, "a number is a colour"
    edges: dict[tuple[object, object], int] = {}
    for index, piece in enumerate(made.pieces):
        for ring in (piece.outer, *piece.holes):
            edges.update({(ring[k - 1], ring[k]): index for k in range(len(ring))})
    neighbours = [(index, edges[b, a]) for (a, b), index in edges.items() if (b, a) in edges]
    assert len(neighbours) >= 2 * len(made.cuts) and all(drawn[i] != drawn[j] for i, j in neighbours)


def test_options_can_be_changed() -> None:
    options = DecomposeOptions(Fraction(1, 3), alpha_to=2)
    assert (options.persistence, options.alpha_from, options.alpha_to) == (Fraction(1, 3), 0, 2)
    options.alpha_to = None
    options.persistence = 0.5
    again = pickle.loads(pickle.dumps(options))
    assert (again.persistence, again.alpha_to) == (Fraction(1, 2), None)


@pytest.mark.parametrize(
    ("work", "code"),
    [
        (lambda: ShapeFeatures(dymsum.Region()), ErrorCode.unsupported_operand),
        (lambda: ShapeFeatures(COMB, FeatureOptions(hybrid_tolerance=-1)), ErrorCode.out_of_range),
        (lambda: ShapeFeatures(COMB, FeatureOptions(hybrid_tolerance=math.nan)), ErrorCode.out_of_range),
        (lambda: ShapeFeatures(COMB).bridges(-1), ErrorCode.out_of_range),
        (lambda: decompose(ShapeFeatures("LINESTRING(0 0, 1 0)")), ErrorCode.unsupported_operand),
        (lambda: decompose(ShapeFeatures(COMB), DecomposeOptions(-1)), ErrorCode.out_of_range),
        (lambda: decompose(ShapeFeatures(COMB), DecomposeOptions(0, 2, 1)), ErrorCode.out_of_range),
    ],
)
def test_errors(work: Any, code: ErrorCode) -> None:
    with pytest.raises(dymsum.Error) as raised:
        work()
    assert raised.value.code == code


def test_events_that_there_are_not() -> None:
    features = ShapeFeatures(COMB)
    for ask in (features.event_alpha, features.event_text):
        with pytest.raises(IndexError):
            ask(features.event_count())
    with pytest.raises(dymsum.Error) as raised:
        features.bridges(math.nan)
    assert raised.value.code == ErrorCode.not_finite


def test_significant_bars_are_as_deep_as_they_last() -> None:
    features = ShapeFeatures(COMB)
    assert features.significant(0) == features.lasting(0)
    assert features.significant(3) == [0, 2, 4, 6] and features.significant(Fraction(301, 100)) == []
    assert features.lasting(Fraction(301, 100)) == [0, 2, 4, 6], "they last for ever, and are 3 deep"
    assert features.significant(2, from_=1, to=4) == [0, 2, 4, 6] and features.significant(3, 1, 3) == []


@pytest.mark.parametrize(
    "crossing", ["MULTILINESTRING((0 0, 2 2), (0 2, 2 0))", "MULTILINESTRING((0 0, 2 0), (1 0, 3 0))"]
)
def test_polylines_that_cross_are_refused(crossing: str) -> None:
    with pytest.raises(dymsum.Error) as raised:
        ShapeFeatures(crossing)
    assert raised.value.code == ErrorCode.unsupported_operand
