// How the vertices of a sum lie to each other, exactly: signs of determinants of their positions, by doubles of double
// length where these decide, else by integers. Nothing is brought to lowest terms: a sign needs no fraction.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "exact/big.h"
#include "exact/int.h"
#include "exact/interval.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum::spatial {

class VertexSigns {
 public:
  /// The sum has to live as long.
  explicit VertexSigns(const SpatialSum& sum) : sum_(sum) {}

  /// The sign of the component of (b - a) x (c - a) along an axis.
  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t axis);
  /// The sign of det(b - a, c - a, d - a).
  int side(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);

 private:
  using Fine = exact::Vector3<exact::FineInterval>;
  /// (x, y, z) / w, in units that no sign depends on, and the same over powers of two that no coordinate exceeds.
  struct Position {
    std::array<exact::BigInteger, 4> h;
    Fine fine;
  };
  /// All of them are made when one is requested.
  const Position& position(std::uint32_t v) {
    if (positions_.empty()) make_positions();
    return positions_[v];
  }
  void make_positions();

  const SpatialSum& sum_;
  std::vector<Position> positions_;
};

// Faces of a solid sum split into triangles.

/// Every face as triangles of its own vertices, counter-clockwise seen from outside, each with area: all edges of the
/// loops once, all others twice. Exact. O(n^2) for a face of n vertices, and O(n) more for each hole.
Triangles triangulated(const SpatialSum& sum);

/// The first face that has none, as its loops cross or have no area; tight faces are counted after the others. Requires
/// plane faces of vertices in the order of positions, nothing else of what a sum is.
std::optional<std::size_t> first_without_triangles(const SpatialSum& sum);

// Vertices of a sum that touch a face inside it: its triangles have to have them as corners, too.

/// The triangles of a sum's faces, those that a vertex touches inside, or on a side that is no edge of the sum, split
/// there. Exact. O(n log n), and exact comparisons for the triangles near a vertex of others.
Triangles split_at_touching_vertices(const SpatialSum& sum, Triangles triangles);

}  // namespace dymsum::spatial
