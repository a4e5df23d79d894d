#include "planar/operand/prepared_region.h"

#include "planar/region/region_validate.h"
#include "planar/region/separate_touching.h"

namespace dymsum::planar {

std::shared_ptr<PreparedRegion> not_yet_prepared() { return std::make_shared<PreparedRegion>(); }

std::shared_ptr<const Operand> PreparedRegion::operand(const Region& region, std::uint32_t op, bool reflected) {
  Slot& slot = slots_[2 * op + (reflected ? 1 : 0)];
  if (!slot.made.load(std::memory_order_acquire)) {
    const std::lock_guard lock(making_);
    if (!slot.made.load(std::memory_order_relaxed)) {
      slot.operand = make_operand(separate_touching(region.data(), region.touching_points()), op, reflected);
      slot.made.store(true, std::memory_order_release);
    }
  }
  return slot.operand;
}

std::shared_ptr<const Operand> prepared_operand(const Region& region, std::uint32_t op, bool reflected) {
  PreparedRegion* kept = RegionInternals::prepared(region);
  if (kept != nullptr) return kept->operand(region, op, reflected);
  return make_operand(separate_touching(region.data(), {}), op);  // the empty region
}

}  // namespace dymsum::planar
