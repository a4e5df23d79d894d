// Intervals of patches in the frame of their edge, where the reference point of a configuration moves on a circle as
// the angle goes on: u along the edge, v off its line.
#pragma once

#include <vector>

#include "cspace/queries/end_curve.h"
#include "cspace/queries/patch_forms.h"

namespace dymsum::cspace {

/// The angles reference + x with x in [low, high] cover a part of a patch; with x in [proved_low, proved_high], if that
/// is not empty, they belong to it. The cosine and the sine are those of the exact reference, which may differ from its
/// double by 2^-50.
struct PatchInterval {
  std::uint32_t patch = 0;
  double reference = 0, low = 0, high = 0, proved_low = 0, proved_high = 0;
  double c = 1, s = 0;
  EndCurve left, right;
};

/// No point of the interval is outside: by x and y, and in the frame of the edge's direction in the middle.
struct IntervalBox {
  PointRange at;
  Point along;  ///< unit vector
  Range u, v, theta;
};

/// Every patch in intervals of at most `longest` <= 1/4 radians. Near the angle at which a crossing would be between
/// parallel lines that angle is the reference, so that x has all its digits.
std::vector<PatchInterval> make_intervals(const CspaceObstacle& obstacle, const PatchForms& forms, double longest);
IntervalBox box_of(const PatchForms& forms, const PatchInterval& interval);

}  // namespace dymsum::cspace
