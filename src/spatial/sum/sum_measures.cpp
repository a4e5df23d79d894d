// Volume and surface of a sum. Positions have denominators of their own, so the exact volume is a long fraction; its
// nearest double comes from positions cut off at a power of two, with a proved error, and from ever longer ones until
// both ends of the range round to one number. Convex sums have one denominator, and measures of their own.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "dymsum/volume_text.h"
#include "exact/big.h"
#include "spatial/mesh/wide_sum.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {
namespace {

// Volume and surface of a convex sum, over one denominator.

using exact::Big;

using exact::BigInteger;

using exact::BigRational;

exact::Vector3<Big> big_vector(const BigVector& v) { return {Big(v[0]), Big(v[1]), Big(v[2])}; }

BigInteger determinant(const BigVector& a, const BigVector& b, const BigVector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Positions are numerators times this.
BigRational unit_of(const SpatialSum& sum) {
  return SpatialSumInternals::convex(sum)->unit() / SpatialSumInternals::positions(sum).scale;
}

/// The exact volume of a sum that is SpatialSum::is_convex. O(n).
BigRational convex_volume(const SpatialSum& sum) {
  const std::vector<BigVector> at = SpatialSumInternals::convex(sum)->numerators();
  BigInteger six = 0;
  for (const SpatialFace& f : sum.faces) {
    const std::vector<std::uint32_t>& loop = f.loops[0];
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) six += determinant(at[loop[0]], at[loop[i]], at[loop[i + 1]]);
  }
  const BigRational unit = unit_of(sum);
  return BigRational(six) * unit * unit * unit / 6;
}

LengthSum convex_surface(const SpatialSum& sum) {
  const std::vector<BigVector> at = SpatialSumInternals::convex(sum)->numerators();
  LengthSum surface;
  for (const SpatialFace& f : sum.faces) {
    const std::vector<std::uint32_t>& loop = f.loops[0];
    exact::Vector3<Big>& twice = surface.vectors.emplace_back();
    const auto from_first = [&](std::size_t i) { return big_vector(at[loop[i]]) - big_vector(at[loop[0]]); };
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) twice = twice + exact::cross(from_first(i), from_first(i + 1));
  }
  const BigRational unit = unit_of(sum);
  surface.unit = unit * unit / 2;
  return surface;
}

/// Bits of the volume's denominator beyond powers of two, before it is reduced.
std::size_t convex_volume_bits(const SpatialSum& sum) {
  const BigInteger below = denominator(unit_of(sum));
  return 3 * (msb(below) - lsb(below));
}

}  // namespace
}  // namespace dymsum::spatial

namespace dymsum {

// Volume and surface of a sum. Positions have denominators of their own, so the exact volume is a long fraction; its
// nearest double comes from positions cut off at a power of two, with a proved error, and from ever longer ones until
// both ends of the range round to one number. Convex sums have one denominator, and measures of their own.

namespace {

using exact::BigInteger;
using exact::BigRational;
using spatial::SpatialPositions;
using Integers = std::array<BigInteger, 3>;
using Loop = std::vector<std::uint32_t>;

template <class F>
void each_triangle(const Loop& loop, F f) {
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) f(loop[0], loop[k], loop[k + 1]);
}

/// value 2^power.
BigRational scaled(const BigInteger& value, int power) {
  return power >= 0 ? BigRational(BigInteger(value << power)) : BigRational(value, BigInteger(1) << -power);
}

/// A range that holds a measure; one number where both ends are equal.
using Range = std::pair<BigRational, BigRational>;

Range around(const BigInteger& value, const BigInteger& error, int power) {
  return {scaled(BigInteger(value - error), power), scaled(BigInteger(value + error), power)};
}

/// The positions of all vertices in multiples of 2^-shift, rounded down, from the first vertex on. Each coordinate is
/// less than 1 off.
class Multiples {
 public:
  Multiples(const SpatialSum& sum, std::array<int, 3> shift) : shift(shift) {
    const SpatialPositions& positions = spatial::SpatialSumInternals::positions(sum);
    for (std::size_t v = 0; v < sum.vertices.size(); ++v) {
      at.push_back(positions.multiples(v, shift, exact));
      for (int axis = 0; axis < 3; ++axis) {
        if (v > 0) at[v][axis] -= at[0][axis];
        if (const BigInteger size = abs(at[v][axis]); size > largest) largest = size;
      }
    }
    if (!at.empty()) at[0] = {0, 0, 0};
  }

