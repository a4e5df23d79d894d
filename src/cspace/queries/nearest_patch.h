// The patch that is nearest to a configuration, by branch and bound.
#pragma once

#include "cspace/queries/interval_distance.h"
#include "cspace/queries/patch_tree.h"

namespace dymsum::cspace {

struct NearestPatch {
  double distance = 0;
  double error = 0;  ///< the least distance to all patches differs by at most this
  std::uint32_t patch = Patch::kNone;
  Point at;  ///< relative to the forms' origin
  double theta = 0;
  std::uint64_t bounds = 0;  ///< evaluated
};

/// The global minimum over all patches. The weight is finite.
NearestPatch nearest_patch(const PatchForms& forms, const PatchTree& tree, const DistanceQuestion& question);
/// The same among the points at the angle of the question, which errs by 2^-49; its weight is 0. Patches that begin or
/// end within 2^-45 of it may count or not. The error is infinite where an end moves too fast.
NearestPatch nearest_patch_at(const PatchForms& forms, const PatchTree& tree, const DistanceQuestion& question);

}  // namespace dymsum::cspace
