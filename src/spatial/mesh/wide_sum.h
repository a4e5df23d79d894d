// Sums of many terms: of exact ones in integers that are wide enough, of doubles with what each step lost, of
// lengths.
#pragma once

#include <string>
#include <vector>

#include "exact/big.h"
#include "exact/int.h"

namespace dymsum::spatial {

template <class Term>
class WideSum;

template <>
class WideSum<exact::Big> {
 public:
  using Value = exact::Big;
  void add(const exact::Big& term) { value_ = value_ + term; }
  const Value& value() const { return value_; }

 private:
  Value value_ = exact::Big::from_int64(0);
};

template <int B>
class WideSum<exact::Int<B>> {
 public:
  using Value = exact::Int<B + 32>;
  void add(const exact::Int<B>& term) { value_ = Value::from_raw(exact::raw_cast<B + 32>((value_ + term).raw())); }
  const Value& value() const { return value_; }

 private:
  Value value_ = Value::from_int64(0);
};

// Sums of doubles whose error does not grow with their number.

/// Kahan's compensated sum: the error is below 2^-51 of the sum of the magnitudes, for fewer than 2^40 numbers.
class CompensatedSum {
 public:
  void add(double x) {
    const double y = x - lost_, t = sum_ + y;
    lost_ = (t - sum_) - y;
    sum_ = t;
  }
  double value() const { return sum_; }

 private:
  double sum_ = 0, lost_ = 0;
};

// Sums of lengths of exact vectors, rounded once: areas of surfaces.

/// The sum of the lengths of some vectors, times a positive unit.
struct LengthSum {
  std::vector<exact::Vector3<exact::Big>> vectors;
  exact::BigRational unit = 1;

  /// The nearest double. Doubles of double length nearly always decide; where they do not, whole roots of ever more
  /// digits do. That ends: positive roots of rationals have a rational sum only where each of them is rational, which
  /// whole roots show, and any other number has a distance from every position where its rounding changes.
  double nearest() const;
  /// 17 digits, correctly rounded.
  std::string text() const;
};

}  // namespace dymsum::spatial
