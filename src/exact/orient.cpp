#include "exact/orient.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include "exact/big.h"
#include "exact/grid.h"
#include "exact/int.h"
#include "exact/interval.h"
#include "exact/rounding_bound.h"

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

namespace {

// The filter's bound, with e = 2^-53. Differences of doubles err relatively by at most e and never underflow. A term
// (u v - u' v') w is formed from three differences (3e), a product (e), a difference (e) and a product (e), and enters
// at most two sums (2e): together at most 8 roundings of its permanent (|u v| + |u' v'|) |w|. The permanent is
// itself evaluated in doubles, each summand by 8 operations at most: at least (1 - e)^8 of its value. So 10e of the
// computed one covers all that rounding loses, with one to spare. Underflow: where all differences are at most 2^300 in
// magnitude, each of the six inner products loses at most 2^-1074, times 2^300, and the outer ones 2^-1074 each: below
// 2^-700, which also covers what the permanent loses. Then no product exceeds 2^903, and nothing overflows.
constexpr double kRelative = rounding_bound(8, 10);
constexpr double kLost = 0x1p-700;
constexpr double kLargest = 0x1p300;

struct Differences {
  double x, y, z;
};

Differences minus(const Point3& p, const Point3& a) { return {p.x - a.x, p.y - a.y, p.z - a.z}; }

double largest(const Differences& d) { return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}); }

template <class C>
struct Vector {
  C x, y, z;
};

/// The grid of each axis by itself: scaling an axis does not change the sign.
struct Grid {
  int x, y, z;
};

template <class C>
Vector<C> on_grid(const Point3& p, const Point3& a, const Grid& g) {
  return {grid_coordinate<C>(p.x, a.x, g.x), grid_coordinate<C>(p.y, a.y, g.y), grid_coordinate<C>(p.z, a.z, g.z)};
}

template <class C>
int grid_sign(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Grid& g) {
  return sign(determinant(on_grid<C>(b, a, g), on_grid<C>(c, a, g), on_grid<C>(d, a, g)));
}

// Differences of D bits: 3D + 3 bits are one __int128 for D = 41, four limbs for D = 83, six for D = 126.
template <int D>
using Determinant = decltype(determinant(Vector<Int<D>>{}, Vector<Int<D>>{}, Vector<Int<D>>{}));
static_assert(Determinant<41>::kBits == 126 && sizeof(Determinant<41>) == 16);
static_assert(Determinant<83>::kBits == 252 && sizeof(Determinant<83>) == 32);
static_assert(Determinant<126>::kBits == 381 && sizeof(Determinant<126>) == 48);

SignAnswer exact_answer(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const Grid g{common_exponent(std::array{a.x, b.x, c.x, d.x}), common_exponent(std::array{a.y, b.y, c.y, d.y}),
               common_exponent(std::array{a.z, b.z, c.z, d.z})};
  int bits = 0;
  for (const Point3* p : {&b, &c, &d}) {
    bits = std::max({bits, bits_needed(p->x, p->x, a.x, g.x), bits_needed(p->y, p->y, a.y, g.y),
                     bits_needed(p->z, p->z, a.z, g.z)});
  }
  if (bits <= 41) return {grid_sign<Int<41>>(a, b, c, d, g), Rung::integers};
  if (bits <= 83) return {grid_sign<Int<83>>(a, b, c, d, g), Rung::integers};
  if (bits <= 126) return {grid_sign<Int<126>>(a, b, c, d, g), Rung::integers};
  return {grid_sign<Big>(a, b, c, d, g), Rung::big};
}

/// The sign in pairs of doubles, for points that are nearly in one plane, as those of a plane face that was turned in
/// doubles.
std::optional<int> fine_sign(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const auto from_a = [&](const Point3& p) {
    return Vector<FineInterval>{FineInterval::difference(a.x, p.x), FineInterval::difference(a.y, p.y),
                                FineInterval::difference(a.z, p.z)};
  };
  return sign_of(determinant(from_a(b), from_a(c), from_a(d)));
}

}  // namespace

SignAnswer orient3_answer(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const Differences u = minus(b, a), v = minus(c, a), w = minus(d, a);
  if (std::max({largest(u), largest(v), largest(w)}) <= kLargest) [[likely]] {
    const double yz = u.y * v.z, zy = u.z * v.y, zx = u.z * v.x, xz = u.x * v.z, xy = u.x * v.y, yx = u.y * v.x;
    const double s = (yz - zy) * w.x + (zx - xz) * w.y + (xy - yx) * w.z;
    const double permanent = (std::abs(yz) + std::abs(zy)) * std::abs(w.x) +
                             (std::abs(zx) + std::abs(xz)) * std::abs(w.y) +
                             (std::abs(xy) + std::abs(yx)) * std::abs(w.z);
    if (std::abs(s) > kRelative * permanent + kLost) [[likely]]
      return {s > 0 ? 1 : -1, Rung::doubles};
    // What doubles make 0 is 0 nearly always.
    if (s != 0)
      if (const std::optional<int> sign = fine_sign(a, b, c, d)) return {*sign, Rung::double_pairs};
  }
  return exact_answer(a, b, c, d);
}

}  // namespace dymsum::exact
