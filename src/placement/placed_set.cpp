#include "placement/placed_set.h"

#include <algorithm>

namespace dymsum::placement {
namespace {

int value_at(const Line& l, const HomogeneousPoint& p) {
  ++exact_signs();
  return BigInteger(l.a * p.x + l.b * p.y + l.c * p.w).sign();
}

const Interval& coordinate(const NearPoint& p, int axis) { return axis == 0 ? p.x : p.y; }
const BigInteger& coordinate(const HomogeneousPoint& p, int axis) { return axis == 0 ? p.x : p.y; }

/// The order of two intervals, or nothing where they meet.
std::optional<int> order_of(const Interval& a, const Interval& b) {
  if (a.high() < b.low()) return -1;
  if (b.high() < a.low()) return 1;
  if (a.is_point() && b.is_point()) return 0;
  return std::nullopt;
}

Interval cross(const Interval& ax, const Interval& ay, const Interval& bx, const Interval& by) {
  return ax * by - ay * bx;
}

std::optional<int> near_side(EdgeOf f, const NearPoint& p) {
  const NearPoint& a = f.from();
  return sign_of(cross(f->dx, f->dy, p.x - a.x, p.y - a.y));
}

NearPoint near_crossing(EdgeOf f, EdgeOf g) {
  const NearPoint &a = f.from(), &c = g.from();
  const Interval t = cross(c.x - a.x, c.y - a.y, g->dx, g->dy) / cross(f->dx, f->dy, g->dx, g->dy);
  return {a.x + f->dx * t, a.y + f->dy * t};
}

HomogeneousPoint meeting_of(const Line& f, const Line& g) {
  HomogeneousPoint p{f.b * g.c - f.c * g.b, f.c * g.a - f.a * g.c, f.a * g.b - f.b * g.a};
  if (p.w.sign() < 0) p = {-p.x, -p.y, -p.w};
  return p;
}

HomogeneousPoint halfway(const HomogeneousPoint& p, const HomogeneousPoint& q) {
  return {p.x * q.w + q.x * p.w, p.y * q.w + q.y * p.w, BigInteger(2 * p.w * q.w)};
}

}  // namespace

std::uint64_t& exact_signs() {
  thread_local std::uint64_t count = 0;
  return count;
}

PlacedSet::PlacedSet(std::shared_ptr<const OpenSet> set, HomogeneousPoint move, std::uint32_t id)
    : set_(std::move(set)), move_(std::move(move)), near_move_(near_point(move_)), id_(id) {
  near_.reserve(set_->near().size());
  box_ = set_->near().empty() ? std::array<double, 4>{} : std::array{kInfinity, kInfinity, -kInfinity, -kInfinity};
  for (const NearPoint& p : set_->near()) {
    const NearPoint q = near_.emplace_back(NearPoint{p.x + near_move_.x, p.y + near_move_.y});
    box_ = {std::min(box_[0], q.x.low()), std::min(box_[1], q.y.low()), std::max(box_[2], q.x.high()),
            std::max(box_[3], q.y.high())};
  }
}

HomogeneousPoint PlacedSet::exact(std::uint32_t vertex) const {
  const HomogeneousPoint& p = set_->at()[vertex];
  if (p.w == move_.w) return {p.x + move_.x, p.y + move_.y, p.w};
  return {p.x * move_.w + move_.x * p.w, p.y * move_.w + move_.y * p.w, p.w * move_.w};
}

Line PlacedSet::line(std::uint32_t edge) const {
  const Line& l = set_->line(edge);
  return {l.a * move_.w, l.b * move_.w, l.c * move_.w - l.a * move_.x - l.b * move_.y};
}

Site vertex_site(const PlacedSet& set, std::uint32_t vertex) { return {&set, vertex, nullptr, 0, set.near(vertex)}; }

Site crossing_site(EdgeOf f, EdgeOf g) {
  if (f.set->id() > g.set->id()) std::swap(f, g);
  NearPoint near = near_crossing(f, g);
  if (near.x.is_whole() || near.y.is_whole()) near = near_point(meeting_of(f.set->line(f.edge), g.set->line(g.edge)));
  return {f.set, f.edge, g.set, g.edge, near};
}

HomogeneousPoint exact_position(const Site& s) {
  if (s.other == nullptr) return s.set->exact(s.index);
  return meeting_of(s.set->line(s.index), s.other->line(s.other_index));
}

Probe::Probe(const Site& a, const Site& b) : a_(a), b_(b) {
  const auto between = [](const Interval& u, const Interval& v) { return Interval(0.5) * (u + v); };
  near_ = a.same_as(b) ? a.near : NearPoint{between(a.near.x, b.near.x), between(a.near.y, b.near.y)};
}

const HomogeneousPoint& Probe::exact() const {
  if (!exact_) exact_ = a_.same_as(b_) ? exact_position(a_) : halfway(exact_position(a_), exact_position(b_));
  return *exact_;
}

int side(EdgeOf f, const PlacedSet& set, std::uint32_t vertex) {
  if (f.set == &set && (f->from == vertex || f->to == vertex)) return 0;
  if (const std::optional<int> sign = near_side(f, set.near(vertex))) return *sign;
  return value_at(f.set->line(f.edge), set.exact(vertex));
}

int side(EdgeOf f, const Probe& probe) {
  if (const std::optional<int> sign = near_side(f, probe.near())) return *sign;
  return value_at(f.set->line(f.edge), probe.exact());
}

int compare(const Site& a, const Site& b, int axis) {
  if (a.same_as(b)) return 0;
  if (const std::optional<int> order = order_of(coordinate(a.near, axis), coordinate(b.near, axis))) return *order;
  ++exact_signs();
  const HomogeneousPoint p = exact_position(a), q = exact_position(b);
  return BigInteger(coordinate(p, axis) * q.w).compare(BigInteger(coordinate(q, axis) * p.w));
}

int compare_along(EdgeOf f, const Site& a, const Site& b) { return f->sign * compare(a, b, f->axis); }

int turn(EdgeOf f, EdgeOf g) {
  if (const std::optional<int> sign = sign_of(cross(f->dx, f->dy, g->dx, g->dy))) return *sign;
  ++exact_signs();
  const Line &l = f.set->set().line(f.edge), &m = g.set->set().line(g.edge);
  return BigInteger(l.a * m.b - l.b * m.a).sign();
}

bool same_direction(EdgeOf f, EdgeOf g) {
  if (f->axis == g->axis) return f->sign == g->sign;
  const Line &l = f.set->set().line(f.edge), &m = g.set->set().line(g.edge);
  return BigInteger(l.a * m.a + l.b * m.b).sign() > 0;
}

int half_plane(EdgeOf f) {
  const Line& l = f.set->set().line(f.edge);  // (a, b) is a positive multiple of (-dy, dx)
  return l.a.sign() < 0 || (l.a.is_zero() && l.b.sign() > 0) ? 0 : 1;
}

}  // namespace dymsum::placement
