// Coordinates of generated shapes and solids, rounded on request.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

namespace dymsum::shapes {

/// x -> the multiple of `step` nearest to x, ties up; x itself where `step` is 0. Throws std::invalid_argument, with
/// the shape's name, for a step that is neither 0 nor a power of two from 2^-1000 to 2^1000.
class Snap {
 public:
  Snap(std::string_view shape, double step) : step_(step) {
    int exponent = 0;
    const bool power = step >= 0x1p-1000 && step <= 0x1p1000 && std::frexp(step, &exponent) == 0.5;
    if (step != 0 && !power) throw std::invalid_argument(std::string(shape) + ": snap is 0 or a power of two");
  }
  double operator()(double x) const { return step_ == 0 ? x : std::floor(x / step_ + 0.5) * step_; }

 private:
  double step_;
};

}  // namespace dymsum::shapes
