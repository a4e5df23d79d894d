// What makes the waypoints of a path from the steps of a search: paths inside slices, then shortcuts; every piece
// checked exactly.
#pragma once

#include <vector>

#include "cspace/planner/path_search.h"

namespace dymsum::planar {

struct PathPoint {
  Waypoint::Move move = Waypoint::Move::start;
  Position at;
  Orientation theta;
};

class PathPoints {
 public:
  PathPoints(const CspaceObstacle& obstacle, PathLevels& levels, Touching touching);

  std::vector<PathPoint> points(const PathEnd& start, const std::vector<PathStep>& steps, const PathEnd& goal);
  /// Whether a straight translation is free, and which rotation in place is.
  bool glides(const Orientation& theta, const Position& from, const Position& to);
  std::optional<TurnDirection> turns(const Position& at, const Orientation& from, const Orientation& to);

 private:
  using Points = std::vector<PathPoint>;
  void translate(Points& path, const Position& to);
  void rotate(Points& path, const Orientation& to, TurnDirection direction);
  /// The moves that bring `from` to `to` in one or two pieces, if such are free: at most `most` of them.
  Points direct(const PathPoint& from, const PathPoint& to, std::size_t most);
  Points shortened(const Points& path);
  bool stays_free(const Points& path, std::size_t first, std::size_t last, const Position& to);
  Points tightened(Points path);
  double draw_in(Points& path, std::size_t first, std::size_t last, std::size_t& attempts);
  void require_free(const Points& path);

  PathLevels& levels_;
  Touching touching_;
  Pivot pivot_;
};

}  // namespace dymsum::planar
