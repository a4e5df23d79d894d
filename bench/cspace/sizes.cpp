#include "cspace/sizes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "dymsum/planar_sum.h"

namespace dymsum::bench {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

struct Corner {
  Point before, at, after;
  double in = 0, out = 0;  ///< directions of its edges
  /// How far the direction turns here, counter-clockwise: the long way round at reflex vertices.
  double turn() const { return out > in ? out - in : out - in + kTurn; }
};

struct Line {
  Point a, b;
};

double direction(Point a, Point b) { return std::atan2(b.y - a.y, b.x - a.x); }

std::vector<Corner> corners(const Region& region) {
  std::vector<Corner> result;
  const auto add = [&](const Ring& ring) {
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Point a = ring[(i + n - 1) % n], b = ring[i], c = ring[(i + 1) % n];
      result.push_back({a, b, c, direction(a, b), direction(b, c)});
    }
  };
  const Region canonical = region.canonical();
  for (const Part& part : canonical.parts()) {
    add(part.outer);
    for (const Ring& hole : part.holes) add(hole);
  }
  return result;
}

/// Appends the edges that leave the corners of `edges` and whose direction the corners of `vertices` turn through: the
/// directions (in, out], or [in, out) for `with_in`.
void add_segments(const std::vector<Corner>& edges, const std::vector<Corner>& vertices, bool with_in, bool convex_only,
                  std::vector<Line>& lines) {
  for (const Corner& v : vertices) {
    const double turn = v.turn();
    if (convex_only && turn >= std::numbers::pi) continue;
    for (const Corner& e : edges) {
      const double from_in = e.out >= v.in ? e.out - v.in : e.out - v.in + kTurn;
      const bool met = with_in ? e.out != v.out && from_in < turn : e.out == v.out || (from_in > 0 && from_in < turn);
      if (!met) continue;
      lines.push_back({{e.at.x + v.at.x, e.at.y + v.at.y}, {e.after.x + v.at.x, e.after.y + v.at.y}});
    }
  }
}

std::vector<Line> convolution(const Region& p, const Region& q, bool convex_only) {
  const std::vector<Corner> of_p = corners(p), of_q = corners(q);
  std::vector<Line> lines;
  add_segments(of_p, of_q, false, convex_only, lines);
  add_segments(of_q, of_p, true, convex_only, lines);
  return lines;
}

double side(const Line& l, Point x) { return (l.b.x - l.a.x) * (x.y - l.a.y) - (l.b.y - l.a.y) * (x.x - l.a.x); }
bool cross(const Line& l, const Line& m) {
  if (std::max(l.a.y, l.b.y) < std::min(m.a.y, m.b.y) || std::max(m.a.y, m.b.y) < std::min(l.a.y, l.b.y)) return false;
  return side(l, m.a) * side(l, m.b) < 0 && side(m, l.a) * side(m, l.b) < 0;
}

std::uint64_t count_crossings(std::vector<Line> lines) {
  const auto left = [](const Line& l) { return std::min(l.a.x, l.b.x); };
  std::sort(lines.begin(), lines.end(), [&](const Line& l, const Line& m) { return left(l) < left(m); });
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double right = std::max(lines[i].a.x, lines[i].b.x);
    for (std::size_t j = i + 1; j < lines.size() && left(lines[j]) <= right; ++j) count += cross(lines[i], lines[j]);
  }
  return count;
}

}  // namespace

ConvolutionCounts count_convolutions(const Region& p, const Region& q) {
  ConvolutionCounts counts;
  const std::vector<Line> complete = convolution(p, q, false), reduced = convolution(p, q, true);
  counts.complete_crossings = count_crossings(complete);
  counts.reduced_crossings = count_crossings(reduced);
  counts.live_crossings = minkowski_sum(p, q).value().stats.crossings;
  const ConvolutionSizes sizes = convolution_sizes(p, q);
  counts.complete = sizes.full;
  counts.reduced = sizes.reduced;
  const auto apart = [](std::uint64_t a, std::uint64_t b) { return a > b ? a - b : b - a; };
  counts.misjudged = apart(complete.size(), sizes.full) + apart(reduced.size(), sizes.reduced);
  return counts;
}

}  // namespace dymsum::bench
