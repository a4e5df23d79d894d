// The boundary of one side of an angle, at the angle itself: where it touches itself there, and what that adds to the
// Euler numbers of the surfaces that the boundaries of all angles form. docs/design/cspace-obstacle.md, "Euler
// numbers".
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "cspace/boundary/boundary_graph.h"

namespace dymsum::planar {

/// A sub-edge of a loop with free space on its right, and the index of the one after it; kNobody where that is left
/// out, as all is that comes to no position that is looked at.
struct LimitEdge {
  SubEdge at;
  std::uint32_t next = 0;
};

struct BoundaryLimit {
  /// A fraction for every sub-edge: the sum over those of one surface is twice what the surface gains between the angle
  /// and this side of it.
  std::vector<int> halves;
  /// Sub-edges that belong to one surface where the free space is made smaller by a trifle.
  std::vector<std::array<std::uint32_t, 2>> together;
  /// A position where the limit passes more than once, in the forms' doubles.
  std::optional<Point> touch;
  /// What was left out comes to a position after all: nothing above counts.
  bool more_is_needed = false;
};

/// Exact. O(n log n) and the pairs of sub-edges whose boxes meet, in doubles; exact signs where doubles do not keep
/// them apart. Throws std::logic_error unless the sub-edges are the loops of the boundary at near angles.
BoundaryLimit limit_of(const SignsAt& signs, const std::vector<LimitEdge>& edges);

/// The limits from before and from after at the graph's angle, by nodes: shares of surfaces, nodes of one surface, and
/// a position where one of the two limits touches itself. `near`, unless it is empty: all nodes, increasing, that come
/// to positions at which the boundary changes or touches itself; else all nodes are looked at.
struct LimitsOfAngle {
  std::vector<std::pair<std::uint32_t, int>> halves;
  std::vector<std::array<std::uint32_t, 2>> together;
  std::optional<Point> touch;
};
LimitsOfAngle limits_of_angle(const SignsAt& signs, const BoundaryGraph& graph,
                              const std::vector<std::uint32_t>& near = {});

}  // namespace dymsum::planar
