#include "planar/region/plain_rings.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/box_sweep.h"
#include "base/scratch.h"
#include "exact/orient.h"
#include "planar/region/region_sweep.h"

namespace dymsum::planar {
namespace {

/// A box in 15-bit quanta in one word: x0, y0, M - x1, M - y1 from the low bits up, with M = 0x7fff and a guard bit
/// above each. Less in every field is a larger box.
using Box = std::uint64_t;
constexpr Box kFields = 0x7fff7fff7fff7fff, kGuards = 0x8000800080008000;

Box make_box(std::uint64_t x0, std::uint64_t y0, std::uint64_t x1, std::uint64_t y1) {
  return x0 | y0 << 16 | (0x7fff - x1) << 32 | (0x7fff - y1) << 48;
}
/// x1, y1, M - x0, M - y0 and the guards.
Box upper(Box b) { return std::rotl(kFields - b, 32) | kGuards; }
/// Closed boxes, the second one's `upper`: no field of a is greater, so that no guard is borrowed from.
bool meet(Box a, Box upper_b) { return ((upper_b - a) & kGuards) == kGuards; }
/// The least of every field: the box around both.
Box around(Box a, Box b) {
  const Box a_greater = ((a | kGuards) - b) & kGuards, mask = a_greater - (a_greater >> 15);
  return (b & mask) | (a & ~mask);
}

Point low_corner(Point a, Point b) { return {std::min(a.x, b.x), std::min(a.y, b.y)}; }
Point high_corner(Point a, Point b) { return {std::max(a.x, b.x), std::max(a.y, b.y)}; }
/// c and d lie strictly on one side of the line through a and b. Exact.
bool on_one_side(Point a, Point b, Point c, Point d) {
  const int s = exact::orient_sign(a, b, c);
  return s != 0 && exact::orient_sign(a, b, d) == s;
}

class PlainRings {
 public:
  explicit PlainRings(const RegionData& data) : data_(data) {}

  bool proved() {
    if (!gather()) return false;
    if (rings_.size() == 1 && turns_left_once()) return true;
    if (!find_quanta()) return false;
    for (const RingSpan& ring : rings_)
      if (folds(ring)) return false;
    left_ = kPairsPerVertex * size();
    if (size() <= kAllPairs) {
      all_pairs();
    } else {
      make_boxes();
      add_levels();
      within(level_count_ - 1, 0, count_[level_count_ - 1]);
    }
    if (left_ <= 0) return false;
    for (const RingSpan& ring : rings_)
      if (counter_clockwise(ring) != ring.outer) return false;
    return nested();
  }

 private:
  struct RingSpan {
    std::uint32_t first, last;  // vertices, and the edges that start there
    Point low, high;
    bool outer;
  };
  static constexpr std::uint32_t kFanOut = 8, kMostLevels = 12;
  static constexpr std::uint32_t kAllPairs = 96;  // up to this, boxes around boxes cost more than they save
  static constexpr std::uint32_t kTopBoxes = 40;  // boxes around boxes, and so on until there are no more than these
  static constexpr std::size_t kMostVertices = std::size_t{1} << 31;
  /// Pairs of edges or boxes that are looked at, per vertex. A sweep costs about as much as 100.
  static constexpr std::int64_t kPairsPerVertex = 64;

  std::uint32_t size() const { return static_cast<std::uint32_t>(points_.size()); }

  // False: too few vertices, too many, or a coordinate that is not finite.
  bool gather() {
    std::size_t n = 0;
    for (const Part& part : data_.parts) {
      n += part.outer.size();
      for (const Ring& hole : part.holes) n += hole.size();
    }
    if (n == 0 || n > kMostVertices) return false;
    points_.resize(n);
    next_.resize(n);
    for (const Part& part : data_.parts) {
      if (!add_ring(part.outer, true)) return false;
      for (const Ring& hole : part.holes)
        if (!add_ring(hole, false)) return false;
    }
    return true;
  }
  bool add_ring(const Ring& ring, bool outer) {
    if (ring.size() < 3) return false;
    const std::uint32_t first = rings_.empty() ? 0 : rings_.back().last;
    const auto n = static_cast<std::uint32_t>(ring.size());
    RingSpan span{first, first + n, ring[0], ring[0], outer};
    double zero = 0;  // NaN after a coordinate that is not finite
    for (std::uint32_t i = 0; i < n; ++i) {
      const Point p = ring[i];
      points_[first + i] = p;
      next_[first + i] = first + i + 1;
      span.low = low_corner(span.low, p);
      span.high = high_corner(span.high, p);
      zero += (p.x - p.x) + (p.y - p.y);
    }
    if (zero != 0 || std::isnan(zero)) return false;
    next_[span.last - 1] = first;
    rings_.push_back(span);
    return true;
  }

