#include "dymsum/growing_disc.h"

#include <mutex>
#include <utility>

#include "base/poll.h"
#include "shape/disc/level_set.h"

namespace dymsum {

using shape::Complex;
using shape::Side;

namespace {

bool goes_on(const Progress& progress, const char* stage, double fraction) {
  return !progress || progress(stage, fraction);
}
}  // namespace

/// The complex of each side with the order along the boundary, made when first requested.
struct GrowingDisc::State {
  Region region;
  GrowingDiscOptions options;
  struct OneSide {
    std::mutex mutex;
    bool made = false;
    std::optional<Error> error;
    Complex complex;
    shape::BoundaryOrder order;
  };
  OneSide sides[2];

  /// What is made stays so, and is read without the mutex; a call that is stopped leaves nothing.
  Result<const OneSide*> side(Side which, const Progress& progress) {
    OneSide& one = sides[which == Side::inside ? 1 : 0];
    const std::lock_guard lock(one.mutex);
    if (!one.made) {
      const auto engine = options.brute ? shape::Engine::brute : shape::Engine::fast;
      auto made = shape::make_complex(region, which, engine, 0, progress);
      if (!made && made.error().code == ErrorCode::cancelled) return made.error();
      if (!made) {
        one.error = made.error();
      } else {
        one.complex = *std::move(made);
        one.order = shape::boundary_order(one.complex);
      }
      one.made = true;
      if (!goes_on(progress, "complex", 1)) return cancelled();
    }
    if (one.error) return *one.error;
    return &one;
  }
};

namespace {

using Make = DiscSet (*)(const shape::DiscPositions&, const shape::BoundaryOrder&, Semantics);

template <class OneSide>
Result<DiscSet> set_at(const Result<const OneSide*>& side, const Region& region, const DiscRadius& r,
                       Semantics semantics, const Progress& progress, Make make) {
  if (!side) return side.error();
  const OneSide& one = **side;
  if (!goes_on(progress, "set", 0)) return cancelled();
  const auto level = shape::level_at(one.complex, r);
  if (!level) return level.error();
  if (level->radius == 0) return shape::set_of(region);
  DiscSet set = make(shape::DiscPositions(one.complex, *level), one.order, semantics);
  if (!goes_on(progress, "set", 1)) return cancelled();
  return set;
}

}  // namespace

GrowingDisc::GrowingDisc(Region region, GrowingDiscOptions options) : state_(std::make_shared<State>()) {
  state_->region = std::move(region);
  state_->options = options;
}

const Region& GrowingDisc::region() const { return state_->region; }

Result<std::vector<DiscEvent>> GrowingDisc::events(DiscSide side, const Progress& progress) const {
  const auto one = state_->side(side == DiscSide::inside ? Side::inside : Side::outside, progress);
  if (!one) return one.error();
  return shape::disc_events((*one)->complex);
}

Result<DiscSet> GrowingDisc::sum_at(const DiscRadius& r, Semantics semantics, const Progress& progress) const {
  return set_at(state_->side(Side::outside, progress), region(), r, semantics, progress, shape::sum_set);
}

Result<DiscSet> GrowingDisc::eroded_at(const DiscRadius& r, Semantics semantics, const Progress& progress) const {
  return set_at(state_->side(Side::inside, progress), region(), r, semantics, progress, shape::eroded_set);
}

Result<DiscSet> GrowingDisc::opened_at(const DiscRadius& r, Semantics semantics, const Progress& progress) const {
  return set_at(state_->side(Side::inside, progress), region(), r, semantics, progress, shape::opened_set);
}

Result<DiscSet> GrowingDisc::closed_at(const DiscRadius& r, Semantics semantics, const Progress& progress) const {
  return set_at(state_->side(Side::outside, progress), region(), r, semantics, progress, shape::closed_set);
}

}  // namespace dymsum
