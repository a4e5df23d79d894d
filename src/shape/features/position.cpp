#include "shape/features/position.h"

#include <cmath>
#include <limits>
#include <optional>

#include "exact/interval.h"
#include "exact/orient.h"
#include "shape/complex/exact_complex.h"

namespace dymsum::shape {
namespace {

using exact::Interval;
using exact::RootExpression;

using exact::FineInterval;

template <class N>
struct At {
  N x, y;
};
template <class N>
At<N> at(const Position& p);
template <>
At<Interval> at(const Position& p) {
  if (!p.exact) return {Interval(p.at.x), Interval(p.at.y)};
  return {p.exact->x.interval(), p.exact->y.interval()};
}
template <>
At<FineInterval> at(const Position& p) {
  if (!p.exact) return {FineInterval(p.at.x), FineInterval(p.at.y)};
  return {p.fine.x, p.fine.y};
}
template <>
At<RootExpression> at(const Position& p) {
  if (!p.exact) return {RootExpression(p.at.x), RootExpression(p.at.y)};
  return {p.exact->x, p.exact->y};
}

template <class N>
N cross(const Position& a, const Position& b, const Position& c, const Position& d) {
  const At<N> p = at<N>(a), q = at<N>(b), r = at<N>(c), s = at<N>(d);
  return (q.x - p.x) * (s.y - r.y) - (q.y - p.y) * (s.x - r.x);
}

template <class N>
N dot(const Position& a, const Position& b, const Position& c, const Position& d) {
  const At<N> p = at<N>(a), q = at<N>(b), r = at<N>(c), s = at<N>(d);
  return (q.x - p.x) * (s.x - r.x) + (q.y - p.y) * (s.y - r.y);
}

/// The distance of p from the line.
template <class N>
N distance(const Position& a, const Position& b, const Position& p) {
  return cross<N>(a, b, a, p) / sqrt(dot<N>(a, b, a, b));
}

template <class N>
N length_of(const std::vector<const Position*>& path, const Position& a, const Position& b, bool leaves) {
  N length = leaves ? distance<N>(a, b, *path.back()) : N(0);
  for (std::size_t k = 1; k < path.size(); ++k)
    length = length + sqrt(dot<N>(*path[k - 1], *path[k], *path[k - 1], *path[k]));
  return length;
}

/// The nearest double as far as pairs of doubles decide; normal doubles alone.
std::optional<double> nearest_normal(const FineInterval& length) {
  const std::optional<double> near = length.nearest();
  return near && *near >= std::numeric_limits<double>::min() ? near : std::nullopt;
}

bool plain(const Position& a, const Position& b, const Position& c, const Position& d) {
  return !a.exact && !b.exact && !c.exact && !d.exact;
}

}  // namespace

int cross_sign(const Position& a, const Position& b, const Position& c, const Position& d) {
  if (plain(a, b, c, d)) return exact::cross_sign(a.at, b.at, c.at, d.at);
  if (const std::optional<int> sign = sign_of(cross<Interval>(a, b, c, d))) return *sign;
  if (const std::optional<int> sign = sign_of(cross<FineInterval>(a, b, c, d))) return *sign;
  return exact::sign_of(cross<RootExpression>(a, b, c, d));
}

int dot_sign(const Position& a, const Position& b, const Position& c, const Position& d) {
  if (plain(a, b, c, d)) return exact::dot_sign(a.at, b.at, c.at, d.at);
  if (const std::optional<int> sign = sign_of(dot<Interval>(a, b, c, d))) return *sign;
  if (const std::optional<int> sign = sign_of(dot<FineInterval>(a, b, c, d))) return *sign;
  return exact::sign_of(dot<RootExpression>(a, b, c, d));
}

double distance_left(const Position& a, const Position& b, const Position& p) {
  if (turn_sign(a, b, p) <= 0) return 0;
  if (const std::optional<double> near = nearest_normal(distance<FineInterval>(a, b, p))) return *near;
  return nearest_double(distance<RootExpression>(a, b, p));
}

// A sum of positive roots of rationals is rational only where each of them is, and RootExpression knows these: of other
// sums some precision tells the nearest double.
double way_length(const std::vector<const Position*>& path, const Position& a, const Position& b) {
  const bool leaves = turn_sign(a, b, *path.back()) > 0;
  if (const std::optional<double> near = nearest_normal(length_of<FineInterval>(path, a, b, leaves))) return *near;
  return nearest_double(length_of<RootExpression>(path, a, b, leaves));
}

Centre centre_of(const Complex& complex, std::uint32_t node) {
  const ExactComplex& exact = *complex.exact;
  Centre centre{exact_disc(complex, node).centre};
  constexpr int kMostExponent = 250;  // pairs of doubles reach from 2^-300 to 2^300
  if (std::abs(exact.walks.unit_exponent) > kMostExponent) return centre;
  const DiscOf<FineInterval> disc = disc_of<FineInterval>(exact.walks, exact.discs[node]);
  const FineInterval unit(std::ldexp(1.0, exact.walks.unit_exponent));
  centre.fine = {disc.x * unit, disc.y * unit};
  return centre;
}

Position contact_position(const Complex& complex, std::uint32_t site, const Centre& centre) {
  const Site& s = complex.sites[site];
  if (s.kind == Site::Kind::vertex) return {s.a, nullptr};
  const ExactPoint touched = exact_contact(complex, site, centre.exact);
  const FineInterval ax(s.a.x), ay(s.a.y), dx = FineInterval(s.b.x) - ax, dy = FineInterval(s.b.y) - ay;
  const FineInterval k = ((centre.fine.x - ax) * dx + (centre.fine.y - ay) * dy) / (dx * dx + dy * dy);
  return {{touched.x.interval().midpoint(), touched.y.interval().midpoint()},
          std::make_shared<const ExactPoint>(touched),
          {ax + k * dx, ay + k * dy}};
}

}  // namespace dymsum::shape
