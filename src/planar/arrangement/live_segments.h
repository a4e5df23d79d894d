// The segments of a convolution that the mask does not prove to lie inside the sum.
#pragma once

#include "base/poll.h"
#include "planar/arrangement/soup.h"
#include "planar/convolution/convolution.h"
#include "planar/mask/interior_mask.h"

namespace dymsum::planar {

/// Whether segments in the same place become one.
enum class Twins { kept, merged };

/// Adds the segments of the convolution that are not wholly in dead cells to the soup. Returns for each id its segment
/// there, or kNone.
Array<std::uint32_t> add_live(const ReducedConvolution& convolution, const InteriorMask* mask, Twins twins, Soup& soup,
                              const Poll& poll);

}  // namespace dymsum::planar
