"""Penetration depth from Python: the values of the library, arrays of translations, errors."""

from __future__ import annotations

import copy
import pickle
from fractions import Fraction

import numpy
import pytest

import dymsum
from dymsum import Meeting, shapes, solids

BOX = solids.box(-1, -1, -1, 1, 1, 1)
ANGLE = solids.prism([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)], 1.0)
MOVES = numpy.random.default_rng(3).uniform(-2, 4, (60, 3))


def test_cubes_that_overlap_by_a_half() -> None:
    found = dymsum.SolidDepth(BOX, BOX).at((1.5, 0, 0))
    assert found.meeting == Meeting.overlapping
    assert (found.squared, found.distance, found.complete, found.at_least) == (Fraction(1, 4), 0.5, True, 0.5)
    (way,) = found.ways
    assert way.move == (Fraction(1, 2), 0, 0) and way.direction == (1, 0, 0)
    assert dymsum.SolidFeature.Kind.face in [contact.q.kind for contact in way.contacts]
    assert found.work.facets > 0
    assert len(dymsum.SolidDepth(BOX, BOX).at().ways) == 6
    assert dymsum.SolidDepth(BOX, BOX).at((2, 0, 0)).meeting == Meeting.touching


def test_both_engines_agree_in_everything() -> None:
    search = dymsum.SolidDepth(ANGLE, BOX)
    boundary = dymsum.SolidDepth(ANGLE, BOX, dymsum.DepthOptions(engine=dymsum.DepthEngine.boundary))
    for move in MOVES[:20]:
        assert search.at(move) == boundary.at(move)
    assert search.facet_count() > 0


def test_arrays_of_translations_are_rows_in_their_order() -> None:
    pair = dymsum.SolidDepth(ANGLE, BOX)
    alone = [pair.at(move) for move in MOVES]
    for threads in (1, 3):
        assert dymsum.depth_batch(pair, MOVES, dymsum.DepthBatchOptions(threads=threads)) == alone
    assert dymsum.depth_batch(pair, MOVES.tolist()) == alone
    assert dymsum.depth_batch(pair, numpy.asfortranarray(MOVES)[::2]) == alone[::2]
    assert dymsum.depth_batch(pair, numpy.zeros((0, 3))) == []
    rows = dymsum.depth_batch_arrays(pair, MOVES)
    assert rows.distance.tolist() == [row.distance for row in alone]
    assert [Meeting(m) for m in rows.meeting.tolist()] == [row.meeting for row in alone]
    assert [tuple(d) for d in rows.direction.tolist()] == [tuple(row.ways[0].direction) for row in alone]
    assert rows.ways.tolist() == [len(row.ways) for row in alone]
    assert rows.complete.all() and (rows.at_least == rows.distance).all()
    assert len(set(rows.meeting.tolist())) > 1


def test_what_is_wrong_with_translations_is_raised() -> None:
    pair = dymsum.SolidDepth(ANGLE, BOX)
    bad = MOVES.copy()
    bad[7, 1] = numpy.nan
    with pytest.raises(dymsum.Error) as raised:
        dymsum.depth_batch(pair, bad)
    assert raised.value.code == dymsum.ErrorCode.not_finite and raised.value.vertex == 7
    with pytest.raises(TypeError):
        dymsum.depth_batch(pair, numpy.zeros((4, 2)))  # type: ignore[call-overload]
    with pytest.raises(dymsum.Error):
        dymsum.depth_batch(pair, MOVES, dymsum.DepthBatchOptions(threads=-1))
    for move, limit in (((numpy.inf, 0, 0), 0.0), ((0, 0, 0), -1.0)):
        with pytest.raises(ValueError):
            pair.at(move, limit)
    with pytest.raises(ValueError):
        pair.along((0, 0, 0), (0, 0, 0))
    with pytest.raises(dymsum.Error) as empty:
        dymsum.SolidDepth(BOX, dymsum.Mesh())
    assert empty.value.code == dymsum.ErrorCode.no_area


def test_many_pairs() -> None:
    questions = [dymsum.DepthQuestion(ANGLE, BOX, move) for move in MOVES[:5]]
    pair = dymsum.SolidDepth(ANGLE, BOX)
    assert dymsum.depth_batch(questions) == [pair.at(move) for move in MOVES[:5]]
    questions.insert(2, dymsum.DepthQuestion(BOX, dymsum.Mesh()))
    with pytest.raises(dymsum.Error):
        dymsum.depth_batch(questions)
    rows = dymsum.depth_batch(questions, return_errors=True)
    assert isinstance(rows[2], dymsum.Error) and rows[2].code == dymsum.ErrorCode.no_area
    assert rows[3] == pair.at(MOVES[2])
    kept = pickle.loads(pickle.dumps(questions[0]))
    assert kept.q_moved_by == questions[0].q_moved_by and kept.p == ANGLE


