#include "fit/fit_contacts.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "exact/rounding_bound.h"
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

}  // namespace dymsum::planar
