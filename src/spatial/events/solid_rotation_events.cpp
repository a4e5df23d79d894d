#include "dymsum/solid_rotation_events.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>

#include "base/poll.h"
#include "spatial/events/plane_names.h"
#include "spatial/events/root_contacts.h"
#include "spatial/motion/beside_origin.h"
#include "spatial/moving/moving_solid_sum.h"
#include "spatial/moving/sum_shape.h"

namespace dymsum::spatial {
namespace {

// Walks counter-clockwise through a range of angles, window by window: the angles at which something meets on the
// boundary, in order, and what changes there.

/// What is made of a pair once, for all walks.
struct RotatingFacets {
  explicit RotatingFacets(RotatingPair of) : pair(std::move(of)), maps(pair), balls(pair) {}
  RotatingFacets(const RotatingFacets&) = delete;  // the maps refer to the pair
  RotatingFacets& operator=(const RotatingFacets&) = delete;

  RotatingPair pair;
  GaussMaps maps;
  PairOfBalls balls;
};

/// A path from a position of the circle to another one, both included unless `past`: then not the first one. A whole
/// turn from a position back to it where `whole`.
struct RotationPath {
  ChartPosition from, to;
  bool past = false, whole = false;
};

/// The exact sum at a position of the circle.
SpatialSum turned_sum(const RotatingPair& pair, const ChartPosition& at, const SpatialOptions& options);

using exact::AlgebraicRoot;

using exact::BigRational;

/// Windows within which directions and positions move by some part of an edge are cheapest.
double window_of(const RotatingPair& pair) {
  double reach = 0, edges = 0;
  std::size_t count = 0;
  const TurnAxis& axis = pair.circle.axis();
  const double l = pair.circle.length();
  const Vec3 a{axis[0] / l, axis[1] / l, axis[2] / l};
  for (const Vec3 v : pair.positions[pair.turning]) reach = std::max(reach, length(cross(a, v)));
  for (int op = 0; op < 2; ++op)
    for (const Wedge& w : pair.operand(op).wedges)
      edges += length(pair.positions[op][w.to] - pair.positions[op][w.from]), ++count;
  if (reach == 0 || count == 0) return 0.25;
  return std::clamp(0.06 * edges / static_cast<double>(count) / reach, 1e-4, 0.2);
}

/// The multiple of a power of two near x, with some bits more than |x| / grain has.
BigRational dyadic(double x, double grain) {
  const double unit = std::ldexp(1.0, std::ilogb(grain) - 8);
  return exact::exact_value(std::nearbyint(x / unit) * unit);
}

class RotationWalk {
 public:
  RotationWalk(const RotatingFacets& of, const SolidRotationOptions& options, SolidRotationWork& work,
               const Progress& progress)
      : of_(of), pair_(of.pair), options_(options), work_(work), progress_(progress) {
    stages_.tight = options.tight, stages_.threads = options.threads;
    if (progress) stages_.progress = [this](std::string_view, double) { return progress_("events", fraction_); };
    step_ = options.window > 0 ? options.window : window_of(pair_);
  }

