// The pieces of neighbouring levels that free space may join, and how many free cells lie between a piece and the goal.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "cspace/planner/free_components.h"
#include "cspace/planner/path_levels.h"

namespace dymsum::planar {

class PathLinks {
 public:
  /// Requires: all of them live as long as this; every slab has a level.
  PathLinks(const CspaceObstacle& obstacle, PathLevels& levels, const JoinedComponents& joined);

  /// Whether free space may join a piece of level k and one of the next level between the two angles. It says yes
  /// wherever that is so, and sometimes where it is not: it knows at which events a free cell begins and ends, and not
  /// which ones it meets there.
  bool may_join(std::size_t k, std::uint32_t group, std::uint32_t next_group);

  /// Counts the steps from cell to cell to a piece. O(cells).
  void aim(std::size_t k, std::uint32_t group);
  /// How many steps at least lead from a piece to the one aimed at; far() where no cell is known that does. What it
  /// says of cells around islands within one face may be too much: a hint where to look first.
  std::uint32_t steps(std::size_t k, std::uint32_t group);
  std::uint32_t far() const { return static_cast<std::uint32_t>(steps_.size()); }

 private:
  bool may_join(std::uint32_t cell, std::uint32_t next, std::optional<std::uint32_t> event) const;
  std::uint32_t root(std::uint32_t cell) const;

  const CspaceObstacle& obstacle_;
  PathLevels& levels_;
  const JoinedComponents& joined_;
  /// Cells that begin or end at an event, of one joined component.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> at_event_;
  std::vector<std::uint32_t> steps_;  // per cell
};

}  // namespace dymsum::planar
