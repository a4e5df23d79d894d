// How the segments that a reduced convolution has put into a soup hang together.
#pragma once

#include "planar/arrangement/soup.h"
#include "planar/convolution/convolution.h"

namespace dymsum::planar {

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

}  // namespace dymsum::planar
