#include "planar/operand/round_place.h"

#include "planar/operand/sum_bounds.h"

namespace dymsum::planar {

void round_place(const Lattice& lattice, Place& place) {
  const Pair start = start_of(place.on);
  const Lattice::Position at = lattice.position(place), from = lattice.position(start);
  const PlacedPoints &p = *lattice.points[0], &q = *lattice.points[1];
  const exact::BigRational unit = exact::exact_value(lattice.unit);
  place.x = p.x[start.p] + q.x[start.q] + exact::round_to_double(exact::BigRational((at.x - from.x) / unit));
  place.y = p.y[start.p] + q.y[start.q] + exact::round_to_double(exact::BigRational((at.y - from.y) / unit));
  place.error = kRoundedPlace * lattice.span;
}

}  // namespace dymsum::planar
