// The orientations at which a planner looks at slices, in their order round the circle, and the components they meet.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "base/memory_budget.h"
#include "cspace/boundary/boundary_graph.h"
#include "cspace/motion/pivot.h"
#include "cspace/planner/slice_graph.h"
#include "dymsum/planner.h"
#include "dymsum/progress.h"

namespace dymsum::planar {

// How long a search goes on.

enum class SearchStop : std::uint8_t { none, cancelled, out_of_time };

struct SearchLimits {
  std::chrono::steady_clock::time_point deadline;
  Progress progress;

  /// The search queries it between two steps.
  SearchStop query() const {
    if (progress && !progress("search", 0)) return SearchStop::cancelled;
    return std::chrono::steady_clock::now() > deadline ? SearchStop::out_of_time : SearchStop::none;
  }
};

/// A cell, or an edge, that is not known.
inline constexpr std::uint32_t kUnknown = SliceMap::kNone;

/// One orientation with its slice.
struct PathLevel {
  explicit PathLevel(const Orientation& at) : theta(at), angle(exact_angle(at)) {}
  Orientation theta;
  ExactAngle angle;
  std::uint32_t id = 0;  // in the order in which they were added
  std::optional<std::uint32_t> slab;
  std::unique_ptr<SliceMap> map;  // made when it is looked at
  std::unique_ptr<SliceGraph> graph;
  std::uint64_t looked_at = 0;
  std::vector<std::optional<std::vector<std::uint32_t>>> cells;  // by group
};

class PathLevels {
 public:
  PathLevels(const CspaceObstacle& obstacle, const PlanOptions& options, double frame);

  std::size_t size() const { return levels_.size(); }
  const Orientation& theta(std::size_t k) const { return levels_[k]->theta; }
  const ExactAngle& angle(std::size_t k) const { return levels_[k]->angle; }
  /// What stays the same while indices change.
  const PathLevel* level(std::size_t k) const { return levels_[k].get(); }
  std::size_t index_of(const PathLevel* level) const;
  /// Both are valid until let_go().
  const SliceMap& map(std::size_t k);
  const SliceGraph& graph(std::size_t k);
  /// Lets go of slices where they take more than PlanOptions::slice_bytes: those that were not looked at for longest
  /// go, and are made again when they are wanted.
  void let_go();
  std::uint64_t slices() const { return slices_; }

  /// The index of the level at this orientation, which is made if there is none. Indices after it change.
  std::size_t add(const Orientation& theta);
  /// Levels at one orientation of every slab, and with touching at every rational event angle.
  void add_all();
  /// The event between level k and the next, or at the next: at most one where every slab has a level.
  std::optional<std::uint32_t> event_before_next(std::size_t k) const;
  /// One or two more between level k and the next, nearer to the event between them. What is between two levels has
  /// at most half the length in the tangent of the half angle after two such steps.
  std::vector<Orientation> between(std::size_t k) const;

  /// The free cells of all faces that a group of a level consists of, increasing: one for each loop of a face's
  /// boundary, at an event angle those in the slab after it. kNone stands for one that is not known.
  const std::vector<std::uint32_t>& cells(std::size_t k, std::uint32_t group);
  /// Their components.
  std::vector<std::uint32_t> components(std::size_t k, std::uint32_t group);
  /// The slab of a level; nothing at an event angle.
  std::optional<std::uint32_t> slab(std::size_t k) const { return levels_[k]->slab; }
  /// That, or the one after the event.
  std::uint32_t slab_after(std::size_t k) const;

 private:
  static std::array<std::uint32_t, 3> key_of(const Contact& c) {
    return {static_cast<std::uint32_t>(c.kind), c.p, c.q};
  }
  void hold(std::uint64_t bytes);
  std::uint32_t cell_in_slab(std::uint32_t slab, const SliceMap& map, std::uint32_t edge);
  std::vector<std::uint32_t> cells_of(std::uint32_t slab, const SliceMap& map, const SliceGraph& graph,
                                      std::uint32_t face);
  std::vector<std::uint32_t> cells_beside(std::size_t k, std::uint32_t face);

  const CspaceObstacle& obstacle_;
  Touching touching_;
  std::uint64_t most_bytes_;
  double frame_;
  std::vector<std::unique_ptr<PathLevel>> levels_;
  std::map<std::array<std::uint32_t, 3>, std::vector<std::uint32_t>> patches_;  // by contact
  std::uint64_t bytes_ = 0, looks_ = 0;                                         // of slices: those held
  base::HeldMemory held_;
  Pivot pivot_;
  std::uint64_t slices_ = 0;
};

// The components of free space that belong together, and what there is to say about one.

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
