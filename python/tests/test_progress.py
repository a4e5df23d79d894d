"""Every function that takes a progress calls it, and is stopped by it."""

from __future__ import annotations

import inspect
from fractions import Fraction
from typing import Any, Callable, Iterator

import numpy
import pytest

import dymsum
from dymsum import shapes, solids

P, Q = shapes.random_polygon(40, 1, 4), shapes.gear(12, 0.3, 0.5)
BOX, BALL = solids.box(0, 0, 0, 1, 1, 1), solids.geodesic_sphere(1, 2)
#: A solid that is not convex, so that sums go the long way.
ANGLE = solids.prism([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)], 1.0)
CROSSING = dymsum.MeshData(
    [*BOX.vertices, *ANGLE.vertices], [*BOX.faces, *([v + len(BOX.vertices) for v in face] for face in ANGLE.faces)]
)
DEPTH, QUESTIONS = dymsum.SolidDepth(ANGLE, BOX), [dymsum.DepthQuestion(ANGLE, BOX)] * 3
ROD, WALL = shapes.rectangle(-1, -0.25, 1, 0.25), shapes.gear(8, 2, 3)
OBSTACLE = dymsum.CspaceObstacle(ROD, WALL)
QUERIES = dymsum.ObstacleQueries(OBSTACLE)
TURNING = dymsum.SolidRotationEvents(ANGLE, BOX, (0, 0, 1))
TURN, FURTHER = dymsum.AxisTurn.of(Fraction(3, 10)), dymsum.AxisTurn.of(Fraction(3, 8))
LOCATOR = dymsum.SumLocator(dymsum.minkowski_sum(P, Q))
FEATURES = dymsum.ShapeFeatures(P)
RECORDING = dymsum.begin_recording(dymsum.EditableSum(P, Q))
SOLID_RECORDING = dymsum.begin_recording(dymsum.EditableSolidSum(ANGLE, BOX))
THETA = dymsum.Orientation.nearest(0.3)
POSE = dymsum.SolidPose(dymsum.Rotation.of(5, 1, 2, 1))
POINTS = numpy.random.default_rng(1).uniform(-2, 2, (5000, 2))
PLACES = numpy.random.default_rng(2).uniform(-2, 2, (300, 3))
POSES = numpy.array([[-9, 9 - k / 100, 0] for k in range(200)])
Progress = Callable[[str, float], Any]


EAST, NORTH = dymsum.Orientation(), dymsum.Orientation.parse("1")


def planar(progress: Progress) -> dymsum.SumOptions:
    return dymsum.SumOptions(progress=progress)


def solid(progress: Progress) -> dymsum.SpatialOptions:
    return dymsum.SpatialOptions(progress=progress)


def family_of(progress: Progress) -> dymsum.SolidFamilyOptions:
    return dymsum.SolidFamilyOptions(progress=progress)


def moving(progress: Progress) -> dymsum.MovingOptions:
    return dymsum.MovingOptions(progress=progress)


TABLE = dymsum.TableInput([dymsum.TableItem("p", P, [0]), dymsum.TableItem("q", Q, [0])])
#: Small tables are planned without a question.
LARGE_TABLE = dymsum.TableInput([dymsum.TableItem(f"p{k}", P, [0]) for k in range(70)])


