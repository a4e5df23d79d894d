// Sums of doubles whose error does not grow with their number.
#pragma once

namespace dymsum::spatial {

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

}  // namespace dymsum::spatial
