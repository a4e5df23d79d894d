"""Planar sums, standing and moving."""

from __future__ import annotations

import copy
import pickle
from fractions import Fraction
from pathlib import Path

import numpy
import pytest
import shapely

import dymsum
from dymsum import Engine, ErrorCode, Orientation, PlanarSum, Region, Scale, Semantics, SumOptions, shapes


def test_engines_and_semantics() -> None:
    p, q = shapes.gear(9, 3, 4), shapes.star(5, 0.5, 1)
    sums = [dymsum.minkowski_sum(p, q, SumOptions(engine=e)) for e in (Engine.fast, Engine.brute, Engine.winding)]
    assert sums[0] == sums[1] == sums[2]
    assert dymsum.nfp(p, dymsum.negated(q)) == sums[0]
    peg = dymsum.nfp(shapes.letter_u(4, 4, 1), shapes.rectangle(0, 0, 2, 1), SumOptions(semantics=Semantics.regular))
    assert not peg.tight_segments


def test_a_limit_of_memory_is_kept_or_said() -> None:
    p, q = shapes.comb(30, 2, 1, 40), dymsum.rotated_sum(shapes.comb(24, 3, 1, 50), "POINT (0 0)", Orientation.of(1, 1))
    turned = q.rounded()
    free = dymsum.minkowski_sum(p, turned)
    assert dymsum.minkowski_sum(p, turned, SumOptions(memory=10**9)) == free
    for limited in (
        lambda: dymsum.minkowski_sum(p, turned, SumOptions(memory=1000)),
        lambda: dymsum.ScalingSum(p, turned, dymsum.MovingOptions(memory=1000)),
        lambda: dymsum.CspaceObstacle(shapes.star(9, 1, 2), shapes.star(7, 2, 3), dymsum.ObstacleOptions(memory=1000)),
    ):
        with pytest.raises(dymsum.Error, match="the limit is 1000 bytes") as refused:
            limited()
        assert refused.value.code == ErrorCode.out_of_memory


def test_round_shapes_are_nearest_doubles_unless_they_are_snapped() -> None:
    x, y = shapes.disc(8, 1).parts[0].outer[1]
    assert (x, y) == (2**-0.5, 2**-0.5) or abs(x - 2**-0.5) < 2**-52
    snapped = shapes.gear(9, 3, 4, snap=shapes.demo_snap(4)).parts[0].outer
    assert all((v * 2**21).is_integer() for v in numpy.asarray(snapped).ravel().tolist())
    assert any(not (v * 2**21).is_integer() for v in numpy.asarray(shapes.gear(9, 3, 4).parts[0].outer).ravel().tolist())
    with pytest.raises(ValueError):
        shapes.star(5, 1, 2, snap=0.3)


def test_fields_of_a_sum() -> None:
    sum = dymsum.minkowski_sum(shapes.disc(7, 1), shapes.disc(5, 2), SumOptions(trace=True))
    ring = sum.parts[0].outer
    assert len(ring) == len(ring.vertices) == ring.at.shape[0]
    for k, vertex in enumerate(ring.vertices):
        exact = sum.exact(vertex)
        assert abs(float(exact.x) - ring.at[k][0]) <= 2 * sum.at_error + 1e-15
        assert vertex.at == tuple(ring.at[k])
        assert vertex.out.kind in (dymsum.Contact.Kind.edge_of_p, dymsum.Contact.Kind.edge_of_q)
    assert sum.trace is not None and sum.trace.convolution
    assert isinstance(sum.area_exact(), Fraction) and float(sum.area_exact()) == sum.area()
    assert sum.area_exact_within(1) is None or sum.area_exact_within(1) == sum.area_exact()
    assert shapely.area(sum.to_shapely()) == pytest.approx(sum.area())


def test_views_of_a_sum_outlive_it() -> None:
    at = dymsum.minkowski_sum(shapes.disc(9, 1), shapes.disc(9, 2)).parts[0].outer.at
    assert numpy.all(numpy.abs(at) <= 3.0001)


def test_union_and_rotation() -> None:
    two = dymsum.union_of([shapes.rectangle(0, 0, 2, 2), "POLYGON((1 1, 3 1, 3 3, 1 3, 1 1))"])
    assert two.area_exact() == 7
    unit = shapes.rectangle(0, 0, 1, 1)
    turned = dymsum.rotated_sum(unit, unit, Orientation.of(1, 1))
    assert turned.rounded() == shapes.rectangle(-1, 0, 1, 2)


def test_cancelled_by_progress() -> None:
    with pytest.raises(dymsum.Error) as raised:
        dymsum.minkowski_sum(
            shapes.random_polygon(400, 2, 1), shapes.random_polygon(400, 2, 2), SumOptions(progress=lambda s, f: False)
        )
    assert raised.value.code == ErrorCode.cancelled


