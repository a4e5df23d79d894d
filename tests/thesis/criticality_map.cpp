#include "thesis/criticality_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "spatial/convex/convex_sum.h"
#include "spatial/convex/exact_positions.h"
#include "spatial/convex/facet_corners.h"
#include "spatial/gauss/overlay.h"
#include "spatial/sum/spatial_sum.h"
#include "thesis/critical_angles.h"
#include "thesis/structure_store.h"

namespace dymsum {

using exact::Big;
using exact::BigInteger;
using exact::BigRational;
using exact::QuadraticRoot;
using spatial::Overlay;
using spatial::Polytope;
using spatial::RelativeMap;
using spatial::RotationEvent;
using spatial::RotationForms;

namespace {

QuadraticRoot quarter(int k) {
  return QuadraticRoot::rational(Big::from_int64(k == 0 ? 0 : k == 3 ? -1 : 1), Big::from_int64(k == 2 ? 0 : 1));
}

/// (u : v) of a turn strictly inside the interval from a to b, a < b as turns, or from a to the full turn when b is
/// null. The turns t = 0, 1, infinity, -1 split the circle into parts in which t or 1 / t is at most 1.
std::array<BigInteger, 2> turn_between(const QuadraticRoot& a, const QuadraticRoot* b) {
  for (int k = 1; k < 4; ++k) {
    const QuadraticRoot stop = quarter(k);
    const int from = exact::compare_turns(a, stop);
    if (from >= 0) continue;
    const int to = b != nullptr ? exact::compare_turns(stop, *b) : -1;
    if (to < 0)
      return k == 1   ? std::array<BigInteger, 2>{1, 1}
             : k == 2 ? std::array<BigInteger, 2>{0, 1}
                      : std::array<BigInteger, 2>{1, -1};
    break;  // both in the part before this stop
  }
  const bool upright = exact::compare_turns(a, quarter(1)) >= 0 && exact::compare_turns(a, quarter(3)) < 0;
  if (upright) {  // 1 / t falls, and is zero at infinity
    const BigRational x = exact::between(b->reciprocal(), a.reciprocal());
    const BigInteger num = numerator(x), den = denominator(x);
    return {num, den};
  }
  const QuadraticRoot zero = quarter(0);
  const BigRational x = exact::between(a, b != nullptr ? *b : zero);
  return {BigInteger(denominator(x)), BigInteger(numerator(x))};
}

}  // namespace

class CriticalityMap::State {
 public:
  State(Polytope a, Polytope b, std::array<std::int64_t, 3> axis, std::shared_ptr<const spatial::ConvexOperands> source)
      : p(std::move(a)), q(std::move(b)), forms(p, q, axis), source(std::move(source)) {}
  State(const State&) = delete;  // forms refers to p and q
  State& operator=(const State&) = delete;

  Polytope p, q;
  RotationForms forms;
  std::shared_ptr<const spatial::ConvexOperands> source;
  std::vector<RotationEvent> events;
  spatial::StructureStore structures;
  CriticalityStats stats;

