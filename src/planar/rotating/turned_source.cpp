#include "planar/rotating/turned_source.h"

#include "planar/turning/slice.h"

namespace dymsum::planar {

PlacedPair TurnedSource::placed() const { return placed_at(base(), theta_); }

// Sums with one vertex of the turning operand differ as the vertices that stand still do.
std::optional<int> TurnedSource::compare_corners(const SumVertex& a, const SumVertex& b, int axis) const {
  const std::uint32_t still = 1 - base().moved;
  if ((still == 0 ? a.corner_q : a.corner_p) != (still == 0 ? b.corner_q : b.corner_p)) return std::nullopt;
  const auto& source = base().operands[still].numbered_vertex;
  const std::vector<Point>& input = base().lattice->points[still]->input;
  const Point &u = input[source[still == 0 ? a.corner_p : a.corner_q]],
              &v = input[source[still == 0 ? b.corner_p : b.corner_q]];
  const double x = axis == 0 ? u.x : u.y, y = axis == 0 ? v.x : v.y;
  return x < y ? -1 : x > y;
}

}  // namespace dymsum::planar
