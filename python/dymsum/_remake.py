"""What pickled results are made again by: from their operands and options, as exactly as the first time."""

from __future__ import annotations

from typing import Optional, Union

from . import _core
from ._core import (
    AxisTurn,
    ClipBall,
    ClipBox,
    ConvexSum,
    FamilyOptions,
    LocalOptions,
    LocalPart,
    LocalSum,
    Mesh,
    EditableSolidSum,
    EditableSum,
    EditOptions,
    MovingOptions,
    MovingSolidOptions,
    MovingSolidSum,
    Orientation,
    PlanarBox,
    PlanarDisc,
    PlanarLocalOptions,
    PlanarLocalPart,
    PlanarLocalSum,
    PlanarPose,
    PlanarSum,
    Region,
    RotatingSum,
    RotationFamily,
    Scale,
    ScalingFamily,
    ScalingSum,
    SolidPose,
    SolidEditOptions,
    SolidRotationEvents,
    SolidRotationOptions,
    SpatialSum,
    SumLocator,
    SumOptions,
)


PlanarOperand = Union[Region, PlanarSum]


def minkowski_sum(p: PlanarOperand, q: PlanarOperand, options: Optional[SumOptions]) -> PlanarSum:
    """As the function of this name; without options by the default ones. So the following."""
    return _core.minkowski_sum(p, q, options or SumOptions())


def planar_sum_of(sets: list[PlanarOperand], options: Optional[SumOptions]) -> PlanarSum:
    return _core.minkowski_sum(sets, options or SumOptions())


def nfp(a: PlanarOperand, b: PlanarOperand, options: Optional[SumOptions]) -> PlanarSum:
    return _core.nfp(a, b, options or SumOptions())


def erode(p: PlanarOperand, q: PlanarOperand, options: Optional[SumOptions]) -> PlanarSum:
    return _core.erode(p, q, options or SumOptions())


def opening(p: PlanarOperand, q: PlanarOperand, options: Optional[SumOptions]) -> PlanarSum:
    return _core.opening(p, q, options or SumOptions())


def closing(p: PlanarOperand, q: PlanarOperand, options: Optional[SumOptions]) -> PlanarSum:
    return _core.closing(p, q, options or SumOptions())


def union_of(regions: list[Region], options: Optional[SumOptions]) -> PlanarSum:
    return _core.union_of(regions, options or SumOptions())


def rotated_sum(p: Region, q: Region, theta: Orientation, options: Optional[SumOptions]) -> PlanarSum:
    return _core.rotated_sum(p, q, theta, options or SumOptions())


def cspace_slice(robot: Region, obstacle: Region, theta: Orientation, options: Optional[SumOptions]) -> PlanarSum:
    return _core.cspace_slice(robot, obstacle, theta, options or SumOptions())


def rotated_erode(container: Region, part: Region, theta: Orientation, options: Optional[SumOptions]) -> PlanarSum:
    return _core.rotated_erode(container, part, theta, options or SumOptions())


sum_locator = SumLocator
solid_sum = _core.minkowski_sum
solid_sum_of = _core.minkowski_sum
solid_erode = _core.erode
negated = _core.negated
united = _core.united
intersection = _core.intersection
difference = _core.difference
symmetric_difference = _core.symmetric_difference
filled = _core.filled
parse_sum = _core.parse_sum
outer_rotated_sum = _core.outer_rotated_sum
inner_rotated_sum = _core.inner_rotated_sum
parse_solid_sum = _core.parse_solid_sum


def scaling(p: Region, q: Region, options: MovingOptions, sx: Scale, sy: Scale) -> ScalingSum:
    """A scaling sum at the scales it stood at."""
    made = ScalingSum(p, q, options)
    made.set(sx, sy)
    return made


def scaling_sum(p: Region, q: Region, options: MovingOptions, sx: Scale, sy: Scale) -> PlanarSum:
    """The sum that a scaling sum had."""
    return scaling(p, q, options, sx, sy).sum()


def edited_solid_sum(p: Mesh, q: Mesh, options: SolidEditOptions) -> SpatialSum:
    """The sum that an edited sum of solids had."""
    return EditableSolidSum(p, q, options).sum()


def edited_sum(p: Region, q: Region, options: EditOptions) -> PlanarSum:
    """The sum that an edited sum had."""
    return EditableSum(p, q, options).sum()


def rotation_family_at(p: Region, q: Region, options: FamilyOptions, theta: Orientation) -> PlanarSum:
    """The sum of a family at an orientation."""
    return RotationFamily(p, q, options).at(theta)


def family_at(family: ScalingFamily, scales: list[Scale]) -> PlanarSum:
    """The sum of a family at a scale."""
    return family.at(*scales)


def family_outer(family: ScalingFamily, scales: list[Scale]) -> PlanarSum:
    """What lies in some sum of an interval of a family."""
    return family.outer(*scales)


def family_inner(family: ScalingFamily, scales: list[Scale]) -> PlanarSum:
    """What lies in all sums of an interval of a family."""
    return family.inner(*scales)


def rotating(p: Region, q: Region, options: MovingOptions, theta: Orientation) -> RotatingSum:
    """A rotating sum at the orientation it stood at."""
    made = RotatingSum(p, q, options)
    made.set(theta)
    return made


def rotating_sum(p: Region, q: Region, options: MovingOptions, theta: Orientation) -> PlanarSum:
    """The sum that a rotating sum had."""
    return rotating(p, q, options, theta).sum()


def convex(p: Union[Mesh, SpatialSum], q: Mesh, p_pose: SolidPose, q_pose: SolidPose) -> ConvexSum:
    """A sum of convex solids at the poses it stood at."""
    made = ConvexSum(p, q)
    made.set(p_pose, q_pose)
    return made


def sum_of_convex(p: Union[Mesh, SpatialSum], q: Mesh, p_pose: SolidPose, q_pose: SolidPose) -> SpatialSum:
    """The sum that such an object had."""
    return convex(p, q, p_pose, q_pose).sum()


posed_sum = _core.posed_sum


def moving_solid(p: Mesh, q: Mesh, options: MovingSolidOptions, p_pose: SolidPose, q_pose: SolidPose) -> MovingSolidSum:
    """A sum of moving solids at the poses it stood at."""
    made = MovingSolidSum(p, q, options)
    made.set(p_pose, q_pose)
    return made


def local_part(
    p: Mesh, q: Mesh, options: LocalOptions, place: Union[ClipBox, ClipBall], p_pose: SolidPose, q_pose: SolidPose
) -> LocalPart:
    """The part of a sum at a place."""
    sum = LocalSum(p, q, options)
    return sum.in_(place, p_pose, q_pose) if isinstance(place, ClipBox) else sum.in_(place, p_pose, q_pose)


def planar_local_part(
    p: Region,
    q: Region,
    options: PlanarLocalOptions,
    place: Union[PlanarBox, PlanarDisc],
    p_pose: PlanarPose,
    q_pose: PlanarPose,
) -> PlanarLocalPart:
    """The part of a planar sum at a place."""
    sum = PlanarLocalSum(p, q, options)
    return sum.in_(place, p_pose, q_pose) if isinstance(place, PlanarBox) else sum.in_(place, p_pose, q_pose)


def turned_solid_sum(
    p: Mesh, q: Mesh, axis: tuple[int, int, int], options: SolidRotationOptions, turn: AxisTurn
) -> SpatialSum:
    return SolidRotationEvents(p, q, axis, options).at(turn)
