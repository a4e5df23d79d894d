#include "dymsum/solid_rotation_events.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

#include "base/poll.h"
#include "spatial/events/plane_names.h"
#include "spatial/events/rotation_walk.h"
#include "spatial/motion/beside_origin.h"
#include "spatial/moving/posed_sum.h"
#include "spatial/moving/sum_shape.h"

namespace dymsum {

using spatial::ChartPosition;

class SolidRotationEvents::State {
 public:
  State(const Mesh& p, const Mesh& q, const TurnAxis& axis, const SolidRotationOptions& given)
      : options(given), pair(p, q, axis, given.moving == MovingOperand::p ? 0 : 1), near(beside_origin_of(p, q)) {
    stages.tight = options.tight, stages.threads = options.threads;
  }

  /// Runs a walk; errors as events().
  Result<void> walk(const AxisTurn& a, const AxisTurn& b, bool after, bool whole, const Progress& progress,
                    const SolidRotationOptions& how, const std::function<bool(SolidRotationEvent&)>& take) {
    work = {};
    const Stopwatch watch;
    Result<void> made = spatial::guarded([&] {
      const spatial::RotationPath path{pair.circle.position(a), pair.circle.position(b), after, whole};
      spatial::walk_angles(near, path, how, work, progress, [&](SolidRotationEvent& e) {
        if (moved) move_back(e);
        return take(e);
      });
    });
    work.ms = watch.ms();
    return made;
  }

  /// The events from a to b, both included; up to a whole turn after a where `whole`.
  Result<std::vector<SolidRotationEvent>> list(const AxisTurn& a, const AxisTurn& b, bool whole,
                                               const Progress& progress) {
    std::vector<SolidRotationEvent> events;
    const Result<void> made = walk(a, b, whole, whole, progress, options, [&](SolidRotationEvent& e) {
      events.push_back(std::move(e));
      return true;
    });
    if (!made) return made.error();
    return events;
  }

  Result<std::optional<SolidRotationEvent>> first(const AxisTurn& a, const AxisTurn& limit, const Progress& progress,
                                                  bool topology) {
    std::optional<SolidRotationEvent> found;
    if (a == limit) return found;
    SolidRotationOptions how = options;
    how.changes = true;
    const Result<void> made = walk(a, limit, true, false, progress, how, [&](SolidRotationEvent& e) {
      if (topology ? e.topology : e.visible) found = std::move(e);
      return !found;
    });
    if (!made) return made.error();
    return found;
  }

  spatial::RotatingPair beside_origin_of(const Mesh& p, const Mesh& q) {
    const std::optional<Mesh> near_p = spatial::beside_origin(p), near_q = spatial::beside_origin(q);
    moved = near_p || near_q;
    if (!moved) return pair;
    return {near_p.value_or(p), near_q.value_or(q), pair.circle.axis(), pair.turning};
  }
  /// Contacts to where they are of the given operands.
  void move_back(SolidRotationEvent& event) const {
    const spatial::JetFrame frame(pair, event.approx, 0);
    const auto direction = [&](int op) {  // of any vertex, which is moved as all are
      const Point3 &from = near.pair.operand(op).vertices[0], &to = pair.operand(op).vertices[0];
      return spatial::Vec3{to.x - from.x, to.y - from.y, to.z - from.z};
    };
    const spatial::Vec3 by = frame.matrix() * direction(pair.turning) + direction(1 - pair.turning);
    for (SolidRotationContact& contact : event.contacts)
      contact.at = {contact.at.x + by.x, contact.at.y + by.y, contact.at.z + by.z};
  }

