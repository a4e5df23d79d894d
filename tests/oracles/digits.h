// Numbers of fifty digits with the functions of angles: what doubles are compared with where the truth is not rational.
// Compiled once: the templates behind them take seconds in every file that includes them.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <memory>

namespace dymsum::oracles {

/// Within 2^-160 of a result, relatively, but for what cancels. A value.
class Digits {
 public:
  Digits(double v = 0);  // NOLINT(google-explicit-constructor)
  explicit Digits(const boost::multiprecision::cpp_rational& v);
  static Digits pi();
  explicit operator double() const;

  friend Digits operator+(const Digits& a, const Digits& b);
  friend Digits operator-(const Digits& a, const Digits& b);
  friend Digits operator*(const Digits& a, const Digits& b);
  friend Digits operator/(const Digits& a, const Digits& b);
  friend Digits operator-(const Digits& a) { return 0 - a; }
  Digits& operator-=(const Digits& b) { return *this = *this - b; }
  friend bool operator<(const Digits& a, const Digits& b);
  friend bool operator>(const Digits& a, const Digits& b) { return b < a; }
  friend bool operator<=(const Digits& a, const Digits& b) { return !(b < a); }
  friend bool operator>=(const Digits& a, const Digits& b) { return !(a < b); }

  friend Digits abs(const Digits& a) { return a < 0 ? -a : a; }
  friend Digits round(const Digits& a);
  friend Digits sqrt(const Digits& a);
  friend Digits sin(const Digits& a);
  friend Digits cos(const Digits& a);
  friend Digits tan(const Digits& a);
  friend Digits atan(const Digits& a);
  friend Digits atan2(const Digits& y, const Digits& x);

 private:
  struct Number;
  explicit Digits(Number v);
  std::shared_ptr<const Number> value_;
};

}  // namespace dymsum::oracles
