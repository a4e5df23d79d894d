// The stages of a sum of solids as data: what pictures look at.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dymsum/mesh.h"

namespace dymsum {

/// Drawn positions are rounded; decisions never read them back.
struct SpatialTrace {
  struct Facet {
    std::vector<Point3> corners;  ///< counter-clockwise seen from outside
    enum class Kind : std::uint8_t { face_vertex, vertex_face, edge_edge } kind = Kind::face_vertex;
  };
  std::vector<Facet> facets;                  ///< the reduced convolution
  std::vector<std::array<Point3, 2>> pieces;  ///< of lines, into which facets of different planes cut each other
};

}  // namespace dymsum
