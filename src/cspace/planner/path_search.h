// A way through the levels of a planner: rotations in place from level to level, joined by the free pieces of slices.
// Where a passage is too narrow for the levels there are, more are put between, there alone.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "cspace/planner/path_levels.h"

namespace dymsum::planar {

// The pieces of neighbouring levels that free space may join, and how many free cells lie between a piece and the goal.

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

/// Two neighbouring levels, a position that was reached at one of them, and one at the other that was not.
struct PathBarrier {
  Orientation from, to;  ///< counter-clockwise
  Position reached, beyond;
};

class PathSearch {
 public:
  PathSearch(const CspaceObstacle& obstacle, PathLevels& levels, PathLinks& links, Touching touching);

  enum class Outcome : std::uint8_t { found, nothing, cancelled, out_of_time };
  /// Requires: both are levels, and free. `nothing`: no piece is reached next to one that is not and that it may be
  /// joined to. Ends with `found` if a path exists that keeps some distance from the obstacle, given the time.
  Outcome run(const PathEnd& start, const PathEnd& goal, const SearchLimits& limits);
  /// The steps of a search that found a path; the goal is then reached by translations.
  std::vector<PathStep> steps() const;
  /// The position, nearest to the goal, that a search reached which ran out of time.
  std::optional<PathBarrier> barrier();
  std::uint64_t rotations() const { return rotations_; }
  std::uint64_t refinements() const { return refinements_; }

 private:
  struct Visit {
    const PathLevel* level = nullptr;
    std::uint32_t group = 0, from = 0;  // an index of visits_; its own at the start
    Position at;                        // of the rotation from there
    TurnDirection direction = TurnDirection::counter_clockwise;
    double cost = 0;
  };
  struct Open {
    double estimate = 0;
    std::uint32_t visit = 0;
    TurnDirection direction = TurnDirection::counter_clockwise;
    bool operator<(const Open& o) const {
      return std::tuple{estimate, visit, direction} > std::tuple{o.estimate, o.visit, o.direction};
    }
  };
  // A gap between a level and the next, where a piece is reached and one it may be joined to is not. The order: gaps
  // near the goal first, but not so that one waits for ever, as each gap that is filled leaves deeper ones.
  struct Stuck {
    std::uint32_t steps = 0, depth = 0;
    double width = 0;
    const PathLevel *low = nullptr, *high = nullptr;
    bool operator<(const Stuck& o) const {
      return std::tuple{steps + depth, -width, low->id} > std::tuple{o.steps + o.depth, -o.width, o.low->id};
    }
  };
  void visit(Visit v);
  std::optional<Outcome> expand_all(const SearchLimits& limits);
  void expand(std::uint32_t visit, TurnDirection direction);
  bool try_place(std::uint32_t visit, std::size_t to, TurnDirection direction, const Position& at);
  std::vector<Position> roomy(std::size_t level, std::uint32_t group, const Position& near, std::size_t most);
  std::vector<std::uint32_t>& visits_at(std::size_t level);
  bool reached(std::size_t level, std::uint32_t group) { return visits_at(level)[group] != SliceMap::kNone; }
  std::vector<std::uint32_t> wanted(std::size_t level, std::uint32_t group, std::size_t to, TurnDirection direction);
  void queue_stuck();
  std::optional<Stuck> stuck_at(const PathLevel* low);
  std::optional<Stuck> next_stuck();
  void refine(const Stuck& gap);

  PathLevels& levels_;
  PathLinks& links_;
  Touching touching_;
  Pivot pivot_;
  double room_ = 0;
  double goal_angle_ = 0;
  std::uint32_t goal_group_ = 0;
  const PathLevel* goal_level_ = nullptr;
  std::vector<Visit> visits_;
  std::uint32_t last_ = 0;  // of a way that was found
  std::unordered_map<const PathLevel*, std::vector<std::uint32_t>> visits_at_;
  std::priority_queue<Open> open_;
  std::vector<const PathLevel*> touched_;  // gaps after them
  std::unordered_map<const PathLevel*, std::uint32_t> depth_;
  std::priority_queue<Stuck> stuck_;
  std::uint64_t rotations_ = 0, refinements_ = 0;
};

}  // namespace dymsum::planar
