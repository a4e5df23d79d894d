// Positions of the vertices of a sum as the doubles nearest to the exact ones. Every vertex of an operand is turned and
// scaled once, in pairs of doubles, two vertices at a time; a vertex of the sum is one addition, which proves its
// rounding or, hardly ever, leaves it to exact numbers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dymsum/convex_sum.h"
#include "spatial/convex/exact_positions.h"
#include "spatial/convex/facet_corners.h"

namespace dymsum::spatial {

class NearestPositions {
 public:
  /// Positions of some vertices of each operand, named by their indices in the operand. `source` has to outlive this.
  NearestPositions(const ConvexOperands& source, const std::array<std::span<const std::uint32_t>, 2>& vertices);

  /// O(vertices) for an operand whose pose is another one than before.
  void pose(const SolidPose& p, const SolidPose& q);
  /// at[i] becomes the doubles nearest to the exact position of pairs[i], by positions in the lists of vertices;
  /// infinite past the range of doubles. Entries whose pair is kNoPair are set to 0. Requires poses.
  void position(std::span<const VertexPair> pairs, std::span<Point3> at);
  /// How many vertices of the last call exact numbers decided.
  std::size_t decided_exactly() const { return decided_exactly_; }
  /// Memory held, without the exact numbers.
  std::size_t bytes() const;

 private:
  /// A posed vertex, within `error` of high + low. Three coordinates each, and a 0.
  struct alignas(32) Posed {
    std::array<double, 4> high, low, error;
  };
  struct Operand {
    std::vector<std::uint32_t> vertex;
    /// Coordinates as given: upper + lower in halves of 26 bits, and what a double does not hold, in `rest`, which is
    /// empty for doubles.
    std::array<std::vector<double>, 3> upper, lower, rest;
    bool decides = true;          ///< no coordinate is out of range
    std::array<bool, 3> exact{};  ///< high + low of this coordinate are exact, of all vertices
    std::vector<Posed> posed;
    std::optional<SolidPose> pose;
  };
  void take(Operand& operand, const ConvexOperands::Operand& source, std::span<const std::uint32_t> vertices);
  void pose(Operand& operand, const SolidPose& pose);
  Point3 in_doubt(VertexPair pair);
  std::optional<double> exact_in_doubles(VertexPair pair, std::size_t coordinate) const;
  Point3 exactly(VertexPair pair);

  const ConvexOperands* source_;
  std::array<Operand, 2> operand_;
  std::optional<ExactPositions> exactly_;
  std::size_t decided_exactly_ = 0;
};

// The order of positions of a convex sum: by x, then y, then z.

/// The doubles nearest to the exact positions of vertices, infinite past the range of doubles.
std::vector<Point3> nearest_positions(const ConvexOperands& operands, const SolidPose& p, const SolidPose& q,
                                      std::span<const ConvexSum::Vertex> vertices);

/// The indices of vertices with different positions by these positions, of which `nearest` are the nearest doubles.
/// Exact: where doubles are equal, what they leave out decides. O(n log n) comparisons of doubles.
std::vector<std::uint32_t> order_by_position(const ConvexOperands& operands, const SolidPose& p, const SolidPose& q,
                                             std::span<const ConvexSum::Vertex> vertices,
                                             std::span<const Point3> nearest);

}  // namespace dymsum::spatial
