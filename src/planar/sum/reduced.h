// The reduced engine: convolution, mask, arrangement, loops, as in the outline of docs/design/planar-sum.md.
#pragma once

#include "base/poll.h"
#include "planar/arrangement/crossings.h"
#include "planar/convolution/convolution.h"
#include "planar/mask/fine_cells.h"
#include "planar/mask/interior_mask.h"
#include "planar/result/planar_sum.h"

namespace dymsum::planar {

// How the segments that a reduced convolution has put into a soup hang together.

/// The chains of the convolution's segments, which come first in the soup; those after `reduced` (sides of
/// parallelograms) belong to no chain.
class ReducedChain final : public Chain {
 public:
  /// `live` gives the segment of the soup for each id, or kNone; empty: the id.
  ReducedChain(const Soup& soup, const ReducedConvolution& convolution, Array<std::uint32_t> live,
               std::uint32_t reduced);
  void incident(WalkPair v, Array<Incidence>& out) const override;

 private:
  void fill_next();
  std::uint32_t live(std::uint32_t id) const {
    if (id == kNoRank) return kNone;
    return live_.empty() ? id : live_[id];
  }
  void add(std::uint32_t id, bool starts, Array<Incidence>& out) const {
    if (const std::uint32_t s = live(id); s != kNone) out.push_back({s, starts});
  }

  const Soup& soup_;
  const ReducedConvolution& convolution_;
  Array<std::uint32_t> live_;
};

// The segments of a convolution as labelled segments for the arrangement: all of them, or those that the mask does not
// prove to lie inside the sum.

/// Adds all segments to the soup, in the order of their ids.
void add_all(const ReducedConvolution& convolution, Soup& soup);

/// Whether segments in the same position become one.
enum class Twins { kept, merged };

/// Adds the segments of the convolution that are not wholly in covered cells to the soup. Returns for each id its
/// segment there, or kNone.
Array<std::uint32_t> add_live(const ReducedConvolution& convolution, const InteriorMask* mask, Twins twins, Soup& soup,
                              const Poll& poll);

/// Fills state.boundary, by all steps (Engine::fast), or without mask and refinement and with all pairs
/// (Engine::brute).
void run_reduced(const SumOptions& options, SumState& state, Refine refine, Poll& poll);

}  // namespace dymsum::planar
