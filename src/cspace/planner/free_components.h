// The components of free space that belong together, and what there is to say about one.
#pragma once

#include <vector>

#include "cspace/boundary/partition.h"
#include "cspace/planner/path_levels.h"
#include "cspace/planner/search_limits.h"

namespace dymsum::planar {

/// Components that touching joins, at first single ones.
class JoinedComponents {
 public:
  explicit JoinedComponents(const CspaceObstacle& obstacle);
  std::uint32_t root(std::uint32_t component) const { return classes_.find(component); }
  /// Joins what touches in a slice at a rational event angle, and before and after an angle at which a passage is
  /// shut. What it was stopped by, if it was.
  SearchStop join_touching(const CspaceObstacle& obstacle, PathLevels& levels, const SearchLimits& limits);

 private:
  Partition classes_;
};

FreeComponent described(const CspaceObstacle& obstacle, std::uint32_t component);
/// "component 2, with angles from -20 to 30 degrees, enclosed by shell 1"
std::string text_of(const FreeComponent& component);
/// "the time limit of 60 s was reached between 44.1 and 44.2 degrees near (1, 2)"
std::string text_of(const SearchLimit& limit);

}  // namespace dymsum::planar
