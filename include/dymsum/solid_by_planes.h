// Solids by their planes: faces as they were meant, before coordinates were turned and rounded to doubles.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/result.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

/// The directions of a part's axes, as columns of a matrix: doubles of few digits.
using PartAxes = std::array<Point3, 3>;

struct PlanesOptions {
  /// The most that a vertex may move. Nothing: 2^-40 of the part's size (2^-20 where all coordinates are of single
  /// precision and one is no multiple of 2^-12 of the size), but at least 64 ulps of the largest
  /// coordinate.
  std::optional<double> tolerance;
  SpatialOptions sums;  ///< threads, memory and progress of the union that makes the solid
};

struct SolidByPlanes {
  /// The solid: exact, canonical, without tight features. An operand like every result; `p` of a face is the face of
  /// the data that it was.
  SpatialSum solid;
  std::vector<PartAxes> axes;  ///< of the solid's parts, other than those of the coordinates: each once
  double tolerance = 0;        ///< that held
  double largest_move = 0;     ///< no vertex is further from where it was; proved
  std::size_t merged = 0;      ///< coordinates along an axis that became one with another one
  std::size_t bent_faces = 0;  ///< faces of more than three vertices that are in no plane still, and became triangles
  std::size_t faces = 0;       ///< of the data
  std::string to_string()
      const;  ///< "12 faces in 6 planes, along axes of their own; no vertex moved by more than 2e-16"
};

/// The solid whose faces are plane and parallel where those of the data are but for rounding. For each shell its axes
/// are looked for (see docs/design/solid-by-planes.md); along each of them coordinates that are nearly equal become
/// one. So faces of boxes and the ends and sides of prisms, turned or not, lie exactly in planes, whatever their number
/// of vertices, and parallel ones are exactly parallel. Coordinates in turned axes are no doubles: vertices are exact
/// fractions of some 100 bits, over powers of two. Along the coordinates' own axes they stay doubles, moved onto one of
/// theirs. Slanted faces that are not parallel to any axis stay what they are to within the tolerance: triangles, and
/// polygons where they are plane still.
/// The data need not be plane, and coordinates need not be equal where faces meet, to within the tolerance; in all else
/// it has to be a closed surface as `united` takes it, by positive winding numbers.
/// Errors: as united; out_of_range for a tolerance that is not positive and finite or below the least that is named
/// above, with that; no_area where nothing is left; not_closed with a position. Cost: that of the union.
Result<SolidByPlanes> by_planes(const MeshData& data, const PlanesOptions& options = {});

/// The same of several solids, in their order, with axes in common wherever none of them has more directions of planes
/// for that: parts that were turned alike. The order does not matter.
Result<std::vector<SolidByPlanes>> by_planes(std::span<const MeshData> solids, const PlanesOptions& options = {});

}  // namespace dymsum
