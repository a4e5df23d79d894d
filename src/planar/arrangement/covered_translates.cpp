#include "planar/arrangement/covered_translates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dymsum::planar {
namespace {

// The coordinates along an edge from its start, and to its left.
struct Frame {
  double ax, ay, ux, uy, length;
  explicit Frame(const EdgeBox& e) : ax(e.ax), ay(e.ay), ux(0), uy(0), length(std::hypot(e.dx, e.dy)) {
    if (length > 0) {
      ux = e.dx / length;
      uy = e.dy / length;
    }
  }
  double along(double x, double y) const { return x * ux + y * uy; }
  double depth(double x, double y) const { return y * ux - x * uy; }
};

// Edges at the ends of the edge that go inwards above it lean over what is beneath; by so much along it for every unit
// of depth. Directions of edges are rounded once, so that a slope of up to 256 is good to 2^-40.
constexpr double kSteepest = 256;
double lean(double along, double depth) {
  if (along <= 0) return 0;
  if (depth < -along / kSteepest) return 0;
  return depth > along / kSteepest ? along / depth : std::numeric_limits<double>::infinity();
}

// The least depth of an edge that meets the strip beneath another one; infinity where it lies outside the strip or
// above it.
double depth_in_strip(const Frame& f, const EdgeBox& e, double margin) {
  const double s = f.along(e.ax - f.ax, e.ay - f.ay), t = f.along(e.bx - f.ax, e.by - f.ay);
  const double c = f.depth(e.ax - f.ax, e.ay - f.ay), d = f.depth(e.bx - f.ax, e.by - f.ay);
  const bool outside = std::max(s, t) < -margin || std::min(s, t) > f.length + margin || std::max(c, d) < -margin;
  return outside ? std::numeric_limits<double>::infinity() : std::min(c, d);
}

// A translate: its start along the edge and outwards of it.
struct Translate {
  double along, height;
  std::uint32_t segment;
};

// Translates of one edge.
class Family {
 public:
  Family(const Beneath& beneath, double length, double reach, double margin)
      : b_(beneath), length_(length), reach_(reach), margin_(margin) {}

  /// The ends of what covers the starts of translates, from the left.
  void cover_starts(Array<Translate>& list, Array<Span>& spans) {
    const auto key = [&](const Translate& t) { return t.along + b_.from_start * t.height; };
    std::sort(list.begin(), list.end(), [&](const Translate& a, const Translate& b) {
      return std::pair(key(a), a.segment) < std::pair(key(b), b.segment);
    });
    scan(list, [&](const Translate& own, const Translate& over) {
      const double d = over.height - own.height;
      if (own.along < over.along + b_.from_start * d + reach_) return false;
      const double end = over.along + length_ - b_.from_end * d - reach_;
      spans[own.segment].low = std::max(spans[own.segment].low, (end - own.along) / length_);
      return true;
    });
  }
  void cover_ends(Array<Translate>& list, Array<Span>& spans) {
    const auto key = [&](const Translate& t) { return t.along - b_.from_end * t.height; };
    std::sort(list.begin(), list.end(), [&](const Translate& a, const Translate& b) {
      return std::pair(key(b), a.segment) < std::pair(key(a), b.segment);
    });
    scan(list, [&](const Translate& own, const Translate& over) {
      const double d = over.height - own.height;
      if (own.along > over.along - b_.from_end * d - reach_) return false;
      const double start = over.along + b_.from_start * d + reach_;
      spans[own.segment].high = std::min(spans[own.segment].high, (start - own.along) / length_);
      return true;
    });
  }

 private:
  // Finds for every translate one of the last ones before it that is higher, if covers(own, that) accepts it.
  template <class F>
  void scan(const Array<Translate>& list, F&& covers) {
    constexpr std::size_t kTries = 4;
    higher_.clear();
    for (const Translate& own : list) {
      while (!higher_.empty() && higher_.back().height <= own.height) higher_.pop_back();
      for (std::size_t k = 0; k < std::min(kTries, higher_.size()); ++k) {
        const Translate& over = higher_[higher_.size() - 1 - k];
        const double d = over.height - own.height;
        if (d >= b_.depth) break;
        if (d > margin_ && covers(own, over)) break;
      }
      higher_.push_back(own);
    }
  }

