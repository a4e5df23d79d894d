// What the engine keeps of a region from one sum to the next: the region as an operand, in each role it has played so
// far.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

#include "dymsum/region.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

/// Shared by all copies of a region; each operand is made when it is first requested. Thread-safe.
class PreparedRegion {
 public:
  /// The region, or its reflection, as operand `op`. Requires: always the same region.
  std::shared_ptr<const Operand> operand(const Region& region, std::uint32_t op, bool reflected);

 private:
  struct Slot {
    std::atomic<bool> made = false;
    std::shared_ptr<const Operand> operand;
  };
  std::array<Slot, 4> slots_;
  std::mutex making_;  // a once_flag asks the system to wake whoever waits, which takes as long as a small operand
};

/// The region, or its reflection, as operand `op`, kept with the region.
std::shared_ptr<const Operand> prepared_operand(const Region& region, std::uint32_t op, bool reflected = false);

}  // namespace dymsum::planar
