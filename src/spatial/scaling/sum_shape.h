// The combinatorics of a sum at a scale, whatever its positions: what events change.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/spatial_sum.h"
#include "spatial/mesh/grid_places.h"

namespace dymsum::spatial {

struct SumTopology {
  std::vector<std::int64_t> euler;     ///< of every shell, sorted
  std::array<std::size_t, 3> tight{};  ///< faces, segments, points
  friend bool operator==(const SumTopology&, const SumTopology&) = default;
};

struct SumShape {
  std::uint64_t hash = 0;
  SumTopology topology;
  friend bool operator==(const SumShape&, const SumShape&) = default;
};

/// Shapes of sums of two meshes one of which scales. Faces are told by their planes as functions of the scale, so that
/// it does not matter how a face of several coplanar facets is named.
class SumShapes {
 public:
  SumShapes(const Mesh& p, const Mesh& q, int moving);
  /// O(n log n).
  SumShape of(const SpatialSum& sum) const;

 private:
  using Big3 = std::array<exact::BigInteger, 3>;
  std::uint64_t plane_name(const SolidContact& contact) const;
  Big3 place(int operand, std::uint32_t v) const;
  std::vector<std::uint32_t> vertices_of(int operand, const SolidFeature& feature) const;

  const Mesh *p_, *q_;
  int moving_;
  GridPlaces places_;
};

}  // namespace dymsum::spatial