  void run(const RotationPath& path, const std::function<bool(SolidRotationEvent&)>& take) {
    const ChartPosition &a = path.from, &b = path.to;
    const RotationCircle& circle = pair_.circle;
    const auto radians = [&](const ChartPosition& p) { return circle.radians(p.chart, exact::round_to_double(p.t)); };
    constexpr double kTurn = 2 * std::numbers::pi;
    double all = radians(b) - radians(a);
    while (all < 0) all += kTurn;
    while (all >= kTurn) all -= kTurn;
    if (a.chart == b.chart && a.t == b.t) all = path.whole ? kTurn : 0;
    // The step in t of a chart; angles turn by at most 2 |axis| as much. The walk begins a little before a.
    const double step = step_ / 2 / circle.length();
    ChartPosition low{a.chart, dyadic(exact::round_to_double(a.t) - 0.3 * step, step)};
    double done = radians(low) - radians(a);
    for (bool first = true;; first = false) {
      fraction_ = std::clamp(done / (all + step_), 0.0, 1.0);
      query();
      RotationRange range{low.chart, low.t, dyadic(exact::round_to_double(low.t) + step, step)};
      const std::optional<BigRational> to = seen_in(range.chart, b);
      const double ahead = to ? circle.radians(range.chart, exact::round_to_double(*to)) - radians(low) : 0;
      // A turn or more may lead from a to b: the way that is left determines whether it ends here.
      const auto ends = [&] { return to && *to >= range.low && *to < range.high && std::abs(done + ahead - all) < 1; };
      const auto wanted = [&] {
        return Wanted{first ? std::optional(a.t) : std::nullopt, ends() ? to : std::nullopt, path.past};
      };
      std::vector<Angle> angles = angles_in(range, wanted());
      for (int k = 1; !angles.empty() && exact::compare(angles.back().root, range.high) == 0; ++k) {
        range.high = range.low + dyadic(step * (1 - k / (37.0 + 8 * k)), step / std::ldexp(1.0, std::min(k, 30)));
        angles = angles_in(range, wanted());
      }
      before_.reset();
      for (std::size_t i = 0; i < angles.size(); ++i) {
        if (!angles[i].wanted) {
          before_.reset();
          continue;
        }
        std::optional<SolidRotationEvent> event = event_at(range, angles, i);
        if (!event) continue;
        ++work_.events;
        if (!take(*event)) return;
      }
      if (ends()) return;
      done += radians({range.chart, range.high}) - radians(low);
      low = {range.chart, range.high};
      if (range.high > circle.reach(range.chart)) low = {1 - range.chart, *seen_in(1 - range.chart, low)};
    }
  }

 private:
  struct Angle {
    AlgebraicRoot root;
    bool wanted = false;  ///< others are known by their roots alone, to choose places between
    std::vector<SolidRotationContact> contacts;
  };
  /// The angles of a window that are requested: from `low` (open where `past`) to `high`, where they are.
  struct Wanted {
    std::optional<BigRational> low, high;
    bool past = false;
    bool holds(const AlgebraicRoot& root) const {
      if (low && exact::compare(root, *low) < (past ? 1 : 0)) return false;
      return !high || exact::compare(root, *high) <= 0;
    }
  };

  void query() {
    if (progress_ && !progress_("events", fraction_)) throw Cancelled{};
  }

  /// A position's t in a chart; nothing for infinity.
  std::optional<BigRational> seen_in(int chart, const ChartPosition& p) const {
    if (p.chart == chart) return p.t;
    if (p.t.is_zero()) return std::nullopt;
    return BigRational(-1 / (p.t * pair_.circle.square()));
  }

  std::optional<SolidRotationEvent> event_at(const RotationRange& range, std::vector<Angle>& angles, std::size_t i) {
    SolidRotationEvent event = event_of(range.chart, angles[i]);
    if (!options_.changes) return event;
    look(range, angles, i, event);
    const bool shown = std::any_of(event.contacts.begin(), event.contacts.end(), [](const SolidRotationContact& c) {
      return c.kind != SolidRotationContact::Kind::normal_on_arc;
    });
    if (!event.visible && !shown) return std::nullopt;
    return event;
  }

  std::vector<Angle> angles_in(const RotationRange& range, const Wanted& wanted) {
    const RotationWindow window(pair_, of_.maps, range);
    const WindowMeetings found = meetings_in(pair_, window, work_, [this] { query(); });
    if (!found.parts.empty()) return angles_in_parts(range, found.parts, wanted);
    std::vector<MeetingsAt> at(found.angles.size());
    for (const RootMeeting& m : found.meetings) at[m.angle].all.push_back(m.meeting);
    std::vector<Angle> angles;
    for (const std::uint32_t a : found.angles.ascending()) {
      if (at[a].all.empty()) continue;
      at[a].crowded = found.cells.is_crowded(a);
      Angle angle{found.angles[a], wanted.holds(found.angles[a]), {}};
      if (angle.wanted)
        angle.contacts = contacts_at(pair_, of_.balls, window, angle.root, at[a], work_, [this] { query(); });
      if (!angle.wanted || !angle.contacts.empty()) angles.push_back(std::move(angle));
    }
    return angles;
  }

