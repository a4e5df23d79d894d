// A sum of two solids at exact poses, from the facets of its convolution.
#pragma once

#include <type_traits>

#include "base/poll.h"
#include "dymsum/moving_solid_sum.h"
#include "spatial/motion/posed_pair.h"
#include "spatial/sum/solid_boundary.h"
#include "spatial/sum/solid_faces.h"

namespace dymsum::spatial {

SpatialOptions stage_options(const MovingSolidOptions& options);

/// The stages after the convolution. `corners`: as of assemble. Throws Cancelled.
SpatialSum sum_of_facets(const SolidPair& pair, PosedSpace space, ReducedConvolution convolution,
                         const ConvolutionHints& hints, const SpatialOptions& options,
                         CornerContacts* corners = nullptr);
/// All stages. Throws Cancelled, and std::invalid_argument as posed_space.
SpatialSum fresh_sum(const SolidPair& pair, const PosePair& poses, const SpatialOptions& options);

/// The same in the space of given poses.
SpatialSum fresh_sum(const SolidPair& pair, PosedSpace space, const SpatialOptions& options,
                     CornerContacts* corners = nullptr);

/// Calls make(), and reports what it throws as errors.
template <class F>
auto guarded(F make) -> Result<decltype(make())> {
  try {
    if constexpr (std::is_void_v<decltype(make())>) {
      make();
      return {};
    } else {
      return make();
    }
  } catch (const Cancelled&) {
    return cancelled();
  } catch (const std::invalid_argument&) {
    return Error{ErrorCode::unsupported_operand, "at these poses coordinates need more than 8,192 bits", {}};
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::out_of_memory, "the sum needs more memory than there is", {}};
  }
}

}  // namespace dymsum::spatial
