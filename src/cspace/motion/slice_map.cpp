#include "cspace/motion/slice_map.h"

#include <algorithm>
#include <cmath>

#include "exact/big.h"
#include "exact/rounding_bound.h"

namespace dymsum::planar {

using exact::BigRational;

namespace {

// The error of a position that is rounded is this times its largest coordinate; rounded to a subnormal number it errs
// by 2^-1075.
constexpr double kPositionRounded = exact::rounding_bound(1, 2), kSubnormal = 0x1p-1060;
// The errors of a cross product of differences, times |product| + |product|, and of a difference, besides what they err
// by.
constexpr double kMapCross = exact::rounding_bound(4, 8), kDifference = exact::rounding_bound(1, 2);
// The roundings of bounds themselves.
constexpr double kWider = 1.01;

// Whether d, the difference of two numbers that err by `error` together, has a proved sign.
bool proved(double d, double error) { return std::abs(d) > kWider * error + kDifference * std::abs(d); }

int sign_of(const BigRational& v) { return v.sign(); }

BigRational cross(const BigRational& ax, const BigRational& ay, const BigRational& bx, const BigRational& by) {
  return BigRational(ax * by - ay * bx);
}

// Whether the boxes of the segments are provably apart.
bool boxes_apart(const SlicePoint& a, const SlicePoint& b, const SlicePoint& c, const SlicePoint& d) {
  const double e = 2 * std::max({a.error(), b.error(), c.error(), d.error()});
  const auto [ax0, ax1] = std::minmax({a.at().x, b.at().x});
  const auto [ay0, ay1] = std::minmax({a.at().y, b.at().y});
  const auto [cx0, cx1] = std::minmax({c.at().x, d.at().x});
  const auto [cy0, cy1] = std::minmax({c.at().y, d.at().y});
  return ax1 + e < cx0 || cx1 + e < ax0 || ay1 + e < cy0 || cy1 + e < ay0;
}

// The position of p on the line from a to b, as a fraction.
BigRational fraction_of(const Position& a, const Position& b, const Position& p) {
  const BigRational dx = b.x - a.x, dy = b.y - a.y;
  return BigRational((dx * (p.x - a.x) + dy * (p.y - a.y)) / (dx * dx + dy * dy));
}

}  // namespace

SlicePoint::SlicePoint(Position exact) : at_{exact::round_to_double(exact.x), exact::round_to_double(exact.y)} {
  error_ = std::max(std::abs(at_.x), std::abs(at_.y)) * kPositionRounded + kSubnormal;
  exact_ = std::move(exact);
}

SlicePoint::SlicePoint(Point p) : at_(p) {}

SlicePoint::SlicePoint(const PlanarSum& sum, const SumVertex& vertex)
    : at_(vertex.at), error_(sum.at_error), sum_(&sum), vertex_(&vertex) {}

const Position& SlicePoint::exact() const {
  if (!exact_ && sum_ != nullptr) exact_ = exact_source(*sum_)->position(*vertex_);
  if (!exact_) exact_ = Position{exact::exact_value(at_.x), exact::exact_value(at_.y)};
  return *exact_;
}

// Each difference errs by at most twice the largest error and one rounding, hence each product by what is added up.
int side(const SlicePoint& a, const SlicePoint& b, const SlicePoint& c) {
  const double e = 2 * std::max({a.error(), b.error(), c.error()});
  const double bx = b.at().x - a.at().x, by = b.at().y - a.at().y, cx = c.at().x - a.at().x, cy = c.at().y - a.at().y;
  const double det = bx * cy - by * cx;
  const double bound = kWider * e * (std::abs(bx) + std::abs(by) + std::abs(cx) + std::abs(cy) + 2 * e) +
                       kMapCross * (std::abs(bx * cy) + std::abs(by * cx)) + exact::kUnderflow;
  if (std::abs(det) > bound) return det > 0 ? 1 : -1;
  if (&a == &b || &a == &c || &b == &c) return 0;
  const Position &p = a.exact(), &q = b.exact(), &r = c.exact();
  return sign_of(cross(q.x - p.x, q.y - p.y, r.x - p.x, r.y - p.y));
}

int compare_x(const SlicePoint& a, const SlicePoint& b) {
  const double d = a.at().x - b.at().x;
  if (proved(d, a.error() + b.error())) return d > 0 ? 1 : -1;
  return &a == &b ? 0 : exact::compare(a.exact().x, b.exact().x);
}

int compare_y(const SlicePoint& a, const SlicePoint& b) {
  const double d = a.at().y - b.at().y;
  if (proved(d, a.error() + b.error())) return d > 0 ? 1 : -1;
  return &a == &b ? 0 : exact::compare(a.exact().y, b.exact().y);
}

bool same(const SlicePoint& a, const SlicePoint& b) { return compare_x(a, b) == 0 && compare_y(a, b) == 0; }

bool on_segment(const SlicePoint& a, const SlicePoint& b, const SlicePoint& p) {
  if (boxes_apart(a, b, p, p) || side(a, b, p) != 0) return false;
  return compare_x(a, p) * compare_x(p, b) >= 0 && compare_y(a, p) * compare_y(p, b) >= 0;
}

Position along(const Position& a, const Position& b, const BigRational& fraction) {
  return {BigRational(a.x + fraction * (b.x - a.x)), BigRational(a.y + fraction * (b.y - a.y))};
}

SliceMap::SliceMap(PlanarSum slice) : slice_(std::move(slice)) {
  for (const SumPart& part : slice_.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  for (const SumSegment& s : slice_.tight_segments) cracks_.push_back(add(s.from, s.to));
  for (const SumVertex& v : slice_.tight_points) cracks_.push_back(add(v, v));
  for (const SumSegment& s : slice_.segments) wires_.push_back(add(s.from, s.to));
  for (const SumVertex& v : slice_.points) wires_.push_back(add(v, v));
}

std::size_t SliceMap::bytes() const {
  // The vertex of the sum with what is known of its lattice, and two fractions of some ten words.
  constexpr std::size_t kSpot = sizeof(SlicePoint) + sizeof(SumVertex) + 512;
  return sizeof(*this) + spots_.size() * kSpot + edges_.size() * sizeof(Edge);
}

std::array<std::uint32_t, 2> SliceMap::add(const SumVertex& from, const SumVertex& to) {
  const auto first = static_cast<std::uint32_t>(spots_.size());
  spots_.emplace_back(slice_, from);
  spots_.emplace_back(slice_, to);
  return {first, first + 1};
}

void SliceMap::add(const SumRing& ring) {
  const auto first = static_cast<std::uint32_t>(spots_.size()), n = static_cast<std::uint32_t>(ring.vertices.size());
  for (std::uint32_t k = 0; k < n; ++k) {
    spots_.emplace_back(slice_, ring.vertices[k]);
    edges_.push_back({first + k, first + (k + 1) % n, ring.vertices[k].in, ring.vertices[k].out});
  }
}

bool SliceMap::on_any(const std::vector<std::array<std::uint32_t, 2>>& pieces, const SlicePoint& p) const {
  return std::any_of(pieces.begin(), pieces.end(),
                     [&](const auto& piece) { return on_segment(spots_[piece[0]], spots_[piece[1]], p); });
}

SliceMap::Where SliceMap::where(const SlicePoint& p) const {
  bool inside = false;
  for (const Edge& e : edges_) {
    const SlicePoint &a = spots_[e.from], &b = spots_[e.to];
    if (on_segment(a, b, p)) return Where::touching;
    // A ray upwards meets the edge, whose left end belongs to it.
    const int ahead = compare_x(a, p), behind = compare_x(b, p);
    if ((ahead <= 0) == (behind <= 0)) continue;
    if (side(a, b, p) == (ahead <= 0 ? -1 : 1)) inside = !inside;
  }
  if (!inside) return on_any(wires_, p) ? Where::touching : Where::outside;
  return on_any(cracks_, p) ? Where::touching : Where::inside;
}

std::uint32_t SliceMap::edge_at(const SlicePoint& p) const {
  for (std::uint32_t k = 0; k < edges_.size(); ++k)
    if (on_segment(spots_[edges_[k].from], spots_[edges_[k].to], p)) return k;
  return kNone;
}

// The fractions of a to b at which it meets the segment from c to d: one, or both ends of what they have in common.
void SliceMap::add_meetings(const SlicePoint& a, const SlicePoint& b, const SlicePoint& c, const SlicePoint& d,
                            std::uint32_t edge, std::vector<std::pair<BigRational, std::uint32_t>>& to) const {
  if (boxes_apart(a, b, c, d)) return;
  const int from = side(a, b, c), til = side(a, b, d);
  if (from * til > 0 || side(c, d, a) * side(c, d, b) > 0) return;
  const Position &p = a.exact(), &q = b.exact(), &u = c.exact(), &v = d.exact();
  if (from == 0 && til == 0) {
    BigRational low = fraction_of(p, q, u), high = fraction_of(p, q, v);
    if (low > high) std::swap(low, high);
    if (high < 0 || low > 1) return;
    to.emplace_back(low < 0 ? BigRational(0) : low, edge);
    to.emplace_back(high > 1 ? BigRational(1) : high, edge);
    return;
  }
  const BigRational dx = v.x - u.x, dy = v.y - u.y;
  to.emplace_back(cross(u.x - p.x, u.y - p.y, dx, dy) / cross(q.x - p.x, q.y - p.y, dx, dy), edge);
}

SliceMap::Passage SliceMap::standing(const SlicePoint& a, bool touching_allowed) const {
  const Where w = where(a);
  if (w == Where::outside || (w == Where::touching && touching_allowed)) return {};
  return {false, 0, edge_at(a)};
}

SliceMap::Passage SliceMap::passage(const SlicePoint& a, const SlicePoint& b, bool touching_allowed) const {
  if (same(a, b)) return standing(a, touching_allowed);
  std::vector<std::pair<BigRational, std::uint32_t>> meetings;
  for (std::uint32_t k = 0; k < edges_.size(); ++k)
    add_meetings(a, b, spots_[edges_[k].from], spots_[edges_[k].to], k, meetings);
  const auto earlier = [](const auto& m, const auto& n) { return m < n; };
  if (!touching_allowed) {
    const Passage start = standing(a, false);
    for (const auto& [c, d] : wires_) add_meetings(a, b, spots_[c], spots_[d], kNone, meetings);
    if (!start.free || meetings.empty()) return start;
    const auto first = std::min_element(meetings.begin(), meetings.end(), earlier);
    return {false, first->first, first->second};
  }
  for (const auto& [c, d] : cracks_) add_meetings(a, b, spots_[c], spots_[d], kNone, meetings);
  meetings.emplace_back(0, kNone);
  meetings.emplace_back(1, kNone);
  std::sort(meetings.begin(), meetings.end(), earlier);
  // Between two meetings the path stays on one side of everything; its points in the open slice form open intervals.
  for (std::size_t k = 0; k + 1 < meetings.size(); ++k) {
    const BigRational &low = meetings[k].first, &high = meetings[k + 1].first;
    if (low == high) continue;
    const SlicePoint midpoint(along(a.exact(), b.exact(), BigRational((low + high) / 2)));
    if (where(midpoint) != Where::inside) continue;
    Passage blocked{false, low, kNone};
    for (const auto& [fraction, edge] : meetings)
      if (fraction == low && edge != kNone) blocked.edge = std::min(blocked.edge, edge);
    return blocked;
  }
  return {};
}

}  // namespace dymsum::planar
