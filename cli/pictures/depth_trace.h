// Depth along a motion: a table and a plot.
#pragma once

#include <string>
#include <vector>

#include "dymsum/continuous_depth.h"

namespace dymsum::cli {

struct DepthRow {
  Point3 at;
  Rotation turned;
  ContinuousContact contact;
  Rational squared;  ///< of the exact depth
  bool exact_jumps =
      false;  ///< the shortest way out ends where no continuous motion of its end leads from the last one
};

/// Whether a row is drawn as a jump: it does not follow, and is not the first one inside.
bool jumps(const DepthRow& row);

/// Columns: the pose, both depths and directions, witnesses, branch, jump.
std::string depth_csv(const std::vector<DepthRow>& rows);
/// Both depths over the rows, and both directions by their coordinates; jumps of the continuous depth as red lines,
/// those of the exact one as grey ones. `title` is a line of text.
std::string depth_svg(const std::vector<DepthRow>& rows, const std::string& title);

}  // namespace dymsum::cli
