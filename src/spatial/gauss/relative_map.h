// How two solids stand to each other: the linear map from Q's own coordinates to P's, up to a positive factor, and its
// inverse.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dymsum/rotation.h"
#include "exact/big.h"
#include "exact/vector3.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

/// The exact factors of a pose, parsed once.
struct PoseFactors {
  Rotation rotation;
  std::array<exact::BigInteger, 3> num{1, 1, 1}, den{1, 1, 1};
  bool scaled = false;  ///< some factor is not 1

  static PoseFactors of(const SolidPose& pose);
};

/// Index 0: from Q to P, which faces of P meet edges of Q by. Index 1: from P to Q, for faces of Q and edges of P.
class RelativeMap {
 public:
  RelativeMap() : RelativeMap(PoseFactors{}, PoseFactors{}) {}
  RelativeMap(const PoseFactors& p, const PoseFactors& q);
  /// P rotated by a quaternion (w, x, y, z) of integers of any size, Q where it is.
  static RelativeMap turned(const std::array<exact::BigInteger, 4>& quaternion);

  /// |entries| <= 2^bits().
  int bits() const { return bits_; }
  /// Requires that the entries fit: bits() <= 62 for Int<62>, bits() <= 126 for Int<126>.
  template <class M>
  exact::Matrix3<M> matrix(int index) const {
    exact::Matrix3<M> m;
    for (int r = 0; r < 3; ++r) m[r] = {entry<M>(index, 3 * r), entry<M>(index, 3 * r + 1), entry<M>(index, 3 * r + 2)};
    return m;
  }
  /// The map in doubles, scaled by a power of two so that the largest entry is in [1, 2); every entry has relative
  /// error at most 2^-52.
  const Mat3& approx(int index) const { return approx_[index]; }
  /// A bound, at least the spectral norm of approx(index).
  double norm(int index) const { return norm_[index]; }
  double per_norm(int index) const { return per_norm_[index]; }  ///< 1 / norm
  /// A bound of the error of u . (approx(index) v) for unit vectors u, v with errors below 2^-50.
  double error(int index) const { return error_[index]; }

  /// Whether the maps are the same, with the same factor.
  bool operator==(const RelativeMap& other) const {
    return bits_ == other.bits_ && fixed_ == other.fixed_ && big_ == other.big_;
  }

  /// An upper bound of the angle by which directions move from the situation `before` to this one, edges of Q and
  /// normals of Q alike, seen from P, on a path on which they move no further; 4, more than any angle, when it is not
  /// small.
  double angle_from(const RelativeMap& before) const;

 private:
  template <class M>
  M entry(int index, int k) const {
    if constexpr (std::is_same_v<M, exact::Big>) {
      return bits_ <= 126 ? exact::to_big(fixed_[index][k]) : big_[9 * index + k];
    } else {
      return M::from_raw(exact::raw_cast<M::kBits>(fixed_[index][k]));
    }
  }
  void set_rotation(const Rotation& p, const Rotation& q);
  void set_scaled(const PoseFactors& p, const PoseFactors& q);
  bool set_scaled_in_words(const PoseFactors& p, const PoseFactors& q);
  void set_big(unsigned most);
  void approximate();

  int bits_ = 62;
  bool rotation_ = true;  // nothing but a rotation
  std::array<std::array<exact::i128, 9>, 2> fixed_{};
  std::vector<exact::Big> big_;  // nine for each index, when bits_ > 126
  std::array<Mat3, 2> approx_;
  std::array<double, 2> norm_{}, per_norm_{}, error_{};
};

/// A bound that is at least the spectral norm, and at most a tenth more: ||m||^8 = ||(m^T m)^4|| <= the Frobenius norm
/// of that.
double spectral_bound(const Mat3& m);

}  // namespace dymsum::spatial
