#include "planar/scaling/frame_place.h"

namespace dymsum::planar {

const Lattice& FramePlace::lattice() {
  if (lattice_ == nullptr) lattice_ = base_->lattice_at(scale_);
  return *lattice_;
}

const Operand& FramePlace::operand(std::uint32_t op) {
  if (op != base_->scaled) return base_->operands[op];
  if (scaled_ == nullptr) scaled_ = base_->operand_at(op, lattice());
  return *scaled_;
}

Collision& FramePlace::collision() {
  if (collision_ == nullptr) collision_ = std::make_unique<Collision>(lattice(), operand(0), operand(1), true);
  return *collision_;
}

}  // namespace dymsum::planar
