// The patch that is nearest to a configuration, by branch and bound.
#pragma once

#include <array>
#include <vector>

#include "cspace/queries/patch_interval.h"

namespace dymsum::cspace {

// A hierarchy of boxes around intervals of patches in configuration space, four to a node so that their distances are
// computed side by side.

class PatchTree {
 public:
  static constexpr std::size_t kWide = 4;

  /// Boxes by their midpoints and halves, roundings included.
  struct Node {
    std::array<double, kWide> x{}, x_half{}, y{}, y_half{}, theta{}, theta_half{};
    std::array<std::uint32_t, kWide> first{};  ///< of the intervals if there is a count, else another node
    std::array<std::uint32_t, kWide> count{};  ///< a box without any child is infinitely far
  };
  /// A box along the edge of an interval.
  struct Slab {
    Point along;
    double u = 0, u_half = 0, v = 0, v_half = 0, theta = 0, theta_half = 0;
  };

  /// `weight`: lengths per radian, for choosing where to split.
  PatchTree(const CspaceObstacle& obstacle, const PatchForms& forms, double weight);

  const Node& node(std::uint32_t k) const { return nodes_[k]; }  ///< the root is 0
  const PatchInterval& interval(std::uint32_t k) const { return intervals_[k]; }
  const Slab& slab(std::uint32_t k) const { return slabs_[k]; }
  std::size_t bytes() const;

 private:
  std::vector<PatchInterval> intervals_;
  std::vector<Slab> slabs_;
  std::vector<Node> nodes_;
};

/// The smallest square distances of any point of the boxes to (x, y, theta), angles a whole turn apart being the same.
std::array<double, PatchTree::kWide> square_distances(const PatchTree::Node& node, Point at, double theta,
                                                      double weight);
double square_distance(const PatchTree::Slab& slab, Point at, double theta, double weight);

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