def test_a_progress_that_raises() -> None:
    def fail(stage: str, share: float) -> None:
        raise KeyError(stage)

    with pytest.raises(KeyError):
        dymsum.minkowski_sum(shapes.random_polygon(400, 2, 1), shapes.gear(9, 1, 2), SumOptions(progress=fail))


def test_scaling_follows() -> None:
    snap = shapes.demo_snap(3)  # so that scales by these factors are not rounded
    star, gear = shapes.star(5, 1, 2, snap), shapes.gear(6, 2, 3, snap)
    sum = dymsum.ScalingSum(star, gear)
    for s in (1.0, 1.25, 1.5, Fraction(7, 5)):
        sum.set(s)
        if float(s) in (1.0, 1.25, 1.5):
            assert sum.sum() == dymsum.minkowski_sum(dymsum.scaled(star, float(s), float(s)), gear)
    assert sum.scale() == Scale(Fraction(7, 5)) and hash(sum.scale()) == hash(Scale(Fraction(7, 5)))
    sum.set(2, 0.5)
    assert sum.sum() == dymsum.minkowski_sum(dymsum.scaled(star, 2, 0.5), gear)
    again = pickle.loads(pickle.dumps(sum))
    assert again.sum() == sum.sum()
    with pytest.raises(dymsum.Error):
        sum.set(-1)
    assert len(sum.ring_ids()) == sum.sum().hole_count() + len(sum.sum().parts)
    events = dymsum.ScalingSum(star, gear).events(1, 2)
    assert [e.s for e in events] == sorted(e.s for e in events) and len(events) > 3
    first = dymsum.ScalingSum(star, gear).next_event(1, 2)
    assert first is not None and first.s == next(e.s for e in events if e.visible and e.s > 1)


def test_families_of_scales(tmp_path: Path) -> None:
    star, gear = shapes.star(5, 1, 2), shapes.gear(6, 2, 3)
    family = dymsum.ScalingFamily(star, gear, Fraction(1, 2), 2)
    moving = dymsum.ScalingSum(star, gear)
    for s in [Fraction(1, 2), Fraction(7, 5), *(e.s for e in family.events())]:
        moving.set(s)
        assert family.at(s) == moving.sum()
    assert family.changes(1, 2) == [e for e in family.events() if e.visible and e.s >= 1]
    assert len(family.ring_ids(1)) == len(family.at(1).parts) + family.at(1).hole_count() and all(family.ring_ids(Fraction(7, 5)))
    first = family.next(1)
    assert first == moving.next_event(1, 2) and family.locate(first.s).event and not family.locate(2).event
    assert {life.feature for life in family.lifetimes()} >= {dymsum.FamilyFeature.vertex, dymsum.FamilyFeature.edge}
    assert family.work().cells == len(family.events()) + 1 and (family.low().approx(), family.high().approx()) == (0.5, 2)
    assert family.inner(1, 2) == family.at(1) and family.outer(1, 2) == family.at(2)  # both are round the origin
    dymsum.write_file(tmp_path / "x.family.gz", dymsum.format_family(family))
    for again in (dymsum.read_family(tmp_path / "x.family.gz"), pickle.loads(pickle.dumps(family))):
        assert dymsum.format_family(again) == dymsum.format_family(family) and again.at(1.25) == family.at(1.25)
    tall = dymsum.ScalingFamily(star, gear, 1, 2, Fraction(3, 2))
    moving.set(1.5, 2.25)
    assert tall.at(1.5) == moving.sum() and tall.ratio() == Scale(1.5)
    few = dymsum.ScalingFamily(star, gear, 1, 2, options=dymsum.FamilyOptions(structure_bytes=1))
    for refused in (lambda: few.lifetimes(), lambda: few.inner(1, 2), lambda: family.at(3), lambda: family.outer(2, 1)):
        with pytest.raises(dymsum.Error):
            refused()


def test_windows_made_ahead_do_not_hang() -> None:
    options = dymsum.MovingOptions(threads=2, progress=lambda stage, share: True)
    sum = dymsum.ScalingSum(shapes.random_polygon(60, 1, 3), shapes.gear(6, 0.2, 0.3), options)
    for k in range(20):
        sum.set(1 + k / 100)
    assert sum.sum() == pickle.loads(pickle.dumps(sum)).sum()


def test_rotating_follows() -> None:
    p, q = shapes.letter_l(3, 2, 1), shapes.disc(8, 0.5)
    sum = dymsum.RotatingSum(p, q)
    for k in range(5):
        theta = Orientation.nearest(0.1 * k, 1e-6)
        sum.set(theta)
        assert sum.orientation() == theta
        assert sum.sum() == dymsum.rotated_sum(p, q, theta)
    assert pickle.loads(pickle.dumps(sum)).sum() == sum.sum()


