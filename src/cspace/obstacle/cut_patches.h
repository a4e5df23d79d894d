// Patches where rings touch: an edge that is cut there has several walk edges, whose visible sub-edges in line are one
// patch.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "cspace/obstacle/swept_boundary.h"

namespace dymsum::planar {

/// A patch in the sweep's own indices.
struct CutPatch {
  Patch patch;                                                 ///< without begin, end and shell
  std::uint32_t begin = 0, end = 0;                            ///< angles; kNobody: it is there at every angle
  std::uint32_t node = 0;                                      ///< one of its sub-edges
  std::vector<std::pair<std::uint32_t, std::uint32_t>> cells;  ///< (angle, cell): the cell on its right from there on
};

struct ContactNames {
  std::function<Contact(std::uint32_t)> contact;             ///< of a segment
  std::function<bool(std::uint32_t, std::uint32_t)> corner;  ///< whether one follows the other at an end of both
};

/// All patches: in every slab sub-edges of one contact that follow each other are put together; what has the same
/// contact and neighbours in the next slab is the same patch. Requires a closed turn. O(slabs s log s), s the size of a
/// slice.
std::vector<CutPatch> cut_patches(const SweptBoundary& swept, const ContactNames& names);

}  // namespace dymsum::planar
