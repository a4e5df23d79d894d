// The edges of a complex in the order in which the rays from the boundary meet them: once round each walk.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shape/complex/complex.h"

namespace dymsum::shape {

/// An edge of the complex as a site sees it: `up` where the walk along the site goes from its low node to its high one,
/// so that the site lies on the left of it; else from high to low, the site on the right.
struct BoundaryItem {
  std::uint32_t edge = 0, site = 0;
  bool up = false;
};

/// Items of a loop follow each other cyclically; where the rays between two of them go to infinity the first ends and
/// the next begins there. A loop without items sees nothing but infinity.
struct BoundaryOrder {
  std::vector<BoundaryItem> items;
  std::vector<std::uint32_t> first_item, first_site;  ///< loop -> into items, sites; one more than loops
  std::vector<std::array<std::uint32_t, 2>> item_of;  ///< edge -> its item up, its item down
  std::uint32_t loops() const { return static_cast<std::uint32_t>(first_site.size()) - 1; }
  std::uint32_t loop_of(const Complex& complex, std::uint32_t item) const {
    return complex.sites[items[item].site].loop;
  }
  std::uint32_t next(const Complex& complex, std::uint32_t item) const {
    const std::uint32_t loop = loop_of(complex, item);
    return item + 1 == first_item[loop + 1] ? first_item[loop] : item + 1;
  }
  std::uint32_t previous(const Complex& complex, std::uint32_t item) const {
    const std::uint32_t loop = loop_of(complex, item);
    return item == first_item[loop] ? first_item[loop + 1] - 1 : item - 1;
  }
};

/// O(nodes + edges).
BoundaryOrder boundary_order(const Complex& complex);

}  // namespace dymsum::shape