#: What is called, by its name; several calls of one name are its overloads.
CALLS: list[tuple[str, Callable[[Progress], Any]]] = [
    ("minkowski_sum", lambda f: dymsum.minkowski_sum(P, Q, planar(f))),
    ("minkowski_sum", lambda f: dymsum.minkowski_sum(ANGLE, ANGLE, solid(f))),
    ("minkowski_sum", lambda f: dymsum.minkowski_sum([ANGLE, BOX, BOX], solid(f))),
    ("nfp", lambda f: dymsum.nfp(P, Q, planar(f))),
    ("Uncertain.of_variants", lambda f: dymsum.Uncertain.of_variants([P, Q], f)),
    ("minkowski_sum", lambda f: dymsum.minkowski_sum(dymsum.Uncertain.known(P), Q, planar(f))),
    ("nfp", lambda f: dymsum.nfp(dymsum.Uncertain.known(P), Q, planar(f))),
    ("erode", lambda f: dymsum.erode(dymsum.Uncertain.known(shapes.rectangle(0, 0, 9, 9)), P, planar(f))),
    ("united", lambda f: dymsum.united(dymsum.Uncertain.known(P), Q, planar(f))),
    ("intersection", lambda f: dymsum.intersection(dymsum.Uncertain.known(P), Q, planar(f))),
    ("difference", lambda f: dymsum.difference(dymsum.Uncertain.known(P), Q, planar(f))),
    ("fits_anywhere", lambda f: dymsum.fits_anywhere(shapes.rectangle(0, 0, 9, 9), P, planar(f))),
    ("erode", lambda f: dymsum.erode(shapes.rectangle(0, 0, 9, 9), P, planar(f))),
    ("erode", lambda f: dymsum.erode(solids.box(0, 0, 0, 9, 9, 9), ANGLE, solid(f))),
    ("union_of", lambda f: dymsum.union_of([P, Q], planar(f))),
    ("rotated_sum", lambda f: dymsum.rotated_sum(P, Q, THETA, planar(f))),
    ("rotated_erode", lambda f: dymsum.rotated_erode(shapes.rectangle(0, 0, 9, 9), P, THETA, planar(f))),
    ("cspace_slice", lambda f: dymsum.cspace_slice(ROD, WALL, THETA, planar(f))),
    ("contains_each", lambda f: dymsum.contains_each(P, Q, POINTS, progress=f)),
    ("contains_each", lambda f: dymsum.contains_each(P, Q, POINTS[:2], progress=f)),
    ("contains_each", lambda f: dymsum.contains_each(P, Q, [(Fraction(1, 3), 1)], progress=f)),
    ("contains_each", lambda f: dymsum.contains_each(ANGLE, BOX, PLACES, progress=f)),
    ("contains_each", lambda f: dymsum.contains_each(ANGLE, BOX, [(Fraction(1, 3), 1, 1)], progress=f)),
    ("SumLocator.contains_each", lambda f: LOCATOR.contains_each(POINTS, progress=f)),
    ("SumLocator.contains_each", lambda f: LOCATOR.contains_each([(Fraction(1, 3), 1)], progress=f)),
    ("check_motion", lambda f: dymsum.check_motion(ROD, WALL, (-9, 9, 0), (9, 9, 1), progress=f)),
    ("MovingSolidSum", lambda f: dymsum.MovingSolidSum(ANGLE, BOX, dymsum.MovingSolidOptions(progress=f))),
    ("MovingSolidSum", lambda f: dymsum.MovingSolidSum.create(ANGLE, BOX, dymsum.MovingSolidOptions(progress=f))),
    ("posed_sum", lambda f: dymsum.posed_sum(ANGLE, BOX, POSE, options=dymsum.MovingSolidOptions(progress=f))),
    ("posed_sums", lambda f: dymsum.posed_sums(ANGLE, BOX, [POSE] * 3, options=dymsum.MovingSolidOptions(progress=f))),
    ("SolidRotationEvents.at", lambda f: TURNING.at(TURN, progress=f)),
    ("SolidRotationEvents.events", lambda f: TURNING.events(TURN, TURN, progress=f)),
    ("SolidRotationEvents.events_of_turn", lambda f: TURNING.events_of_turn(progress=f)),
    ("SolidRotationEvents.next_event", lambda f: TURNING.next_event(TURN, FURTHER, progress=f)),
    ("SolidRotationEvents.next_topology_change", lambda f: TURNING.next_topology_change(TURN, FURTHER, progress=f)),
    ("nfp_each", lambda f: dymsum.nfp_each([(P, Q)] * 3, planar(f))),
    ("nfp_each", lambda f: dymsum.nfp_each([(P, Q)] * 3, planar(f), return_errors=True)),
    ("ScalingSum", lambda f: dymsum.ScalingSum(P, Q, moving(f))),
    ("ScalingSum", lambda f: dymsum.ScalingSum.create(P, Q, moving(f))),
    ("EditableSum", lambda f: dymsum.EditableSum(P, Q, dymsum.EditOptions(progress=f))),
    ("EditableSum", lambda f: dymsum.EditableSum.create(P, Q, dymsum.EditOptions(progress=f))),
    ("EditableSolidSum", lambda f: dymsum.EditableSolidSum(ANGLE, BOX, dymsum.SolidEditOptions(progress=f))),
    ("EditableSolidSum", lambda f: dymsum.EditableSolidSum.create(ANGLE, BOX, dymsum.SolidEditOptions(progress=f))),
    ("replay", lambda f: dymsum.replay(RECORDING, f)),
    ("replay", lambda f: dymsum.replay(SOLID_RECORDING, f)),
    ("ScalingSum.events", lambda f: dymsum.ScalingSum(P, Q).events(1, Fraction(9, 8), f)),
    ("ScalingSum.next_event", lambda f: dymsum.ScalingSum(P, Q).next_event(1, 8, dymsum.EventChange.topology, f)),
    ("RotationFamily", lambda f: dymsum.RotationFamily(P, Q, dymsum.FamilyOptions(progress=f))),
    ("RotationFamily", lambda f: dymsum.RotationFamily.create(P, Q, options=dymsum.FamilyOptions(progress=f))),
    ("outer_rotated_sum", lambda f: dymsum.outer_rotated_sum(P, Q, EAST, NORTH, 1, dymsum.FamilyOptions(progress=f))),
    ("inner_rotated_sum", lambda f: dymsum.inner_rotated_sum(P, Q, EAST, NORTH, 1, dymsum.FamilyOptions(progress=f))),
    ("ScalingFamily", lambda f: dymsum.ScalingFamily(P, Q, 1, Fraction(9, 8), options=dymsum.FamilyOptions(progress=f))),
    (
        "ScalingFamily",
        lambda f: dymsum.ScalingFamily.create(P, Q, 1, Fraction(9, 8), options=dymsum.FamilyOptions(progress=f)),
    ),
    ("RotatingSum", lambda f: dymsum.RotatingSum(P, Q, moving(f))),
    ("RotatingSum", lambda f: dymsum.RotatingSum.create(P, Q, moving(f))),
    ("scaled_copies", lambda f: dymsum.scaled_copies(P, Q, [dymsum.ScaledCopy(dymsum.Scale.of(2), (0, 0))], moving(f))),
    ("SolidScaleEvents.at", lambda f: dymsum.SolidScaleEvents(ANGLE, BOX).at(2, f)),
    ("SolidScaleEvents.events", lambda f: dymsum.SolidScaleEvents(ANGLE, BOX).events(1, 2, f)),
    ("SolidScaleEvents.next_event", lambda f: dymsum.SolidScaleEvents(ANGLE, BOX).next_event(1, 2, progress=f)),
    (
        "SolidScaleEvents.next_topology_change",
        lambda f: dymsum.SolidScaleEvents(ANGLE, BOX).next_topology_change(1, 2, progress=f),
    ),
    ("SolidScaleEvents.combinatorial_hash", lambda f: dymsum.SolidScaleEvents(ANGLE, BOX).combinatorial_hash(2, f)),
    ("SolidScalingFamily", lambda f: dymsum.SolidScalingFamily(ANGLE, BOX, 1, 2, family_of(f))),
    ("SolidScalingFamily", lambda f: dymsum.SolidScalingFamily.create(ANGLE, BOX, 1, 2, family_of(f))),
    ("SolidScalingFamily.at", lambda f: dymsum.SolidScalingFamily(ANGLE, BOX, 1, 2).at(2, f)),
    ("SolidScalingFamily.lifetimes", lambda f: dymsum.SolidScalingFamily(ANGLE, BOX, 1, 2).lifetimes(f)),
    ("SolidScalingFamily.volume_polynomial", lambda f: dymsum.SolidScalingFamily(ANGLE, BOX, 1, 2).volume_polynomial(2, f)),
    ("SolidRotationFamily", lambda f: dymsum.SolidRotationFamily(ANGLE, BOX, (0, 0, 1), options=family_of(f))),
    ("SolidRotationFamily", lambda f: dymsum.SolidRotationFamily.create(ANGLE, BOX, (0, 0, 1), options=family_of(f))),
    ("SolidRotationFamily.at", lambda f: dymsum.SolidRotationFamily(ANGLE, BOX, (0, 0, 1)).at(TURN, f)),
    ("solid_scale_range", lambda f: dymsum.solid_scale_range(BOX, [(0, 0, 9), (0, 0, -9)], ANGLE, f)),
    ("solid_fit_range", lambda f: dymsum.solid_fit_range(BOX, ANGLE, f)),
    ("solid_fit_range", lambda f: dymsum.solid_fit_range(BOX, ANGLE, (0.1, 0.1, 0.1), f)),
    (
        "scaled_solid_copies",
        lambda f: dymsum.scaled_solid_copies(
            ANGLE, BOX, [dymsum.ScaledSolidCopy(dymsum.Scale.of(2), (0, 0, 0))], progress=f
        ),
    ),
    ("scale_range", lambda f: dymsum.scale_range(Q, [(0, 0), (5, 0)], WALL, f)),
    ("fit_range", lambda f: dymsum.fit_range(Q, P, f)),
    ("fit_range", lambda f: dymsum.fit_range(Q, P, (0.1, 0.1), f)),
    ("CspaceObstacle", lambda f: dymsum.CspaceObstacle(ROD, WALL, dymsum.ObstacleOptions(progress=f))),
    ("CspaceObstacle", lambda f: dymsum.CspaceObstacle.create(ROD, WALL, dymsum.ObstacleOptions(progress=f))),
    ("obstacle_mesh", lambda f: dymsum.obstacle_mesh(OBSTACLE, dymsum.ObstacleMeshOptions(progress=f))),
    ("ObstacleQueries.clearance_each", lambda f: QUERIES.clearance_each(PLACES, progress=f)),
    ("plan", lambda f: dymsum.plan(OBSTACLE, (-8, 0, 0), (8, 0, 1), dymsum.PlanOptions(progress=f))),
    ("direct_plan", lambda f: dymsum.direct_plan(ROD, WALL, (-8, 0, 0), (-8, 0, 1), dymsum.PlanOptions(progress=f))),
    ("check_path", lambda f: dymsum.check_path(ROD, WALL, POSES, progress=f)),
    ("check_path", lambda f: dymsum.check_path(ROD, WALL, PATH, progress=f)),
    ("pose_batch", lambda f: dymsum.pose_batch(BALL, BOX, [dymsum.Rotation()] * 40, dymsum.BatchOptions(progress=f))),
    (
        "pose_batch_arrays",
        lambda f: dymsum.pose_batch_arrays(BALL, BOX, [(1, 0, 0, 0)] * 40, dymsum.BatchOptions(progress=f)),
    ),
    ("by_planes", lambda f: dymsum.by_planes(ANGLE, dymsum.PlanesOptions(sums=solid(f)))),
    ("by_planes", lambda f: dymsum.by_planes([dymsum.MeshData(ANGLE.vertices, ANGLE.faces)], dymsum.PlanesOptions(sums=solid(f)))),
    ("by_lines", lambda f: dymsum.by_lines(P, dymsum.LinesOptions(sums=planar(f)))),
    ("by_lines", lambda f: dymsum.by_lines([P.data], dymsum.LinesOptions(sums=planar(f)))),
    ("check_offset", lambda f: dymsum.check_offset(P, Q, dymsum.DiscSide.outside, f)),
    ("check_offset", lambda f: dymsum.check_offset(ANGLE, BOX, dymsum.DiscSide.outside, solid(f))),
    ("check_set", lambda f: dymsum.check_set(P, Q, dymsum.SetCheckOptions(progress=f))),
    ("check_set", lambda f: dymsum.check_set(dymsum.minkowski_sum(ANGLE, BOX), ANGLE, solid(f))),
    ("united", lambda f: dymsum.united(ANGLE, options=solid(f))),
    ("united", lambda f: dymsum.united([ANGLE, BOX], solid(f))),
    ("united", lambda f: dymsum.united([P, Q], planar(f))),
    ("united", lambda f: dymsum.united(P, Q, planar(f))),
    ("filled", lambda f: dymsum.filled([[(0, 0), (2, 2), (2, 0), (0, 2)]], options=planar(f))),
    ("intersection", lambda f: dymsum.intersection(P, Q, planar(f))),
    ("intersection", lambda f: dymsum.intersection([P, Q], planar(f))),
    ("intersection", lambda f: dymsum.intersection([ANGLE, BOX], solid(f))),
    ("difference", lambda f: dymsum.difference(P, Q, planar(f))),
    ("symmetric_difference", lambda f: dymsum.symmetric_difference(P, Q, planar(f))),
    ("intersection", lambda f: dymsum.intersection(ANGLE, BOX, solid(f))),
    ("difference", lambda f: dymsum.difference(ANGLE, BOX, solid(f))),
    ("symmetric_difference", lambda f: dymsum.symmetric_difference(ANGLE, BOX, solid(f))),
    ("repair_with_union", lambda f: dymsum.repair_with_union(CROSSING, options=solid(f))),
    ("opening", lambda f: dymsum.opening(solids.box(0, 0, 0, 9, 9, 9), ANGLE, solid(f))),
    ("closing", lambda f: dymsum.closing(ANGLE, BOX, solid(f))),
    ("offset", lambda f: dymsum.offset(ANGLE, 0.5, 0.2, options=solid(f))),
    ("slice_of_sum", lambda f: dymsum.slice_of_sum(ANGLE, ANGLE, 0.5, solid(f))),
    ("LocalSum", lambda f: dymsum.LocalSum(ANGLE, BOX, dymsum.LocalOptions(progress=f))),
    ("PlanarLocalSum", lambda f: dymsum.PlanarLocalSum(P, Q, dymsum.PlanarLocalOptions(progress=f))),
    ("PlanarLocalSum", lambda f: dymsum.PlanarLocalSum.create(P, Q, dymsum.PlanarLocalOptions(progress=f))),
    ("LocalSum", lambda f: dymsum.LocalSum.create(ANGLE, BOX, dymsum.LocalOptions(progress=f))),
    ("ContinuousDepth", lambda f: dymsum.ContinuousDepth(ANGLE, BOX, dymsum.ContinuousDepthOptions(progress=f))),
    ("ContinuousDepth", lambda f: dymsum.ContinuousDepth.create(ANGLE, BOX, dymsum.ContinuousDepthOptions(progress=f))),
    ("SolidDepth", lambda f: dymsum.SolidDepth(ANGLE, BOX, dymsum.DepthOptions(progress=f))),
    ("SolidDepth", lambda f: dymsum.SolidDepth.create(ANGLE, BOX, dymsum.DepthOptions(progress=f))),
    ("depth_batch", lambda f: dymsum.depth_batch(DEPTH, PLACES[:40], dymsum.DepthBatchOptions(1, progress=f))),
    ("depth_batch", lambda f: dymsum.depth_batch(QUESTIONS, dymsum.DepthBatchOptions(1, progress=f))),
    (
        "depth_batch",
        lambda f: dymsum.depth_batch(QUESTIONS, dymsum.DepthBatchOptions(1, progress=f), return_errors=True),
    ),
    (
        "depth_batch_arrays",
        lambda f: dymsum.depth_batch_arrays(DEPTH, PLACES[:40], dymsum.DepthBatchOptions(1, progress=f)),
    ),
    ("NfpTable", lambda f: dymsum.NfpTable(LARGE_TABLE, progress=f)),
    ("NfpTable", lambda f: dymsum.NfpTable.create(LARGE_TABLE, progress=f)),
    ("check_layout", lambda f: dymsum.check_layout(dymsum.Layout([P], []), dymsum.LayoutCheckOptions(progress=f))),
    ("decompose", lambda f: dymsum.decompose(FEATURES, dymsum.DecomposeOptions(progress=f))),
    ("GrowingDisc.events", lambda f: dymsum.GrowingDisc(P).events(dymsum.DiscSide.inside, f)),
    ("GrowingDisc.sum_at", lambda f: dymsum.GrowingDisc(P).sum_at(1, progress=f)),
    ("GrowingDisc.eroded_at", lambda f: dymsum.GrowingDisc(P).eroded_at(0.01, progress=f)),
    ("GrowingDisc.opened_at", lambda f: dymsum.GrowingDisc(P).opened_at(0.01, progress=f)),
    ("GrowingDisc.closed_at", lambda f: dymsum.GrowingDisc(P).closed_at(1, progress=f)),
    ("ShapeFeatures", lambda f: dymsum.ShapeFeatures(P, dymsum.FeatureOptions(progress=f))),
    ("ShapeFeatures", lambda f: dymsum.ShapeFeatures.create(P, dymsum.FeatureOptions(progress=f))),
    ("compute_table", lambda f: dymsum.compute_table(dymsum.NfpTable(TABLE), dymsum.TableOptions(progress=f))),
]
PATH = dymsum.plan(OBSTACLE, (-8, 0, 0), (8, 0, 1)).path
NAMES = [f"{name} {k}" for k, (name, _) in enumerate(CALLS)]


