// How the vertices of a sum lie to each other, exactly: signs of determinants of their positions, by doubles of double
// length where these decide, else by integers. Nothing is brought to lowest terms: a sign needs no fraction.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "exact/big.h"
#include "exact/interval.h"
#include "exact/vector3.h"

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

}  // namespace dymsum::spatial
