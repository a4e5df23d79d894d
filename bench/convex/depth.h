// Penetration depths of convex solids that move, beside other systems'.
#pragma once

#include <string>
#include <vector>

#include "dymsum/solids.h"

namespace dymsum::bench {

/// P turns a little from query to query, Q is put somewhere into it. Ours is exact; the others are compared with it.
struct DepthRow {
  std::string p, q, system;
  double us = 0;                       ///< a query, 0: no answer
  std::size_t queries = 0, wrong = 0;  ///< errors above 1e-6 of P's width
  double worst = 0;                    ///< largest error, in P's widths
};
std::vector<DepthRow> measure_depth(const solids::NamedMesh& p, const solids::NamedMesh& q, int queries);

}  // namespace dymsum::bench