def test_copies_of_a_master() -> None:
    copies = [dymsum.ScaledCopy(Scale(1), (0, 0)), dymsum.ScaledCopy(scale=Scale(2), at=(9, 9))]
    sums = dymsum.scaled_copies(shapes.rectangle(0, 0, 1, 1), shapes.rectangle(0, 0, 1, 1), copies)
    assert [c.sum.area_exact() for c in sums] == [4, 9] and sums[1].at == (9, 9)


def test_scale_ranges() -> None:
    part, plate = shapes.rectangle(-1, -1, 1, 1), shapes.pockets(3, 1)
    ranges = dymsum.fit_range(part, shapes.rectangle(0, 0, 3, 5))
    assert ranges.free[0].low is None and ranges.free[0].high == Fraction(3, 2)
    assert ranges.contains(1.5) and not ranges.contains(Fraction(3001, 2000))
    assert dymsum.fit_range(part, shapes.rectangle(0, 0, 3, 5), (1, 1)).free[0].high == 1
    blocked = dymsum.scale_range(part, [(-9, 0), (-5, 0)], plate)
    assert blocked.contains(1)


@pytest.mark.parametrize("make", [
    lambda: dymsum.minkowski_sum(shapes.gear(9, 3, 4), "POINT(1 2)"),
    lambda: dymsum.nfp([(0, 0), (1, 0), (0, 1)], shapes.disc(5, 1), SumOptions(semantics=Semantics.open)),
    lambda: dymsum.erode(shapes.rectangle(0, 0, 3, 2), shapes.rectangle(0, 0, 1, 2)),
    lambda: dymsum.union_of([shapes.disc(5, 1), shapes.disc(6, 1)]),
    lambda: dymsum.rotated_sum(shapes.disc(5, 1), shapes.disc(6, 1), Orientation.of(1, 7)),
    lambda: dymsum.cspace_slice(shapes.disc(5, 1), shapes.disc(6, 1), Orientation.half_turn()),
    lambda: dymsum.ScalingSum(shapes.disc(5, 1), shapes.disc(6, 1)).sum(),
    lambda: dymsum.RotatingSum(shapes.disc(5, 1), shapes.disc(6, 1)).sum(),
    lambda: dymsum.ScalingFamily(shapes.disc(5, 1), shapes.disc(6, 1), 1, 2).at(Fraction(4, 3)),
    lambda: dymsum.ScalingFamily(shapes.disc(5, 1), shapes.disc(6, 1), 1, 2).inner(1, 2),
    lambda: dymsum.ScalingFamily(shapes.disc(5, 1), shapes.disc(6, 1), 1, 2).outer(1, 2),
])  # fmt: skip
def test_sums_are_pickled(make: object) -> None:
    sum = make()  # type: ignore[operator]
    again = pickle.loads(pickle.dumps(sum))
    assert isinstance(again, PlanarSum) and again == sum and again is not sum
    assert pickle.loads(pickle.dumps(again)) == sum


@pytest.mark.parametrize("value", [
    Region("GEOMETRYCOLLECTION(POLYGON((0 0, 1 0, 0 1, 0 0)), LINESTRING(5 5, 6 6), POINT(9 9))"),
    Region(), shapes.pockets(4, 1).data, shapes.pockets(4, 1).parts[0],
    Scale(Fraction(22, 7)), Orientation.of(3, 7), Orientation.half_turn(), dymsum.Rotation.of(1, 2, 3, 4),
    dymsum.SolidPose(dymsum.Rotation.of(1, 2, 3, 4), (1, 2, Fraction(1, 3))), dymsum.PlanarPose(),
    dymsum.Point(1, 2), dymsum.RationalPoint(Fraction(1, 3), Fraction(2)), dymsum.Contact(),
    dymsum.ErrorCode.not_convex, dymsum.Contact.Kind.edge_of_q,
])  # fmt: skip
def test_values_are_pickled(value: object) -> None:
    again = pickle.loads(pickle.dumps(value))
    assert again == value and type(again) is type(value)
    assert copy.deepcopy(value) == value


def test_options_are_pickled_and_shown() -> None:
    options = SumOptions(engine=Engine.brute, semantics=Semantics.open)
    again = pickle.loads(pickle.dumps(options))
    assert again.engine == Engine.brute and again.semantics == Semantics.open and again.progress is None
    assert repr(options).startswith("SumOptions(engine=")
    options.trace = True
    assert options.trace


def test_functions_are_pickled_by_name() -> None:
    for function in (dymsum.nfp, dymsum.minkowski_sum, shapes.gear):
        assert pickle.loads(pickle.dumps(function)) is function