  // Monotone in the coordinates, so that what meets meets in quanta too. False: no area, or too large or small to be
  // determined in doubles.
  bool find_quanta() {
    Point low = rings_[0].low, high = rings_[0].high;
    for (const RingSpan& ring : rings_) {
      low = low_corner(low, ring.low);
      high = high_corner(high, ring.high);
    }
    low_ = low;
    x_scale_ = 0x7ffe / (high.x - low.x);
    y_scale_ = 0x7ffe / (high.y - low.y);
    return x_scale_ > 0 && y_scale_ > 0 && std::isfinite(x_scale_) && std::isfinite(y_scale_);
  }
  // The extent times its scale is 0x7ffe with two roundings.
  std::int32_t x_quantum(std::size_t v) const { return static_cast<std::int32_t>((points_[v].x - low_.x) * x_scale_); }
  std::int32_t y_quantum(std::size_t v) const { return static_cast<std::int32_t>((points_[v].y - low_.y) * y_scale_); }

  void make_boxes() {
    // A point's box, then the one around an edge's ends.
    Array<Box> at(size(), &memory_);
    for (std::uint32_t v = 0; v < size(); ++v) {
      const auto x = static_cast<std::uint64_t>(x_quantum(v)), y = static_cast<std::uint64_t>(y_quantum(v));
      at[v] = make_box(x, y, x, y);
    }
    boxes_.emplace(levels(std::make_index_sequence<kMostLevels>()));
    Array<Box>& edges = boxes_->front();
    edges.resize(size());
    for (std::uint32_t e = 0; e < size(); ++e) edges[e] = around(at[e], at[next_[e]]);
  }

  /// Left at every vertex, by less than half a turn, and in all one turn: such a ring is convex. False where doubles do
  /// not decide.
  bool turns_left_once() const {
    const std::uint32_t n = size();
    const auto upper = [](Point a, Point b) { return b.y > a.y || (b.y == a.y && b.x > a.x); };
    int turns = 0;
    Point a = points_[n - 2], b = points_[n - 1];
    for (bool was_upper = upper(a, b); const Point c : points_) {
      if (exact::proved_cross_sign(a, b, b, c) <= 0) return false;
      const bool is_upper = upper(b, c);
      turns += is_upper && !was_upper;
      was_upper = is_upper;
      a = b;
      b = c;
    }
    return turns == 1;
  }

  /// An edge has no length or runs back along the one before.
  bool folds(const RingSpan& ring) const {
    Point a = points_[ring.last - 2], b = points_[ring.last - 1];
    for (std::uint32_t v = ring.first; v < ring.last; ++v) {
      const Point c = points_[v];
      if (exact::proved_cross_sign(a, b, b, c) == 0 &&
          (b == c || (exact::orient_sign(a, b, c) == 0 && exact::dot_sign(a, b, b, c) <= 0))) {
        return true;
      }
      a = b;
      b = c;
    }
    return false;
  }

  void add_levels() {
    count_[0] = size();
    while (count_[level_count_ - 1] > kTopBoxes) {
      const Array<Box>& below = (*boxes_)[level_count_ - 1];
      Array<Box>& level = (*boxes_)[level_count_];
      for (std::size_t i = 0; i < below.size(); i += kFanOut) {
        Box box = below[i];
        for (std::size_t k = i + 1; k < std::min<std::size_t>(i + kFanOut, below.size()); ++k)
          box = around(box, below[k]);
        level.push_back(box);
      }
      count_[level_count_++] = static_cast<std::uint32_t>(level.size());
    }
  }
  std::uint32_t end_of(std::uint32_t level, std::uint32_t group) const {
    return std::min((group + 1) * kFanOut, count_[level]);
  }

  // All pairs of edges, eight at a time.
  void all_pairs() {
    const std::uint32_t n = size(), room = n + kLanes;
    Array<std::int16_t> lists(6 * room, &memory_);
    std::int16_t *const x = lists.data(), *const y = x + room;
    std::int16_t *const x0 = y + room, *const y0 = x0 + room, *const x1 = y0 + room, *const y1 = x1 + room;
    for (std::uint32_t v = 0; v < n; ++v) {
      x[v] = static_cast<std::int16_t>(x_quantum(v));
      y[v] = static_cast<std::int16_t>(y_quantum(v));
    }
    const auto bound = [=](std::uint32_t e, std::uint32_t end) {
      x0[e] = std::min(x[e], x[end]);
      y0[e] = std::min(y[e], y[end]);
      x1[e] = std::max(x[e], x[end]);
      y1[e] = std::max(y[e], y[end]);
    };
    for (std::uint32_t e = 0; e + 1 < n; ++e) bound(e, e + 1);
    for (const RingSpan& ring : rings_) bound(ring.last - 1, ring.first);
    std::fill(x0 + n, x0 + room, static_cast<std::int16_t>(kBoxQuanta));  // beyond the last edge nothing meets
    for (std::uint32_t e = 0; e < n && left_ > 0; ++e) {
      const Lanes ex0 = Lanes{} + x0[e], ey0 = Lanes{} + y0[e], ex1 = Lanes{} + x1[e], ey1 = Lanes{} + y1[e];
      for (std::uint32_t f = next_[e] == e + 1 ? e + 2 : e + 1; f < n; f += kLanes) {
        const Lanes apart = (load_lanes(x0 + f) > ex1) | (load_lanes(y0 + f) > ey1) | (load_lanes(x1 + f) < ex0) |
                            (load_lanes(y1 + f) < ey0);
        for (auto bits = zero_lanes(apart); bits != 0; bits &= bits - 1) look_at(e, f + lane_of(bits));
      }
    }
  }

