"""Obstacles of robots that turn, questions to them, paths."""

from __future__ import annotations

import math
import pickle
from fractions import Fraction

import numpy
import pytest

import dymsum
from dymsum import CspaceObstacle, MotionCheck, ObstacleQueries, Orientation, Patch, Touching, shapes

ROD = shapes.rectangle(-1.5, -0.25, 1.5, 0.25)
POSTS = shapes.grate(4, 2, 1, 6)


@pytest.fixture(scope="module")
def obstacle() -> CspaceObstacle:
    return CspaceObstacle(ROD, POSTS)


@pytest.fixture(scope="module")
def queries(obstacle: CspaceObstacle) -> ObstacleQueries:
    return ObstacleQueries(obstacle)


def poses(count: int) -> numpy.ndarray:
    random = numpy.random.default_rng(5)
    return numpy.column_stack(
        [random.uniform(-3, 12, count), random.uniform(-3, 9, count), random.uniform(-4, 4, count)]
    )


def test_parts_of_an_obstacle(obstacle: CspaceObstacle) -> None:
    assert obstacle.robot() == ROD and obstacle.obstacle() == POSTS
    for patch in obstacle.patches():
        assert patch.begin == Patch.kNone or patch.begin < len(obstacle.angles())
    slab = obstacle.slab_of(Orientation.nearest(0.3))
    assert slab is not None
    for loop in obstacle.loops(slab):
        for patch in loop:
            assert patch < len(obstacle.patches())
            assert obstacle.free_cell(slab, patch) < len(obstacle.free_cells())
    exact = obstacle.angles()[0].exact
    assert exact is None or obstacle.slab_of(exact) is None
    assert obstacle.slice(Orientation.of(1, 1)) == dymsum.cspace_slice(ROD, POSTS, Orientation.of(1, 1))


def test_batches_equal_single_answers(obstacle: CspaceObstacle, queries: ObstacleQueries) -> None:
    at = poses(300)
    inside = queries.contains_each(at, threads=2)
    assert inside.dtype == numpy.bool_ and 20 < inside.sum() < 280
    assert inside.tolist() == [queries.contains(tuple(p)) for p in at]
    assert inside.tolist() == [obstacle.contains(x, y, Orientation.nearest(t)) for x, y, t in at]
    assert (queries.free_each(at.tolist()) == ~inside).all()
    assert (queries.contains_each(numpy.asfortranarray(at)) == inside).all()
    for touching in (Touching.allowed, Touching.forbidden):
        many = queries.clearance_each(at[:60], touching=touching, threads=2)
        for k in range(60):
            one = queries.clearance(at[k], touching=touching)
            assert (many.distance[k], many.error[k], many.patch[k]) == (one.distance, one.error, one.patch)
            assert tuple(many.nearest[k]) == one.nearest
        assert ((many.distance < 0) <= inside[:60]).all()
    assert (
        queries.clearance_each(at[:5], weight=2.0).distance == [queries.clearance(p, 2.0).distance for p in at[:5]]
    ).all()
    assert queries.contains_each(numpy.empty((0, 3))).shape == (0,)
    assert queries.contains_each([]).shape == (0,)


def test_what_is_not_finite(queries: ObstacleQueries) -> None:
    for ask in (queries.contains, queries.clearance):
        with pytest.raises(ValueError, match="."):
            ask((0, 0, math.inf))
    with pytest.raises(ValueError, match="."):
        queries.clearance_each([(0, 0, 0), (0, 0, math.nan)])
    with pytest.raises(ValueError, match="."):
        queries.contains_each([(0, 0, 0), (0, 0, math.nan)])
    with pytest.raises(TypeError):
        queries.contains_each([(0, 0), (1, 1)])
    with pytest.raises(ValueError, match="."):
        queries.clearance((0, 0, 0), -1.0)


def test_indices_out_of_range(obstacle: CspaceObstacle) -> None:
    for ask in (obstacle.loops, obstacle.inside, obstacle.half_tangent):
        with pytest.raises(IndexError):
            ask(10**6)
    with pytest.raises(IndexError):
        obstacle.free_cell(0, 10**6)


def test_free_angles(queries: ObstacleQueries) -> None:
    free = queries.free_angles(-1.0, 3.0)
    assert free and all(a.begin_error < 1e-9 for a in free)
    for a in free:
        if a.begin < a.end:
            assert not queries.contains((-1.0, 3.0, (a.begin + a.end) / 2))


