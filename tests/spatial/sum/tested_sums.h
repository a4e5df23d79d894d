// The sums that tests of this room compare, and how many pairs their random rounds take.
#pragma once

#include <algorithm>
#include <cstdlib>

#include "dymsum/spatial_sum.h"
#include "spatial/sum/spatial_sum.h"

namespace dymsum {

/// The sum of solids that have one, by an engine.
inline SpatialSum sum(const Mesh& p, const Mesh& q, SpatialEngine engine = SpatialEngine::fast) {
  SpatialOptions options;
  options.engine = engine;
  return minkowski_sum(p, q, options).value();
}

/// The same of surfaces that need not be meshes: edges may have more than two faces.
inline SpatialSum sum(const MeshData& p, const MeshData& q, SpatialEngine engine = SpatialEngine::fast,
                      int threads = 1) {
  SpatialOptions options;
  options.engine = engine;
  options.threads = threads;
  return spatial::sum_of_solids(p, q, options).value();
}

/// How many pairs a test takes: a few, or one of so many of those that DYMSUM_FUZZ_PAIRS requests.
inline int fuzz_pairs(int few, int of = 10) {
  const char* text = std::getenv("DYMSUM_FUZZ_PAIRS");
  return text != nullptr ? std::max(few, std::atoi(text) / of) : few;
}

}  // namespace dymsum
