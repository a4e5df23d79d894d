#include "spatial/convex/kept_vertices.h"

#include <algorithm>

namespace dymsum::spatial {

void KeptVertices::leave(std::span<const std::uint32_t> corners) {
  if (++stamp_ == 0) {
    std::fill(left_.begin(), left_.end(), 0);
    stamp_ = 1;
  }
  for (const std::uint32_t v : corners) {
    left_[v] = stamp_;
    if (--uses_[v] == 0) unused_.push_back(v);
  }
}

std::uint32_t KeptVertices::index_for(VertexPair pair) {
  if (free_.empty()) {
    pairs_.push_back(pair);
    uses_.push_back(0);
    left_.push_back(0);
    return static_cast<std::uint32_t>(pairs_.size() - 1);
  }
  const std::uint32_t v = free_.back();
  free_.pop_back();
  pairs_[v] = pair;
  return v;
}

void KeptVertices::drop_unused(std::vector<std::uint32_t>& gone) {
  gone.clear();
  for (const std::uint32_t v : unused_) {
    if (uses_[v] > 0 || pairs_[v] == kNoPair) continue;
    index_.erase(pairs_[v]);
    pairs_[v] = kNoPair;
    gone.push_back(v);
  }
  unused_.clear();
  std::sort(gone.begin(), gone.end());
  // The smallest one is taken first.
  free_.insert(free_.end(), gone.rbegin(), gone.rend());
}

}  // namespace dymsum::spatial
