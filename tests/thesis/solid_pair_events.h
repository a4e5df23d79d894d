// The thesis's pair events of solids, counted.
#pragma once

#include <cstdint>

#include "dymsum/solid_scale_events.h"

namespace dymsum {

/// The thesis's pair events over s in (0, infinity), counted without storing them: for each pair of facets of the
/// reduced convolution that are not parallel the finite ends of the interval of scales at which they meet.
struct SolidPairEventCount {
  std::uint64_t facets = 0;
  std::uint64_t pairs_that_meet = 0;  ///< pairs with a non-empty interval, but for those that share a corner
  std::uint64_t vertex_on_facet = 0;  ///< ends at which a corner of one lies on the other
  std::uint64_t edge_on_edge = 0;     ///< ends at which two borders cross
  std::uint64_t exact_pairs = 0;      ///< pairs that doubles did not decide
  std::uint64_t events() const { return vertex_on_facet + edge_on_edge; }
};
/// O(N^2) time for N facets, O(N) memory. Errors: as SolidScaleEvents::create; cancelled.
Result<SolidPairEventCount> count_solid_pair_events(const Mesh& p, const Mesh& q, const SolidScaleOptions& options = {},
                                                    const Progress& progress = {});

}  // namespace dymsum