  std::array<int, 3> shift;
  std::vector<Integers> at;
  BigInteger largest = 0;
  bool exact = true;  ///< nothing was cut off
};

/// The powers of two that are at least as large as the sum, as seen from its origin, along each axis.
std::array<int, 3> sizes(const SpatialSum& sum) {
  std::array<int, 3> size{-2000, -2000, -2000};
  const SpatialPositions& positions = spatial::SpatialSumInternals::positions(sum);
  for (std::size_t v = 0; v < sum.vertices.size(); ++v) positions.grow(v, size);
  return size;
}

BigInteger six_volume(const SpatialSum& sum, const std::vector<Integers>& at) {
  BigInteger six = 0;
  for (const SpatialFace& face : sum.faces) {
    for (const Loop& loop : face.loops) {
      each_triangle(loop, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        const Integers &a = at[i], &b = at[j], &c = at[k];
        six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
      });
    }
  }
  return six;
}

std::size_t triangle_count(const SpatialSum& sum) {
  std::size_t count = 0;
  for (const SpatialFace& face : sum.faces)
    for (const Loop& loop : face.loops) count += loop.size() - 2;
  return count;
}

/// The range of the volume. With coordinates X off by less than 1, each of the six products of a determinant is off by
/// less than 3 (max |X| + 1)^2.
Range volume_range(const SpatialSum& sum, const std::array<int, 3>& size, int bits) {
  const Multiples m(sum, {bits - size[0], bits - size[1], bits - size[2]});
  const BigInteger reach = m.largest + 1;
  const BigInteger error = m.exact ? BigInteger(0) : BigInteger(18 * triangle_count(sum) * reach * reach);
  Range six = around(six_volume(sum, m.at), error, -(m.shift[0] + m.shift[1] + m.shift[2]));
  return {six.first / 6, six.second / 6};
}

/// Six times the volume of some of the tetrahedra from the origin to the surface: numerator / product of the weights of
/// the vertices that they have, each once.
struct VolumeTerm {
  BigInteger numerator = 0;
  std::vector<std::uint32_t> vertices;  // sorted; those of weight 1 left out
};

class VolumeTree {
 public:
  VolumeTree(const SpatialSum& sum, std::vector<std::array<BigInteger, 4>> at) : at_(std::move(at)) {
    for (const SpatialFace& face : sum.faces)
      for (const Loop& loop : face.loops)
        each_triangle(loop, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
          triangles_.push_back({a, b, c});
        });
  }
  VolumeTerm total() const { return triangles_.empty() ? VolumeTerm{} : term(0, triangles_.size()); }
  BigInteger weight(std::uint32_t v) const { return at_[v][3]; }

 private:
  // Faces are sorted by their smallest vertices, vertices by x: halves have few vertices in common.
  VolumeTerm term(std::size_t first, std::size_t last) const {
    if (last - first == 1) return leaf(triangles_[first]);
    const VolumeTerm a = term(first, (first + last) / 2), b = term((first + last) / 2, last);
    VolumeTerm both;
    std::set_union(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(),
                   std::back_inserter(both.vertices));
    both.numerator = a.numerator * missing(b, a) + b.numerator * missing(a, b);
    return both;
  }
  /// The product of the weights that one share has and the other one has not.
  BigInteger missing(const VolumeTerm& has, const VolumeTerm& not_) const {
    std::vector<std::uint32_t> only;
    std::set_difference(has.vertices.begin(), has.vertices.end(), not_.vertices.begin(), not_.vertices.end(),
                        std::back_inserter(only));
    std::vector<BigInteger> weights;
    for (const std::uint32_t v : only) weights.push_back(weight(v));
    return exact::product_of(weights);
  }
  VolumeTerm leaf(const std::array<std::uint32_t, 3>& triangle) const {
    const auto &a = at_[triangle[0]], &b = at_[triangle[1]], &c = at_[triangle[2]];
    VolumeTerm term;
    term.numerator =
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    for (const std::uint32_t v : triangle)
      if (at_[v][3] != 1) term.vertices.push_back(v);
    std::sort(term.vertices.begin(), term.vertices.end());
    return term;
  }

  std::vector<std::array<BigInteger, 4>> at_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

