#include "dymsum/solid_scale_events.h"

#include <utility>

#include "exact/big.h"
#include "spatial/events/scale_walk.h"
#include "spatial/motion/posed_pair.h"

namespace dymsum {

using exact::BigRational;
using namespace spatial;

class SolidScaleEvents::State {
 public:
  State(const Mesh& p, const Mesh& q, const SolidScaleOptions& options) : walk(p, q, options) {}
  const ScaleWalk walk;
};

Result<SolidScaleEvents> SolidScaleEvents::create(const Mesh& p, const Mesh& q, const SolidScaleOptions& options) {
  if (std::optional<Error> error = scaling_refusal(p, q, options.threads)) return *std::move(error);
  return guarded([&] { return SolidScaleEvents(std::make_unique<State>(p, q, options)); });
}

SolidScaleEvents::SolidScaleEvents(std::unique_ptr<State> state) : state_(std::move(state)) {}
SolidScaleEvents::SolidScaleEvents(SolidScaleEvents&&) noexcept = default;
SolidScaleEvents& SolidScaleEvents::operator=(SolidScaleEvents&&) noexcept = default;
SolidScaleEvents::~SolidScaleEvents() = default;

std::size_t SolidScaleEvents::facet_count() const { return state_->walk.facet_count(); }

Result<SpatialSum> SolidScaleEvents::at(const Scale& s, const Progress& progress) const {
  return guarded([&] { return state_->walk.at(s, progress); });
}

Result<std::vector<ScaleEvent>> SolidScaleEvents::events(const Scale& a, const Scale& b, const Progress& progress,
                                                         SolidEventWork* work) const {
  const BigRational from = exact::exact_value(a.exact()), to = exact::exact_value(b.exact());
  if (from > to) return Error{ErrorCode::bad_scale, "the range of scales begins after its end", {}};
  SolidEventWork counted;
  return within_scales([&] {
    return guarded([&] {
      std::vector<ScaleEvent> events = state_->walk.events(from, to, ListedScales::visible, progress, counted);
      if (work != nullptr) *work = counted;
      return events;
    });
  });
}

Result<std::optional<ScaleEvent>> SolidScaleEvents::next_event(const Scale& s, const Scale& limit, EventChange change,
                                                               const Progress& progress) const {
  const BigRational from = exact::exact_value(s.exact()), to = exact::exact_value(limit.exact());
  if (from > to) return Error{ErrorCode::bad_scale, "the range of scales begins after its end", {}};
  const auto first_event = [&]() -> std::optional<ScaleEvent> {
    SolidEventWork work;
    const std::vector<BigRational> ends = state_->walk.steps(from, to);
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
      for (const ScaleEvent& event : state_->walk.events(ends[k], ends[k + 1], ListedScales::visible, progress, work))
        if (exact::exact_value(event.parameter) > from && (change == EventChange::visible || event.topology))
          return event;
    return std::nullopt;
  };
  return within_scales([&] { return guarded(first_event); });
}

Result<std::uint64_t> SolidScaleEvents::combinatorial_hash(const Scale& s, const Progress& progress) const {
  return guarded([&] { return state_->walk.shape(s, progress).hash; });
}

}  // namespace dymsum