  std::size_t intervals() const { return std::max<std::size_t>(1, events.size()); }
  std::array<BigInteger, 4> quaternion(const std::array<BigInteger, 2>& turn) const {
    const auto& d = forms.axis();
    return {turn[0], turn[1] * d[0], turn[1] * d[1], turn[1] * d[2]};
  }
  std::array<BigInteger, 2> turn_inside(std::size_t i) const;
  std::optional<QuadraticRoot> turn_of(const Rotation& rotation) const;
  std::size_t interval(const QuadraticRoot& turn) const;
  bool store(const Progress& progress);
};

std::array<BigInteger, 2> CriticalityMap::State::turn_inside(std::size_t i) const {
  if (events.empty()) return {1, 0};
  const QuadraticRoot a = events[i].root(forms);
  if (i + 1 < events.size()) {
    const QuadraticRoot b = events[i + 1].root(forms);
    return turn_between(a, &b);
  }
  // Through zero: zero itself unless the first angle is zero.
  if (exact::compare_turns(quarter(0), events[0].root(forms)) < 0) return {1, 0};
  return turn_between(a, nullptr);
}

/// The turn about the axis as a number t, or nothing for rotations about other axes.
std::optional<QuadraticRoot> CriticalityMap::State::turn_of(const Rotation& rotation) const {
  const auto [w, x, y, z] = rotation.quaternion();
  const auto& d = forms.axis();
  // 2^30 2^15 each.
  if (y * d[2] != z * d[1] || z * d[0] != x * d[2] || x * d[1] != y * d[0]) return std::nullopt;
  const int k = d[0] != 0 ? 0 : d[1] != 0 ? 1 : 2;
  return QuadraticRoot::rational(Big::from_int64(std::array{x, y, z}[k] / d[k]), Big::from_int64(w));
}

std::size_t CriticalityMap::State::interval(const QuadraticRoot& turn) const {
  const double angle = forms.angle(turn);
  const auto after = std::partition_point(events.begin(), events.end(), [&](const RotationEvent& e) {
    const double ahead = e.angle - angle;
    if (std::abs(ahead) > 2 * RotationForms::kAngleError) return ahead < 0;
    return exact::compare_turns(e.root(forms), turn) <= 0;
  });
  return after == events.begin() ? intervals() - 1 : static_cast<std::size_t>(after - events.begin()) - 1;
}

bool CriticalityMap::State::store(const Progress& progress) {
  Overlay overlay(p, q);
  std::vector<std::uint32_t> words;
  for (std::size_t i = 0; i < intervals(); ++i) {
    if (i % 64 == 0 && progress && !progress("structures", static_cast<double>(i) / static_cast<double>(intervals())))
      return false;
    const RelativeMap map = RelativeMap::turned(quaternion(turn_inside(i)));
    if (i == 0) {
      overlay.build(map);
    } else {
      overlay.update(map);
    }
    overlay.capture(words);
    structures.push(words);
  }
  structures.shrink();
  return true;
}

Result<CriticalityMap> CriticalityMap::create(const Mesh& p, const Mesh& q, std::array<std::int32_t, 3> axis,
                                              const Progress& progress) {
  const std::int64_t divisor = std::gcd(std::gcd<std::int64_t, std::int64_t>(axis[0], axis[1]), std::int64_t{axis[2]});
  if (divisor == 0) return Error{ErrorCode::bad_rotation, "a rotation needs an axis that is not zero", {}};
  std::array<std::int64_t, 3> d;
  for (int k = 0; k < 3; ++k) {
    d[k] = axis[k] / divisor;
    if (std::abs(d[k]) > std::int64_t{1} << kAxisBits)
      return Error{ErrorCode::bad_rotation, "a component of the axis is beyond 2^15", {}};
  }
  Result<Polytope> a = spatial::make_polytope(p), b = spatial::make_polytope(q);
  if (!a) return a.error();
  if (!b) return b.error();
  auto source = std::make_shared<spatial::ConvexOperands>();
  source->operand[0].vertices = p.vertices();
  source->operand[1].vertices = q.vertices();
  auto state = std::make_shared<State>(std::move(a).value(), std::move(b).value(), d, std::move(source));

  const Error cancelled{ErrorCode::cancelled, "the critical angles were not wanted any more", {}};
  spatial::RotationEventCounts counts;
  auto events = spatial::find_rotation_events(state->forms, counts, [&](std::size_t done, std::size_t all) {
    return !progress || progress("critical angles", static_cast<double>(done) / static_cast<double>(all));
  });
  if (!events) return cancelled;
  state->events = std::move(*events);
  state->events.shrink_to_fit();
  if (!state->store(progress)) return cancelled;
  state->stats = {counts.pairs,
                  counts.persistent,
                  counts.meetings,
                  counts.exact_pairs,
                  counts.exact_orders,
                  state->events.size() * sizeof(RotationEvent),
                  state->structures.key_bytes(),
                  state->structures.difference_bytes(),
                  state->structures.full_bytes()};
  return CriticalityMap(std::move(state));
}

CriticalityMap::CriticalityMap(std::shared_ptr<const State> state) : state_(std::move(state)) {}

std::size_t CriticalityMap::size() const { return state_->events.size(); }
double CriticalityMap::angle(std::size_t i) const { return state_->events.at(i).angle; }
const CriticalityStats& CriticalityMap::stats() const { return state_->stats; }

CriticalAngle CriticalityMap::exact_angle(std::size_t i) const {
  const RotationEvent& e = state_->events.at(i);
  const exact::Quadratic q = state_->forms.form(e.op, e.face, 2 * e.edge);
  const BigInteger divisor = gcd(gcd(q[0].value(), q[1].value()), q[2].value());
  CriticalAngle angle;
  angle.radians = e.angle;
  for (int k = 0; k < 3; ++k) angle.coefficients[k] = BigInteger(q[k].value() / divisor).str();
  angle.slope = e.slope;
  const Polytope &own = state_->forms.poly(e.op), &other = state_->forms.poly(1 - e.op);
  angle.face = spatial::face_feature(own, e.face);
  angle.edge = spatial::edge_feature(other, other.origin[2 * e.edge], other.target(2 * e.edge));
  angle.face_of_p = e.op == 0;
  return angle;
}

std::size_t CriticalityMap::bytes() const {
  const State& s = *state_;
  std::size_t total =
      sizeof(s) + s.p.bytes() + s.q.bytes() + s.stats.angle_bytes + s.stats.key_bytes + s.stats.difference_bytes;
  for (const spatial::ConvexOperands::Operand& o : s.source->operand) total += o.bytes();
  return total;
}

Rotation CriticalityMap::near(double radians) const {
  if (!std::isfinite(radians)) throw std::invalid_argument("CriticalityMap::near: the angle is not finite");
  const auto& d = state_->forms.axis();
  const double most = static_cast<double>(std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}));
  // (u : v) as long as fits; rounding v moves the quaternion by |axis| / 2.
  const double u = std::cos(radians / 2), v = std::sin(radians / 2) / state_->forms.axis_length();
  const double scale = 0x1p30 / std::max(std::abs(u), most * std::abs(v));
  const auto w = static_cast<std::int64_t>(std::trunc(scale * u)), k = static_cast<std::int64_t>(std::trunc(scale * v));
  // The larger of |w| and most |k| is within 2^15 of 2^30, so that not all are 0; neither is above it, as they are
  // integers and scale u and most scale v no more than 2^30 (1 + 2^-50).
  return *Rotation::of(w, k * d[0], k * d[1], k * d[2]);
}

