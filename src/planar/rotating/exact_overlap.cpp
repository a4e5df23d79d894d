#include "planar/rotating/exact_overlap.h"

#include "exact/rounding_bound.h"

namespace dymsum::planar {
namespace {

/// Of a position rounded from the exact one relative to a pair of vertices, times the span: the difference, two
/// vertices of three roundings each and two sums.
constexpr double kRoundedPlace = exact::rounding_bound(9, 32);

}  // namespace

bool ExactOverlap::inside_right_of(const Segment& on, const std::optional<Segment>& from,
                                   const std::optional<Segment>& to) {
  if (!placed_) {
    placed_ = placed_at(*base_, theta_);
    collision_.emplace(*placed_->lattice, *placed_->p, *placed_->q, true);
  }
  const Lattice& l = *placed_->lattice;
  Place p;
  p.on = on;
  const auto cut = [&](const std::optional<Segment>& by, Pair end) {
    Cut c;
    if (by) {
      c.kind = Cut::Kind::crossing;
      c.by = *by;
    } else {
      c.pair = end;
    }
    return c;
  };
  p.first = cut(from, start_of(p.on));
  p.second = cut(to, end_of(p.on));
  p.between = true;
  // The exact place, rounded, relative to the start, whose doubles are known.
  const Pair start = start_of(p.on);
  const Lattice::Position at = l.position(p), origin = l.position(start);
  p.x = l.points[0]->x[start.p] + l.points[1]->x[start.q] +
        exact::round_to_double(exact::BigRational(at.x - origin.x)) / l.unit;
  p.y = l.points[0]->y[start.p] + l.points[1]->y[start.q] +
        exact::round_to_double(exact::BigRational(at.y - origin.y)) / l.unit;
  p.error = kRoundedPlace * l.span;
  return collision_->overlaps_right_of(p);
}

}  // namespace dymsum::planar
