#include "fit/path_free.h"

#include <algorithm>
#include <cmath>

#include "exact/rounding_bound.h"
#include "planar/boundary/collision.h"
#include "planar/operand/lattice.h"

namespace dymsum::planar {

using exact::BigRational;

namespace {

// The error of the side of a wall's end from a leg, times the span and |leg|_1, where the wall crosses the leg: two
// points (4 each) and their difference; product and difference; and what turns the leg's line about its start where the
// leg is short, the error of a difference of two ends, as far as the leg is long (4 + 4 + 1).
constexpr double kLegSide = exact::rounding_bound(9 + 2 + 9, 32);

}  // namespace

PathFree::PathFree(std::shared_ptr<const OperandPair> base, std::uint32_t first_waypoint, std::uint32_t waypoints,
                   std::uint32_t reference, std::uint32_t beside)
    : base_(std::move(base)),
      forms_(*base_),
      convolution_(*base_->lattice, base_->operands[0], base_->operands[1], never_filled),
      first_(first_waypoint),
      count_(waypoints),
      reference_(reference),
      beside_(beside) {
  convolution_.for_each([&](const WalkSegment& w) {
    walls_.push_back(w);
    const std::uint32_t next = base_->operands[w.side].next[w.edge];
    corners_.push_back(w.side == 0 ? WalkPair{w.edge, w.vertex} : WalkPair{w.vertex, w.edge});
    corners_.push_back(w.side == 0 ? WalkPair{next, w.vertex} : WalkPair{w.vertex, next});
  });
  const auto key = [](const WalkPair& v) { return std::pair{v.p, v.q}; };
  std::sort(corners_.begin(), corners_.end(), [&](const WalkPair& a, const WalkPair& b) { return key(a) < key(b); });
  corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
}

void PathFree::add(Critical& to, const BigRational& s, const WalkSegment* wall, const WalkPair* corner,
                   std::uint32_t leg, Pair position, bool on_leg) const {
  const Operand &o = base_->operands[0], &r = base_->operands[1];
  ScaleContact c;
  if (wall != nullptr && wall->side == 0) {
    c.kind = ScaleContact::Kind::vertex_on_edge;
    c.obstacle = o.edge_index[wall->edge];
    c.part = r.vertex_index[wall->vertex];
  } else if (wall != nullptr) {
    c.kind = ScaleContact::Kind::edge_on_vertex;
    c.part = r.edge_index[wall->edge];
    c.obstacle = o.vertex_index[wall->vertex];
  } else {
    c.kind = ScaleContact::Kind::vertex_on_vertex;
    c.obstacle = o.vertex_index[corner->p];
    c.part = r.vertex_index[corner->q];
  }
  c.leg = leg;
  // The position of a pair at scale s, in input coordinates.
  const Lattice& l = *base_->lattice;
  const Point p = l.points[0]->input[position.p], q = l.points[1]->input[position.q];
  const BigRational x = exact::exact_value(p.x) + s * exact::exact_value(q.x),
                    y = exact::exact_value(p.y) + s * exact::exact_value(q.y);
  c.at = {exact::to_rational(x), exact::to_rational(y)};
  if (on_leg) {
    const Point a = l.points[0]->input[first_ + leg], b = l.points[0]->input[first_ + leg + 1];
    const BigRational ax = exact::exact_value(a.x), bx = exact::exact_value(b.x), ay = exact::exact_value(a.y),
                      by = exact::exact_value(b.y);
    c.along = exact::to_rational(ax != bx ? BigRational((x - ax) / (bx - ax)) : BigRational((y - ay) / (by - ay)));
  } else if (leg + 1 == count_ && leg > 0) {
    c.leg = leg - 1;
    c.along = 1;
  }
  to[s].push_back(c);
}

PathFree::Critical PathFree::critical(const std::function<void(double)>& query) const {
  Critical found;
  const double all = static_cast<double>(walls_.size() + corners_.size());
  double done = 0;
  const auto on = [&](const Segment& s, Pair v, const BigRational& at) {
    return forms_.along(s, v).sign_at(at) >= 0 && forms_.along(reversed(s), v).sign_at(at) >= 0;
  };
  // Scales at which v comes onto the closed segment, or, always on its line, to one of its ends.
  const auto values = [&](const Segment& s, Pair v, auto&& f) {
    const ExactForm side = forms_.side(s, v);
    if (side.always_zero()) {
      for (const Segment& way : {s, reversed(s)})
        if (const auto root = forms_.along(way, v).root(); root && on(s, v, *root)) f(*root);
    } else if (const auto root = side.root(); root && on(s, v, *root)) {
      f(*root);
    }
  };
  for (const WalkSegment& w : walls_) {
    query(done++ / all);
    const Segment wall{base_->operands[w.side].edge(w.edge), base_->operands[1 - w.side].source[w.vertex]};
    for (std::uint32_t k = 0; k < count_; ++k)
      values(wall, waypoint(k), [&](const BigRational& s) { add(found, s, &w, nullptr, k, waypoint(k), false); });
  }
  for (const WalkPair& corner : corners_) {
    query(done++ / all);
    const Pair v{base_->operands[0].source[corner.p], base_->operands[1].source[corner.q]};
    for (std::uint32_t k = 0; k + 1 < count_; ++k)
      values(leg(k), v, [&](const BigRational& s) { add(found, s, nullptr, &corner, k, v, true); });
  }
  return found;
}

bool PathFree::free(const BigRational& s) const {
  const ScaleValue value = scale_value(s);
  const std::shared_ptr<const Lattice> lattice = base_->lattice_at(base_->lattice_scale(value, value));
  const std::shared_ptr<const Operand> part = base_->operand_at(1, *lattice);
  Collision collision(*lattice, base_->operands[0], *part, true);
  SegmentPosition start;
  start.on = count_ > 1 ? leg(0) : Segment{{0, first_, beside_}, reference_};
  start.first.pair = waypoint(0);
  round_position(*lattice, start);
  if (collision.overlaps(start)) return false;
  for (std::uint32_t k = 0; k + 1 < count_; ++k)
    if (!leg_free(k, *lattice, collision)) return false;
  return true;
}

// Where the leg meets no segment of the convolution, it lies inside or outside the open sum as a whole: one position
// decides.
bool PathFree::leg_free(std::uint32_t k, const Lattice& l, Collision& collision) const {
  const Segment on = leg(k);
  const Pair from = waypoint(k), to = waypoint(k + 1);
  const auto at = [&](Pair v) {
    return Point{l.points[0]->x[v.p] + l.points[1]->x[v.q], l.points[0]->y[v.p] + l.points[1]->y[v.q]};
  };
  const Point a = at(from), b = at(to);
  const double ax = b.x - a.x, ay = b.y - a.y, size = std::abs(ax) + std::abs(ay);
  const double bound = kLegSide * l.span * size;
  std::vector<Cut> cuts;
  Cut end;
  end.pair = from;
  cuts.push_back(end);
  end.pair = to;
  cuts.push_back(end);
  for (const WalkSegment& w : walls_) {
    const Segment wall{base_->operands[w.side].edge(w.edge), base_->operands[1 - w.side].source[w.vertex]};
    const Pair v0 = start_of(wall), v1 = end_of(wall);
    const Point p0 = at(v0), p1 = at(v1);
    const double o0 = ax * (p0.y - a.y) - ay * (p0.x - a.x), o1 = ax * (p1.y - a.y) - ay * (p1.x - a.x);
    if ((o0 > bound && o1 > bound) || (o0 < -bound && o1 < -bound)) continue;
    const int s0 = l.side(on, v0), s1 = l.side(on, v1);
    if (s0 * s1 > 0) continue;
    const int t0 = l.side(wall, from), t1 = l.side(wall, to);
    if (t0 * t1 > 0) continue;
    const auto touch = [&](int sign, Pair v) {
      if (sign != 0 || l.along(on, v) <= 0 || l.along(reversed(on), v) <= 0) return;
      Cut c;
      c.pair = v;
      cuts.push_back(c);
    };
    if (s0 * s1 < 0 && t0 * t1 < 0) {
      Cut c;
      c.kind = Cut::Kind::crossing;
      c.by = wall;
      cuts.push_back(c);
    } else {
      touch(s0, v0);
      touch(s1, v1);
    }
  }
  std::sort(cuts.begin(), cuts.end(), [&](const Cut& x, const Cut& y) { return l.compare(on, x, y) < 0; });
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (l.compare(on, cuts[i], cuts[i + 1]) == 0) continue;
    SegmentPosition p;
    p.on = on;
    p.first = cuts[i];
    p.second = cuts[i + 1];
    p.between = true;
    round_position(l, p);
    if (collision.overlaps(p)) return false;
  }
  return true;
}

}  // namespace dymsum::planar
