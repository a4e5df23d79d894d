#include "fit/path_free.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "exact/rounding_bound.h"
#include "planar/boundary/collision.h"
#include "planar/operand/lattice.h"
#include "planar/position/exact_source.h"

namespace dymsum::planar {

using exact::BigRational;

namespace {

class ContactFinder {
 public:
  ContactFinder(const OperandPair& base, const PlanarSum& sum, const BigRational& s, const ObstacleIndices& indices)
      : base_(base), s_(s), approx_(exact::round_to_double(s)), indices_(indices) {
    const auto at = [&](const SumVertex& v) { return make_spot(exact_source(sum)->position(v)); };
    for (const SumVertex& v : sum.tight_points) features_.push_back({at(v), at(v)});
    for (const SumSegment& t : sum.tight_segments) features_.push_back({at(t.from), at(t.to)});
  }

  /// The contacts of edge `edge` of operand `side` with vertex `vertex` of the other one.
  void see(std::uint32_t side, std::uint32_t edge, std::uint32_t vertex) {
    const std::uint32_t next = base_.operands[side].next[edge];
    const auto [ax, ay, ae] = position(side, edge, vertex);
    const auto [bx, by, be] = position(side, next, vertex);
    const double error = ae + be, x0 = std::min(ax, bx) - error, x1 = std::max(ax, bx) + error,
                 y0 = std::min(ay, by) - error, y1 = std::max(ay, by) + error;
    for (const Feature& f : features_) {
      const Point u = f.from.nearest, v = f.to.nearest;
      const double slack = kPositionError * (std::abs(u.x) + std::abs(u.y) + std::abs(v.x) + std::abs(v.y));
      if (v.x < x0 - slack || u.x > x1 + slack || std::max(u.y, v.y) < y0 - slack || std::min(u.y, v.y) > y1 + slack)
        continue;
      decide(side, edge, vertex, spot(side, edge, vertex), spot(side, next, vertex), f);
    }
  }

  std::vector<ScaleContact> finish() {
    std::sort(found_.begin(), found_.end(), [](const Found& x, const Found& y) {
      if (const int order = compare(x.at, y.at); order != 0) return order < 0;
      return std::tie(x.contact.kind, x.contact.part, x.contact.obstacle) <
             std::tie(y.contact.kind, y.contact.part, y.contact.obstacle);
    });
    std::vector<ScaleContact> contacts;
    for (Found& f : found_)
      if (contacts.empty() || !(contacts.back() == f.contact)) contacts.push_back(std::move(f.contact));
    return contacts;
  }

 private:
  // The error of a position, times the sizes added up: the scale, the product and the sum, and the sums with the bound
  // itself.
  static constexpr double kPositionError = exact::rounding_bound(3 + 2, 8);
  struct Feature {
    Spot from, to;  // equal for a point; from <= to
  };
  struct Found {
    Spot at;
    ScaleContact contact;
  };
  struct NearPosition {
    double x, y, error;
  };

  Point input(std::uint32_t op, std::uint32_t walk) const {
    return base_.lattice->points[op]->input[base_.operands[op].source[walk]];
  }

  /// The position of the reference point where walk vertex i of operand `side` and j of the other one put the reference
  /// point.
  NearPosition position(std::uint32_t side, std::uint32_t i, std::uint32_t j) const {
    const Point o = input(0, side == 0 ? i : j), r = input(1, side == 0 ? j : i);
    const double size = std::abs(o.x) + std::abs(o.y) + approx_ * (std::abs(r.x) + std::abs(r.y));
    return {o.x + approx_ * r.x, o.y + approx_ * r.y, kPositionError * size + exact::kUnderflow};
  }
  Spot spot(std::uint32_t side, std::uint32_t i, std::uint32_t j) const {
    const Point o = input(0, side == 0 ? i : j), r = input(1, side == 0 ? j : i);
    return make_spot(Position{exact::exact_value(o.x) + s_ * exact::exact_value(r.x),
                              exact::exact_value(o.y) + s_ * exact::exact_value(r.y)});
  }

