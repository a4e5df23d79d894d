#include "planar/scaling/exact_frame.h"

namespace dymsum::planar {

// Both ways round to the nearest double; quotients of doubles do so by themselves.
double ExactFrame::tau(std::uint32_t moving) const {
  if (moving == base_->moved) return value_.approx;
  constexpr std::int64_t kDoubles = std::int64_t{1} << 53;
  if (value_.num < kDoubles && value_.den < kDoubles)
    return value_.den.convert_to<double>() / value_.num.convert_to<double>();
  return exact::round_to_double(exact::BigRational(value_.den, value_.num));
}

const Lattice& ExactFrame::lattice() {
  if (lattice_ == nullptr) lattice_ = base_->lattice_at(scale_);
  return *lattice_;
}

const Operand& ExactFrame::operand(std::uint32_t op) {
  if (op != base_->moved) return base_->operands[op];
  if (scaled_ == nullptr) scaled_ = base_->operand_at(op, lattice());
  return *scaled_;
}

PlacedPair ExactFrame::placed() {
  const auto shared = [this](std::uint32_t op) {
    operand(op);
    return op == base_->moved ? scaled_ : std::shared_ptr<const Operand>(base_, &base_->operands[op]);
  };
  lattice();
  return {lattice_, shared(0), shared(1)};
}

Collision& ExactFrame::collision() {
  if (collision_ == nullptr) collision_ = std::make_unique<Collision>(lattice(), operand(0), operand(1), true);
  return *collision_;
}

}  // namespace dymsum::planar
