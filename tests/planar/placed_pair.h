// Two regions as operands on their common lattice: what the stages of a sum start from.
#pragma once

#include "planar/operand/operand.h"

namespace dymsum::planar {

inline PlacedPair placed_pair(const Region& a, const Region& b) {
  const auto p = prepared_operand(a, 0), q = prepared_operand(b, 1);
  const auto lattice = make_lattice(p->points, q->points, 0);
  return {lattice, placed_on(*lattice, p), placed_on(*lattice, q)};
}

}  // namespace dymsum::planar