  // All pairs of edges below the boxes [first, last) of a level. What is left is zero or less once a pair is not
  // distinguished.
  void within(std::uint32_t level, std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t i = first; i < last && left_ > 0; ++i) {
      if (level > 0) within(level - 1, i * kFanOut, end_of(level - 1, i));
      against(level, i, i + 1, last);
    }
  }
  void against(std::uint32_t level, std::uint32_t i, std::uint32_t first, std::uint32_t last) {
    const Box* const boxes = (*boxes_)[level].data();
    const Box mine = upper(boxes[i]);
    for (std::uint32_t j = first; j < last; ++j) {
      if (!meet(boxes[j], mine)) continue;
      if (--left_ <= 0) return;
      if (level == 0) look_at(i, j);
      else
        for (std::uint32_t k = i * kFanOut; k < end_of(level - 1, i); ++k)
          against(level - 1, k, j * kFanOut, end_of(level - 1, j));
    }
  }
  void look_at(std::uint32_t e, std::uint32_t f) {
    if (next_[e] == f || next_[f] == e) return;  // judged by `folds`
    const Point a = points_[e], b = points_[next_[e]], c = points_[f], d = points_[next_[f]];
    if (!on_one_side(a, b, c, d) && !on_one_side(c, d, a, b)) left_ = 0;
  }

  /// Whether a simple ring is counter-clockwise: the turn at its smallest vertex, where it is strictly convex.
  bool counter_clockwise(const RingSpan& ring) const {
    std::uint32_t v = ring.first;
    for (std::uint32_t u = v + 1; u < ring.last; ++u)
      if (lex_less(points_[u], points_[v])) v = u;
    const std::uint32_t before = v == ring.first ? ring.last - 1 : v - 1;
    return exact::orient_sign(points_[before], points_[v], points_[next_[v]]) > 0;
  }

  static bool apart(const RingSpan& a, const RingSpan& b) {
    return a.high.x < b.low.x || b.high.x < a.low.x || a.high.y < b.low.y || b.high.y < a.low.y;
  }
  /// The first vertex of `inner`, which does not lie on `ring`, lies inside it.
  bool inside(const RingSpan& inner, const RingSpan& ring) const {
    if (apart(inner, ring)) return false;
    const Point p = points_[inner.first];
    bool in = false;
    for (std::uint32_t e = ring.first; e < ring.last; ++e) {
      const Point a = points_[e], b = points_[next_[e]];
      if ((a.y > p.y) == (b.y > p.y)) continue;
      if ((exact::orient_sign(a, b, p) > 0) == (b.y > a.y)) in = !in;
    }
    return in;
  }
  // Disjoint rings: every hole inside its outer ring and no other hole, and parts side by side. False where a part may
  // lie in a hole.
  bool nested() const {
    const std::size_t r = rings_.size();
    if (r == 1) return true;
    if (r * r > static_cast<std::size_t>(kPairsPerVertex) * points_.size()) return false;
    const RingSpan* outer = nullptr;
    std::int64_t work = kPairsPerVertex * size();
    for (std::size_t i = 0; i < r; ++i) {
      const RingSpan& ring = rings_[i];
      if (ring.outer) {
        outer = &ring;
      } else {
        work -= outer->last - outer->first;
        if (work < 0 || !inside(ring, *outer)) return false;
      }
      for (std::size_t k = i; k-- > 0;) {
        const RingSpan& other = rings_[k];
        if (&other == outer || apart(ring, other) || other.outer != ring.outer) continue;
        if (ring.outer) return false;
        work -= other.last - other.first + ring.last - ring.first;
        if (work < 0 || inside(ring, other) || inside(other, ring)) return false;
      }
    }
    return true;
  }

  const RegionData& data_;
  Scratch memory_;
  Array<Point> points_{&memory_};
  Array<std::uint32_t> next_{&memory_};
  Array<RingSpan> rings_{&memory_};
  Point low_;
  double x_scale_ = 0, y_scale_ = 0;                          ///< quanta per unit
  std::optional<std::array<Array<Box>, kMostLevels>> boxes_;  ///< of many edges
  std::array<std::uint32_t, kMostLevels> count_{};
  std::uint32_t level_count_ = 1;
  std::int64_t left_ = 0;

  template <std::size_t... k>
  std::array<Array<Box>, kMostLevels> levels(std::index_sequence<k...>) {
    return {((void)k, Array<Box>(&memory_))...};
  }
};

}  // namespace

bool plainly_valid(const RegionData& data) {
  return !data.parts.empty() && data.polylines.empty() && data.points.empty() && PlainRings(data).proved();
}

}  // namespace dymsum::planar
