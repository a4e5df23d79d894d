// Volumes and surfaces of any size as text, for those outside of the range of doubles, where doubles are zero or
// infinite. The form is that of area_text.
#pragma once

#include <string>

#include "dymsum/mesh.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

/// The exact volume as a decimal number of 17 significant digits, correctly rounded, and an exponent. O(n).
std::string volume_text(const Mesh& mesh);
/// Cost: that of SpatialSum::volume.
std::string volume_text(const SpatialSum& sum);

/// What surface_area() gives, with its relative error, at any size. O(n).
std::string surface_text(const Mesh& mesh);
/// Correctly rounded. Cost: that of SpatialSum::area.
std::string surface_text(const SpatialSum& sum);

}  // namespace dymsum
