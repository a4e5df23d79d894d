// Exact positions of the vertices of two posed operands over one denominator, so that sums of them are additions of
// integers.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "dymsum/convex_sum.h"
#include "exact/big.h"
#include "exact/int.h"
#include "spatial/gauss/signs.h"
#include "spatial/mesh/vec3.h"

namespace dymsum {

namespace spatial {

/// The vertices of the operands of a convex sum as they were given.
struct ConvexOperands {
  /// The positions of an operand: doubles of a mesh, or `exact` ones of a sum, multiples of 2^exponent.
  struct Operand {
    std::vector<Point3> vertices;
    std::vector<exact::Vector3<exact::Big>> exact;
    int exponent = 0;

    std::size_t size() const { return vertices.size() + exact.size(); }
    /// Memory held, without what lies behind arbitrary precision.
    std::size_t bytes() const { return vertices.capacity() * sizeof(Point3) + exact.capacity() * sizeof(exact[0]); }
  };
  std::array<Operand, 2> operand;
};

using BigVector = std::array<exact::BigInteger, 3>;

/// x -> matrix x / den.
struct ExactPose {
  std::array<exact::BigInteger, 9> matrix;
  exact::BigInteger den;
  static ExactPose of(const SolidPose& pose);
};

class ExactPositions {
 public:
  ExactPositions(const spatial::ConvexOperands& source, const SolidPose& p, const SolidPose& q);

  /// The numerators of the position of vertex v of an operand; positions are numerators times unit().
  BigVector of(int op, std::uint32_t v) const;
  /// 2^exponent / denominator.
  const exact::BigRational& unit() const { return unit_; }

 private:
  const spatial::ConvexOperands& source_;
  std::array<std::array<exact::BigInteger, 9>, 2> matrix_;  // over the common denominator
  int exponent_ = 0;
  exact::BigRational unit_;
};

/// The exact positions of the vertices of a convex sum, made from its operands when they are requested.
class ConvexPositions {
 public:
  ConvexPositions(std::shared_ptr<const ConvexOperands> operands, const SolidPose& p, const SolidPose& q,
                  std::vector<ConvexSum::Vertex> vertices);

  std::size_t size() const { return vertices_.size(); }
  /// Positions are numerators times unit().
  BigVector numerators(std::size_t vertex) const;
  std::vector<BigVector> numerators() const;
  const exact::BigRational& unit() const { return exactly().unit(); }

 private:
  const ExactPositions& exactly() const;

  std::shared_ptr<const ConvexOperands> operands_;
  SolidPose p_pose_, q_pose_;
  std::vector<ConvexSum::Vertex> vertices_;
  mutable std::once_flag made_;
  mutable std::optional<ExactPositions> exactly_;
};

}  // namespace spatial

}  // namespace dymsum

namespace dymsum::spatial {

// A pose in doubles, scaled so that nothing overflows or vanishes.

/// The pose x -> 2^exponent map x, and the map of its normals and area vectors, n -> (a positive factor) cofactors n.
/// The largest entries of both matrices are in [1, 2). Column j of the map is a column of a rotation times the factor
/// of axis j, column j of the cofactors one times those of the other two axes: every entry has relative error below
/// 2^-49.
struct PosedDoubles {
  Mat3 map, cofactors;
  int exponent = 0, cofactors_exponent = 0;  ///< det(A) A^-T = 2^cofactors_exponent cofactors for the pose A
  double determinant = 1;                    ///< of 2^exponent map, in units of 8^exponent

  explicit PosedDoubles(const PoseFactors& pose);
};

/// The power of two at or below the largest magnitude of the entries, which are not all zero.
int exponent_of(const Mat3& m);
Mat3 scaled_by_power(const Mat3& m, int exponent);

}  // namespace dymsum::spatial
