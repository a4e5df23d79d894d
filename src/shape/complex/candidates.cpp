#include "shape/complex/candidates.h"

#include <algorithm>
#include <bit>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "base/doubles.h"
#include "shape/complex/walks.h"

namespace dymsum::shape::rough {
namespace {

// Numbers for a Voronoi diagram that only has to be close: where Boost.Polygon would take integers of 2048 bits, pairs
// of doubles, and doubles for its roots of them. What comes out wrong is a wrong guess.

/// Coordinates have so many bits that nothing overflows: Boost.Polygon multiplies some forty of them.
inline constexpr int kBits = 22;

/// What stands for a large integer: a pair of doubles, and how far it may be from the integer. A sum of no more than
/// that is taken for 0, as it is wherever discs of symmetric shapes touch four sites.
class Integer {
 public:
  Integer() = default;
  Integer(std::int64_t n)  // NOLINT(google-explicit-constructor)
      : v_(base::exact_sum(static_cast<double>(n),
                           static_cast<double>(n - static_cast<std::int64_t>(static_cast<double>(n))))) {}
  double d() const { return v_.high; }

  friend Integer operator-(const Integer& a) { return {-a.v_, a.error_}; }
  friend Integer operator+(const Integer& a, const Integer& b) {
    const Integer sum(a.v_ + b.v_, a.error_ + b.error_);
    return std::abs(sum.v_.high) <= sum.error_ ? Integer() : sum;
  }
  friend Integer operator-(const Integer& a, const Integer& b) { return a + -b; }
  friend Integer operator*(const Integer& a, const Integer& b) {
    return {a.v_ * b.v_, std::abs(a.v_.high) * b.error_ + std::abs(b.v_.high) * a.error_};
  }

 private:
  /// Integers of 100 bits are sums and products without an error.
  Integer(base::DoublePair v, double error) : v_(v), error_(error) {
    if (!(std::abs(v.high) < 0x1p100)) error_ += std::abs(v.high) * (2 * base::kPairError);
  }
  base::DoublePair v_;
  double error_ = 0;
};

inline bool is_pos(const Integer& a) { return a.d() > 0; }

inline bool is_neg(const Integer& a) { return a.d() < 0; }

inline bool is_zero(const Integer& a) { return a.d() == 0; }

/// What stands for a double with a large exponent.
struct Real {
  double v = 0;
  Real() = default;
  Real(double a) : v(a) {}  // NOLINT(google-explicit-constructor)
  double d() const { return v; }
  friend Real operator-(const Real& a) { return {-a.v}; }
  friend Real operator+(const Real& a, const Real& b) { return {a.v + b.v}; }
  friend Real operator-(const Real& a, const Real& b) { return {a.v - b.v}; }
  friend Real operator*(const Real& a, const Real& b) { return {a.v * b.v}; }
  friend Real operator/(const Real& a, const Real& b) { return {a.v / b.v}; }
};

inline bool is_pos(const Real& a) { return a.v > 0; }

inline bool is_neg(const Real& a) { return a.v < 0; }

inline bool is_zero(const Real& a) { return a.v == 0; }

inline Real get_sqrt(const Real& a) { return {std::sqrt(a.v)}; }

struct ToReal {
  Real operator()(const Integer& a) const { return {a.d()}; }
};

struct ToDouble {
  template <class T>
  double operator()(const T& a) const {
    return static_cast<double>(a);
  }
  double operator()(const Integer& a) const { return a.d(); }
  double operator()(const Real& a) const { return a.v; }
};

struct Traits {
  using int_type = std::int32_t;
  using int_x2_type = std::int64_t;
  using uint_x2_type = std::uint64_t;
  using big_int_type = Integer;
  using fpt_type = double;
  using efpt_type = Real;
  using ulp_cmp_type = boost::polygon::detail::ulp_comparison<double>;
  using to_fpt_converter_type = ToDouble;
  using to_efpt_converter_type = ToReal;
};

using Builder = boost::polygon::voronoi_builder<std::int32_t, Traits>;

}  // namespace
}  // namespace dymsum::shape::rough

namespace dymsum::shape {
namespace {

// Sites with coordinates of few bits, for a diagram that needs no more than to be close.

struct RoundedPoint {
  std::int32_t x = 0, y = 0;
  friend auto operator<=>(const RoundedPoint&, const RoundedPoint&) = default;
};

struct RoundedSegment {
  RoundedPoint a, b;  ///< a < b
  std::uint32_t site = 0;
  friend auto operator<=>(const RoundedSegment&, const RoundedSegment&) = default;
};

struct RoundedSites {
  std::vector<RoundedPoint> points;      ///< per boundary point
  std::vector<RoundedSegment> segments;  ///< of the edges whose ends differ, in order
  int bits = 0;
  bool lossless = false;  ///< they are the sites themselves, scaled
};

inline constexpr int kMostBits = 30;

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

/// Requires: bits at most kMostBits.
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

/// Whether no two of the segments have more in common than an end of both, or the whole. Exact; O(n log n) in practice.
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

}  // namespace
}  // namespace dymsum::shape

// Boost.Polygon takes points and segments of any type that says how.

