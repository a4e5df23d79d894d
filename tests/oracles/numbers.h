// Exact numbers for the slow answers: Small, a fraction of 64-bit integers that throws Overflow instead of being wrong,
// and Big, an unbounded one. Every oracle is written once for either; callers try Small first.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>

namespace dymsum::oracles {

__extension__ typedef __int128 Wide;

using BigInt = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;
using Big =
    boost::multiprecision::number<boost::multiprecision::rational_adaptor<boost::multiprecision::cpp_int_backend<>>,
                                  boost::multiprecision::et_off>;

/// Thrown when a Small value would not fit; the caller repeats its work with Big.
struct Overflow {};

/// num / den in lowest terms, den > 0, both below 2^62 in size.
class Small {
 public:
  Small() = default;
  Small(std::int64_t value) : num_(value) { check(value); }
  Small(Wide num, Wide den) {
    if (den < 0) {
      num = -num;
      den = -den;
    }
    if (den != 1) {
      const Wide divisor = gcd(num < 0 ? -num : num, den);
      num /= divisor;
      den /= divisor;
    }
    check(num);
    check(den);
    num_ = static_cast<std::int64_t>(num);
    den_ = static_cast<std::int64_t>(den);
  }

  std::int64_t num() const { return num_; }
  std::int64_t den() const { return den_; }

  friend Small operator+(const Small& a, const Small& b) {
    if (a.den_ == b.den_) return {Wide{a.num_} + b.num_, Wide{a.den_}};
    return {Wide{a.num_} * b.den_ + Wide{b.num_} * a.den_, Wide{a.den_} * b.den_};
  }
  friend Small operator-(const Small& a, const Small& b) { return a + -b; }
  friend Small operator*(const Small& a, const Small& b) { return {Wide{a.num_} * b.num_, Wide{a.den_} * b.den_}; }
  friend Small operator/(const Small& a, const Small& b) { return {Wide{a.num_} * b.den_, Wide{a.den_} * b.num_}; }
  Small operator-() const { return {-Wide{num_}, Wide{den_}}; }

  friend bool operator==(const Small& a, const Small& b) { return a.num_ == b.num_ && a.den_ == b.den_; }
  friend bool operator!=(const Small& a, const Small& b) { return !(a == b); }
  friend bool operator<(const Small& a, const Small& b) { return Wide{a.num_} * b.den_ < Wide{b.num_} * a.den_; }
  friend bool operator>(const Small& a, const Small& b) { return b < a; }
  friend bool operator<=(const Small& a, const Small& b) { return !(b < a); }
  friend bool operator>=(const Small& a, const Small& b) { return !(a < b); }

 private:
  static void check(Wide value) {
    constexpr Wide kLimit = Wide{1} << 62;
    if (value >= kLimit || value <= -kLimit) throw Overflow{};
  }
  static Wide gcd(Wide a, Wide b) {
    constexpr Wide kWord = Wide{1} << 62;
    while (b != 0) {
      if (a < kWord && b < kWord) return std::gcd(static_cast<std::int64_t>(a), static_cast<std::int64_t>(b));
      a %= b;
      std::swap(a, b);
    }
    return a;
  }
  std::int64_t num_ = 0, den_ = 1;
};

/// Numerator and denominator as BigInt, whatever the number.
inline BigInt numerator_of(const Small& a) { return a.num(); }
inline BigInt denominator_of(const Small& a) { return a.den(); }
inline BigInt numerator_of(const Big& a) { return boost::multiprecision::numerator(a); }
inline BigInt denominator_of(const Big& a) { return boost::multiprecision::denominator(a); }

inline Big to_big(const Big& a) { return a; }
inline Big to_big(const Small& a) { return Big(BigInt(a.num()), BigInt(a.den())); }

/// The exact value of a finite double.
template <class N>
N from_double(double value);

template <>
inline Small from_double<Small>(double value) {
  int shift = 0;
  while (value != std::nearbyint(value)) {
    value *= 2;
    if (++shift > 60) throw Overflow{};
  }
  if (std::fabs(value) >= 0x1p61) throw Overflow{};
  return {Wide{static_cast<std::int64_t>(value)}, Wide{1} << shift};
}

template <>
inline Big from_double<Big>(double value) {
  int exponent = 0;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
  exponent -= 53;
  BigInt power = 1;
  power <<= static_cast<unsigned>(std::abs(exponent));
  return exponent < 0 ? Big(BigInt(mantissa), power) : Big(BigInt(mantissa) * power);
}

/// The value of decimal digits num over den.
template <class N>
N from_digits(const std::string& num, const std::string& den);

template <>
inline Small from_digits<Small>(const std::string& num, const std::string& den) {
  if (num.size() > 18 || den.size() > 18) throw Overflow{};
  return {Wide{std::stoll(num)}, Wide{std::stoll(den)}};
}

template <>
inline Big from_digits<Big>(const std::string& num, const std::string& den) {
  return Big(BigInt(num), BigInt(den));
}

template <class N>
struct Pt {
  N x, y;
  friend bool operator==(const Pt& a, const Pt& b) { return a.x == b.x && a.y == b.y; }
  friend bool operator!=(const Pt& a, const Pt& b) { return !(a == b); }
  friend bool operator<(const Pt& a, const Pt& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }
  friend Pt operator+(const Pt& a, const Pt& b) { return {a.x + b.x, a.y + b.y}; }
  friend Pt operator-(const Pt& a, const Pt& b) { return {a.x - b.x, a.y - b.y}; }
};

template <class N>
struct Seg {
  Pt<N> a, b;
  friend bool operator==(const Seg& s, const Seg& t) { return s.a == t.a && s.b == t.b; }
  friend bool operator<(const Seg& s, const Seg& t) { return s.a != t.a ? s.a < t.a : s.b < t.b; }
};

template <class N>
N cross(const Pt<N>& u, const Pt<N>& v) {
  return u.x * v.y - u.y * v.x;
}

/// The sign of the turn a, b, c: +1 left, -1 right, 0 straight.
template <class N>
int turn(const Pt<N>& a, const Pt<N>& b, const Pt<N>& c) {
  const N value = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  const N zero(0);
  return value > zero ? 1 : (value < zero ? -1 : 0);
}

/// c lies on the closed segment.
template <class N>
bool on_segment(const Seg<N>& s, const Pt<N>& c) {
  if ((c.x < s.a.x && c.x < s.b.x) || (c.x > s.a.x && c.x > s.b.x)) return false;
  if ((c.y < s.a.y && c.y < s.b.y) || (c.y > s.a.y && c.y > s.b.y)) return false;
  return turn(s.a, s.b, c) == 0;
}

}  // namespace dymsum::oracles
