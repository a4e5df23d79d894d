// The scales at which two facets meet: an interval, since what a facet sweeps in (x, s) is convex.
#pragma once

#include <optional>

#include "thesis/pair_facets.h"

namespace dymsum::spatial {

/// The interval of scales in (0, infinity) at which two facets meet: its finite ends.
struct PairInterval {
  enum class End : std::uint8_t { none, corner, facet_edges };
  bool meets = false;                     ///< at more than one scale
  End low = End::none, high = End::none;  ///< a corner of one on the other, or borders that cross
};

/// By doubles; nothing where these do not decide. Requires facets that share no corner, in planes that are not
/// parallel.
std::optional<PairInterval> near_interval(const PairFacets& all, std::uint32_t f, std::uint32_t g);
/// Exact; corners and borders that doubles prove to miss each other are left out first, or nothing is.
enum class Ahead : std::uint8_t { nothing, doubles };
PairInterval exact_interval(const PairFacets& all, std::uint32_t f, std::uint32_t g, Ahead ahead = Ahead::doubles);

}  // namespace dymsum::spatial