  /// The angles in parts of a window. Of a part without wanted angles one angle is listed, no event's: the end of it
  /// that is nearer to wanted ones.
  std::vector<Angle> angles_in_parts(const RotationRange& range, std::vector<BigRational> ends, const Wanted& wanted) {
    std::vector<Angle> angles;
    ends.push_back(range.high);
    RotationRange part{range.chart, range.low, range.low};
    for (BigRational& end : ends) {
      part.low = std::move(part.high), part.high = std::move(end);
      const auto leave_out = [&](const BigRational& t) {
        const AlgebraicRoot at = AlgebraicRoot::rational(t);
        if (angles.empty() || exact::compare(angles.back().root, at) < 0) angles.push_back({at, false, {}});
      };
      if (wanted.low && part.high < *wanted.low) leave_out(part.high);
      else if (wanted.high && part.low > *wanted.high) leave_out(part.low);
      else
        for (Angle& angle : angles_in(part, wanted)) angles.push_back(std::move(angle));
    }
    return angles;
  }

  SolidRotationEvent event_of(int chart, Angle& angle) const {
    SolidRotationEvent event;
    const AlgebraicRoot& root = angle.root;
    event.approx = std::remainder(pair_.circle.radians(chart, root.approx()), 2 * std::numbers::pi);
    if (event.approx == -std::numbers::pi) event.approx = std::numbers::pi;
    AlgebraicTurn& at = event.parameter;
    if (const auto t = exact::rational_value(root)) at.exact = pair_.circle.turn({chart, *t});
    for (int k = 0; k <= root.polynomial().degree(); ++k) at.polynomial.push_back(root.polynomial()[k].value().str());
    at.t_low = root.low(), at.t_high = root.high(), at.opposite = chart == 1;
    event.contacts = angle.contacts, event.kind = angle.contacts.back().kind;
    return event;
  }

  void look(const RotationRange& range, const std::vector<Angle>& angles, std::size_t i, SolidRotationEvent& event) {
    const AlgebraicRoot& root = angles[i].root;
    const auto position = [&](const AlgebraicRoot& a, const AlgebraicRoot& b) {
      return ChartPosition{range.chart, exact::between(a, b)};
    };
    if (!before_) before_ = shape(position(i == 0 ? AlgebraicRoot::rational(range.low) : angles[i - 1].root, root));
    std::optional<SumShape> at;
    if (event.parameter.exact) at = shape(pair_.circle.position(*event.parameter.exact));
    SumShape after =
        shape(position(root, i + 1 < angles.size() ? angles[i + 1].root : AlgebraicRoot::rational(range.high)));
    const ShapeChange change = change_of(*before_, at, after);
    event.visible = change.visible, event.topology = change.topology;
    before_ = std::move(after);
  }

  SumShape shape(const ChartPosition& at) {
    ++work_.sums;
    return shape_of(turned_sum(pair_, at, stages_), [&](const SolidContact& c) { return plane_name(pair_, c); });
  }

  const RotatingFacets& of_;
  const RotatingPair& pair_;
  const SolidRotationOptions& options_;
  SolidRotationWork& work_;
  const Progress& progress_;
  SpatialOptions stages_;
  double step_ = 0, fraction_ = 0;
  std::optional<SumShape> before_;
};

SpatialSum turned_sum(const RotatingPair& pair, const ChartPosition& at, const SpatialOptions& options) {
  ExactPose turned = pair.circle.pose(at), still = ExactPose::of({});
  if (pair.turning == 1) std::swap(turned, still);
  return fresh_sum(pair.pair, posed_space(pair.pair, std::move(turned), std::move(still)), options);
}

/// Calls take(event) for the events of a path in order, until it says false. Throws Cancelled, and
/// std::invalid_argument where sums need more than 8,192 bits.
void walk_angles(const RotatingFacets& of, const RotationPath& path, const SolidRotationOptions& options,
                 SolidRotationWork& work, const Progress& progress,
                 const std::function<bool(SolidRotationEvent&)>& take) {
  RotationWalk(of, options, work, progress).run(path, take);
}

}  // namespace
}  // namespace dymsum::spatial

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
