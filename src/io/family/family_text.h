// What writers and readers of families agree on.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "io/checked_json.h"

namespace dymsum::io {

inline constexpr CheckedFormat kFamilyFormat{"dymsum family", 1, "a family"};
/// What moves: other motions have other contents.
inline constexpr const char* kScalingMotion = "scaling";

/// The rings of a cell by their identities, of several with one identity the first. A ring of the next cell is written
/// as what it changes: so many vertices at the beginning and at the end of the ring of its identity are kept.
class KnownRings {
 public:
  using Names = std::vector<std::uint32_t>;
  void add(std::uint64_t identity, Names names) { next_.try_emplace(identity, std::move(names)); }
  /// The rings that were added are those of the cell before.
  void next_cell() { before_ = std::exchange(next_, {}); }
  /// The ring of this identity in the cell before; empty where there was none.
  const Names& before(std::uint64_t identity) const {
    static const Names kNothing;
    const auto known = before_.find(identity);
    return known == before_.end() ? kNothing : known->second;
  }

 private:
  std::unordered_map<std::uint64_t, Names> before_, next_;
};

}  // namespace dymsum::io
