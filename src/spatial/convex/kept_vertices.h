// The vertices of a solid whose indices stay: a vertex leaves when no corner of a facet stands at it any more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "spatial/convex/pair_index.h"
#include "spatial/convex/vertex_pair.h"

namespace dymsum::spatial {

class KeptVertices {
 public:
  /// The pair of each index; kNoPair where one is free.
  std::span<const VertexPair> pairs() const { return pairs_; }
  /// The corners that a facet had go.
  void leave(std::span<const std::uint32_t> corners);
  /// A corner of that facet now: its vertex. Calls fresh(vertex) for one that has no index yet.
  template <class Fresh>
  std::uint32_t enter(VertexPair pair, const Fresh& fresh) {
    const std::uint32_t v = index_.find_or_add(pair, [&] {
      const std::uint32_t added = index_for(pair);
      fresh(added);
      return added;
    });
    ++uses_[v];
    return v;
  }
  /// Whether the facet had a corner there that went.
  bool was_left(std::uint32_t v) const { return left_[v] == stamp_; }
  /// Frees those without corners, and lists them, sorted.
  void drop_unused(std::vector<std::uint32_t>& gone);
  /// Memory held beside this.
  std::size_t bytes() const {
    const auto of = [](const auto&... v) { return (std::size_t{0} + ... + (v.capacity() * sizeof(v[0]))); };
    return index_.bytes() + of(pairs_, uses_, left_, free_, unused_);
  }

 private:
  std::uint32_t index_for(VertexPair pair);

  PairIndex index_;
  std::vector<VertexPair> pairs_;
  std::vector<std::uint32_t> uses_, left_;  // how many corners are there; the stamp when one last went
  std::vector<std::uint32_t> free_, unused_;
  std::uint32_t stamp_ = 0;
};

}  // namespace dymsum::spatial
