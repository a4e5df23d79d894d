// Signs of the vertices of one operand, by their indices: of doubles, or of fractions where no doubles hold the
// vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/mesh.h"
#include "exact/big.h"
#include "exact/fraction.h"
#include "exact/int.h"
#include "exact/orient.h"

namespace dymsum::spatial {

using ExactVertex = exact::Vector3<exact::Fraction>;

class OperandSigns {
 public:
  virtual ~OperandSigns() = default;
  /// The sign that exact::orient3_sign has.
  virtual int orient(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const = 0;
  /// The sign that exact::normal_sign has.
  virtual int normal(std::uint32_t a, std::uint32_t b, std::uint32_t c, exact::Axis axis) const = 0;
  /// The sign of b's coordinate less a's.
  virtual int order(std::uint32_t a, std::uint32_t b, exact::Axis axis) const = 0;

  /// a, b, c lie on one line; equal vertices do.
  bool collinear(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return normal(a, b, c, exact::Axis::z) == 0 && normal(a, b, c, exact::Axis::x) == 0 &&
           normal(a, b, c, exact::Axis::y) == 0;
  }
};

/// Keeps the reference.
class SignsOfDoubles final : public OperandSigns {
 public:
  explicit SignsOfDoubles(const std::vector<Point3>& vertices) : at_(vertices) {}
  int orient(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const override {
    return exact::orient3_sign(at_[a], at_[b], at_[c], at_[d]);
  }
  int normal(std::uint32_t a, std::uint32_t b, std::uint32_t c, exact::Axis axis) const override {
    return exact::normal_sign(at_[a], at_[b], at_[c], axis);
  }
  int order(std::uint32_t a, std::uint32_t b, exact::Axis axis) const override;

 private:
  const std::vector<Point3>& at_;
};

/// Keeps the reference.
class SignsOfFractions final : public OperandSigns {
 public:
  explicit SignsOfFractions(const std::vector<ExactVertex>& vertices) : at_(vertices) {}
  int orient(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const override;
  int normal(std::uint32_t a, std::uint32_t b, std::uint32_t c, exact::Axis axis) const override;
  int order(std::uint32_t a, std::uint32_t b, exact::Axis axis) const override;

 private:
  /// Up to a positive factor.
  ExactVertex direction(std::uint32_t a, std::uint32_t b) const { return exact::integral(at_[b] - at_[a]); }

  const std::vector<ExactVertex>& at_;
};

}  // namespace dymsum::spatial
