#include "shape/features/place.h"

#include <optional>

#include "exact/interval.h"
#include "exact/orient.h"

namespace dymsum::shape {
namespace {

using exact::Interval;
using exact::RootExpression;

template <class N>
N coordinate(double v, const RootExpression* exact);
template <>
Interval coordinate(double v, const RootExpression* exact) {
  return exact == nullptr ? Interval(v) : exact->interval();
}
template <>
RootExpression coordinate(double v, const RootExpression* exact) {
  return exact == nullptr ? RootExpression(v) : *exact;
}

template <class N>
N x_of(const Place& p) {
  return coordinate<N>(p.at.x, p.exact ? &p.exact->x : nullptr);
}
template <class N>
N y_of(const Place& p) {
  return coordinate<N>(p.at.y, p.exact ? &p.exact->y : nullptr);
}

template <class N>
N cross(const Place& a, const Place& b, const Place& c, const Place& d) {
  return (x_of<N>(b) - x_of<N>(a)) * (y_of<N>(d) - y_of<N>(c)) - (y_of<N>(b) - y_of<N>(a)) * (x_of<N>(d) - x_of<N>(c));
}

template <class N>
N dot(const Place& a, const Place& b, const Place& c, const Place& d) {
  return (x_of<N>(b) - x_of<N>(a)) * (x_of<N>(d) - x_of<N>(c)) + (y_of<N>(b) - y_of<N>(a)) * (y_of<N>(d) - y_of<N>(c));
}

bool plain(const Place& a, const Place& b, const Place& c, const Place& d) {
  return !a.exact && !b.exact && !c.exact && !d.exact;
}

}  // namespace

int cross_sign(const Place& a, const Place& b, const Place& c, const Place& d) {
  if (plain(a, b, c, d)) return exact::cross_sign(a.at, b.at, c.at, d.at);
  const std::optional<int> certain = sign_of(cross<Interval>(a, b, c, d));
  return certain ? *certain : exact::sign_of(cross<RootExpression>(a, b, c, d));
}

int dot_sign(const Place& a, const Place& b, const Place& c, const Place& d) {
  if (plain(a, b, c, d)) return exact::dot_sign(a.at, b.at, c.at, d.at);
  const std::optional<int> certain = sign_of(dot<Interval>(a, b, c, d));
  return certain ? *certain : exact::sign_of(dot<RootExpression>(a, b, c, d));
}

double distance_left(const Place& a, const Place& b, const Place& p) {
  if (turn_sign(a, b, p) <= 0) return 0;
  return nearest_double(cross<RootExpression>(a, b, a, p) / sqrt(dot<RootExpression>(a, b, a, b)));
}

Place contact_place(const Complex& complex, std::uint32_t site, const ExactPoint& centre) {
  const Site& s = complex.sites[site];
  if (s.kind == Site::Kind::vertex) return {s.a, nullptr};
  const ExactPoint touched = exact_contact(complex, site, centre);
  const Point at{touched.x.interval().middle(), touched.y.interval().middle()};
  return {at, std::make_shared<const ExactPoint>(touched)};
}

}  // namespace dymsum::shape
