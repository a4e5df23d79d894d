// A hierarchy of boxes around intervals of patches in configuration space, four to a node so that their distances are
// computed side by side.
#pragma once

#include <array>
#include <vector>

#include "cspace/queries/patch_interval.h"

namespace dymsum::cspace {

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

}  // namespace dymsum::cspace
