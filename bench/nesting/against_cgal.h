// Every row of a table by CGAL's reduced convolution.
#pragma once

#include <cstddef>

#include "dymsum/nfp_table.h"

namespace dymsum::bench {

struct Rivalry {
  double cgal_ms = 0;  ///< of all rows together
  std::size_t rows = 0, equal = 0;
  std::size_t witnessed = 0;  ///< rows that differ of which its vertical decomposition says what we say
};

/// Compared with our exact sums: parts, holes, vertices and area.
Rivalry against_cgal(const NfpTable& table);

}  // namespace dymsum::bench
