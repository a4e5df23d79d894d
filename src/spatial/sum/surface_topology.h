// The numbers by which the topology of two surfaces of triangles is compared.
#pragma once

#include <cstddef>
#include <cstdint>

#include "dymsum/mesh.h"

namespace dymsum::spatial {

struct SurfaceTopology {
  std::size_t pieces = 0;  ///< connected, if only by a vertex
  std::int64_t euler = 0;  ///< vertices less edges plus triangles
  friend bool operator==(const SurfaceTopology&, const SurfaceTopology&) = default;
};

/// Requires that all vertices are used. O(n log n).
SurfaceTopology topology_of(const MeshData& triangles);

}  // namespace dymsum::spatial