  const Beneath& b_;
  double length_, reach_, margin_;
  std::vector<Translate> higher_;  // from the highest one down to the last one
};

// Offsets of the segments of each edge of a side in a list by edges.
Array<std::uint32_t> by_edge(const Soup& soup, std::uint32_t side, Array<std::uint32_t>& list) {
  Array<std::uint32_t> start(soup.operands[side]->boxes.size() + 2, 0, soup.memory);
  for (const SoupSegment& s : soup.segments)
    if (s.side() == side) ++start[s.edge() + 2];
  for (std::size_t e = 2; e < start.size(); ++e) start[e] += start[e - 1];
  list.resize(start.back());
  for (std::uint32_t k = 0; k < soup.size(); ++k)
    if (const SoupSegment& s = soup.segments[k]; s.side() == side) list[start[s.edge() + 1]++] = k;
  return start;
}

}  // namespace

Beneath beneath(const Operand& o, std::uint32_t edge, double margin) {
  const LoopKind kind =
      std::find_if(o.loops.begin(), o.loops.end(), [&](const Loop& l) { return edge < l.last; })->kind;
  const Frame f(o.boxes[edge]);
  if ((kind != LoopKind::outer && kind != LoopKind::hole) || f.length <= margin) return {};
  const std::uint32_t before = o.prev[edge], after = o.next[edge];
  const EdgeBox &p = o.boxes[before], &n = o.boxes[after];
  Beneath b{std::numeric_limits<double>::infinity(), lean(-f.along(p.dx, p.dy), -f.depth(p.dx, p.dy)),
            lean(-f.along(n.dx, n.dy), f.depth(n.dx, n.dy))};
  if (!(b.from_start + b.from_end < kSteepest)) return {};
  for (std::uint32_t e = 0; e < o.boxes.size(); ++e)
    if (e != edge && e != before && e != after)
      b.depth = std::min(b.depth, depth_in_strip(f, o.boxes[e], margin) - margin);
  return b.depth > margin ? b : Beneath{};
}

Array<Span> uncovered_spans(const Soup& soup, double reach, std::size_t fewest, const Poll& poll) {
  // Looking at all edges of an operand once for every so many translates.
  constexpr std::size_t kEdgesEach = 8;
  // The error of a difference of two lengths, each the scalar product of a difference of two points (3 + 3 + 1
  // roundings of a coordinate) with a unit vector (3 + 2 + 1): 15 roundings of |x| + |y| <= sqrt(2) S, the product's
  // among them, and the sum.
  constexpr double kLengths = exact::rounding_bound(2 * (22 + 1) + 1, 8192);
  const double margin = kLengths * soup.lattice.span;
  Array<Span> spans(soup.memory);
  Array<std::uint32_t> list(soup.memory);
  Array<Translate> family(soup.memory);
  for (std::uint32_t side = 0; side < 2; ++side) {
    const Operand& o = *soup.operands[side];
    if (o.boxes.size() * fewest > soup.size() * kEdgesEach) continue;
    const Array<std::uint32_t> start = by_edge(soup, side, list);
    for (std::uint32_t e = 0; e < o.boxes.size(); ++e) {
      const std::size_t n = start[e + 1] - start[e];
      if (n < fewest || n * kEdgesEach < o.boxes.size()) continue;
      const Beneath b = beneath(o, e, margin);
      if (b.depth == 0) continue;
      if (spans.empty()) spans.resize(soup.size());
      const Frame f(o.boxes[e]);
      family.clear();
      for (std::uint32_t k = start[e]; k < start[e + 1]; ++k) {
        const SoupBox& box = soup.boxes[list[k]];
        family.push_back({f.along(box.ax, box.ay), -f.depth(box.ax, box.ay), list[k]});
      }
      Family translates(b, f.length, reach, margin);
      translates.cover_starts(family, spans);
      translates.cover_ends(family, spans);
      poll(static_cast<double>(e) / static_cast<double>(o.boxes.size()));
    }
  }
  return spans;
}

}  // namespace dymsum::planar