  void decide(std::uint32_t side, std::uint32_t edge, std::uint32_t vertex, const Spot& a, const Spot& b,
              const Feature& f) {
    if (compare(f.from, f.to) == 0) {
      // Every vertex begins an edge: two vertices that meet are found at the edge that begins there, once for both
      // operands.
      if (compare(f.from, a) == 0) {
        if (side == 0) add(ScaleContact::Kind::vertex_on_vertex, side, edge, vertex, f.from);
      } else if (compare(f.from, b) != 0 && on_segment(a, b, f.from)) {
        add(kind(side), side, edge, vertex, f.from);
      }
      return;
    }
    if (orientation(f.from, f.to, a) != 0 || orientation(f.from, f.to, b) != 0) return;
    const bool ahead = compare(a, b) < 0;
    const Spot &low = ahead ? a : b, &high = ahead ? b : a, &first = compare(low, f.from) < 0 ? f.from : low;
    if (compare(first, f.to) < 0 && compare(first, high) < 0) add(kind(side), side, edge, vertex, first);
  }

  static ScaleContact::Kind kind(std::uint32_t side) {
    return side == 0 ? ScaleContact::Kind::vertex_on_edge : ScaleContact::Kind::edge_on_vertex;
  }

  void add(ScaleContact::Kind kind, std::uint32_t side, std::uint32_t edge, std::uint32_t vertex, const Spot& at) {
    const Operand &o = base_.operands[0], &r = base_.operands[1];
    const auto index = [](const std::vector<std::uint32_t>& given, std::uint32_t own) {
      return given.empty() ? own : given[own];
    };
    ScaleContact c;
    c.kind = kind;
    if (kind == ScaleContact::Kind::vertex_on_edge) c.obstacle = index(indices_.edges, o.edge_index[edge]);
    else c.obstacle = index(indices_.vertices, o.vertex_index[side == 0 ? edge : vertex]);
    c.part =
        kind == ScaleContact::Kind::edge_on_vertex ? r.edge_index[edge] : r.vertex_index[side == 0 ? vertex : edge];
    c.at = {exact::to_rational(at.exact.x), exact::to_rational(at.exact.y)};
    found_.push_back({at, std::move(c)});
  }

  const OperandPair& base_;
  const BigRational& s_;
  double approx_;
  const ObstacleIndices& indices_;
  std::vector<Feature> features_;
  std::vector<Found> found_;
};

}  // namespace

std::vector<ScaleContact> tight_contacts(const OperandPair& base, const PlanarSum& sum, const BigRational& s,
                                         const ObstacleIndices& indices) {
  ContactFinder finder(base, sum, s, indices);
  for (std::uint32_t side = 0; side < 2; ++side)
    for (std::uint32_t edge = 0; edge < base.operands[side].size(); ++edge)
      for (std::uint32_t vertex = 0; vertex < base.operands[1 - side].size(); ++vertex) finder.see(side, edge, vertex);
  return finder.finish();
}

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

namespace {

// The error of a cross or scalar product d . (u - v) from coordinates, times the sizes |d|_1 (|u|_1 + |v|_1): d is a
// difference (1), so is u - v (1), products and their sum 1 each; and the sizes with what is made of them here.
constexpr double kProduct = exact::rounding_bound(4 + 12, 64);

/// A value, and what it errs by at most.
struct Bounded {
  double value = 0, error = 0;
};

/// A segment start + t d (0 <= t <= 1, where it does not scale, or s), start = still + s moved.
struct ScalingSegment {
  Point d, still, moved;
  bool scales;
};

double size_of(Point v) { return std::abs(v.x) + std::abs(v.y); }

/// Whether doubles prove that `still` + s `moved` is on the segment at no scale s > 0. What they do not decide may be.
bool never_on(const ScalingSegment& on, Point still, Point moved) {
  const Point u{still.x - on.still.x, still.y - on.still.y}, v{moved.x - on.moved.x, moved.y - on.moved.y};
  const double size = kProduct * size_of(on.d);
  const double u_size = size * (size_of(still) + size_of(on.still)) + exact::kUnderflow,
               v_size = size * (size_of(moved) + size_of(on.moved)) + exact::kUnderflow;
  const auto cross = [&](Point w) { return on.d.x * w.y - on.d.y * w.x; };
  const auto dot = [&](Point w) { return on.d.x * w.x + on.d.y * w.y; };
  const Bounded a{cross(u), u_size}, b{cross(v), v_size};
  if ((a.value > a.error && b.value > b.error) || (a.value < -a.error && b.value < -b.error)) return true;
  if (!(std::abs(b.value) > 2 * b.error)) return false;
  // The root of a + b s, and how far from it the true one may be.
  const double s = -a.value / b.value,
               near = 4 * (a.error + std::abs(s) * b.error) / std::abs(b.value) + kProduct * std::abs(s);
  if (!std::isfinite(s) || !std::isfinite(near)) return false;
  if (s < -near) return true;
  const double along = dot(u) + s * dot(v), length = dot(on.d) * (on.scales ? s : 1),
               error = u_size + std::abs(s) * v_size + near * (std::abs(dot(v)) + v_size + dot(on.d)) +
                       kProduct * (std::abs(dot(u)) + std::abs(s * dot(v)) + std::abs(length));
  return along < -error || along - length > error;
}

}  // namespace

PathFree::Critical PathFree::critical(const std::function<void(double)>& query, bool all_exactly) const {
  const auto input = [&](std::uint32_t op, std::uint32_t v) { return base_->lattice->points[op]->input[v]; };
  const auto difference = [](Point u, Point v) { return Point{u.x - v.x, u.y - v.y}; };
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
    const Point from = input(w.side, wall.edge.from), vertex = input(1 - w.side, wall.vertex);
    const Point d = difference(input(w.side, wall.edge.to), from);
    const ScalingSegment on =
        w.side == 0 ? ScalingSegment{d, from, vertex, false} : ScalingSegment{d, vertex, from, true};
    for (std::uint32_t k = 0; k < count_; ++k)
      if (all_exactly || !never_on(on, input(0, first_ + k), input(1, reference_)))
        values(wall, waypoint(k), [&](const BigRational& s) { add(found, s, &w, nullptr, k, waypoint(k), false); });
  }
  for (const WalkPair& corner : corners_) {
    query(done++ / all);
    const Pair v{base_->operands[0].source[corner.p], base_->operands[1].source[corner.q]};
    for (std::uint32_t k = 0; k + 1 < count_; ++k)
      if (const Point from = input(0, first_ + k);
          all_exactly || !never_on({difference(input(0, first_ + k + 1), from), from, input(1, reference_), false},
                                   input(0, v.p), input(1, v.q)))
        values(leg(k), v, [&](const BigRational& s) { add(found, s, nullptr, &corner, k, v, true); });
  }
  return found;
}

