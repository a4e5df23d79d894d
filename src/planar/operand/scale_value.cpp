#include "planar/operand/scale_value.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>

#include "base/double_text.h"
#include "exact/big.h"

namespace dymsum {
namespace {

using exact::BigInteger;
using exact::BigRational;

constexpr unsigned kMaxBits = exact::kMaxTextBits;

Error bad(std::string message) { return {ErrorCode::bad_scale, std::move(message), {}}; }

/// The fewest digits that say this double.
std::string shortest_text(double value) {
  char text[32];
  return std::string(text, base::shortest_text(text, text + sizeof text, value));
}

Result<BigRational> within_limits(BigRational v, const std::string& what, const std::string& text) {
  const BigInteger limit = BigInteger(1) << 64;
  if (v > BigRational(limit) || v < BigRational(BigInteger(1), limit))
    return bad("a " + what + " has to lie between 2^-64 and 2^64: " + text);
  if (msb(numerator(v)) >= kMaxBits || msb(denominator(v)) >= kMaxBits)
    return bad("numerator and denominator of a " + what + " may have at most 4096 bits");
  return v;
}

Result<BigRational> checked(BigRational v, const std::string& text) {
  if (v.sign() == 0) return bad("a scale of zero leaves no shape");
  if (v.sign() < 0) return bad("a scale has to be positive; reflect the operand first: " + text);
  return within_limits(std::move(v), "scale", text);
}

Result<BigRational> checked_step(BigRational v, const std::string& text) {
  if (v.sign() == 0) return bad("a step of zero leads nowhere");
  if (v.sign() < 0) return bad("a step has to be positive; the ends say which way it leads: " + text);
  return within_limits(std::move(v), "step", text);
}

}  // namespace

Result<Scale> Scale::of(double value) {
  if (!std::isfinite(value))
    return Error{ErrorCode::not_finite, "a scale must be finite, not " + base::general_text(value, 6), {}};
  constexpr double kLimit = 0x1p64;  // of within_limits
  if (!(value >= 1 / kLimit && value <= kLimit))
    return checked(exact::exact_value(value), shortest_text(value)).error();
  Scale s;
  if (value * 0x1p30 == std::floor(value * 0x1p30) && value < 0x1p30) {
    // A small dyadic fraction, as sweeps use them: lowest terms by hand.
    auto num = static_cast<std::uint64_t>(value * 0x1p30), den = std::uint64_t{1} << 30;
    const int common = std::min(std::countr_zero(num), 30);
    s.value_ = exact::to_rational(BigInteger(num >> common), BigInteger(den >> common));
  } else {
    s.value_ = exact::to_rational(exact::exact_value(value));
  }
  s.approx_ = value;
  return s;
}

Result<Scale> Scale::of(const Rational& value) {
  const Result<BigRational> v = checked(exact::exact_value(value), value.to_string().substr(0, 60));
  if (!v) return v.error();
  Scale s;
  s.value_ = exact::to_rational(*v);
  s.approx_ = exact::round_to_double(*v);
  return s;
}

Result<Scale> Scale::parse(std::string_view text) {
  const Result<BigRational> number = exact::number_in(text, "scale", ErrorCode::bad_scale);
  if (!number) return number.error();
  const Result<BigRational> v = checked(*number, std::string(text.substr(0, 60)));
  if (!v) return v.error();
  return of(exact::to_rational(*v));
}

Result<Scale> parse_scale_step(std::string_view text) {
  const Result<BigRational> number = exact::number_in(text, "step", ErrorCode::bad_scale);
  if (!number) return number.error();
  const Result<BigRational> v = checked_step(*number, std::string(text.substr(0, 60)));
  if (!v) return v.error();
  return Scale::of(exact::to_rational(*v));
}

Result<std::vector<Scale>> scale_steps(const Scale& from, const Scale& to, const Scale& step, StepKind kind,
                                       std::size_t most) {
  const BigRational first = exact::exact_value(from.exact()), last = exact::exact_value(to.exact()),
                    by = exact::exact_value(step.exact());
  const bool up = last >= first;
  const BigInteger grid = BigInteger(1) << 40;
  // No step is longer than that: what is too many is reported before they are made.
  const BigRational longest =
      kind == StepKind::percent ? BigRational(std::max(first, last) * by / 100 + BigRational(1, grid)) : by;
  if (abs(BigRational(last - first)) >= longest * most) return bad("more than " + std::to_string(most) + " steps");
  std::vector<Scale> scales;
  for (BigRational s = first; up ? s <= last : s >= last;) {
    if (scales.size() == most) return bad("more than " + std::to_string(most) + " steps");
    Result<Scale> next = Scale::of(exact::to_rational(s));
    if (!next) return next.error();
    scales.push_back(std::move(next).value());
    BigRational then;
    if (kind == StepKind::percent) {
      const BigRational ratio = 1 + by / 100, wanted = up ? BigRational(s * ratio) : BigRational(s / ratio);
      then = BigRational(BigInteger(numerator(wanted) * grid / denominator(wanted)), grid);
    } else {
      then = up ? BigRational(s + by) : BigRational(s - by);
      if (then.sign() <= 0) break;  // beyond the end
    }
    if (then == s || then.sign() <= 0) return bad("a step leads nowhere: it is less than 2^-40");
    s = then;
  }
  if (!(scales.back() == to)) scales.push_back(to);
  return scales;
}

namespace planar {

ScaleValue scale_value(const Scale& scale) {
  return {exact::numerator_of(scale.exact()), exact::denominator_of(scale.exact()), scale.approx()};
}

ScaleValue scale_value(const BigRational& value) {
  return {numerator(value), denominator(value), exact::round_to_double(value)};
}

exact::BigRational simple_between(const BigRational& a, const BigRational& b) {
  // The first power of two 2^k that fits twice between them has a multiple strictly inside; smaller k are tried first.
  const BigRational width = b - a;
  const double w = exact::round_to_double(width);
  constexpr double kLeast = 0x1p-1000;  // below, all k are tried
  int k = w > kLeast ? static_cast<int>(std::floor(-std::log2(w))) - 1 : 0;
  for (;; ++k) {
    const BigInteger one = BigInteger(1) << static_cast<unsigned>(std::abs(k));
    const BigRational scaled = k >= 0 ? BigRational(a * one) : BigRational(a / one);
    BigInteger floor = numerator(scaled) / denominator(scaled);
    if (scaled.sign() < 0 && floor * denominator(scaled) != numerator(scaled)) floor -= 1;
    const BigRational candidate =
        k >= 0 ? BigRational(BigInteger(floor + 1), one) : BigRational(BigInteger((floor + 1) * one));
    if (candidate > a && candidate < b) return candidate;
  }
}

}  // namespace planar
}  // namespace dymsum
