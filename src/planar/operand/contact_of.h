// What a segment of the convolution is called in the regions.
#pragma once

#include "dymsum/planar_sum.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

/// Requires: operands P and Q.
inline Contact contact_of(const WalkSegment& s, const Operand& p, const Operand& q) {
  if (s.side == 0) return {Contact::Kind::edge_of_p, p.edge_index[s.edge], q.vertex_index[s.vertex]};
  return {Contact::Kind::edge_of_q, p.vertex_index[s.vertex], q.edge_index[s.edge]};
}

}  // namespace dymsum::planar
