// Two solids made ready for questions about their depth: the facets of the reduced convolution of P and -Q, in doubles
// of one scale, in a tree.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "depth/touching_pairs.h"
#include "dymsum/penetration_depth.h"
#include "spatial/convolution/inner_cells.h"
#include "spatial/convolution/reduced_facets.h"
#include "spatial/convolution/solid_operand.h"
#include "spatial/mesh/box_tree.h"

namespace dymsum::depth {

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

Result<std::shared_ptr<const DepthOperands>> depth_operands(const Mesh& p, const Mesh& q, const DepthOptions& options);

}  // namespace dymsum::depth
