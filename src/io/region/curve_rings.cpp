#include "io/region/curve_rings.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace dymsum::io {
namespace {

/// The version of a chain for a ring that has the region on its left, and is the chain or its reverse.
Ring version_of(ChordChain chain, const Ring& ring, CurveBound bound) {
  if (chain.curves == 0 || bound == CurveBound::nearest) return ring;
  if (chain.on != ring) {  // the first vertex of a ring stays first
    chain.reverse();
    for (std::vector<Point>* version : {&chain.on, &chain.left, &chain.right})
      std::rotate(version->begin(), version->end() - 1, version->end());
  }
  return bound == CurveBound::inside ? chain.left : chain.right;
}

/// Chains by their first vertices.
class ChainsOfRings {
 public:
  explicit ChainsOfRings(std::vector<ChordChain> chains) : chains_(std::move(chains)) {
    for (std::size_t k = 0; k < chains_.size(); ++k)
      starts_.emplace(std::pair(chains_[k].front().x, chains_[k].front().y), k);
  }

  Ring version(const Ring& ring, CurveBound bound) const {
    const auto [first, last] = starts_.equal_range({ring.front().x, ring.front().y});
    for (auto it = first; it != last; ++it) {
      const ChordChain& chain = chains_[it->second];
      const bool reversed = chain.on.size() == ring.size() &&
                            std::equal(chain.on.begin() + 1, chain.on.end(), std::make_reverse_iterator(ring.end()));
      if (chain.on == ring || reversed) return version_of(chain, ring, bound);
    }
    return ring;
  }

 private:
  std::vector<ChordChain> chains_;
  std::multimap<std::pair<double, double>, std::size_t> starts_;
};

}  // namespace

bool nest_chains(std::vector<ChordChain> chains, std::vector<Part>& parts, CurveBound bound, FillRule rule) {
  std::erase_if(chains, [](const ChordChain& chain) { return chain.empty(); });
  std::vector<Ring> rings;
  for (const ChordChain& chain : chains) rings.push_back(chain.on);
  std::vector<Part> nested;
  if (!nest_rings(std::move(rings), nested, rule)) return false;
  if (bound != CurveBound::nearest) {
    const ChainsOfRings known(std::move(chains));
    for (Part& part : nested) {
      part.outer = known.version(part.outer, bound);
      for (Ring& hole : part.holes) hole = known.version(hole, bound);
    }
  }
  std::move(nested.begin(), nested.end(), std::back_inserter(parts));
  return true;
}

Part part_of_chains(std::vector<ChordChain> rings, CurveBound bound) {
  Part part;
  for (std::size_t k = 0; k < rings.size(); ++k) (k == 0 ? part.outer : part.holes.emplace_back()) = rings[k].on;
  orient_rings(part);
  for (std::size_t k = 0; k < rings.size(); ++k) {
    Ring& ring = k == 0 ? part.outer : part.holes[k - 1];
    if (!ring.empty()) ring = version_of(std::move(rings[k]), ring, bound);
  }
  return part;
}

}  // namespace dymsum::io
