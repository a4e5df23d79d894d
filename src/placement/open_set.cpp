#include "placement/open_set.h"

#include <algorithm>
#include <cmath>

#include "planar/position/exact_source.h"
#include "planar/result/result_region.h"

namespace dymsum::placement {
namespace {

// Numbers beyond the doubles get the whole line.
Interval near_number(const BigInteger& num, const BigInteger& den, bool exact) {
  const double v = exact::round_to_double(num, den);
  return exact ? Interval(v) : Interval(std::nextafter(v, -kInfinity), std::nextafter(v, kInfinity));
}

bool is_double(const BigInteger& num, const BigInteger& den) {
  const double v = exact::round_to_double(num, den);
  if (!std::isfinite(v)) return false;
  const exact::BigRational value = exact::exact_value(v);
  return numerator(value) * den == num * denominator(value);
}

HomogeneousPoint exact_at(const PlanarSum& sum, const SumVertex& v) {
  return exact::in_lowest_terms(exact_source(sum)->homogeneous(v));
}

}  // namespace

NearPoint near_point(const HomogeneousPoint& p) {
  return {near_number(p.x, p.w, is_double(p.x, p.w)), near_number(p.y, p.w, is_double(p.y, p.w))};
}

Line line_through(const HomogeneousPoint& p, const HomogeneousPoint& q) {
  return {p.y * q.w - p.w * q.y, p.w * q.x - p.x * q.w, p.x * q.y - p.y * q.x};
}

std::shared_ptr<const OpenSet> OpenSet::inside(const PlanarSum& no_fit) {
  auto set = std::make_shared<OpenSet>();
  set->add_rings(no_fit, false);
  set->add_segments(no_fit.tight_segments, no_fit);
  set->add_points(no_fit.tight_points, no_fit);
  set->finish();
  return set;
}

std::shared_ptr<const OpenSet> OpenSet::outside(const PlanarSum& inner_fit) {
  auto set = std::make_shared<OpenSet>();
  set->unbounded_ = true;
  set->add_rings(inner_fit, true);
  set->add_segments(inner_fit.segments, inner_fit);
  set->add_points(inner_fit.points, inner_fit);
  set->finish();
  return set;
}

std::shared_ptr<const OpenSet> OpenSet::position(HomogeneousPoint at) {
  auto set = std::make_shared<OpenSet>();
  const std::uint32_t v = set->add(std::move(at));
  set->add_edge(v, v, BoundaryEdge::Kind::point);
  set->finish();
  return set;
}

std::uint32_t OpenSet::add(HomogeneousPoint p) {
  near_.push_back(near_point(p));
  at_.push_back(std::move(p));
  return static_cast<std::uint32_t>(at_.size() - 1);
}

void OpenSet::add_edge(std::uint32_t from, std::uint32_t to, BoundaryEdge::Kind kind) {
  BoundaryEdge edge;
  edge.from = from;
  edge.to = to;
  edge.kind = kind;
  edges_.push_back(edge);
}

void OpenSet::add_rings(const PlanarSum& sum, bool reversed) {
  const auto add_ring = [&](const SumRing& ring) {
    const auto first = static_cast<std::uint32_t>(at_.size()), n = static_cast<std::uint32_t>(ring.vertices.size());
    for (std::uint32_t k = 0; k < n; ++k) add(exact_at(sum, ring.vertices[reversed ? n - 1 - k : k]));
    for (std::uint32_t k = 0; k < n; ++k) add_edge(first + k, first + (k + 1) % n, BoundaryEdge::Kind::ring);
  };
  for (const SumPart& part : sum.parts) {
    add_ring(part.outer);
    std::for_each(part.holes.begin(), part.holes.end(), add_ring);
  }
}

void OpenSet::add_segments(const std::vector<SumSegment>& segments, const PlanarSum& sum) {
  for (const SumSegment& s : segments) {
    const std::uint32_t from = add(exact_at(sum, s.from)), to = add(exact_at(sum, s.to));
    add_edge(from, to, BoundaryEdge::Kind::crack);
  }
}

void OpenSet::add_points(const std::vector<SumVertex>& points, const PlanarSum& sum) {
  for (const SumVertex& p : points) {
    const std::uint32_t v = add(exact_at(sum, p));
    add_edge(v, v, BoundaryEdge::Kind::point);
  }
}

double OpenSet::low_of(std::uint32_t e) const {
  return std::min(near_[edges_[e].from].y.low(), near_[edges_[e].to].y.low());
}

double OpenSet::high_of(std::uint32_t e) const {
  return std::max(near_[edges_[e].from].y.high(), near_[edges_[e].to].y.high());
}

std::size_t OpenSet::row(double y) const {
  const double r = (y - box_[1]) * per_row_, last = static_cast<double>(first_.size()) - 2;
  return r >= last ? static_cast<std::size_t>(last) : r > 0 ? static_cast<std::size_t>(r) : 0;
}

void OpenSet::list_rows() {
  const std::size_t rows = std::clamp<std::size_t>(edges_.size(), 1, 4096);
  const double per_row = static_cast<double>(rows) / (box_[3] - box_[1]);
  per_row_ = std::isfinite(per_row) ? per_row : 0;
  first_.assign(rows + 1, 0);
  const auto each_row = [&](std::uint32_t e, auto&& f) {
    for (std::size_t r = row(low_of(e)); r <= row(high_of(e)); ++r) f(r);
  };
  for (std::uint32_t e = 0; e < edges_.size(); ++e) each_row(e, [&](std::size_t r) { ++first_[r + 1]; });
  for (std::size_t r = 0; r < rows; ++r) first_[r + 1] += first_[r];
  listed_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t e = 0; e < edges_.size(); ++e) each_row(e, [&](std::size_t r) { listed_[next[r]++] = e; });
}

