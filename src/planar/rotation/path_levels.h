// The orientations at which a planner looks at slices, in their order round the circle, and the components they meet.
#pragma once

#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "dymsum/planner.h"
#include "planar/rotation/pivot.h"
#include "planar/rotation/slice_graph.h"

namespace dymsum::planar {

/// One orientation with its slice.
struct PathLevel {
  Orientation theta;
  ExactAngle angle;
  std::unique_ptr<SliceMap> map;      // made when first looked at
  std::unique_ptr<SliceGraph> graph;
};

class PathLevels {
 public:
  PathLevels(const CspaceObstacle& obstacle, Touching touching, double frame);

  std::size_t size() const { return levels_.size(); }
  const Orientation& theta(std::size_t k) const { return levels_[k]->theta; }
  const ExactAngle& angle(std::size_t k) const { return levels_[k]->angle; }
  const SliceMap& map(std::size_t k);
  const SliceGraph& graph(std::size_t k);
  std::uint64_t slices() const { return slices_; }

  /// The number of the level at this orientation, which is made if there is none. Numbers behind it change.
  std::size_t add(const Orientation& theta);
  /// Levels at one orientation of every slab, and with touching at every rational event angle.
  void add_all();
  /// One or two more between level k and the next, nearer to the event between them.
  std::vector<Orientation> between(std::size_t k) const;

  /// The free cell of a face of a level, at an event angle that of the slab behind it; kNone where it is not known.
  std::uint32_t cell(std::size_t k, std::uint32_t face);
  /// The free cells of all faces that a group of a level consists of.
  std::vector<std::uint32_t> cells(std::size_t k, std::uint32_t group);
  /// Their components.
  std::vector<std::uint32_t> components(std::size_t k, std::uint32_t group);
  /// The slab of a level; nothing at an event angle.
  std::optional<std::uint32_t> slab(std::size_t k) const { return obstacle_.slab_of(levels_[k]->theta); }

 private:
  std::uint32_t cell_in_slab(std::uint32_t slab, const SliceMap& map, std::uint32_t edge);
  std::uint32_t cell_beside(std::size_t k, std::uint32_t face);

  const CspaceObstacle& obstacle_;
  Touching touching_;
  double frame_;
  std::vector<std::unique_ptr<PathLevel>> levels_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> patches_;  // by slab
  std::unordered_map<const PathLevel*, std::vector<std::optional<std::uint32_t>>> known_;
  Pivot pivot_;
  std::uint64_t slices_ = 0;
};

}  // namespace dymsum::planar