def _signatures(function: Any) -> list[str]:
    return [overload[0] for overload in getattr(function, "__nb_signature__", ())]


def _that_take_a_progress() -> Iterator[str]:
    options = [
        name
        for name, kind in vars(dymsum).items()
        if name.endswith("Options") and (hasattr(kind, "progress") or hasattr(kind, "sums"))
    ]
    assert len(options) == 24
    for name, value in vars(dymsum).items():
        members = vars(value).items() if inspect.isclass(value) else [("", value)]
        for member, function in members:
            if name in options or not any(
                word in text for text in _signatures(function) for word in ("progress:", *(f"{o} =" for o in options))
            ):
                continue
            yield name if member in ("", "__init__", "create") else f"{name}.{member}"


def test_all_of_them_are_called() -> None:
    assert sorted(set(_that_take_a_progress())) == sorted({name for name, _ in CALLS})


@pytest.mark.parametrize("call", [call for _, call in CALLS], ids=NAMES)
def test_progress(call: Callable[[Progress], Any]) -> None:
    seen: list[tuple[str, float]] = []
    call(lambda stage, share: seen.append((stage, share)))
    assert seen and all(stage and 0 <= share <= 1 for stage, share in seen)

    class Stop(Exception):
        pass

    def stop(stage: str, share: float) -> None:
        raise Stop(stage)

    with pytest.raises(Stop) as stopped:
        call(stop)
    assert stopped.value.args == (seen[0][0],)
    with pytest.raises(dymsum.Error) as raised:
        call(lambda stage, share: False)
    assert raised.value.code == dymsum.ErrorCode.cancelled


def test_a_solid_sum_in_motion_is_stopped_and_changes_nothing() -> None:
    answer: list[Any] = [None]
    made = dymsum.MovingSolidSum(ANGLE, BOX, dymsum.MovingSolidOptions(progress=lambda stage, share: answer[0]))
    before = made.sum()
    answer[0] = False
    with pytest.raises(dymsum.Error):
        made.set(POSE)
    assert made.sum() == before and made.p_pose() == dymsum.SolidPose()
    answer[0] = None
    made.set(POSE)
    assert made.sum() == dymsum.posed_sum(ANGLE, BOX, POSE) != before


@pytest.mark.parametrize("kind", [dymsum.ScalingSum, dymsum.RotatingSum])
def test_moves_are_stopped_and_change_nothing(kind: Any) -> None:
    answer: list[Any] = [None]
    made = kind(P, Q, moving(lambda stage, share: answer[0]))
    before = made.sum()
    there = Fraction(13, 7) if kind is dymsum.ScalingSum else dymsum.Orientation.nearest(1.3)
    answer[0] = False
    with pytest.raises(dymsum.Error):
        made.set(there)
    assert made.sum() == before
    answer[0] = None
    made.set(there)
    assert made.sum() != before
