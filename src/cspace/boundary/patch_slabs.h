// The slabs, the ranges between neighbouring event angles, that a patch is in.
#pragma once

#include "dymsum/cspace_obstacle.h"

namespace dymsum::planar {

/// Slabs counted from `begin` on, round the circle.
inline std::uint32_t slabs_between(std::uint32_t begin, std::uint32_t slab, std::size_t slabs) {
  return static_cast<std::uint32_t>(slab >= begin ? slab - begin : slab + slabs - begin);
}
/// Whether a patch is there in a slab.
inline bool is_in_slab(const Patch& p, std::uint32_t slab, std::size_t slabs) {
  if (p.begin == Patch::kNone) return true;
  const std::uint32_t length = slabs_between(p.begin, p.end, slabs);
  return length == 0 || slabs_between(p.begin, slab, slabs) < length;
}

}  // namespace dymsum::planar
