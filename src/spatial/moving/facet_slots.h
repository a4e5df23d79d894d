// The facets of a sum that moves, in slots that they keep as long as they exist.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "spatial/convolution/sum_space.h"

namespace dymsum::spatial {

/// Slots of facets that ended are used again from the next move on.
class FacetSlots {
 public:
  std::size_t count() const { return facets_.size(); }
  std::size_t facets() const { return facets_.size() - free_.size() - removed_.size(); }
  bool exists(std::uint32_t slot) const { return exists_[slot] != 0; }
  const SumFacet& operator[](std::uint32_t slot) const { return facets_[slot]; }
  /// The slots of the last move's new facets, and of those that ended.
  const std::vector<std::uint32_t>& added() const { return added_; }
  const std::vector<std::uint32_t>& removed() const { return removed_; }

  void begin_move() {
    free_.insert(free_.end(), removed_.begin(), removed_.end());
    added_.clear(), removed_.clear();
  }
  std::uint32_t add(const SumFacet& facet) {
    std::uint32_t slot = 0;
    if (free_.empty()) {
      slot = static_cast<std::uint32_t>(facets_.size());
      facets_.push_back(facet), exists_.push_back(1);
    } else {
      slot = free_.back();
      free_.pop_back();
      facets_[slot] = facet, exists_[slot] = 1;
    }
    added_.push_back(slot);
    return slot;
  }
  void remove(std::uint32_t slot) {
    exists_[slot] = 0;
    removed_.push_back(slot);
  }

 private:
  std::vector<SumFacet> facets_;
  std::vector<std::uint8_t> exists_;
  std::vector<std::uint32_t> free_, added_, removed_;
};

}  // namespace dymsum::spatial
