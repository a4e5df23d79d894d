// Which facets lie deep inside the open sum, at all poses near one.
#pragma once

#include <optional>
#include <vector>

#include "spatial/convolution/inner_cells.h"
#include "spatial/frames/posed_pair.h"

namespace dymsum::spatial {

/// The linear part of a pose in doubles.
Mat3 linear_map(const SolidPose& pose);

class InnerWindow {
 public:
  /// About a pair of poses, as long as no point moves by more than `share` of a box: see sweep(). With `across` boxes
  /// over the sum.
  InnerWindow(const SolidPair& pair, const PosePair& poses, int across, double share);
  /// Finds the boxes inside; to be called before hold().
  void fill(const SolidPair& pair, StageWatch& watch);

  /// What the window says is true at all poses that are no further away.
  double sweep() const { return sweep_; }
  /// At least how far a point of P moves, plus one of Q, relative to the middles of their boxes.
  double moved_to(const PosePair& poses) const;
  /// Whether a facet lies in the open sum at all poses of the window.
  bool hold(const SumFacet& facet) const { return cells_->hold(facet); }

 private:
  int across_;
  PosePair poses_;
  std::array<double, 2> radius_{};  // of operands about the middles of their boxes, before posing
  double sweep_ = 0, own_sweep_ = 0;  // in positions, in units of the space
  PosedSpace at_;
  std::optional<InnerCells> cells_;
};

/// At least the distance of any point of a solid from the middle of its box.
double radius_about_middle(const std::vector<Point3>& vertices);
/// At least how far a point within a radius of the origin moves from one pose to another one.
double displacement(const SolidPose& from, const SolidPose& to, double radius);

}  // namespace dymsum::spatial
