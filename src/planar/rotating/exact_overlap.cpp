#include "planar/rotating/exact_overlap.h"

#include "planar/operand/round_place.h"

namespace dymsum::planar {

bool ExactOverlap::inside_right_of(const Segment& on, const std::optional<Segment>& from,
                                   const std::optional<Segment>& to) {
  if (!placed_) {
    placed_ = placed_at(*base_, theta_);
    collision_.emplace(*placed_->lattice, *placed_->p, *placed_->q, true);
  }
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
  round_place(*placed_->lattice, p);
  return collision_->overlaps_right_of(p);
}

}  // namespace dymsum::planar
