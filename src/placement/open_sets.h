// Open sets that come and go, and the positions that lie in none of them: whatever a set does not meet stays as it is.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>

#include "placement/free_set.h"

namespace dymsum::placement {

class OpenSets {
 public:
  /// Requires: an id that no set has had.
  void add(std::uint32_t id, std::shared_ptr<const OpenSet> set, HomogeneousPoint move);
  void remove(std::uint32_t id);
  bool contains(std::uint32_t id) const { return members_.contains(id); }
  std::vector<std::uint32_t> ids() const;

  /// Requires: the complement of the union is bounded. Cost: that of free_boundary for sets that changed or meet one
  /// that did, and of free_set.
  FreeSet free();
  /// The ids of sets in which a position lies, ascending.
  std::vector<std::uint32_t> holding(const HomogeneousPoint& at) const;

 private:
  struct Member {
    std::shared_ptr<const PlacedSet> set;
    std::map<std::uint32_t, Cover> covers;  // by the sets with these ids
    FreeBoundary boundary;
    bool changed = true;
  };
  std::map<std::uint32_t, Member> members_;
};

}  // namespace dymsum::placement