def test_a_limit_of_time_leaves_bounds() -> None:
    found = dymsum.SolidDepth(ANGLE, ANGLE).at((0.25, 0.5, 0), time_limit=1e-12)
    assert not found.complete and found.ways == [] and 0 <= found.at_least <= found.distance


def test_along_a_direction() -> None:
    assert dymsum.SolidDepth(BOX, BOX).along((1.5, 0, 0), (0, 0, 2)) == 1


def test_translations_may_be_fractions() -> None:
    third = Fraction(1, 3)
    pair = dymsum.SolidDepth(BOX, BOX)
    found = pair.at((4 * third, 0, 0))
    assert found.squared == Fraction(4, 9) and found.ways[0].move == (Fraction(2, 3), 0, 0)
    assert pair.along((third, 0, 0), (third, 0, 0)) == 5
    assert dymsum.depth_batch(pair, [(4 * third, 0, 0)]) == [found]
    assert dymsum.depth_batch_arrays(pair, [(4 * third, 0, 0)]).ways.tolist() == [1]
    square = shapes.rectangle(0, 0, 1, 1)
    assert dymsum.PlanarDepth(square, square).at((third, 0)).squared == (1 - third) ** 2
    assert dymsum.PlanarDepth(square, "POINT(0 0)").at((third, Fraction(1, 2))).distance == float(third)
    room = shapes.rectangle(0, 0, 2, 2)
    assert dymsum.fit_range(square, room, (third, third)).free[0].high == 2 - third
    with pytest.raises(ValueError):
        pair.at((third, numpy.nan, 0))


def test_planar_regions() -> None:
    slot, peg = shapes.letter_u(4, 4, 1), shapes.rectangle(0, 0, 2, 1)
    depth = dymsum.PlanarDepth(slot, peg)
    assert depth.at((1, 2)).meeting == Meeting.touching
    found = depth.at((1.25, 2))
    assert (found.meeting, found.squared) == (Meeting.overlapping, Fraction(1, 16))
    assert found.ways[0].move == (Fraction(-1, 4), 0) and found.ways[0].contacts
    touch = found.ways[0].contacts[0]
    assert touch.dimension == 1 and touch.p.kind == touch.q.kind == dymsum.PlanarFeature.Kind.edge
    assert pickle.loads(pickle.dumps(depth)).at((1.25, 2)).squared == Fraction(1, 16)
    with pytest.raises(ValueError):
        depth.at((numpy.nan, 0))
    with pytest.raises(dymsum.Error):
        dymsum.PlanarDepth(slot, dymsum.Region())


def test_pickled_and_copied() -> None:
    pair = dymsum.SolidDepth(ANGLE, BOX, dymsum.DepthOptions(threads=1, progress=lambda stage, share: None))
    found = pair.at((0.5, 0.5, 0.25))
    assert pickle.loads(pickle.dumps(found)) == found
    for again in (pickle.loads(pickle.dumps(pair)), copy.copy(pair)):
        assert again.at((0.5, 0.5, 0.25)) == found and again.options.threads == 1


def test_contacts_are_all_pairs_that_touch() -> None:
    small = dymsum.solids.box(0, 0, 0, 0.25, 0.25, 0.25)
    large = dymsum.solids.box(0, 0, 0, 5, 5, 5)
    contacts = dymsum.SolidDepth(large, small).at((2, 2, 4.9375)).ways[0].contacts
    assert [c.dimension for c in contacts] == [2] + 4 * [1] + 4 * [0]
    assert all(isinstance(c, dymsum.SolidTouch) and c.at.z == 5 and c.patch == 0 for c in contacts)
    assert contacts[0].p.kind == contacts[0].q.kind == dymsum.SolidFeature.Kind.face


def test_a_point_in_a_solid() -> None:
    point = dymsum.Mesh.with_thin_parts(dymsum.MeshData([(0, 0, 0)], [(0,)]))
    found = dymsum.SolidDepth(BOX, point).at((0.75, 0, 0))
    assert found.squared == Fraction(1, 16) and len(found.ways) == 1
