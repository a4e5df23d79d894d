#include "planar/operand/round_position.h"

#include "planar/operand/sum_bounds.h"

namespace dymsum::planar {

void round_position(const Lattice& lattice, SegmentPosition& position) {
  const Pair start = start_of(position.on);
  const Lattice::Position at = lattice.position(position), from = lattice.position(start);
  const PlacedPoints &p = *lattice.points[0], &q = *lattice.points[1];
  const exact::BigRational unit = exact::exact_value(lattice.unit);
  position.x = p.x[start.p] + q.x[start.q] + exact::round_to_double(exact::BigRational((at.x - from.x) / unit));
  position.y = p.y[start.p] + q.y[start.q] + exact::round_to_double(exact::BigRational((at.y - from.y) / unit));
  position.error = kRoundedPosition * lattice.span;
}

}  // namespace dymsum::planar