  SolidRotationOptions options;
  SpatialOptions stages;
  spatial::RotatingPair pair;
  bool moved = false;  ///< an operand is far from the origin, and moved beside it
  /// Facets of the pair beside the origin, the events of which are those of the given one: R(theta) (P + c) + Q + d is
  /// R(theta) P + Q moved by R(theta) c + d.
  spatial::RotatingFacets near;
  SolidRotationWork work;
};

namespace {

/// What numbers at roots may need: doubles hold products of seven coordinates.
constexpr int kMostBits = 140;

bool has(const spatial::SolidOperand& operand, const SolidFeature& f) {
  if (f.kind == SolidFeature::Kind::face)
    return std::find(operand.face.begin(), operand.face.end(), f.a) != operand.face.end();
  return std::max(f.a, f.b) < operand.vertices.size();
}

std::optional<Error> refusal(const Mesh& p, const Mesh& q, const TurnAxis& axis, const SolidRotationOptions& options) {
  if (axis == TurnAxis{}) return Error{ErrorCode::bad_rotation, "the axis is zero", {}};
  for (const std::int32_t a : axis)
    if (a < -(1 << 15) || a > 1 << 15) return Error{ErrorCode::bad_rotation, "the axis is longer than 2^15", {}};
  if (options.threads < 0)
    return Error{ErrorCode::out_of_range, "threads must be at least 0, not " + std::to_string(options.threads), {}};
  if (!(options.window >= 0 && options.window <= 1))
    return Error{ErrorCode::out_of_range, "windows are between 0 and 1 radian wide", {}};
  if (p.empty() || q.empty() || p.has_thin_parts() || q.has_thin_parts())
    return Error{
        ErrorCode::unsupported_operand, "operands of a turning sum are solids, without parts of no volume", {}};
  return std::nullopt;
}

}  // namespace

Result<SolidRotationEvents> SolidRotationEvents::create(const Mesh& p, const Mesh& q, const TurnAxis& axis,
                                                        const SolidRotationOptions& options) {
  if (std::optional<Error> error = refusal(p, q, axis, options)) return *std::move(error);
  const std::int32_t divisor = std::gcd(std::gcd(axis[0], axis[1]), axis[2]);
  auto state =
      std::make_unique<State>(p, q, TurnAxis{axis[0] / divisor, axis[1] / divisor, axis[2] / divisor}, options);
  int square_bits = 0;
  while ((std::int64_t{1} << square_bits) < state->pair.circle.square()) ++square_bits;
  if (std::max(state->near.pair.pair.p_positions.bits, state->near.pair.pair.q_positions.bits) + 2 * square_bits >
      kMostBits)
    return Error{ErrorCode::unsupported_operand,
                 "coordinates on their common grid, with the square of the axis twice, need more than 140 bits",
                 {}};
  return SolidRotationEvents(std::move(state));
}

SolidRotationEvents::SolidRotationEvents(std::unique_ptr<State> state) : state_(std::move(state)) {}
SolidRotationEvents::SolidRotationEvents(SolidRotationEvents&&) noexcept = default;
SolidRotationEvents& SolidRotationEvents::operator=(SolidRotationEvents&&) noexcept = default;
SolidRotationEvents::~SolidRotationEvents() = default;

const TurnAxis& SolidRotationEvents::axis() const { return state_->pair.circle.axis(); }
const SolidRotationWork& SolidRotationEvents::work() const { return state_->work; }

Result<SpatialSum> SolidRotationEvents::at(const AxisTurn& turn, const Progress& progress) const {
  SpatialOptions stages = state_->stages;
  stages.progress = progress;
  return spatial::guarded(
      [&] { return spatial::turned_sum(state_->pair, state_->pair.circle.position(turn), stages); });
}

std::uint64_t SolidRotationEvents::combinatorial_hash(const SpatialSum& sum) const {
  const auto check = [&](const SolidContact& c) {
    if (!has(state_->pair.operand(0), c.p) || !has(state_->pair.operand(1), c.q))
      throw std::invalid_argument("combinatorial_hash: a sum of other operands, which names features these have not");
  };
  for (const SpatialFace& f : sum.faces) check({f.p, f.q});
  for (const auto& contacts : sum.tight_face_contacts) check(contacts[0]);
  return spatial::shape_of(sum, [&](const SolidContact& c) { return spatial::plane_name(state_->pair, c); }).hash;
}

Result<std::vector<SolidRotationEvent>> SolidRotationEvents::events(const AxisTurn& a, const AxisTurn& b,
                                                                    const Progress& progress) const {
  return state_->list(a, b, false, progress);
}

Result<std::vector<SolidRotationEvent>> SolidRotationEvents::events_of_turn(const Progress& progress) const {
  return state_->list(AxisTurn::half_turn(), AxisTurn::half_turn(), true, progress);
}

Result<std::optional<SolidRotationEvent>> SolidRotationEvents::next_event(const AxisTurn& a, const AxisTurn& limit,
                                                                          const Progress& progress) const {
  return state_->first(a, limit, progress, false);
}

Result<std::optional<SolidRotationEvent>> SolidRotationEvents::next_topology_change(const AxisTurn& a,
                                                                                    const AxisTurn& limit,
                                                                                    const Progress& progress) const {
  return state_->first(a, limit, progress, true);
}

}  // namespace dymsum