namespace boost::polygon {

template <>
struct geometry_concept<dymsum::shape::RoundedPoint> {
  using type = point_concept;
};
template <>
struct point_traits<dymsum::shape::RoundedPoint> {
  using coordinate_type = std::int32_t;
  static coordinate_type get(const dymsum::shape::RoundedPoint& p, orientation_2d orient) {
    return orient == HORIZONTAL ? p.x : p.y;
  }
};

}  // namespace boost::polygon

namespace dymsum::shape {
namespace {

namespace bp = boost::polygon;
using Diagram = bp::voronoi_diagram<double>;

/// Sites by the cells of a diagram.
class Neighbours {
 public:
  Neighbours(const Walks& walks, const RoundedSites& rounded) : walks_(walks), rounded_(rounded) {
    for (std::uint32_t s = 0; s < walks.sites.size(); ++s) {
      if (!walks.is_edge(s)) vertices_.emplace_back(rounded.points[walks.ends[s].a], s);
    }
    std::sort(vertices_.begin(), vertices_.end());
  }

  template <class Builder>
  Candidates of_segments() {
    Builder builder;
    const std::vector<RoundedSegment>& list = rounded_.segments;
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (i > 0 && list[i].a == list[i - 1].a && list[i].b == list[i - 1].b) {
        inputs_.back().push_back(list[i].site);
        continue;
      }
      inputs_.push_back({list[i].site});
      starts_.push_back(list[i].a);
      ends_.push_back(list[i].b);
      builder.insert_segment(list[i].a.x, list[i].a.y, list[i].b.x, list[i].b.y);
    }
    // Points that no segment ends at.
    std::vector<RoundedPoint> taken(starts_);
    taken.insert(taken.end(), ends_.begin(), ends_.end());
    std::sort(taken.begin(), taken.end());
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const RoundedPoint p = vertices_[i].first;
      if ((i > 0 && vertices_[i - 1].first == p) || std::binary_search(taken.begin(), taken.end(), p)) continue;
      inputs_.push_back({});
      starts_.push_back(p);
      ends_.push_back(p);
      builder.insert_point(p.x, p.y);
    }
    return pairs(builder);
  }

  Candidates of_points() {
    std::vector<std::pair<RoundedPoint, std::uint32_t>> points;
    for (std::uint32_t s = 0; s < walks_.sites.size(); ++s) {
      const RoundedPoint a = rounded_.points[walks_.ends[s].a], b = rounded_.points[walks_.ends[s].b];
      points.emplace_back(a, s);
      if (a != b) {
        points.emplace_back(b, s);
        points.emplace_back(RoundedPoint{a.x / 2 + b.x / 2, a.y / 2 + b.y / 2}, s);
      }
    }
    std::sort(points.begin(), points.end());
    bp::voronoi_builder<std::int32_t> builder;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i > 0 && points[i].first == points[i - 1].first) {
        inputs_.back().push_back(points[i].second);
        continue;
      }
      inputs_.push_back({points[i].second});
      builder.insert_point(points[i].first.x, points[i].first.y);
    }
    all_points_ = true;
    return pairs(builder);
  }

 private:
  template <class Builder>
  Candidates pairs(Builder& builder) {
    Diagram diagram;
    builder.construct(&diagram);
    Candidates out(walks_.sites.size());
    for (const Diagram::edge_type& e : diagram.edges()) {
      if (!e.is_primary() || e.cell() > e.twin()->cell()) continue;
      for (const std::uint32_t s : sites_of(*e.cell())) {
        for (const std::uint32_t j : sites_of(*e.twin()->cell())) {
          if (s == j) continue;
          out[s].push_back(j);
          out[j].push_back(s);
        }
      }
    }
    for (std::vector<std::uint32_t>& list : out) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return out;
  }

  std::vector<std::uint32_t> sites_of(const Diagram::cell_type& cell) const {
    const std::size_t i = cell.source_index();
    if (all_points_ || cell.contains_segment()) return inputs_[i];
    const bool end = cell.source_category() == bp::SOURCE_CATEGORY_SEGMENT_END_POINT;
    const RoundedPoint p = end ? ends_[i] : starts_[i];
    std::vector<std::uint32_t> out;
    for (auto v = std::lower_bound(vertices_.begin(), vertices_.end(), std::make_pair(p, std::uint32_t{0}));
         v != vertices_.end() && v->first == p; ++v)
      out.push_back(v->second);
    return out;
  }

  const Walks& walks_;
  const RoundedSites& rounded_;
  std::vector<std::pair<RoundedPoint, std::uint32_t>> vertices_;  // vertex sites
  std::vector<std::vector<std::uint32_t>> inputs_;                // of the diagram -> sites
  std::vector<RoundedPoint> starts_, ends_;
  bool all_points_ = false;
};

}  // namespace

Candidates candidates_of(const Walks& walks) {
  const RoundedSites rounded = round_sites(walks, kMostBits);
  Neighbours neighbours(walks, rounded);
  return is_planar(rounded) ? neighbours.of_segments<bp::voronoi_builder<std::int32_t>>() : neighbours.of_points();
}

std::optional<Candidates> rough_candidates_of(const Walks& walks) {
  const RoundedSites rounded = round_sites(walks, rough::kBits);
  if (!is_planar(rounded)) return std::nullopt;
  return Neighbours(walks, rounded).of_segments<rough::Builder>();
}

}  // namespace dymsum::shape
