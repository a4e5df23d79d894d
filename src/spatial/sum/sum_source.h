// What exact positions of a SpatialSum are made from.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/result.h"
#include "dymsum/spatial_sum.h"
#include "exact/big.h"
#include "spatial/convex/exact_positions.h"
#include "spatial/convolution/sum_space.h"

namespace dymsum::spatial {

using ExactPosition = std::array<exact::BigRational, 3>;

/// The positions of the vertices of a sum: common points of planes in a space, or, of convex operands, sums of their
/// vertices.
struct SpatialPositions {
  std::shared_ptr<const SumSpace> space;
  std::vector<PointSource> vertices;
  std::shared_ptr<const ConvexPositions> convex;  ///< of a convex sum, which has no space
  exact::BigInteger scale = 1;                    ///< positions are those of space or convex places divided by it
  int shift = 0;                                  ///< and times 2^shift
  /// Of a sum that has neither of these, as one that was read: positions (x, y, z) / w.
  std::vector<std::array<exact::BigInteger, 4>> listed;
  std::shared_ptr<const struct MappedSum> mapped;  ///< of a sum that is the image of another one (mapped_sum.h)

  ExactPosition at(std::size_t vertex) const;
  /// The nearest doubles.
  Point3 rounded(std::size_t vertex) const;

  // The position for comparisons with others. All are seen from an origin near the sum, in units of powers of two along
  // each axis: the grid's.
  /// x, y, z and w > 0: the position is (x, y, z) / w, not in lowest terms.
  std::array<exact::BigInteger, 4> homogeneous(std::size_t vertex) const;
  /// The exponents of the units of homogeneous().
  std::array<int, 3> unit_exponents() const;
  /// The position in multiples of 2^-shift along each axis, rounded down; `exact` becomes false where that changes it.
  std::array<exact::BigInteger, 3> multiples(std::size_t vertex, const std::array<int, 3>& shift, bool& exact) const;
  /// Raises exponents to those of powers of two that the coordinates do not exceed.
  void grow(std::size_t vertex, std::array<int, 3>& exponents) const;
};

struct SpatialSumInternals {
  static void set_positions(SpatialSum& sum, std::shared_ptr<const SpatialPositions> positions) {
    sum.positions_ = std::move(positions);
  }
  /// What touches along each of the sum's edges, in their order.
  static void set_edge_contacts(SpatialSum& sum, std::vector<std::optional<SolidContact>> contacts) {
    sum.edge_contacts_ = std::move(contacts);
  }
  static const SpatialPositions& positions(const SpatialSum& sum) { return *sum.positions_; }
  /// Nothing where it is no convex sum.
  static const ConvexPositions* convex(const SpatialSum& sum) {
    return sum.is_convex() ? sum.positions_->convex.get() : nullptr;
  }
};

/// Divides a sum of sets in units of 2^shift / scale by these. Requires that the quotient is a double: 0 < scale <
/// 2^shift 2^1000.
void unscale(SpatialSum& sum, const exact::BigInteger& scale, int shift = 0);

// Operands whose common grid has more bits than a space of sums holds.

/// What a space of sums needs: bits on the axis that needs most, and the vertex of either list that has the smallest
/// unit there.
struct GridNeed {
  int bits = 0;
  char axis = 'x';
  std::size_t vertex = 0;
  Point3 at;
};
/// Requires: both have vertices.
GridNeed grid_need(const std::vector<Point3>& p, const std::vector<Point3>& q);

/// unsupported_operand, with the vertex whose coordinate has the smallest unit on the axis that needs most bits;
/// nothing where kMostGridBits do. Requires: both have vertices.
std::optional<Error> grid_error(const std::vector<Point3>& p, const std::vector<Point3>& q);

}  // namespace dymsum::spatial