/// Common divisors make weights long: positions in lowest terms.
std::array<BigInteger, 4> lowest(std::array<BigInteger, 4> p) {
  const BigInteger common = gcd(gcd(p[0], p[3]), gcd(p[1], p[2]));
  if (common > 1)
    for (BigInteger& c : p) c /= common;
  return p;
}

/// Brings all to units of one power of two, the largest in any weight, whose exponent is returned: what is left of the
/// weights is odd.
int leave_odd(std::vector<std::array<BigInteger, 4>>& at) {
  unsigned twos = 0;
  for (const auto& v : at) twos = std::max(twos, static_cast<unsigned>(lsb(v[3])));
  for (auto& v : at) {
    const auto own = static_cast<unsigned>(lsb(v[3]));
    v[3] >>= own;
    for (std::size_t axis = 0; axis < 3; ++axis) v[axis] <<= twos - own;
  }
  return static_cast<int>(twos);
}

std::optional<Rational> volume_fraction(const SpatialSum& sum, std::size_t bits) {
  if (sum.faces.empty()) return Rational();
  const SpatialPositions& positions = spatial::SpatialSumInternals::positions(sum);
  std::vector<std::array<BigInteger, 4>> at;
  std::size_t total = 0;
  for (std::size_t v = 0; v < sum.vertices.size(); ++v) {
    at.push_back(lowest(positions.homogeneous(v)));
    const BigInteger& w = at.back()[3];
    total += msb(w) == lsb(w) ? 0 : msb(w) - lsb(w) + 1;  // powers of two have a common one
    if (total > bits) return std::nullopt;
  }
  const std::array<int, 3> unit = positions.unit_exponents();
  const int power = unit[0] + unit[1] + unit[2] - 3 * leave_odd(at);
  const VolumeTree tree(sum, std::move(at));
  const VolumeTerm six = tree.total();
  if (six.numerator.is_zero()) return Rational();
  std::vector<BigInteger> factors{6};
  for (const std::uint32_t v : six.vertices) factors.push_back(tree.weight(v));
  BigInteger numerator = six.numerator;
  if (power >= 0) numerator <<= power;
  else factors.push_back(BigInteger(1) << -power);
  const BigInteger denominator = exact::product_of(factors), common = exact::gcd_with_product(factors, numerator);
  return exact::to_rational(BigInteger(numerator / common), BigInteger(denominator / common));
}

constexpr std::size_t kAnyLength = std::numeric_limits<std::size_t>::max();

/// Calls decide(range) for narrower and narrower ranges of the volume until it returns true.
void narrow_volume(const SpatialSum& sum, const std::function<bool(const Range&)>& decide) {
  if (sum.faces.empty()) {
    decide({0, 0});
    return;
  }
  const std::array<int, 3> size = sizes(sum);
  for (const int bits : {100, 512, 2048})
    if (decide(volume_range(sum, size, bits))) return;
  const BigRational exact = exact::exact_value(*volume_fraction(sum, kAnyLength));
  decide({exact, exact});
}

/// Twice the area of a face by its components, from positions in multiples: each fan triangle is less than 8 max |X| +
/// 2 off in each.
Integers twice_area(const SpatialFace& face, const std::vector<Integers>& at) {
  Integers n{0, 0, 0};
  for (const Loop& loop : face.loops) {
    each_triangle(loop, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
      Integers u, v;
      for (int axis = 0; axis < 3; ++axis) u[axis] = at[j][axis] - at[i][axis], v[axis] = at[k][axis] - at[i][axis];
      for (int axis = 0; axis < 3; ++axis) {
        const int s = (axis + 1) % 3, t = (axis + 2) % 3;
        n[axis] += u[s] * v[t] - u[t] * v[s];
      }
    });
  }
  return n;
}

