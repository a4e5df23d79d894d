#include "dymsum/growing_disc.h"

#include <mutex>
#include <utility>

#include "shape/disc/level_set.h"

namespace dymsum {

using shape::Complex;
using shape::Side;

/// The complex of each side with the order along the boundary, made when first asked for.
struct GrowingDisc::State {
  Region region;
  GrowingDiscOptions options;
  struct OneSide {
    std::once_flag once;
    std::optional<Error> error;
    Complex complex;
    shape::BoundaryOrder order;
  };
  OneSide sides[2];

  Result<const OneSide*> side(Side which) {
    OneSide& one = sides[which == Side::inside ? 1 : 0];
    std::call_once(one.once, [&] {
      auto made = shape::make_complex(region, which, options.brute ? shape::Engine::brute : shape::Engine::fast);
      if (!made) {
        one.error = made.error();
        return;
      }
      one.complex = *std::move(made);
      one.order = shape::boundary_order(one.complex);
    });
    if (one.error) return *one.error;
    return &one;
  }
};

namespace {

using Make = DiscSet (*)(const shape::DiscPlaces&, const shape::BoundaryOrder&, Semantics);

std::optional<Error> needs_area(const Region& region, const char* what) {
  if (region.polylines().empty() && region.points().empty()) return std::nullopt;
  return Error{ErrorCode::unsupported_operand,
               std::string(what) + " is defined for regions without polylines and points",
               {}};
}

template <class OneSide>
Result<DiscSet> set_at(const Result<const OneSide*>& side, const Region& region, const DiscRadius& r,
                       Semantics semantics, Make make) {
  if (!side) return side.error();
  const OneSide& one = **side;
  const auto level = shape::level_at(one.complex, r);
  if (!level) return level.error();
  if (level->radius == 0) return shape::set_of(region);
  return make(shape::DiscPlaces(one.complex, *level), one.order, semantics);
}

}  // namespace

GrowingDisc::GrowingDisc(Region region, GrowingDiscOptions options) : state_(std::make_shared<State>()) {
  state_->region = std::move(region);
  state_->options = options;
}

const Region& GrowingDisc::region() const { return state_->region; }

Result<std::vector<DiscEvent>> GrowingDisc::events(DiscSide side) const {
  const auto one = state_->side(side == DiscSide::inside ? Side::inside : Side::outside);
  if (!one) return one.error();
  return shape::disc_events((*one)->complex);
}

Result<DiscSet> GrowingDisc::sum_at(const DiscRadius& r, Semantics semantics) const {
  return set_at(state_->side(Side::outside), region(), r, semantics, shape::sum_set);
}

Result<DiscSet> GrowingDisc::eroded_at(const DiscRadius& r, Semantics semantics) const {
  if (auto error = needs_area(region(), "erosion")) return *error;
  return set_at(state_->side(Side::inside), region(), r, semantics, shape::eroded_set);
}

Result<DiscSet> GrowingDisc::opened_at(const DiscRadius& r, Semantics semantics) const {
  if (auto error = needs_area(region(), "opening")) return *error;
  return set_at(state_->side(Side::inside), region(), r, semantics, shape::opened_set);
}

Result<DiscSet> GrowingDisc::closed_at(const DiscRadius& r, Semantics semantics) const {
  if (auto error = needs_area(region(), "closing")) return *error;
  return set_at(state_->side(Side::outside), region(), r, semantics, shape::closed_set);
}

}  // namespace dymsum
