// A way through the levels of a planner: rotations in place from level to level, joined by the free pieces of slices.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "planar/rotation/path_levels.h"

namespace dymsum::planar {

/// Translate to `at`, then rotate in place to `theta`.
struct PathStep {
  Position at;
  Orientation theta;
  TurnDirection direction = TurnDirection::counter_clockwise;
};

struct PathEnd {
  Position at;
  Orientation theta;
};

class PathSearch {
 public:
  /// `joined`: whether two components belong together for the purpose of this search; kNone is any.
  PathSearch(const CspaceObstacle& obstacle, PathLevels& levels, Touching touching,
             std::function<bool(std::uint32_t, std::uint32_t)> joined);

  enum class Outcome : std::uint8_t { found, nothing, cancelled };
  /// One round over the levels as they are, each rotation tried at up to `places` places of a piece.
  Outcome round(const PathEnd& start, const PathEnd& goal, std::size_t places, const Progress& progress);
  /// The steps of the last round that found a way; the goal is then reached by translations.
  const std::vector<PathStep>& steps() const { return steps_; }
  /// More levels where the last round reached a piece, and not one next to it of the same free cell, or of one that
  /// begins or ends between them.
  void refine();
  std::uint64_t rotations() const { return rotations_; }

 private:
  struct Visit {
    bool reached = false;
    std::uint32_t from_level = 0, from_group = 0;
    Position at;
    TurnDirection direction = TurnDirection::counter_clockwise;
    double cost = 0;
  };
  struct Open {
    double estimate = 0;
    std::uint32_t level = 0, group = 0;
    bool operator<(const Open& o) const {
      return std::tuple{estimate, level, group} > std::tuple{o.estimate, o.level, o.group};
    }
  };
  void expand(std::uint32_t level, std::uint32_t group, TurnDirection direction, std::size_t places);
  bool try_place(std::uint32_t from, std::uint32_t group, std::uint32_t to, TurnDirection direction,
      const Position& at);
  std::vector<Position> roomy(std::uint32_t level, std::uint32_t group, const Position& near, std::size_t most);
  std::vector<Visit>& visits(std::uint32_t level);
  void collect(std::uint32_t level, std::uint32_t group);
  bool neighbours(std::uint32_t level, std::uint32_t cell, std::uint32_t next, std::uint32_t next_cell) const;
  bool mismatch(std::uint32_t level, std::uint32_t next);

  const CspaceObstacle& obstacle_;
  PathLevels& levels_;
  Touching touching_;
  std::function<bool(std::uint32_t, std::uint32_t)> joined_;
  Pivot pivot_;
  double room_ = 0;
  double goal_angle_ = 0;
  std::vector<std::vector<Visit>> visits_;
  std::vector<Open> open_;
  std::vector<PathStep> steps_;
  std::uint64_t rotations_ = 0;
};

}  // namespace dymsum::planar
