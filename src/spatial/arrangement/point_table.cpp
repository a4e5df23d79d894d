#include "spatial/arrangement/point_table.h"

#include <algorithm>
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

namespace {

/// Each source once, and which of these every one is.
struct NamedOnce {
  std::vector<PointSource> sources;
  std::vector<std::uint32_t> index;
};

NamedOnce named_once(std::span<const PointSource> all) {
  NamedOnce once;
  once.index.reserve(all.size());
  std::vector<std::uint32_t> slots(std::bit_ceil(2 * all.size() + 1), kNoId);
  for (const PointSource& s : all) {
    const std::uint64_t mixed = ((static_cast<std::uint64_t>(s.a) << 32 | s.b) ^ s.c * 0x9e3779b97f4a7c15ULL) *
                                (0xd6e8feb86659fd93ULL + 2 * static_cast<std::uint64_t>(s.kind));
    std::size_t at = (mixed >> 32) & (slots.size() - 1);
    while (slots[at] != kNoId && once.sources[slots[at]] != s) at = (at + 1) & (slots.size() - 1);
    if (slots[at] == kNoId) {
      slots[at] = static_cast<std::uint32_t>(once.sources.size());
      once.sources.push_back(s);
    }
    once.index.push_back(slots[at]);
  }
  return once;
}

}  // namespace

std::vector<PointId> PointTable::add(std::span<const PointSource> all, StageWatch& watch) {
  const NamedOnce once = named_once(all);
  std::vector<PointId> ids = add_named_once(once.sources, watch), result;
  result.reserve(all.size());
  for (const std::uint32_t k : once.index) result.push_back(ids[k]);
  return result;
}

std::vector<PointId> PointTable::add_named_once(std::span<const PointSource> sources, StageWatch& watch) {
  constexpr std::size_t kPart = 1024;
  std::vector<exact::Residue> hashes(sources.size());
  watch.run((sources.size() + kPart - 1) / kPart, [&](std::size_t part) {
    const std::size_t first = part * kPart, count = std::min(kPart, sources.size() - first);
    const std::vector<exact::Residue> some = space_.point_hashes(sources.subspan(first, count));
    std::copy(some.begin(), some.end(), hashes.begin() + static_cast<std::ptrdiff_t>(first));
  });
  const std::size_t room = std::bit_ceil(2 * (sources_.size() + sources.size()) + 16);
  if (room > slots_.size()) rehash(room);
  const std::size_t known = sources_.size();
  std::vector<PointId> ids;
  ids.reserve(sources.size());
  std::vector<std::uint32_t> fresh;  // of the sources: those of new points
  const auto source_of = [&](PointId id) { return id < known ? sources_[id] : sources[fresh[id - known]]; };
  const auto hash_of = [&](PointId id) { return id < known ? hash_[id] : hashes[fresh[id - known]]; };
  for (std::size_t k = 0; k < sources.size(); ++k) {
    std::size_t at = hashes[k] & (slots_.size() - 1);
    while (slots_[at] != kNoId &&
           !(hash_of(slots_[at]) == hashes[k] && space_.same_point(source_of(slots_[at]), sources[k])))
      at = (at + 1) & (slots_.size() - 1);
    if (slots_[at] == kNoId) {
      slots_[at] = static_cast<PointId>(known + fresh.size());
      fresh.push_back(static_cast<std::uint32_t>(k));
    }
    ids.push_back(slots_[at]);
  }
  const std::size_t all = known + fresh.size();
  sources_.reserve(all), hash_.reserve(all), approx_.reserve(all);
  for (const std::uint32_t k : fresh) sources_.push_back(sources[k]), hash_.push_back(hashes[k]);
  watch.hold((sources_.size() - known) *
             (sizeof(PointSource) + sizeof(Approx) + sizeof(exact::Residue) + 4 * sizeof(PointId)));
  approx_.resize(sources_.size());
  watch.run((sources_.size() - known + kPart - 1) / kPart, [&](std::size_t part) {
    const std::size_t first = known + part * kPart;
    for (std::size_t k = first; k < std::min(first + kPart, sources_.size()); ++k)
      approx_[k] = space_.approximate(sources_[k]);
  });
  return ids;
}

}  // namespace dymsum::spatial
