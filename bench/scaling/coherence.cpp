#include "scaling/coherence.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

namespace dymsum::bench {
namespace {

using Corner = std::array<std::uint32_t, 6>;

std::vector<Corner> corners(const PlanarSum& sum) {
  std::vector<Corner> all;
  const auto add = [&](const SumRing& ring) {
    for (const SumVertex& v : ring.vertices)
      all.push_back({static_cast<std::uint32_t>(v.in.kind), v.in.p, v.in.q, static_cast<std::uint32_t>(v.out.kind),
                     v.out.p, v.out.q});
  };
  for (const SumPart& part : sum.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

double corners_kept(const PlanarSum& before, const PlanarSum& now) {
  const std::vector<Corner> a = corners(before), b = corners(now);
  std::vector<Corner> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return b.empty() ? 1 : static_cast<double>(both.size()) / static_cast<double>(b.size());
}

}  // namespace dymsum::bench
