// The number tier that the coordinates of a region or a mesh alone request.
#pragma once

#include "dymsum/mesh.h"
#include "dymsum/region.h"

namespace dymsum::cli {

/// Bits of the integers that hold the region on its lossless grid: 29, 61, 512, or 0 for arbitrary precision.
int tier_of(const Region& region);
/// The tier of two regions that are summed.
int tier_of(const Region& p, const Region& q);

/// The smallest B >= 1 such that all coordinates of the mesh are at most 2^B of the largest power of two that divides
/// all.
int grid_bits(const Mesh& mesh);
/// The tier of those bits: 26, 61, 72, 124, 250, or 0 for arbitrary precision.
int tier_of(const Mesh& mesh);
/// The tier of two solids on one grid.
int tier_of(const Mesh& p, const Mesh& q);

}  // namespace dymsum::cli
