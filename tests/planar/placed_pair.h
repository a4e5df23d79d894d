// Two regions as operands on their common lattice: what the stages of a sum start from.
#pragma once

#include <memory>

#include "planar/operand/prepared_region.h"

namespace dymsum::planar {

struct PlacedPair {
  PlacedPair(const Region& a, const Region& b) {
    const auto kept_p = prepared_operand(a, 0), kept_q = prepared_operand(b, 1);
    lattice = make_lattice(kept_p->points, kept_q->points, 0);
    p = placed_on(*lattice, kept_p);
    q = placed_on(*lattice, kept_q);
  }
  std::shared_ptr<const Lattice> lattice;
  std::shared_ptr<const Operand> p, q;
};

}  // namespace dymsum::planar
