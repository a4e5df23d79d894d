// The patch that is nearest to a configuration, by branch and bound.
#pragma once

#include "patch_distance.h"
#include "patch_tree.h"

namespace dymsum::apps {

struct NearestPatch {
  double distance = 0, error = 0;
  std::uint32_t patch = Patch::kNone;
  PatchPoint point;
  std::uint64_t bounds = 0;  ///< evaluated
};

/// The global minimum over all patches. `weight` is finite.
NearestPatch nearest_patch(const PatchForms& forms, const PatchTree& tree, Point from, double theta, double weight);
/// The same among the points at the angle theta.
NearestPatch nearest_patch_at(const PatchForms& forms, const PatchTree& tree, Point from, double theta);

}  // namespace dymsum::apps
