// The structures of a family's cells that are kept: so many bytes of those that were used last.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>

#include "dymsum/solid_family.h"
#include "spatial/family/sum_structure.h"

namespace dymsum::spatial {

/// All of it may be called by several threads at a time.
class StructureCache {
 public:
  using Kept = std::shared_ptr<const SumStructure>;

  /// `most`: bytes; 0 for no limit. The structure that was used last is kept, whatever its size.
  explicit StructureCache(std::uint64_t most) : most_(most) {}

  /// The structure of a cell; null where it is not kept.
  Kept find(std::uint32_t cell) {
    const std::lock_guard lock(mutex_);
    const auto at = of_cell_.find(cell);
    if (at == of_cell_.end()) return nullptr;
    used_.splice(used_.begin(), used_, at->second);
    return at->second->structure;
  }

  /// Keeps what was made for a cell, unless another thread was first. Returns what is kept.
  Kept keep(std::uint32_t cell, SumStructure structure) {
    const std::lock_guard lock(mutex_);
    ++made_;
    if (const auto at = of_cell_.find(cell); at != of_cell_.end()) return at->second->structure;
    used_.push_front({cell, std::make_shared<const SumStructure>(std::move(structure))});
    of_cell_.emplace(cell, used_.begin());
    bytes_ += used_.front().structure->bytes();
    while (most_ != 0 && bytes_ > most_ && used_.size() > 1) {
      bytes_ -= used_.back().structure->bytes();
      of_cell_.erase(used_.back().cell);
      used_.pop_back();
    }
    return used_.front().structure;
  }

  /// Adds what is kept, and what was made.
  void report(SolidFamilyWork& work) const {
    const std::lock_guard lock(mutex_);
    work.kept = used_.size(), work.made = made_, work.bytes = bytes_;
  }

 private:
  struct Entry {
    std::uint32_t cell;
    Kept structure;
  };
  mutable std::mutex mutex_;
  std::list<Entry> used_;  // last used first
  std::unordered_map<std::uint32_t, std::list<Entry>::iterator> of_cell_;
  std::uint64_t most_, bytes_ = 0, made_ = 0;
};

}  // namespace dymsum::spatial
