// What a segment of the convolution is called in the regions.
#pragma once

#include "dymsum/planar_sum.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

/// Requires: operands P and Q.
inline Contact contact_of(const WalkSegment& s, const Operand& p, const Operand& q) {
  if (s.side == 0) return {Contact::Kind::edge_of_p, p.edge_number[s.edge], q.vertex_number[s.vertex]};
  return {Contact::Kind::edge_of_q, p.vertex_number[s.vertex], q.edge_number[s.edge]};
}

}  // namespace dymsum::planar