/// The range of the area, and whether all faces have rational areas there, exactly.
Range area_range(const SpatialSum& sum, int size, int bits) {
  const Multiples m(sum, {bits - size, bits - size, bits - size});
  BigInteger total = 0;
  bool exact = m.exact;
  for (const SpatialFace& face : sum.faces) {
    const Integers n = twice_area(face, m.at);
    BigInteger rest;
    total += exact::floor_root(BigInteger(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), rest);
    exact = exact && rest.is_zero();
  }
  // The length of a vector is off by less than twice what its components are, the root by less than 1.
  const BigInteger error =
      exact ? BigInteger(0) : BigInteger(2 * triangle_count(sum) * (8 * m.largest + 2) + sum.faces.size());
  return around(total, error, -2 * (bits - size) - 1);
}

/// The area where those of all faces are rational.
std::optional<BigRational> rational_area(const SpatialSum& sum) {
  BigRational total;
  for (const SpatialFace& face : sum.faces) {
    BigRational n[3];
    for (const Loop& loop : face.loops) {
      each_triangle(loop, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        const spatial::SpatialPositions& positions = spatial::SpatialSumInternals::positions(sum);
        const auto a = positions.at(i), b = positions.at(j), c = positions.at(k);
        for (int axis = 0; axis < 3; ++axis) {
          const int s = (axis + 1) % 3, t = (axis + 2) % 3;
          n[axis] += (b[s] - a[s]) * (c[t] - a[t]) - (b[t] - a[t]) * (c[s] - a[s]);
        }
      });
    }
    const BigRational square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    BigInteger rest_n, rest_d;
    const BigInteger over = exact::floor_root(BigInteger(numerator(square)), rest_n),
                     under = exact::floor_root(BigInteger(denominator(square)), rest_d);
    if (!rest_n.is_zero() || !rest_d.is_zero()) return std::nullopt;
    total += BigRational(over, under);
  }
  return total / 2;
}

/// Narrows as narrow_volume does. The loop ends: positive roots of rationals with a rational sum are rational, and any
/// other number has a distance from every position where its rounding changes.
void narrow_area(const SpatialSum& sum, const std::function<bool(const Range&)>& decide) {
  if (sum.faces.empty()) {
    decide({0, 0});
    return;
  }
  const std::array<int, 3> sizes_of = sizes(sum);
  const int size = *std::max_element(sizes_of.begin(), sizes_of.end());
  for (int bits = 100;; bits *= 4) {
    if (decide(area_range(sum, size, bits))) return;
    if (bits != 1600) continue;
    if (const std::optional<BigRational> exact = rational_area(sum)) {
      decide({*exact, *exact});
      return;
    }
  }
}

using Narrow = void(const SpatialSum&, const std::function<bool(const Range&)>&);

double nearest(const SpatialSum& sum, Narrow narrow) {
  double value = 0;
  narrow(sum, [&](const Range& range) {
    value = exact::round_to_double(range.first);
    return exact::round_to_double(range.second) == value;
  });
  return value;
}

std::string text(const SpatialSum& sum, Narrow narrow) {
  std::string digits;
  narrow(sum, [&](const Range& range) {
    digits = exact::decimal_text(range.first, 17);
    return exact::decimal_text(range.second, 17) == digits;
  });
  return digits;
}

}  // namespace

double SpatialSum::volume() const {
  return is_convex() ? exact::round_to_double(spatial::convex_volume(*this)) : nearest(*this, narrow_volume);
}

double SpatialSum::area() const {
  return is_convex() ? spatial::convex_surface(*this).nearest() : nearest(*this, narrow_area);
}

Rational SpatialSum::volume_exact() const { return *volume_exact_within(kAnyLength); }

std::optional<Rational> SpatialSum::volume_exact_within(std::size_t bits) const {
  if (!is_convex()) return volume_fraction(*this, bits);
  if (spatial::convex_volume_bits(*this) > bits) return std::nullopt;
  return exact::to_rational(spatial::convex_volume(*this));
}

std::string volume_text(const SpatialSum& sum) {
  return sum.is_convex() ? exact::decimal_text(spatial::convex_volume(sum), 17) : text(sum, narrow_volume);
}

std::string surface_text(const SpatialSum& sum) {
  return sum.is_convex() ? spatial::convex_surface(sum).text() : text(sum, narrow_area);
}

}  // namespace dymsum
