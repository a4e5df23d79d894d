"""Discs of any radius: areas against shapely's buffers and Steiner's formula, events, polygons, errors."""

from __future__ import annotations

import json
import math
import pickle
import threading
from fractions import Fraction
from typing import Any

import numpy
import pytest

import dymsum
from dymsum import DiscBound, DiscRadius, DiscSet, DiscSide, ErrorCode, GrowingDisc, Semantics, shapes

SLOT = shapes.letter_u(4, 4, 1)
#: Discs of radius 1 about these do not meet, but polygons about the discs.
NEAR = GrowingDisc("MULTIPOINT(0 0, 2.02 0)")
#: Chords a quarter of a circle of shapely's buffers. They lie in the circle of R, and about that of R cos(pi / 4 Q).
QUARTER = 64
INNER = math.cos(math.pi / (4 * QUARTER))


@pytest.mark.parametrize("region", [shapes.gear(8, 2, 3), shapes.grate(4, 2, 1, 6), shapes.random_polygon(40, 2, 3)])
@pytest.mark.parametrize("radius", [0.0625, 0.2])
def test_areas_lie_about_those_of_buffers(region: dymsum.Region, radius: float) -> None:
    disc = GrowingDisc(region)
    for sign, made in ((1, disc.sum_at), (-1, disc.eroded_at)):
        buffered = region.to_shapely().buffer(sign * radius, quad_segs=QUARTER).area
        small, large = sorted((dymsum.area(made(radius * INNER)), dymsum.area(made(radius))), key=lambda a: a.value)
        assert small.value + small.error < buffered < large.value - large.error


@pytest.mark.parametrize("radius", [Fraction(1, 1000), 1, 7.5, Fraction(10**9, 3)])
def test_steiners_formula(radius: Fraction) -> None:
    triangle = GrowingDisc([(0, 0), (4, 0), (0, 3)])  # of area 6 and perimeter 12
    grown, r = triangle.sum_at(radius), float(radius)
    area, around = dymsum.area(grown), dymsum.perimeter(grown)
    assert abs(area.value - (6 + 12 * r + math.pi * r**2)) <= area.error < 1e-9 * area.value
    assert abs(around.value - (12 + 2 * math.pi * r)) <= around.error < 1e-9 * around.value
    assert numpy.allclose(dymsum.bounds(grown), [-r, -r, 4 + r, 3 + r], rtol=0, atol=2 * grown.at_error)


def test_openings_and_closings_lie_about_the_region() -> None:
    region = shapes.star(7, 1, 2)
    disc = GrowingDisc(region)
    opened, closed = dymsum.area(disc.opened_at(0.25)), dymsum.area(disc.closed_at(0.25))
    assert opened.value + opened.error < dymsum.area(region) < closed.value - closed.error
    assert dymsum.to_region(disc.sum_at(0), 1).region == region


def test_polygons_on_either_side_are_there_where_discs_nearly_meet() -> None:
    inside = dymsum.to_region(NEAR.sum_at(1), 0.3, DiscBound.inside).region
    outside = dymsum.to_region(NEAR.sum_at(1), 0.3, DiscBound.outside).region
    assert dymsum.area(inside) < 2 * math.pi < dymsum.area(outside)


def test_events_and_the_sets_at_and_between_them() -> None:
    disc = GrowingDisc(SLOT)
    (event,) = disc.events(DiscSide.outside)
    assert event.radius == 1 and event.nodes == 2
    at = disc.sum_at(DiscRadius.at_event(0), Semantics.open)
    assert (at.radius_exact, len(at.tight_segments), at.tight_segments[0].from_.at.x) == ("1", 1, 2)
    assert at.to_json() == disc.sum_at(1, Semantics.open).to_json()
    kinds = [[piece.of for piece in disc.sum_at(r).parts[0].outer.pieces] for r in (0.25, 0.5, 1, 1.5)]
    assert kinds[0] == kinds[1] != kinds[2] and kinds[0] != kinds[3]
    star = GrowingDisc(shapes.star(5, 1, 2, shapes.demo_snap(2)))
    radii = [event.radius for event in star.events(DiscSide.inside)]
    assert radii == sorted(set(radii)) and "sqrt" in star.eroded_at(DiscRadius.at_event(0)).radius_exact


def test_rings_have_their_pieces_and_corners() -> None:
    grown = GrowingDisc(shapes.rectangle(0, 0, 2, 1)).sum_at(1)
    outer = grown.parts[0].outer
    assert len(outer) == grown.piece_count() == 8 and not outer.at.flags.writeable
    assert outer.at.tolist() == [list(piece.from_.at) for piece in outer.pieces]
    arcs = [piece for piece in outer.pieces if piece.of == dymsum.DiscPiece.Of.vertex]
    assert {tuple(arc.centre) for arc in arcs} == {(0, 1), (0, 0), (2, 0), (2, 1)}
    assert sum(arc.sweep for arc in arcs) == pytest.approx(2 * math.pi)
    view = GrowingDisc(SLOT).sum_at(0.5).parts[0].outer.at  # its set is kept
    assert view.shape == (14, 2) and numpy.isfinite(view).all()


