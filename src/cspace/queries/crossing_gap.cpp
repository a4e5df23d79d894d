#include "cspace/queries/crossing_gap.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dymsum::cspace {
namespace {

using base::exact_product, base::exact_sum;

// A number as the sum of its terms, exactly as long as nothing underflows: coordinates are scaled to at most 1.
using Terms = std::vector<double>;

void add(Terms& terms, double v) {
  std::size_t kept = 0;
  for (const double t : terms) {
    const DoublePair s = exact_sum(v, t);
    if (s.low != 0) terms[kept++] = s.low;
    v = s.high;
  }
  terms.resize(kept);
  if (v != 0) terms.push_back(v);
}

Terms product(const Terms& a, const Terms& b) {
  Terms out;
  for (const double x : a)
    for (const double y : b) {
      const DoublePair p = exact_product(x, y);
      add(out, p.low);
      add(out, p.high);
    }
  return out;
}

Terms sum(Terms a, const Terms& b, double sign) {
  for (const double y : b) add(a, sign * y);
  return a;
}

Terms arrow_between(double a, double b) {
  const DoublePair d = exact_sum(a, -b);
  Terms out;
  add(out, d.low);
  add(out, d.high);
  return out;
}

struct Arrow {
  DoublePair x, y;
};
Arrow from_to(Point a, Point b) { return {exact_sum(b.x, -a.x), exact_sum(b.y, -a.y)}; }
DoublePair cross_of_arrows(const Arrow& a, const Arrow& b) { return a.x * b.y - a.y * b.x; }
DoublePair dot_of_arrows(const Arrow& a, const Arrow& b) { return a.x * b.x + a.y * b.y; }
DoublePair square_of_arrow(const Arrow& a) { return a.x * a.x + a.y * a.y; }

// The signed distance of p from the line through a and b.
DoublePair height(Point p, const std::array<Point, 2>& line) {
  const Arrow d = from_to(line[0], line[1]);
  return cross_of_arrows(from_to(line[0], p), d) / square_root(square_of_arrow(d));
}

int sign_of(const Terms& terms) { return terms.empty() ? 0 : terms.back() > 0 ? 1 : -1; }

// 1 where p is as far from one line as q from the other one and on the same side, -1 on different ones, 0 where it is
// not as far, 2 on both lines: by the squares of the distances times those of the lengths.
int same_height(Point p, const std::array<Point, 2>& line, Point q, const std::array<Point, 2>& other) {
  const auto parts = [](Point point, const std::array<Point, 2>& l) {
    const Terms dx = arrow_between(l[1].x, l[0].x), dy = arrow_between(l[1].y, l[0].y);
    const Terms gx = arrow_between(point.x, l[0].x), gy = arrow_between(point.y, l[0].y);
    const Terms area = sum(product(gx, dy), product(gy, dx), -1);
    return std::array{area, sum(product(dx, dx), product(dy, dy), 1)};
  };
  const auto [area, length] = parts(p, line);
  const auto [other_area, other_length] = parts(q, other);
  if (area.empty() && other_area.empty()) return 2;
  const Terms one = product(product(area, area), other_length), two = product(product(other_area, other_area), length);
  return sum(one, two, -1).empty() ? sign_of(area) * sign_of(other_area) : 0;
}

}  // namespace

CrossingGaps crossing_gaps(const std::array<Point, 2>& fixed, const std::array<Point, 2>& turning, Point corner,
                           Point hand) {
  std::array<Point, 6> all{fixed[0], fixed[1], turning[0], turning[1], corner, hand};
  double most = 0, least = INFINITY;
  for (const Point& p : all)
    for (const double v : {std::abs(p.x), std::abs(p.y)}) {
      most = std::max(most, v);
      if (v != 0) least = std::min(least, v);
    }
  int exponent = 0;
  std::frexp(most, &exponent);
  for (Point& p : all) p = {std::ldexp(p.x, -exponent), std::ldexp(p.y, -exponent)};
  const std::array<Point, 2> line{all[0], all[1]}, other{all[2], all[3]};
  const DoublePair a = height(all[4], line), b = -height(all[5], other);
  CrossingGaps gaps{(a + b).value(), (a - b).value()};
  // Products of eight coordinates and their roundings stay within the range of doubles.
  if (least >= std::ldexp(most, -60) && std::min(std::abs(gaps[0]), std::abs(gaps[1])) < 0x1p-85) {
    const int same = same_height(all[4], line, all[5], other);
    if (same > 0) gaps[0] = 0;
    if (same < 0 || same == 2) gaps[1] = 0;
  }
  for (double& gap : gaps) gap = std::ldexp(gap, exponent);
  return gaps;
}

// tan(phi / 2) = sin / (1 + cos) = (1 - cos) / sin, of which one does not cancel.
std::array<DoublePair, 2> half_tangents(const std::array<Point, 2>& a, const std::array<Point, 2>& b) {
  const auto unit = [](const std::array<Point, 2>& edge) {
    Arrow v = from_to(edge[0], edge[1]);
    int exponent = 0;
    std::frexp(std::max(std::abs(v.x.high), std::abs(v.y.high)), &exponent);
    for (DoublePair* d : {&v.x, &v.y}) *d = {std::ldexp(d->high, -exponent), std::ldexp(d->low, -exponent)};
    return v;
  };
  const Arrow u = unit(a), v = unit(b);
  const DoublePair lengths = square_root(square_of_arrow(u) * square_of_arrow(v)), c = dot_of_arrows(u, v),
                   s = cross_of_arrows(u, v);
  const auto half = [&](const DoublePair& cosine, const DoublePair& sine) {
    return cosine.high > 0 ? sine / (lengths + cosine) : (lengths - cosine) / sine;
  };
  return {half(c, s), half(-c, -s)};
}

}  // namespace dymsum::cspace
