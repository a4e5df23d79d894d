// The facets of the generic sum of two convex solids, by what makes them.
#pragma once

#include <cstdint>

namespace dymsum::spatial {

/// A face of an operand with its extreme vertex, or a crossing.
struct GenericFacet {
  int op = 0;  ///< 0, 1: face `id` of P, of Q; 2: crossing `id`
  std::uint32_t id = 0;
};

}  // namespace dymsum::spatial
