// A piece of the boundary between two angles, of a segment between those of its neighbours along the boundary: where it
// begins and ends on its line.
#pragma once

#include <optional>

#include "cspace/events/exact_position.h"

namespace dymsum::planar {

struct SubEdge {
  WalkSegment segment, left, right;
};

/// A parameter along a segment, and how much it may err.
struct Located {
  double t = 0, error = 0;
};
/// The position at which a segment is cut by another one, or meets it in a common pair of vertices at the given end:
/// the error is that at every angle within `turn` of h.
Located position_on(const TurningForms& forms, const WalkSegment& s, const WalkSegment& other, bool at_start, Heading h,
                    double turn = 0);

/// The position at which a sub-edge begins or ends along the line of s at the exact angle, times |d_s|^2 and (1 + t^2);
/// the limit from near angles where its neighbour's line comes to lie along its own. Nothing where these are parallel
/// at every angle, or apart at this one.
std::optional<Fraction> end_along(const SignsAt& signs, const WalkSegment& s, const SubEdge& e, bool at_end);

}  // namespace dymsum::planar
