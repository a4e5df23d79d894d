#include "planar/convolution/parallelogram_sides.h"

namespace dymsum::planar {

bool makes_parallelograms(Semantics semantics, const Operand& p, const Operand& q) {
  return semantics != Semantics::open && has_component_without_area(p) && has_component_without_area(q);
}

std::vector<WalkSegment> parallelogram_sides(const Lattice& lattice, const Operand& p, const Operand& q) {
  std::vector<WalkSegment> sides;
  for (const Component& cp : p.components)
    for (const Component& cq : q.components) {
      if (cp.dimension != 1 || cq.dimension != 1) continue;
      for (std::uint32_t e = cp.first; e < cp.last; ++e)
        for (std::uint32_t f = cq.first; f < cq.last; ++f) {
          if (lattice.cross(p.edge(e), q.edge(f)) <= 0) continue;
          sides.push_back({0, e, f});
          sides.push_back({1, f, p.next[e]});
        }
    }
  return sides;
}

}  // namespace dymsum::planar
