#include "planar/motion/exact_frame.h"

#include "planar/operand/round_place.h"

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

bool ExactOverlap::inside_right_of(const Segment& on, const std::optional<Segment>& from,
                                   const std::optional<Segment>& to) {
  if (!placed_) {
    placed_ = placed_at(*base_, theta_);
    collision_.emplace(*placed_->lattice, *placed_->p, *placed_->q, true);
  }
  Place p;
  p.on = on;
  const auto cut = [&](const std::optional<Segment>& by, Pair end) {
    Cut c;
    if (by) {
      c.kind = Cut::Kind::crossing;
      c.by = *by;
    } else {
      c.pair = end;
    }
    return c;
  };
  p.first = cut(from, start_of(p.on));
  p.second = cut(to, end_of(p.on));
  p.between = true;
  round_place(*placed_->lattice, p);
  return collision_->overlaps_right_of(p);
}

}  // namespace dymsum::planar
