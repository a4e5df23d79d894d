// Two solids one of which scales: where vertices are at a scale, exactly and in doubles, and planes, which keep their
// normals, so that all that they do is linear in s.
#pragma once

#include <array>
#include <vector>

#include "exact/big.h"
#include "spatial/convex/exact_positions.h"
#include "spatial/motion/posed_pair.h"

namespace dymsum::spatial {

/// The moving plane n . x = d0 + s d1, in units of the operands' grid; a hyperplane of (x, s).
struct MovingPlane {
  BigVector n;
  exact::BigInteger d0, d1;
};
/// The same hyperplane in doubles, each within 2^-53 of its size, over one power of two: n, -d1, d0.
using PlaneRow = std::array<double, 5>;
PlaneRow row_of(const MovingPlane& plane);
inline Vec3 normal_of(const PlaneRow& row) { return {row[0], row[1], row[2]}; }

BigVector minus(const BigVector& a, const BigVector& b);
BigVector cross(const BigVector& a, const BigVector& b);
exact::BigInteger dot(const BigVector& a, const BigVector& b);
bool is_zero(const BigVector& v);

class ScalingPair {
 public:
  /// P (`moving` 0) or Q (1) scales.
  ScalingPair(SolidPair pair, int moving);

  const SolidPair& pair() const { return pair_; }
  int moving() const { return moving_; }
  const SolidOperand& operand(int op) const { return op == 0 ? pair_.p : pair_.q; }

  /// A sum is fixed(c) + s moved(c), in doubles each within 2^-53 of its size.
  Vec3 fixed(SumPoint c) const { return moving_ == 0 ? positions_[1][c.q] : positions_[0][c.p]; }
  Vec3 moved(SumPoint c) const { return moving_ == 0 ? positions_[0][c.p] : positions_[1][c.q]; }
  Vec3 at(SumPoint c, double s) const { return fixed(c) + s * moved(c); }
  const BigVector& exact_fixed(SumPoint c) const { return moving_ == 0 ? exact_[1][c.q] : exact_[0][c.p]; }
  const BigVector& exact_moved(SumPoint c) const { return moving_ == 0 ? exact_[0][c.p] : exact_[1][c.q]; }
  const std::vector<Vec3>& positions(int op) const { return positions_[static_cast<std::size_t>(op)]; }
  const std::vector<BigVector>& exact_positions(int op) const { return exact_[static_cast<std::size_t>(op)]; }
  /// A bound that is at least the largest coordinate of an operand.
  double reach(int op) const { return reach_[static_cast<std::size_t>(op)]; }
  /// A bound that is at least the largest coordinate of any sum at scales up to s.
  double span(double s) const { return reach_[1 - moving_] + s * reach_[moving_]; }

  /// The vector from one vertex of an operand to another.
  BigVector along(const DirectionSource& direction) const;
  MovingPlane plane(const PlaneSource& source) const;
  /// The pose of either operand at a scale.
  PosePair poses(const Scale& s) const;

 private:
  SolidPair pair_;
  int moving_;
  std::array<std::vector<BigVector>, 2> exact_;
  std::array<std::vector<Vec3>, 2> positions_;
  std::array<double, 2> reach_{};
};

}  // namespace dymsum::spatial
