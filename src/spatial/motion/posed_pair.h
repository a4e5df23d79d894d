// Two solids at exact poses, or one of which scales: what they are made of once and for all, and the space of their
// sum.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/rotation.h"
#include "dymsum/scale.h"
#include "exact/big.h"
#include "spatial/convex/exact_positions.h"
#include "spatial/convolution/solid_operand.h"
#include "spatial/convolution/sum_space.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

// Scales that are computed, where only those within the range of Scale can be gone to.

/// Thrown where an answer takes a sum at a scale that is none of Scale.
struct BeyondScales {
  Error error;
};

/// Throws BeyondScales.
inline Scale computed_scale(const exact::BigRational& s) {
  Result<Scale> scale = Scale::of(exact::to_rational(s));
  if (!scale) throw BeyondScales{scale.error()};
  return *std::move(scale);
}

/// Calls make(), which returns a Result, and reports what it throws as its error.
template <class F>
auto within_scales(F make) -> decltype(make()) {
  try {
    return make();
  } catch (const BeyondScales& beyond) {
    return beyond.error;
  }
}

/// Triangles, wedges and cones stay what they are under rotations and positive scales: only positions move.
struct SolidPair {
  SolidOperand p, q;
  GridPositions p_positions, q_positions;  ///< in one unit
};
SolidPair solid_pair(const Mesh& p, const Mesh& q);

/// A pose of either operand.
struct PosePair {
  SolidPose p, q;
  friend bool operator==(const PosePair&, const PosePair&) = default;
};

/// The space of the sum at a pair of poses; positions are its own divided by `scale`.
struct PosedSpace {
  std::unique_ptr<SumSpace> space;
  exact::BigInteger scale = 1;
};
/// A height along an axis (0, 1 or 2), in the operands' own units.
struct AxisLevel {
  int axis = 0;
  double at = 0;
};
/// Behind P's vertices the space has a place for every level, whose sum with Q's first vertex lies at that height.
/// Throws std::invalid_argument where coordinates need more than 8,192 bits.
PosedSpace posed_space(const SolidPair& pair, const PosePair& poses, std::span<const AxisLevel> levels = {});
/// The same at any rational linear maps.
PosedSpace posed_space(const SolidPair& pair, ExactPose p, ExactPose q, std::span<const AxisLevel> levels = {});

/// The space at a pair of poses, made when it is first requested: most signs of a motion need none.
class SpaceOnDemand {
 public:
  SpaceOnDemand(const SolidPair& pair, const PosePair& poses) : pair_(pair), poses_(poses) {}
  const SumSpace& operator()() {
    if (!made_) made_ = posed_space(pair_, poses_);
    return *made_->space;
  }
  PosedSpace take() {
    (*this)();
    return *std::exchange(made_, std::nullopt);
  }

 private:
  const SolidPair& pair_;
  const PosePair& poses_;
  std::optional<PosedSpace> made_;
};

// Two solids one of which scales: where vertices are at a scale, exactly and in doubles, and planes, which keep their
// normals, so that all that they do is linear in s.

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

// How far poses are apart, as directions see it, and the map between two operands' frames in doubles.

/// The factors of a scale in doubles, each within 2^-53 of its size.
Vec3 scale_factors(const SolidPose& pose);

/// A bound that is at least the angle by which a scaling from one to the other turns a direction or a normal.
double angle_of_scaling(const Vec3& from, const Vec3& to);

/// Unit quaternions (w, x, y, z), each component within 2^-49.
struct UnitQuaternion {
  double w = 1;
  Vec3 v;
};
/// The quaternion of the rotation from Q's frame to P's.
UnitQuaternion relative_rotation(const Rotation& p, const Rotation& q);
/// Entries within 2^-46.
Mat3 matrix_of(const UnitQuaternion& q);
/// A bound that is at least the angle of the rotation from one to the other.
double angle_between(const UnitQuaternion& a, const UnitQuaternion& b);

}  // namespace dymsum::spatial
