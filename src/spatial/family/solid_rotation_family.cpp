#include "dymsum/solid_rotation_family.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/poll.h"
#include "spatial/family/angle_order.h"
#include "spatial/family/structure_cache.h"
#include "spatial/moving/moving_solid_sum.h"

namespace dymsum {

using namespace spatial;

class SolidRotationFamily::State {
 public:
  State(const Mesh& p, const Mesh& q, const TurnAxis& axis, const Ends& given_ends, const SolidFamilyOptions& given)
      : p(p),
        q(q),
        ends(given_ends),
        options(given),
        pair(p, q, axis, given.moving == MovingOperand::p ? 0 : 1),
        order(pair.circle, position(0), position(1)),
        cache(given.structure_bytes) {
    options.progress = {};
    stages.semantics = options.semantics, stages.tight = options.tight, stages.threads = options.threads;
  }

  static Result<SolidRotationFamily> make(const Mesh& p, const Mesh& q, const TurnAxis& axis, const Ends& ends,
                                          const SolidFamilyOptions& options);
  /// An end of the interval.
  std::optional<ChartPosition> position(std::size_t end) const {
    return ends ? std::optional(pair.circle.position((*ends)[end])) : std::nullopt;
  }

  /// The index of the first event that is not before an angle, and whether it is at it.
  SolidFamilyLocation locate(const ChartPosition& theta) const {
    const auto at = std::partition_point(events.begin(), events.end(),
                                         [&](const SolidRotationEvent& e) { return order.compare(theta, e) > 0; });
    return {static_cast<std::uint32_t>(at - events.begin()), at != events.end() && order.compare(theta, *at) == 0};
  }
  PosedSpace space_at(const ChartPosition& theta) const {
    ExactPose turned = pair.circle.pose(theta), still = ExactPose::of({});
    if (pair.turning == 1) std::swap(turned, still);
    return posed_space(pair.pair, std::move(turned), std::move(still));
  }
  /// Throws Cancelled, std::invalid_argument.
  SpatialSum at(const ChartPosition& theta, const Progress& progress) const {
    SpatialOptions own = stages;
    own.progress = progress;
    const SolidFamilyLocation location = locate(theta);
    if (location.event) return fresh_sum(pair.pair, space_at(theta), own);
    if (const StructureCache::Kept kept = cache.find(location.index))
      if (std::optional<SpatialSum> sum = placed(*kept, space_at(theta))) return *std::move(sum);
    CornerContacts corners;
    SpatialSum sum = fresh_sum(pair.pair, space_at(theta), own, &corners);
    cache.keep(location.index, structure_of(sum, std::move(corners)));
    return sum;
  }

  Mesh p, q;
  Ends ends;
  SolidFamilyOptions options;  ///< with no progress
  SpatialOptions stages;
  RotatingPair pair;
  AngleOrder order;
  std::vector<SolidRotationEvent> events;
  SolidFamilyWork work;
  mutable StructureCache cache;
};

namespace {

SolidRotationOptions angle_search(const SolidFamilyOptions& options) {
  SolidRotationOptions walk;
  walk.moving = options.moving, walk.tight = options.tight, walk.threads = options.threads;
  walk.changes = false;
  return walk;
}

}  // namespace

SolidRotationFamily::SolidRotationFamily(std::unique_ptr<const State> state) : state_(std::move(state)) {}
SolidRotationFamily::SolidRotationFamily(SolidRotationFamily&&) noexcept = default;
SolidRotationFamily& SolidRotationFamily::operator=(SolidRotationFamily&&) noexcept = default;
SolidRotationFamily::~SolidRotationFamily() = default;

Result<SolidRotationFamily> SolidRotationFamily::State::make(const Mesh& p, const Mesh& q, const TurnAxis& axis,
                                                             const Ends& ends, const SolidFamilyOptions& options) {
  const Stopwatch watch;
  const Result<SolidRotationEvents> search = SolidRotationEvents::create(p, q, axis, angle_search(options));
  if (!search) return search.error();
  Result<std::vector<SolidRotationEvent>> events =
      ends ? search->events((*ends)[0], (*ends)[1], options.progress) : search->events_of_turn(options.progress);
  if (!events) return events.error();
  return guarded([&] {
    auto state = std::make_unique<State>(p, q, search->axis(), ends, options);
    state->events = *std::move(events);
    state->work.events = state->events.size(), state->work.cells = state->events.size() + 1;
    state->work.ms = watch.ms();
    return SolidRotationFamily(std::move(state));
  });
}

Result<SolidRotationFamily> SolidRotationFamily::create(const Mesh& p, const Mesh& q, const TurnAxis& axis,
                                                        const SolidFamilyOptions& options) {
  return State::make(p, q, axis, std::nullopt, options);
}

Result<SolidRotationFamily> SolidRotationFamily::create(const Mesh& p, const Mesh& q, const TurnAxis& axis,
                                                        const AxisTurn& from, const AxisTurn& to,
                                                        const SolidFamilyOptions& options) {
  if (from == to)
    return Error{
        ErrorCode::out_of_range, "the interval of angles ends where it begins; leave its ends out for all", {}};
  return State::make(p, q, axis, std::array{from, to}, options);
}

const Mesh& SolidRotationFamily::p() const { return state_->p; }
const Mesh& SolidRotationFamily::q() const { return state_->q; }
const TurnAxis& SolidRotationFamily::axis() const { return state_->pair.circle.axis(); }
const SolidFamilyOptions& SolidRotationFamily::options() const { return state_->options; }
const SolidRotationFamily::Ends& SolidRotationFamily::ends() const { return state_->ends; }
const std::vector<SolidRotationEvent>& SolidRotationFamily::events() const { return state_->events; }
SolidFamilyWork SolidRotationFamily::work() const {
  SolidFamilyWork work = state_->work;
  state_->cache.report(work);
  return work;
}

Result<SpatialSum> SolidRotationFamily::at(const AxisTurn& theta, const Progress& progress) const {
  const ChartPosition at = state_->pair.circle.position(theta);
  if (!state_->order.holds(at))
    return Error{ErrorCode::bad_rotation, "the angle is outside of the family's interval", {}};
  return guarded([&] { return state_->at(at, progress); });
}

SolidFamilyLocation SolidRotationFamily::locate(const AxisTurn& theta) const {
  const ChartPosition at = state_->pair.circle.position(theta);
  if (!state_->order.holds(at))
    throw std::invalid_argument("SolidRotationFamily: an angle outside of the family's interval");
  return state_->locate(at);
}

std::optional<SolidRotationEvent> SolidRotationFamily::next(const AxisTurn& theta) const {
  const auto [index, event] = locate(theta);
  const std::size_t next = event ? index + std::size_t{1} : index;
  return next < events().size() ? std::optional(events()[next]) : std::nullopt;
}

}  // namespace dymsum
