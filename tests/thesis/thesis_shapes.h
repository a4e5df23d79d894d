// Stand-ins for the polygons of the thesis.
#pragma once

#include <string_view>
#include <vector>

#include "dymsum/region.h"

namespace dymsum::shapes {

/// A generated stand-in for each polygon of the thesis's figure 3.3, with its vertex count: airplane 51, bar 4, bird
/// 275, blob 18, dog 145, G1 30, G2 34, G3 24, G4 43, hand1 57, hand2 84, insignia 4, sewing 10, fence 10, pentagon 5,
/// star 44, U 8.
struct Named {
  std::string_view name;
  Region region;
};
std::vector<Named> thesis_like_set();

}  // namespace dymsum::shapes
