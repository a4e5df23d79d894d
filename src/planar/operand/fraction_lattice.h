// The vertices of an operand that is the result of other operations: fractions, each over a denominator of its own.
#pragma once

#include <cstdint>
#include <vector>

#include "exact/big.h"
#include "planar/operand/make_lattice.h"

namespace dymsum::planar {

struct FractionPoints {
  std::vector<exact::HomogeneousPoint> at;  ///< in input coordinates and lowest terms
  std::vector<Point> nearest;               ///< their nearest doubles

  /// The vector from one vertex to another in units of 2^unit, each component rounded once; zero only where it is.
  Point vector(std::uint32_t from, std::uint32_t to, int unit) const;
  /// The same, times a power of two, so that the larger component is far from under- and overflow; each component errs
  /// by at most one rounding and 2^-61 of the larger one, and is zero only where it is.
  Point direction(std::uint32_t from, std::uint32_t to) const;
  /// The sign of the difference of two vertices along an axis (0 = x, 1 = y).
  int compare(std::uint32_t i, std::uint32_t j, int axis) const;
  /// The sign of d x e, of d . e for edge vectors.
  int cross(const Edge& d, const Edge& e) const;
  int dot(const Edge& d, const Edge& e) const;

 private:
  exact::HomogeneousPoint difference(std::uint32_t from, std::uint32_t to) const;
};

/// The points in units of 1 where they are moderate; their nearest doubles are the input. Requires: not empty.
std::shared_ptr<const PlacedPoints> fractions_as_points(std::vector<exact::HomogeneousPoint> at);

/// x and y of such points in units of 2^unit, rounded once.
void fractions_in_units(PlacedPoints& points, int unit);

/// The lattice of operands of which one has fractions for vertices, or both: its numbers have any size.
std::shared_ptr<const Lattice> make_fraction_lattice(LatticePoints points);

}  // namespace dymsum::planar
