// The boundary of one operand as points, segments and triangles, for the search of what touches.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "dymsum/penetration_depth.h"
#include "dymsum/rotation.h"
#include "exact/big.h"
#include "exact/vector3.h"
#include "spatial/mesh/box_tree.h"

namespace dymsum::depth {

using BigVector = exact::Vector3<exact::Big>;

/// Vertices in ascending order, kNoVertex behind them: a point, a segment or a triangle.
using Simplex = std::array<std::uint32_t, 3>;
inline constexpr std::uint32_t kNoVertex = 0xffffffff;
inline int dimension_of(const Simplex& s) { return s[1] == kNoVertex ? 0 : s[2] == kNoVertex ? 1 : 2; }

struct TouchSide {
  std::vector<Point3> at;            ///< of vertices
  std::vector<Simplex> simplices;    ///< none is a side of another one
  std::vector<SolidFeature> inside;  ///< per simplex: the feature that its relative interior belongs to
  /// The same of segments that are sides of triangles inside a face, or edges with a name of their own.
  std::map<std::array<std::uint32_t, 2>, SolidFeature> sides;
  /// Vertices are to be turned by this integer matrix over an integer.
  std::array<std::int64_t, 9> matrix{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::int64_t den = 1;

  void turn(const Rotation& rotation);
  /// The feature that the relative interior of a side of simplex `of`, or of itself, belongs to.
  SolidFeature feature(const Simplex& side, std::uint32_t of) const;
  /// A vertex, turned: times den, in units of 2^exponent, which divides its coordinates.
  BigVector exact(std::uint32_t vertex, int exponent) const;
  /// The same times 2^-scale, in doubles: each coordinate within 2^-49 of the largest one of all vertices.
  spatial::Vec3 approx(std::uint32_t vertex, int scale) const;
};

/// The side of a mesh: faces cut into triangles, points and segments as they are. Features by its indices.
TouchSide touch_side(const Mesh& mesh);
/// The side of a region: its edges at height 0; an edge is named by the vertex that it starts from, as `a`.
TouchSide touch_side(const Region& region);

}  // namespace dymsum::depth
