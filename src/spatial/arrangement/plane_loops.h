// The loops of half-edges in one plane, the connected components that they belong to, and the faces that these lie in.
#pragma once

#include <cstdint>
#include <vector>

#include "spatial/arrangement/plane_half_edges.h"

namespace dymsum::spatial {

/// Loops have indices from 0 on, in the order of their first half-edges, and components in that of their first loops.
class PlaneLoops {
 public:
  PlaneLoops(const PlanePoints& points, const PlaneHalfEdges& half_edges) : points_(points), half_edges_(half_edges) {}

  /// Finds the loops of the half-edges as they are now. Exact. O(n + c l) for c components with l loops around them.
  void run();

  std::uint32_t count() const { return static_cast<std::uint32_t>(start_.size()); }
  std::uint32_t start(std::uint32_t loop) const { return start_[loop]; }
  std::uint32_t of(std::uint32_t half_edge) const { return of_[half_edge]; }
  /// Whether the outside of a component is to the left of a loop.
  bool is_outer(std::uint32_t loop) const { return is_outer_[loop]; }

  std::uint32_t components() const { return static_cast<std::uint32_t>(lowest_.size()); }
  /// The loop around a component.
  std::uint32_t outer(std::uint32_t component) const { return outer_[component]; }
  /// The loop in whose face a component lies; kNoId where it is the plane's outside.
  std::uint32_t home(std::uint32_t component) const { return home_[component]; }
  /// The face of a loop: the loop itself, or for the outside of a component what it lies in; kNoId for the plane's
  /// outside.
  std::uint32_t face(std::uint32_t loop) const { return is_outer_[loop] ? home_[component_[loop]] : loop; }

 private:
  struct LoopBox {
    double low_x = 1e300, low_y = 1e300, high_x = -1e300, high_y = -1e300;
  };

  void trace();
  void find_components();
  void join();
  void nest();
  void find_boxes();
  bool before(PointId a, PointId b) const;
  bool near(std::uint32_t loop, PointId p) const;
  bool encloses(std::uint32_t loop, PointId p) const;
  PointId lowest_point(std::uint32_t component) const { return half_edges_.points()[lowest_[component]]; }

  const PlanePoints& points_;
  const PlaneHalfEdges& half_edges_;
  std::vector<std::uint32_t> start_, of_, component_;  // per loop, per half-edge, per loop
  std::vector<std::uint32_t> lowest_, outer_, home_;   // per component; its lowest point by index
  std::vector<bool> is_outer_;
  std::vector<LoopBox> box_;
  std::vector<std::uint32_t> parent_, index_;  // scratch of join()
  std::vector<std::uint32_t> around_;          // scratch of nest()
};

}  // namespace dymsum::spatial
