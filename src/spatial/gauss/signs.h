// The two predicates that decide everything about the sum of convex solids: on which side of an edge's circle a face's
// normal lies on the sphere of directions, for faces of P and edges of Q, and the other way round. Never zero: Q counts
// as turned by an infinitesimal rotation.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "dymsum/rotation.h"
#include "exact/big.h"
#include "exact/int.h"
#include "exact/orient.h"
#include "exact/rounding_bound.h"
#include "spatial/gauss/polytope.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

// How two solids stand to each other: the linear map from Q's own coordinates to P's, up to a positive factor, and its
// inverse.

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

/// Operand 0 is P, 1 is Q. "The sign of (op, f, h)" is that of n . (M e) with n the outward normal of face f of operand
/// op, e the vector along half-edge h of the other one, and M the map from that one's coordinates: positive when the
/// target of h is further out in direction n than its origin.
class Signs {
 public:
  Signs(const Polytope& p, const Polytope& q) : poly_{&p, &q} {}

  const Polytope& poly(int op) const { return *poly_[op]; }
  const RelativeMap& map() const { return map_; }
  /// Moves the operands. Cost: O(faces).
  void set(const RelativeMap& map);
  /// Moves the operands without the table that `row`, `value` and `sign` read: then only what ends in `_now`, and
  /// `true_sign`, may be requested.
  void move(const RelativeMap& map) { map_ = map; }

  /// The product within error(op) of the exact value for unit normal, unit vector and the map as normalised in doubles.
  double value(int op, std::uint32_t f, HalfEdge h) const {
    const double v = dot(row_[op][f], poly_[1 - op]->direction[h / 2]);
    return (h & 1) ? -v : v;
  }
  /// n^T M of face f of operand op, n its unit normal.
  const Vec3& row(int op, std::uint32_t f) const { return row_[op][f]; }
  /// The same from the map as it is, without the table.
  Vec3 row_now(int op, std::uint32_t f) const { return row_times(poly_[op]->normal[f], map_.approx(op)); }
  /// M e of edge e of the other operand, e its unit vector: the value of (op, f, 2e) is the product of f's unit normal
  /// and this, within the same error.
  Vec3 mapped_edge(int op, std::uint32_t e) const { return map_.approx(op) * poly_[1 - op]->direction[e]; }
  double error(int op) const { return map_.error(op); }
  /// The error where normals and mapped edges are rounded to floats. All factor.
  float float_error(int op) const { return static_cast<float>(kFloatError * map_.norm(op)); }
  /// -1 or 1.
  int sign(int op, std::uint32_t f, HalfEdge h) const {
    const double v = value(op, f, h);
    if (v > map_.error(op)) return 1;
    if (v < -map_.error(op)) return -1;
    return near_zero_sign(op, f, h);
  }
  int sign_now(int op, std::uint32_t f, HalfEdge h) const {
    const double v = value_now(op, f, h);
    if (v > map_.error(op)) return 1;
    if (v < -map_.error(op)) return -1;
    return near_zero_sign(op, f, h);
  }
  /// -1, 0 or 1: without the infinitesimal rotation.
  int true_sign(int op, std::uint32_t f, HalfEdge h) const;
  /// The angle by which directions have to move at least before the sign of (op, f, h) can change; not positive where
  /// doubles cannot decide.
  double margin(int op, double value) const {
    // The error of a margin of at most 1: the difference, the quotient by the norm and the last difference.
    constexpr double kMarginError = exact::rounding_bound(2 + 2 + 1, 8192);
    return (std::abs(value) - map_.error(op)) * map_.per_norm(op) - kMarginError;
  }

  /// Signs that doubles left open; those that doubles determined are not counted.
  const exact::RungCounts& signs() const { return decided_; }
  std::size_t bytes() const { return sizeof(*this) + (row_[0].capacity() + row_[1].capacity()) * sizeof(Vec3); }

  /// Calls f(coordinate, map entry) with values of the narrowest types that hold the operands and the map.
  template <class F>
  auto with_types(F&& f) const {
    const int bits = coordinate_bits();
    if (bits <= 26 && map_.bits() <= 62) return f(exact::Int<26>{}, exact::Int<62>{});
    if (has_integers()) return f(exact::Int<61>{}, exact::Int<126>{});
    return f(exact::Big{}, exact::Big{});
  }

 private:
  int coordinate_bits() const { return poly_[0]->bits > poly_[1]->bits ? poly_[0]->bits : poly_[1]->bits; }
  /// All numbers of a sign are integers of proved width.
  bool has_integers() const { return coordinate_bits() <= 61 && map_.bits() <= 126; }
  void count_exact() const { decided_.count(has_integers() ? exact::Rung::integers : exact::Rung::big); }
  double value_now(int op, std::uint32_t f, HalfEdge h) const {
    const double v = dot(row_now(op, f), poly_[1 - op]->direction[h / 2]);
    return (h & 1) ? -v : v;
  }
  int near_zero_sign(int op, std::uint32_t f, HalfEdge h) const;
  struct Form;
  Form form(int op, std::uint32_t f, HalfEdge h) const;
  bool plainly_zero(const Form& x) const;
  bool plainly_zero(int op, std::uint32_t f, HalfEdge h) const;
  int plain_tie(int op, std::uint32_t f, HalfEdge h) const;
  int exact_sign(int op, std::uint32_t f, HalfEdge h) const;

  std::array<const Polytope*, 2> poly_;
  RelativeMap map_;
  std::array<std::vector<Vec3>, 2> row_;  // n^T M of every face
  mutable exact::RungCounts decided_;
};

}  // namespace dymsum::spatial
