// What exact positions of a SpatialSum are made from.
#pragma once

#include <memory>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "spatial/convolution/sum_space.h"

namespace dymsum {

struct SpatialSum::Source {
  std::shared_ptr<const spatial::SumSpace> space;
  std::vector<spatial::PointSource> vertices;
};

}  // namespace dymsum