ExactSource::Position PathFree::on_leg(std::uint32_t k, double t) const {
  const auto& input = base_->lattice->points[0]->input;
  const Point a = input[first_ + k], b = input[first_ + k + (count_ > 1 ? 1 : 0)];
  const BigRational at = exact::exact_value(t), ax = exact::exact_value(a.x), ay = exact::exact_value(a.y);
  return {ax + at * (exact::exact_value(b.x) - ax), ay + at * (exact::exact_value(b.y) - ay)};
}

std::optional<ExactSource::Position> PathFree::blocked_at(const BigRational& s, std::uint32_t& first) const {
  const ScaleValue value = scale_value(s);
  const std::shared_ptr<const Lattice> lattice = base_->lattice_at(base_->lattice_scale(value, value));
  const std::shared_ptr<const Operand> part = base_->operand_at(1, *lattice);
  Collision collision(*lattice, base_->operands[0], *part, true);
  SegmentPosition start;
  start.on = count_ > 1 ? leg(0) : Segment{{0, first_, beside_}, reference_};
  start.first.pair = waypoint(0);
  round_position(*lattice, start);
  if (collision.overlaps(start)) return on_leg(0, 0);
  for (std::uint32_t i = 0; i + 1 < count_; ++i) {
    const std::uint32_t k = (first + i) % (count_ - 1);
    if (std::optional<ExactSource::Position> blocked = blocked_on(k, *lattice, collision)) {
      first = k;
      return blocked;
    }
  }
  return std::nullopt;
}

// Where the leg meets no segment of the convolution, it lies inside or outside the open sum as a whole: one position
// decides.
std::optional<ExactSource::Position> PathFree::blocked_on(std::uint32_t k, const Lattice& l,
                                                          Collision& collision) const {
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
    if (!collision.overlaps(p)) continue;
    const double t = ((p.x - a.x) * ax + (p.y - a.y) * ay) / (ax * ax + ay * ay);
    return on_leg(k, std::isfinite(t) ? std::clamp(t, 0.0, 1.0) : 0.5);
  }
  return std::nullopt;
}

}  // namespace dymsum::planar