@pytest.mark.parametrize("error", [0.1, 1e-3, 1e-6])
def test_polygons_lie_within_and_about(error: float) -> None:
    grown = GrowingDisc(SLOT).sum_at(Fraction(3, 4))
    inner, outer = dymsum.to_region(grown, error), dymsum.to_region(grown, error, DiscBound.outside)
    assert dymsum.area(inner.region) < dymsum.area(grown).value < dymsum.area(outer.region)
    around = dymsum.perimeter(grown).value
    assert dymsum.area(outer.region) - dymsum.area(inner.region) < 2 * error * around
    assert inner.error <= error and inner.chords > 0
    assert dymsum.Region(grown.to_shapely(error)) == inner.region
    assert grown.to_shapely(bound=DiscBound.outside).area > dymsum.area(grown).value


def test_sets_are_pickled_and_drawn() -> None:
    disc = pickle.loads(pickle.dumps(GrowingDisc(SLOT, dymsum.GrowingDiscOptions(brute=True))))
    assert disc.region() == SLOT and repr(disc) == "<GrowingDisc of <Region: 1 parts, 0 holes, 8 vertices>>"
    made = disc.eroded_at(0.5)
    again = pickle.loads(pickle.dumps(made))
    assert isinstance(again, DiscSet) and again.region == SLOT
    assert again.to_json() == made.to_json() == dymsum.disc_set_to_json(GrowingDisc(SLOT).eroded_at(0.5))
    assert json.loads(made.to_json())["radius_exact"] == "1/2"
    assert made._repr_svg_() == dymsum.draw_disc_set(SLOT, again) and "<svg" in made._repr_svg_()
    for radius in (DiscRadius(Fraction(1, 3)), DiscRadius.at_event(2)):
        assert pickle.loads(pickle.dumps(radius)) == radius
    assert repr(DiscRadius(1)) == "DiscRadius(Fraction(1, 1))"
    assert repr(DiscRadius.at_event(2)) == "DiscRadius.at_event(2)"
    assert DiscRadius(1) != DiscRadius.at_event(0) and DiscRadius.at_event(4).event == 4


def test_a_disc_is_shared_by_threads() -> None:
    region = shapes.random_polygon(300, 3, 5)
    expected = [GrowingDisc(region).sum_at(Fraction(k, 50)).to_json() for k in range(4)]
    disc, answers = GrowingDisc(region), [""] * 4

    def work(k: int) -> None:
        answers[k] = disc.sum_at(Fraction(k, 50)).to_json()

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert answers == expected


@pytest.mark.parametrize(
    ("work", "code"),
    [
        (lambda: GrowingDisc(SLOT).sum_at(-1), ErrorCode.out_of_range),
        (lambda: GrowingDisc(SLOT).sum_at(math.nan), ErrorCode.not_finite),
        (lambda: DiscRadius(math.inf), ErrorCode.not_finite),
        (lambda: GrowingDisc(SLOT).closed_at(DiscRadius.at_event(1)), ErrorCode.out_of_range),
        (lambda: GrowingDisc("MULTILINESTRING((0 0, 1 1), (0 1, 1 0))").closed_at(1), ErrorCode.unsupported_operand),
        (lambda: GrowingDisc([(0, 0), (1, 1), (1, 0), (0, 1)]), ErrorCode.self_crossing),
        (lambda: dymsum.to_region(GrowingDisc(SLOT).sum_at(1), 0), ErrorCode.out_of_range),
        (lambda: dymsum.to_region(GrowingDisc(SLOT).sum_at(1), 1e-30), ErrorCode.out_of_range),
    ],
)
def test_errors(work: Any, code: ErrorCode) -> None:
    with pytest.raises(dymsum.Error) as raised:
        work()
    assert raised.value.code == code


def test_the_closing_of_a_line_keeps_it() -> None:
    closed = GrowingDisc("LINESTRING(3 0, 0 0, 0 3)").closed_at(1)
    assert len(closed.parts) == 1 and len(closed.segments) == 2
    assert dymsum.to_region(closed, 0.01, DiscBound.nearest).region.polylines
    assert GrowingDisc("LINESTRING(3 0, 0 0, 0 3)").opened_at(1).parts == []
    left = GrowingDisc(shapes.rectangle(0, 0, 2, 2)).eroded_at(1 - Fraction(1, 10**16))
    tiny = dymsum.to_region(left, 0.1, DiscBound.nearest)
    assert tiny.collapsed == 1 and tiny.region.points.tolist() == [[1, 1]]


@pytest.mark.parametrize("radius", [None, "1", 1j, (1,)])
def test_what_is_no_radius_is_a_type_error(radius: Any) -> None:
    with pytest.raises(TypeError):
        GrowingDisc(SLOT).sum_at(radius)