void OpenSet::measure(BoundaryEdge& edge) const {
  const HomogeneousPoint &p = at_[edge.from], &q = at_[edge.to];
  const BigInteger w = p.w * q.w, x = q.x * p.w - p.x * q.w, y = q.y * p.w - p.y * q.w;
  edge.dx = near_number(x, w, is_double(x, w));
  edge.dy = near_number(y, w, is_double(y, w));
  const bool steep = x.is_zero() || (!y.is_zero() && std::abs(edge.dy.midpoint()) > std::abs(edge.dx.midpoint()));
  edge.axis = steep ? 1 : 0;
  edge.sign = steep ? y.sign() : x.sign();
}

int OpenSet::order_along(const BoundaryEdge& edge, std::uint32_t i, std::uint32_t j) const {
  const HomogeneousPoint &p = at_[i], &q = at_[j];
  const BigInteger a = (edge.axis == 0 ? p.x : p.y) * q.w, b = (edge.axis == 0 ? q.x : q.y) * p.w;
  return edge.sign * a.compare(b);
}

bool OpenSet::lies_inside(std::uint32_t vertex, const BoundaryEdge& edge) const {
  const NearPoint &a = near_[edge.from], &b = near_[edge.to], &p = near_[vertex];
  if (vertex == edge.from || vertex == edge.to || p.x.high() < std::min(a.x.low(), b.x.low()) ||
      p.x.low() > std::max(a.x.high(), b.x.high()))
    return false;
  const std::optional<int> sign = sign_of(edge.dx * (p.y - a.y) - edge.dy * (p.x - a.x));
  if (sign && *sign != 0) return false;
  const Line line = line_through(at_[edge.from], at_[edge.to]);
  const HomogeneousPoint& v = at_[vertex];
  return BigInteger(line.a * v.x + line.b * v.y + line.c * v.w).is_zero() && order_along(edge, edge.from, vertex) < 0 &&
         order_along(edge, vertex, edge.to) < 0;
}

void OpenSet::cut_edges() {
  std::vector<std::vector<std::uint32_t>> inside(edges_.size());
  bool any = false;
  for (std::uint32_t v = 0; v < at_.size(); ++v)
    for_each_between(near_[v].y.low(), near_[v].y.high(), [&](std::uint32_t e) {
      if (lies_inside(v, edges_[e])) inside[e].push_back(v), any = true;
    });
  if (!any) return;
  std::vector<BoundaryEdge> all;
  all.swap(edges_);
  for (std::uint32_t e = 0; e < all.size(); ++e) {
    const BoundaryEdge& edge = all[e];
    std::sort(inside[e].begin(), inside[e].end(),
              [&](std::uint32_t i, std::uint32_t j) { return order_along(edge, i, j) < 0; });
    std::uint32_t from = edge.from;
    for (const std::uint32_t v : inside[e]) {
      if (from != edge.from && order_along(edge, from, v) == 0) continue;  // equal positions
      add_edge(from, v, edge.kind);
      from = v;
    }
    add_edge(from, edge.to, edge.kind);
  }
  for (BoundaryEdge& edge : edges_) measure(edge);
  list_rows();
}

void OpenSet::finish() {
  box_ = near_.empty() ? std::array<double, 4>{} : std::array{kInfinity, kInfinity, -kInfinity, -kInfinity};
  for (const NearPoint& p : near_)
    box_ = {std::min(box_[0], p.x.low()), std::min(box_[1], p.y.low()), std::max(box_[2], p.x.high()),
            std::max(box_[3], p.y.high())};
  for (BoundaryEdge& edge : edges_) measure(edge);
  list_rows();
  cut_edges();
  for (const BoundaryEdge& edge : edges_) lines_.push_back(line_through(at_[edge.from], at_[edge.to]));
}

}  // namespace dymsum::placement
