#include "planar/frame/rotating_overlap.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {
namespace {

constexpr std::size_t kMostPairs = 1 << 16;  // trees of exact boxes are better beyond

}  // namespace

RotatingOverlap::Box RotatingOverlap::box_of(const std::vector<Point>& points) {
  Box box{INFINITY, INFINITY, -INFINITY, -INFINITY};
  for (const Point& p : points)
    box = {std::min(box.x0, p.x), std::min(box.y0, p.y), std::max(box.x1, p.x), std::max(box.y1, p.y)};
  return box;
}

void RotatingOverlap::collect(const Operand& o, const std::vector<Point>& points, const std::vector<Point>& vectors,
                              const Box& box, std::vector<Edge>& edges) const {
  const double off = kOverlapPlace * forms_.span();
  edges.clear();
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Point a = points[i], b = points[o.next[i]];
    const Edge e{a.x,
                 a.y,
                 b.x,
                 b.y,
                 vectors[i].x,
                 vectors[i].y,
                 std::min(a.x, b.x) - off,
                 std::min(a.y, b.y) - off,
                 std::max(a.x, b.x) + off,
                 std::max(a.y, b.y) + off,
                 i};
    if (e.x0 <= box.x1 && e.x1 >= box.x0 && e.y0 <= box.y1 && e.y1 >= box.y0) edges.push_back(e);
  }
}

RotatingOverlap::Result RotatingOverlap::right_of(const RotatingFrame& frame, const RotatingFrame::Step& s) {
  const std::optional<Point> z = frame.middle_of(s);
  if (!z) return {};
  const Operand &fixed = forms_.operand(0), &turning = forms_.operand(1);
  turning_.resize(turning.size());
  vectors_[0].resize(fixed.size());
  vectors_[1].resize(turning.size());
  for (std::uint32_t v = 0; v < fixed.size(); ++v) vectors_[0][v] = forms_.edge(0, v);
  for (std::uint32_t v = 0; v < turning_.size(); ++v) {
    turning_[v] = {z->x - frame.turned(v).x, z->y - frame.turned(v).y};
    const Point d = frame.direction({1, v, 0});
    vectors_[1][v] = {-d.x, -d.y};
  }
  collect(fixed, forms_.points(0), vectors_[0], box_of(turning_), of_fixed_);
  collect(turning, turning_, vectors_[1], box_of(forms_.points(0)), of_turning_);
  if (of_fixed_.size() * of_turning_.size() > kMostPairs) return {};
  const WalkSegment& on = frame.window().segments[s.segment];
  const auto touches = [&](std::uint32_t e, std::uint32_t f) {
    if (on.side == 0) return e == on.edge && (f == on.vertex || f == turning.prev[on.vertex]);
    return f == on.edge && (e == on.vertex || e == fixed.prev[on.vertex]);
  };
  // Of two ends against a line: on one side of it certainly (1), certainly on both sides (-1), or not told.
  const auto sides = [&](const Edge& line, const Edge& e) {
    const double bound = (std::abs(line.dx) + std::abs(line.dy)) * kOverlapSide * forms_.span();
    const double u = line.dx * (e.ay - line.ay) - line.dy * (e.ax - line.ax),
                 v = line.dx * (e.by - line.ay) - line.dy * (e.bx - line.ax);
    if (!(std::abs(u) > bound) || !(std::abs(v) > bound)) return 0;
    return (u > 0) == (v > 0) ? 1 : -1;
  };
  Result result{Answer::free, 0, 0};
  near_.resize(of_turning_.size() + 1);
  for (const Edge& e : of_fixed_) {
    std::size_t n = 0;
    for (std::uint32_t k = 0; k < of_turning_.size(); ++k) {
      const Edge& f = of_turning_[k];
      near_[n] = k;
      n += (e.x0 <= f.x1) & (e.x1 >= f.x0) & (e.y0 <= f.y1) & (e.y1 >= f.y0);
    }
    for (std::size_t k = 0; k < n; ++k) {
      const Edge& f = of_turning_[near_[k]];
      const int u = sides(e, f), v = sides(f, e);
      if (u > 0 || v > 0 || touches(e.number, f.number)) continue;
      if (u < 0 && v < 0) return {Answer::overlap, e.number, f.number};
      result.answer = Answer::unknown;
    }
  }
  return result;
}

}  // namespace dymsum::planar
