// Both operands of a sum where they stand.
#pragma once

#include <memory>

namespace dymsum::planar {

class Lattice;
struct Operand;

/// P and Q on their common lattice.
struct PlacedPair {
  std::shared_ptr<const Lattice> lattice;
  std::shared_ptr<const Operand> p, q;
};

}  // namespace dymsum::planar
