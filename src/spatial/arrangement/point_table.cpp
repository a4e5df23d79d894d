#include "spatial/arrangement/point_table.h"

#include <bit>

namespace dymsum::spatial {

void PointTable::rehash(std::size_t slots) {
  slots_.assign(slots, kNoId);
  for (PointId id = 0; id < sources_.size(); ++id) {
    std::size_t at = hash_[id] & (slots - 1);
    while (slots_[at] != kNoId) at = (at + 1) & (slots - 1);
    slots_[at] = id;
  }
}

std::vector<PointId> PointTable::add(std::span<const PointSource> sources) {
  const std::vector<exact::Residue> hashes = space_.point_hashes(sources);
  const std::size_t room = std::bit_ceil(2 * (sources_.size() + sources.size()) + 16);
  if (room > slots_.size()) rehash(room);
  std::vector<PointId> ids;
  ids.reserve(sources.size());
  for (std::size_t k = 0; k < sources.size(); ++k) {
    std::size_t at = hashes[k] & (slots_.size() - 1);
    while (slots_[at] != kNoId &&
           !(hash_[slots_[at]] == hashes[k] && space_.same_point(sources_[slots_[at]], sources[k])))
      at = (at + 1) & (slots_.size() - 1);
    if (slots_[at] == kNoId) {
      slots_[at] = static_cast<PointId>(sources_.size());
      sources_.push_back(sources[k]);
      approx_.push_back(space_.approximate(sources[k]));
      hash_.push_back(hashes[k]);
    }
    ids.push_back(slots_[at]);
  }
  return ids;
}

}  // namespace dymsum::spatial