std::optional<Rotation> CriticalityMap::inside(std::size_t i) const {
  const std::array<BigInteger, 2> turn = state_->turn_inside(i);
  const std::array<BigInteger, 4> q = state_->quaternion(turn);
  std::array<std::int64_t, 4> c;
  for (int k = 0; k < 4; ++k) {
    if (abs(q[k]) > BigInteger(1) << Rotation::kBits) return std::nullopt;
    c[k] = static_cast<std::int64_t>(q[k]);
  }
  return *Rotation::of(c[0], c[1], c[2], c[3]);
}

Result<std::size_t> CriticalityMap::interval(const Rotation& rotation) const {
  const auto turn = state_->turn_of(rotation);
  if (!turn) return Error{ErrorCode::bad_rotation, "the rotation is not about the axis of the map", {}};
  return state_->interval(*turn);
}

Result<std::size_t> CriticalityMap::facet_count(const Rotation& rotation) const {
  const Result<std::size_t> i = interval(rotation);
  if (!i) return i.error();
  std::vector<std::uint32_t> words;
  state_->structures.read(*i, words);
  const std::size_t faces = state_->p.face_count() + state_->q.face_count();
  std::size_t count = faces;
  for (std::size_t k = faces; k < words.size(); k += 2) count += words[k] != spatial::kNoCrossing;
  return count;
}

// The structure of an interval is right at its ends too: extreme vertices stay extreme up to there, crossings that are
// proper there are proper before, and those that are not any more are left out by `assemble`, which looks at the
// rotation itself. So are those that persistent coincidences make improper everywhere.
Result<SpatialSum> CriticalityMap::at(const Rotation& rotation) const {
  const Result<std::size_t> i = interval(rotation);
  if (!i) return i.error();
  std::vector<std::uint32_t> words;
  state_->structures.read(*i, words);
  Overlay overlay(state_->p, state_->q);
  const SolidPose pose{rotation, {}};
  overlay.restore(RelativeMap(spatial::PoseFactors::of(pose), {}), words);
  return spatial::sum_of_overlay(overlay, state_->source, pose, {});
}

}  // namespace dymsum
