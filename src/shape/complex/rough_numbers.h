// Numbers for a Voronoi diagram that only has to be close: where Boost.Polygon would take integers of 2048 bits, pairs
// of doubles, and doubles for its roots of them. What comes out wrong is a wrong guess.
#pragma once

#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <cstdint>

#include "base/doubles.h"

namespace dymsum::shape::rough {

/// Coordinates have so many bits that nothing overflows: Boost.Polygon multiplies some forty of them.
inline constexpr int kBits = 22;

/// What stands for a large integer: a pair of doubles, and how far it may be from the integer. A sum of no more than
/// that is taken for 0, as it is wherever discs of symmetric shapes touch four sites.
class Integer {
 public:
  Integer() = default;
  Integer(std::int64_t n)  // NOLINT(google-explicit-constructor)
      : v_(base::exact_sum(static_cast<double>(n),
                           static_cast<double>(n - static_cast<std::int64_t>(static_cast<double>(n))))) {}
  double d() const { return v_.high; }

  friend Integer operator-(const Integer& a) { return {-a.v_, a.error_}; }
  friend Integer operator+(const Integer& a, const Integer& b) {
    const Integer sum(a.v_ + b.v_, a.error_ + b.error_);
    return std::abs(sum.v_.high) <= sum.error_ ? Integer() : sum;
  }
  friend Integer operator-(const Integer& a, const Integer& b) { return a + -b; }
  friend Integer operator*(const Integer& a, const Integer& b) {
    return {a.v_ * b.v_, std::abs(a.v_.high) * b.error_ + std::abs(b.v_.high) * a.error_};
  }

 private:
  /// Integers of 100 bits are sums and products without an error.
  Integer(base::DoublePair v, double error) : v_(v), error_(error) {
    if (!(std::abs(v.high) < 0x1p100)) error_ += std::abs(v.high) * (2 * base::kPairError);
  }
  base::DoublePair v_;
  double error_ = 0;
};
inline bool is_pos(const Integer& a) { return a.d() > 0; }
inline bool is_neg(const Integer& a) { return a.d() < 0; }
inline bool is_zero(const Integer& a) { return a.d() == 0; }

/// What stands for a double with a large exponent.
struct Real {
  double v = 0;
  Real() = default;
  Real(double a) : v(a) {}  // NOLINT(google-explicit-constructor)
  double d() const { return v; }
  friend Real operator-(const Real& a) { return {-a.v}; }
  friend Real operator+(const Real& a, const Real& b) { return {a.v + b.v}; }
  friend Real operator-(const Real& a, const Real& b) { return {a.v - b.v}; }
  friend Real operator*(const Real& a, const Real& b) { return {a.v * b.v}; }
  friend Real operator/(const Real& a, const Real& b) { return {a.v / b.v}; }
};
inline bool is_pos(const Real& a) { return a.v > 0; }
inline bool is_neg(const Real& a) { return a.v < 0; }
inline bool is_zero(const Real& a) { return a.v == 0; }
inline Real get_sqrt(const Real& a) { return {std::sqrt(a.v)}; }

struct ToReal {
  Real operator()(const Integer& a) const { return {a.d()}; }
};
struct ToDouble {
  template <class T>
  double operator()(const T& a) const {
    return static_cast<double>(a);
  }
  double operator()(const Integer& a) const { return a.d(); }
  double operator()(const Real& a) const { return a.v; }
};

struct Traits {
  using int_type = std::int32_t;
  using int_x2_type = std::int64_t;
  using uint_x2_type = std::uint64_t;
  using big_int_type = Integer;
  using fpt_type = double;
  using efpt_type = Real;
  using ulp_cmp_type = boost::polygon::detail::ulp_comparison<double>;
  using to_fpt_converter_type = ToDouble;
  using to_efpt_converter_type = ToReal;
};

using Builder = boost::polygon::voronoi_builder<std::int32_t, Traits>;

}  // namespace dymsum::shape::rough
