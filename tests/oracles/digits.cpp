#include "oracles/digits.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace dymsum::oracles {

struct Digits::Number {
  boost::multiprecision::cpp_bin_float_50 v;
};

Digits::Digits(Number v) : value_(std::make_shared<const Number>(std::move(v))) {}
Digits::Digits(double v) : Digits(Number{v}) {}
Digits::Digits(const boost::multiprecision::cpp_rational& v)
    : Digits(Number{boost::multiprecision::cpp_bin_float_50(v)}) {}
Digits Digits::pi() { return Digits(Number{boost::math::constants::pi<boost::multiprecision::cpp_bin_float_50>()}); }
Digits::operator double() const { return static_cast<double>(value_->v); }

Digits operator+(const Digits& a, const Digits& b) { return Digits(Digits::Number{a.value_->v + b.value_->v}); }
Digits operator-(const Digits& a, const Digits& b) { return Digits(Digits::Number{a.value_->v - b.value_->v}); }
Digits operator*(const Digits& a, const Digits& b) { return Digits(Digits::Number{a.value_->v * b.value_->v}); }
Digits operator/(const Digits& a, const Digits& b) { return Digits(Digits::Number{a.value_->v / b.value_->v}); }
bool operator<(const Digits& a, const Digits& b) { return a.value_->v < b.value_->v; }

Digits round(const Digits& a) { return Digits(Digits::Number{round(a.value_->v)}); }
Digits sqrt(const Digits& a) { return Digits(Digits::Number{sqrt(a.value_->v)}); }
Digits sin(const Digits& a) { return Digits(Digits::Number{sin(a.value_->v)}); }
Digits cos(const Digits& a) { return Digits(Digits::Number{cos(a.value_->v)}); }
Digits tan(const Digits& a) { return Digits(Digits::Number{tan(a.value_->v)}); }
Digits atan(const Digits& a) { return Digits(Digits::Number{atan(a.value_->v)}); }
Digits atan2(const Digits& y, const Digits& x) { return Digits(Digits::Number{atan2(y.value_->v, x.value_->v)}); }

}  // namespace dymsum::oracles
