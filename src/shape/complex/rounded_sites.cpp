#include "shape/complex/rounded_sites.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace dymsum::shape {
namespace {

int turn(const RoundedPoint& a, const RoundedPoint& b, const RoundedPoint& c) {
  const std::int64_t left = (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y);
  const std::int64_t right = (std::int64_t{b.y} - a.y) * (std::int64_t{c.x} - a.x);
  return (left > right) - (left < right);
}
// 31 bits a difference, 62 a product.
static_assert(2 * (kMostBits + 1) <= 63);

bool within(const RoundedSegment& s, const RoundedPoint& p) {
  return s.a <= p && p <= s.b && std::min(s.a.y, s.b.y) <= p.y && p.y <= std::max(s.a.y, s.b.y) &&
         turn(s.a, s.b, p) == 0;
}
bool inside(const RoundedSegment& s, const RoundedPoint& p) { return within(s, p) && p != s.a && p != s.b; }

/// They have a point in common that is not an end of both. Equal segments do not.
bool clash(const RoundedSegment& s, const RoundedSegment& t) {
  if (inside(s, t.a) || inside(s, t.b) || inside(t, s.a) || inside(t, s.b)) return true;
  return turn(s.a, s.b, t.a) * turn(s.a, s.b, t.b) < 0 && turn(t.a, t.b, s.a) * turn(t.a, t.b, s.b) < 0;
}

/// Small integers are shorter to calculate with.
void drop_zero_bits(std::vector<RoundedPoint>& points) {
  std::uint32_t bits = 0;
  for (const RoundedPoint& p : points) bits |= static_cast<std::uint32_t>(p.x) | static_cast<std::uint32_t>(p.y);
  const int zeros = bits == 0 ? 0 : std::countr_zero(bits);
  for (RoundedPoint& p : points) p = {p.x >> zeros, p.y >> zeros};
}

}  // namespace

RoundedSites round_sites(const Walks& walks, int bits) {
  RoundedSites out;
  out.bits = bits;
  out.lossless = true;
  Point low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  for (const BoundaryPoint& p : walks.points) {
    low = {std::min(low.x, p.input.x), std::min(low.y, p.input.y)};
    high = {std::max(high.x, p.input.x), std::max(high.y, p.input.y)};
  }
  const Point midpoint{low.x / 2 + high.x / 2, low.y / 2 + high.y / 2};
  const double reach = std::max(high.x / 2 - low.x / 2, high.y / 2 - low.y / 2);
  const int shift = reach > 0 ? bits - 1 - std::ilogb(reach) - 1 : 0;
  const auto round = [&](double v, double from) {
    const double scaled = std::ldexp(v - from, shift), whole = std::nearbyint(scaled);
    out.lossless = out.lossless && whole == scaled && std::ldexp(scaled, -shift) + from == v;
    return static_cast<std::int32_t>(whole);
  };
  for (const BoundaryPoint& p : walks.points)
    out.points.push_back({round(p.input.x, midpoint.x), round(p.input.y, midpoint.y)});
  if (out.lossless) drop_zero_bits(out.points);
  for (std::uint32_t s = 0; s < walks.sites.size(); ++s) {
    const RoundedPoint a = out.points[walks.ends[s].a], b = out.points[walks.ends[s].b];
    if (a != b) out.segments.push_back({std::min(a, b), std::max(a, b), s});
  }
  std::sort(out.segments.begin(), out.segments.end());
  return out;
}

// A sweep over strips of x: segments that are cut to a strip meet few others there.
bool is_planar(const RoundedSites& sites) {
  if (sites.lossless) return true;
  struct Strip {
    std::vector<std::uint32_t> segments;
  };
  const std::vector<RoundedSegment>& list = sites.segments;
  if (list.empty()) return true;
  const auto count = static_cast<std::int64_t>(std::sqrt(static_cast<double>(list.size()))) + 1;
  const std::int64_t extent = std::int64_t{1} << (sites.bits + 1);
  const auto cell = [&](std::int64_t v) { return (v + extent / 2) * count / (extent + 1); };
  std::vector<std::vector<std::uint32_t>> cells(static_cast<std::size_t>(count * count));
  for (std::uint32_t i = 0; i < list.size(); ++i) {
    const RoundedSegment& s = list[i];
    const std::int64_t first = cell(s.a.x), last = cell(s.b.x);
    const double slope = s.b.x == s.a.x ? 0 : (double(s.b.y) - s.a.y) / (double(s.b.x) - s.a.x);
    for (std::int64_t c = first; c <= last; ++c) {
      // The part of the segment over this column, a little longer than it is.
      const double x0 = static_cast<double>(c * (extent + 1) / count - extent / 2) - 2;
      const double x1 = static_cast<double>((c + 1) * (extent + 1) / count - extent / 2) + 2;
      double y0 = s.a.y, y1 = s.b.y;
      if (x0 > s.a.x) y0 = s.a.y + (x0 - s.a.x) * slope;
      if (x1 < s.b.x) y1 = s.a.y + (x1 - s.a.x) * slope;
      const double low = std::max<double>(std::min(y0, y1) - 2, std::min(s.a.y, s.b.y));
      const double high = std::min<double>(std::max(y0, y1) + 2, std::max(s.a.y, s.b.y));
      const std::int64_t bottom = cell(static_cast<std::int64_t>(std::floor(low)));
      const std::int64_t top = cell(static_cast<std::int64_t>(std::ceil(high)));
      for (std::int64_t r = bottom; r <= top; ++r) {
        std::vector<std::uint32_t>& here = cells[static_cast<std::size_t>(c * count + r)];
        for (const std::uint32_t k : here) {
          if (clash(s, list[k])) return false;
        }
        here.push_back(i);
      }
    }
  }
  return true;
}

}  // namespace dymsum::shape
