// Sums of fewer than 2^32 exact terms, in integers that are wide enough.
#pragma once

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

}  // namespace dymsum::spatial
