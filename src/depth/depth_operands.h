// Two solids made ready for questions about their depth: the facets of the reduced convolution of P and -Q, in doubles
// of one scale, in a tree.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "depth/exact_frame.h"
#include "depth/result_depth.h"
#include "depth/touching_pairs.h"
#include "dymsum/penetration_depth.h"
#include "spatial/boundary/collision.h"
#include "spatial/convolution/inner_cells.h"
#include "spatial/convolution/reduced_facets.h"
#include "spatial/convolution/solid_operand.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::depth {

// Signs of volumes that doubles prove.

inline double largest(spatial::Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// The sign of six volumes of a tetrahedron with these edges, whose components are off by `off` at most, where it is
/// proved, else 0: products of three are off by 6 (A B + B C + C A) off, their sum in doubles by less than 2^-48 A B C,
/// A, B and C being the largest components. Requires edges of about 1 or less, so that nothing overflows.
inline int proved_sign(spatial::Vec3 a, spatial::Vec3 b, spatial::Vec3 c, double off) {
  const double A = largest(a) + off, B = largest(b) + off, C = largest(c) + off;
  const double v = spatial::dot(spatial::cross(a, b), c);
  const double error = 6 * off * (A * B + B * C + C * A) + 0x1p-48 * A * B * C;
  return v > error ? 1 : v < -error ? -1 : 0;
}

/// Doubles are scaled by one power of two so that all sums of vertices are within [-1, 1], each coordinate off by less
/// than kOff.
struct DepthOperands {
  static constexpr double kOff = 0x1p-50;

  DepthEngine engine = DepthEngine::search;
  bool convex = false;         ///< both: then all facets bound the sum, and every position on them is free
  spatial::SolidOperand p, q;  ///< Q reflected
  std::unique_ptr<const spatial::SumSpace> space;
  std::unique_ptr<const spatial::InnerCells> inner;
  std::vector<spatial::SumFacet> facets;  ///< without those deep inside
  int exponent = 0;                       ///< of the unit that divides all coordinates
  int scale = 0;                          ///< a length in the operands' units is 2^scale times the scaled one
  std::vector<spatial::Vec3> p_at, q_at;
  std::vector<spatial::Vec3> normals;             ///< of facets, of length 1, each component off by less than 2^-36
  spatial::BoxTree tree;                          ///< boxes of facets
  std::unique_ptr<const TouchingPairs> touching;  ///< Q as it is; none where contacts are not requested
  std::optional<SpatialSum> sum;                  ///< of the engine that searches its boundary
  /// Of operands that no doubles hold: then there is nothing else.
  std::optional<ResultDepth> results;

  spatial::Vec3 corner(spatial::SumPoint s) const { return p_at[s.p] + q_at[s.q]; }
  /// A position in the operands' units, scaled; each coordinate rounded once, infinite where it is far away.
  spatial::Vec3 scaled(const std::array<exact::BigRational, 3>& world) const;
};

/// An open ball in the open sum, found by an earlier question, in scaled doubles and a little smaller.
struct CoveredBall {
  spatial::Vec3 centre;
  double radius = 0;
  bool holds(spatial::Vec3 x) const { return spatial::length(x - centre) < radius; }
};

Result<std::shared_ptr<const DepthOperands>> depth_operands(const SpatialOperand& p, const SpatialOperand& q,
                                                            const DepthOptions& options);

// Overlap that doubles prove.

/// A vertex that is inside, or an edge of one solid that crosses a triangle of the other, determined by doubles with a
/// margin: a "no" says nothing.
class ProvedOverlap {
 public:
  explicit ProvedOverlap(const DepthOperands& o);

  /// Whether P and Q provably overlap at all positions within `radius` of one, in each coordinate. Pairs that crossed
  /// at the last positions are tried first, then those whose boxes overlap, some of them; then places inside one solid,
  /// whether they are inside the other: they determine where faces are flush and nothing crosses.
  bool holds(spatial::Vec3 at, double radius);

 private:
  struct Solid {
    const spatial::SolidOperand& solid;
    const std::vector<spatial::Vec3>& at;
    spatial::BoxTree tree;
    std::vector<spatial::Vec3> inner;  // places inside
    std::size_t last = 0;              // of these, inside the other solid last time

    Solid(const spatial::SolidOperand& operand, const std::vector<spatial::Vec3>& positions);
    bool contains(spatial::Vec3 position, double margin) const;
  };
  bool crosses(std::uint32_t i, std::uint32_t j, spatial::Vec3 at, double radius) const;
  bool some_inside(Solid& of, const Solid& other, spatial::Vec3 at, double margin);

  const DepthOperands& o_;
  Solid p_, q_;
  std::vector<std::array<std::uint32_t, 2>> witnesses_;  // the last one first
};

// Whether solids overlap at exact positions; one for every thread.

class DepthProbe {
 public:
  explicit DepthProbe(const DepthOperands& o);

  bool overlaps(const std::array<BigRational, 3>& position);
  /// A "no" says nothing. `at` is scaled.
  bool provably_overlaps(spatial::Vec3 at, double radius);

  /// A position that is free, and a facet that it lies on, or kNoFacet.
  struct Free {
    std::array<BigRational, 3> at;
    std::uint32_t facet;
  };
  static constexpr std::uint32_t kNoFacet = 0xffffffff;

  /// What the last questions found: depth is continuous, so nearly all of what lies nearer is known to be covered, and
  /// a free position is near.
  void remember(const CoveredBall& ball, std::vector<Free> free);
  const std::vector<CoveredBall>& balls() const { return balls_; }
  const std::vector<Free>& free() const { return free_; }

 private:
  void renew();

  const DepthOperands& o_;
  ProvedOverlap proved_;
  std::unique_ptr<spatial::SumSpace> space_;
  std::unique_ptr<const spatial::Collision> collision_;
  std::size_t positions_ = 0;
  std::vector<CoveredBall> balls_;  // the last one first
  std::vector<Free> free_;
};

}  // namespace dymsum::depth
