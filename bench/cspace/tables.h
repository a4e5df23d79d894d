// The tables of the benchmark as markdown, on the screen and for the page.
#pragma once

#include <string>
#include <vector>

#include "cspace/measure.h"
#include "cspace/rotation.h"
#include "cspace/sizes.h"
#include "cspace/slices.h"
#include "page.h"

namespace dymsum::bench {

/// A number by name; counts are exact.
struct Value {
  template <class Number>
  Value(const char* what, Number number) : name(what), value(static_cast<double>(number)) {}
  const char* name;
  double value;
};
void add_values(Report& report, const std::string& kind, const std::string& pair, const std::vector<Value>& values);

/// Table 4.1.
void obstacle_heading(Report& report);
void obstacle_line(Report& report, const ObstacleRow& row);

/// What slices cost instead; `obstacle_ms` is the time of the obstacle.
void slices_heading(Report& report);
void slices_line(Report& report, const SlicesRow& row, const ObstacleRow& obstacle);
void slices_remarks(Report& report, const std::vector<SlicesRow>& rows);

/// Table 4.2.
void sizes_heading(Report& report);
void sizes_line(Report& report, const std::string& name, const ConvolutionCounts& counts,
                const PrintedObstacle& thesis);

/// Coincident inputs.
void symmetric_heading(Report& report);
void symmetric_line(Report& report, const ObstacleRow& row);

/// Frames of a turn.
void rotation_heading(Report& report);
void rotation_line(Report& report, const RotationRow& row);

/// What the project promises of the pairs that were measured: a line each.
void promises(Report& report, const std::vector<ObstacleRow>& obstacles, const std::vector<SlicesRow>& slices,
              const std::vector<RotationRow>& rotations);

/// Where 360 slices take less time than the obstacle: a line each.
void losses(Report& report, const std::vector<ObstacleRow>& obstacles, const std::vector<SlicesRow>& slices);

}  // namespace dymsum::bench