def test_obstacles_are_pickled(obstacle: CspaceObstacle, queries: ObstacleQueries) -> None:
    again = pickle.loads(pickle.dumps(obstacle))
    assert dymsum.format_obstacle(again) == dymsum.format_obstacle(obstacle)
    asked = pickle.loads(pickle.dumps(queries))
    assert (asked.contains_each(poses(50)) == queries.contains_each(poses(50))).all()
    with pytest.raises(dymsum.Error):
        dymsum.parse_obstacle("nothing", "text")


def test_queries_keep_their_obstacle() -> None:
    queries = ObstacleQueries(CspaceObstacle(ROD, POSTS))
    assert queries.contains((0, 0, 0))


def test_paths_begin_and_end_at_fractions_exactly() -> None:
    obstacle = CspaceObstacle(shapes.rectangle(-1.5, -0.25, 1.5, 0.25), shapes.grate(4, 2, 1, 6))
    third = Fraction(1, 3)
    turned = dymsum.ExactConfiguration((12, third), dymsum.Orientation.of(1, 3))
    found = dymsum.plan(obstacle, (-4, third, 0), turned)
    assert found.path[0].at == (-4, third) and found.path[-1].at == (12, third)
    assert found.path[-1].theta == turned.theta and repr(turned) == repr(pickle.loads(pickle.dumps(turned)))
    robot, wall = shapes.rectangle(0, 0, 1, 1), shapes.rectangle(3, 0, 4, 1)
    assert dymsum.direct_plan(robot, wall, (third, 0, 0), (0, 0, 1)).found()
    at = [dymsum.ExactPose((third, 2), 0), dymsum.ExactPose((third, 2), 1.5)]
    assert dymsum.check_path(robot, wall, at).outcome == dymsum.MotionCheck.Outcome.free
    into = [dymsum.ExactPose((2 - third, 0), 0), dymsum.ExactPose((2 + third, 0), 0)]
    check = dymsum.check_path(robot, wall, into)
    assert check.outcome == dymsum.MotionCheck.Outcome.blocked and check.high == 0.5
    with pytest.raises(dymsum.Error, match="infinite|finite"):
        dymsum.plan(obstacle, (math.inf, 0, 0), (12, 3, 1))


def test_a_path_and_its_check(obstacle: CspaceObstacle) -> None:
    found = dymsum.plan(obstacle, (-4, 3, 0), (12, 3, 1))
    assert found.found() and found.reason is None
    assert found.configurations.shape == (len(found.path), 3)
    assert tuple(found.configurations[0][:2]) == (-4, 3)
    assert dymsum.check_path(ROD, POSTS, found.path).outcome == MotionCheck.Outcome.free
    again = pickle.loads(pickle.dumps(found))
    assert [w.at for w in again.path] == [w.at for w in found.path]
    straight = dymsum.check_path(ROD, POSTS, [(-4, 3, 0), (12, 3, 0)])
    assert straight.outcome == MotionCheck.Outcome.blocked and straight.contact is not None
    none = dymsum.plan(obstacle, (1.5, 2, math.pi / 2), (12, 3, 0))
    assert not none.found() and none.reason is not None and none.reason.text


def test_motions() -> None:
    unit = shapes.rectangle(0, 0, 1, 1)
    turn = dymsum.check_rotation(
        unit, unit, (3, 0), Orientation(), Orientation.half_turn(), dymsum.TurnDirection.clockwise
    )
    assert turn.free and turn.always
    motion = dymsum.check_motion(unit, unit, (-5, 0, 0), (5, 0, 1), dymsum.MotionOptions(resolution=1e-3))
    assert motion.outcome == MotionCheck.Outcome.blocked and 0 < motion.low <= motion.high


def test_mesh_of_an_obstacle(obstacle: CspaceObstacle) -> None:
    mesh = dymsum.obstacle_mesh(obstacle, dymsum.ObstacleMeshOptions(tolerance=0.01))
    assert dymsum.closure(mesh).watertight() and dymsum.enclosed_volume(mesh) > 0
    assert mesh.configurations.shape == (len(mesh.vertices), 3)
    assert dymsum.format_mesh(dymsum.mesh_data(mesh), dymsum.MeshFormat.glb)[:4] == b"glTF"
    with pytest.raises(dymsum.Error):
        dymsum.obstacle_mesh(obstacle, dymsum.ObstacleMeshOptions(tolerance=2))
