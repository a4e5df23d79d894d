// The segments of a convolution as labelled segments for the arrangement: all of them, or those that the mask does not
// prove to lie inside the sum.
#pragma once

#include "base/poll.h"
#include "planar/arrangement/soup.h"
#include "planar/convolution/convolution.h"
#include "planar/mask/interior_mask.h"

namespace dymsum::planar {

/// Adds all segments to the soup, in the order of their ids.
void add_all(const ReducedConvolution& convolution, Soup& soup);

/// Whether segments in the same position become one.
enum class Twins { kept, merged };

/// Adds the segments of the convolution that are not wholly in covered cells to the soup. Returns for each id its
/// segment there, or kNone.
Array<std::uint32_t> add_live(const ReducedConvolution& convolution, const InteriorMask* mask, Twins twins, Soup& soup,
                              const Poll& poll);

}  // namespace dymsum::planar
