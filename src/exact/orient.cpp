#include "exact/orient.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "exact/big.h"
#include "exact/grid.h"
#include "exact/signs.h"

namespace dymsum::exact {

namespace {

struct Vectors {
  Point a, b, c, d;
};

enum class Form { cross, dot };

template <Form form, class C>
int grid_sign(const Vectors& v, int exponent) {
  // differences are formed on the grid, so that a common offset costs no bits
  const auto ux = grid_coordinate<C>(v.b.x, v.a.x, exponent), uy = grid_coordinate<C>(v.b.y, v.a.y, exponent);
  const auto wx = grid_coordinate<C>(v.d.x, v.c.x, exponent), wy = grid_coordinate<C>(v.d.y, v.c.y, exponent);
  if constexpr (form == Form::cross) return sign_of_cross(ux, uy, wx, wy);
  if constexpr (form == Form::dot) return sign_of_dot(ux, uy, wx, wy);
}

template <Form form>
SignAnswer exact_answer(const Vectors& v) {
  const std::array<double, 8> all = {v.a.x, v.a.y, v.b.x, v.b.y, v.c.x, v.c.y, v.d.x, v.d.y};
  const int exponent = common_exponent(all);
  const auto bits = [&](double from, double to) { return bits_needed(to, to, from, exponent); };
  const int widest = std::max({bits(v.a.x, v.b.x), bits(v.a.y, v.b.y), bits(v.c.x, v.d.x), bits(v.c.y, v.d.y)});
  if (widest <= 61) return {grid_sign<form, Int<61>>(v, exponent), Rung::integers};
  if (widest <= 125) return {grid_sign<form, Int<125>>(v, exponent), Rung::integers};
  return {grid_sign<form, Big>(v, exponent), Rung::big};
}

template <Form form>
SignAnswer answer(const Vectors& v) {
  const double ux = v.b.x - v.a.x, uy = v.b.y - v.a.y, wx = v.d.x - v.c.x, wy = v.d.y - v.c.y;
  const double l = form == Form::cross ? ux * wy : ux * wx;
  const double r = form == Form::cross ? -(uy * wx) : uy * wy;
  if (const int s = proved_sign(l, r); s != 0) [[likely]]
    return {s, Rung::doubles};
  return exact_answer<form>(v);
}

}  // namespace

SignAnswer cross_answer(Point a, Point b, Point c, Point d) { return answer<Form::cross>({a, b, c, d}); }
SignAnswer dot_answer(Point a, Point b, Point c, Point d) { return answer<Form::dot>({a, b, c, d}); }

}  // namespace dymsum::exact
