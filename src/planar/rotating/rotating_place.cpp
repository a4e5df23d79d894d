#include "planar/rotating/rotating_place.h"

#include "exact/rounding_bound.h"

namespace dymsum::planar {
namespace {

/// Of a position rounded from the exact one relative to a pair of vertices, times the span: the difference, two
/// vertices of three roundings each and two sums.
constexpr double kRoundedPlace = exact::rounding_bound(9, 32);

}  // namespace

// Both lie on one contact whose edge stands still and is upright (axis 0) or level (axis 1): rectilinear shapes ask
// this all the time.
bool TurnedSource::on_common_line(const SumVertex& a, const SumVertex& b, int axis) const {
  const std::uint32_t still = 1 - base_->scaled;
  const auto straight = [&](const Contact& c) {
    if ((c.kind == Contact::Kind::edge_of_p ? 0u : 1u) != still) return false;
    const auto [from, to] = base_->operands[still].numbered_edge[still == 0 ? c.p : c.q];
    const Point &u = base_->lattice->points[still]->input[from], &v = base_->lattice->points[still]->input[to];
    return axis == 0 ? u.x == v.x : u.y == v.y;
  };
  for (const Contact& c : {a.in, a.out})
    if ((c == b.in || c == b.out) && straight(c)) return true;
  return false;
}

// Sums with one vertex of the turning operand differ as the vertices that stand still do.
std::optional<int> TurnedSource::compare_corners(const SumVertex& a, const SumVertex& b, int axis) const {
  const std::uint32_t still = 1 - base_->scaled;
  if (a.corner_p == SumVertex::kNone || b.corner_p == SumVertex::kNone) return std::nullopt;
  if ((still == 0 ? a.corner_q : a.corner_p) != (still == 0 ? b.corner_q : b.corner_p)) return std::nullopt;
  const auto& source = base_->operands[still].numbered_vertex;
  const std::vector<Point>& input = base_->lattice->points[still]->input;
  const Point &u = input[source[still == 0 ? a.corner_p : a.corner_q]],
              &v = input[source[still == 0 ? b.corner_p : b.corner_q]];
  const double x = axis == 0 ? u.x : u.y, y = axis == 0 ? v.x : v.y;
  return x < y ? -1 : x > y;
}

int TurnedSource::compare(const SumVertex& a, const SumVertex& b, int axis) const {
  if (on_common_line(a, b, axis)) return 0;
  if (const std::optional<int> sign = compare_corners(a, b, axis)) return *sign;
  return axis == 0 ? source().compare_x(a, b) : source().compare_y(a, b);
}

int TurnedSource::compare_x(const SumVertex& a, const SumVertex& b) const { return compare(a, b, 0); }
int TurnedSource::compare_y(const SumVertex& a, const SumVertex& b) const { return compare(a, b, 1); }

const SumSource& TurnedSource::source() const {
  std::call_once(made_, [this] {
    const SumState state = placed_at(*base_, theta_);
    source_ = std::make_unique<SumSource>(state.lattice, state.p, state.q);
  });
  return *source_;
}

bool RotatingPlace::inside_right_of(const Segment& on, const std::optional<Segment>& from,
                                    const std::optional<Segment>& to) {
  if (!state_) {
    state_ = placed_at(*base_, theta_);
    collision_.emplace(*state_->lattice, *state_->p, *state_->q, true);
  }
  const Lattice& l = *state_->lattice;
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
