// The angles at which a position is free: between those at which patches pass through it.
#pragma once

#include <functional>
#include <vector>

#include "cspace/queries/patch_forms.h"
#include "dymsum/obstacle_queries.h"

namespace dymsum::cspace {

// The angles at which patches, or tight placements, may pass through a position.

/// Angles within [low, high], low in [-pi, pi). Nothing changes at the position outside of passages, unless there are
/// curves of tight placements.
struct Passage {
  double low = 0, high = 0;
  std::uint32_t patch = Patch::kNone;
  bool crosses = false;  ///< just once, from one side of one patch to the other
};

/// Ascending, each apart from the others by more than kPassageGap; none is left where they go all the way round.
struct Passages {
  std::vector<Passage> all;
  bool everywhere = false;
};
/// Any gap is right that halves of it are distinguished in doubles of angles.
constexpr double kPassageGap = 0x1p-44;
static_assert(kPassageGap >= 4 * kAngleMargin);

/// `at` is absolute.
Passages passages_at(const CspaceObstacle& obstacle, const PatchForms& forms, Point at);

/// `is_free` answers exactly at an angle in [-pi, pi].
std::vector<FreeAngles> free_angles(const CspaceObstacle& obstacle, const PatchForms& forms, Point at,
                                    const std::function<bool(double)>& is_free);

}  // namespace dymsum::cspace
