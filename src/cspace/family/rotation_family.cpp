#include "dymsum/rotation_family.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "base/poll.h"
#include "cspace/boundary/obstacle_state.h"
#include "cspace/family/slab_loops.h"
#include "dymsum/orientation.h"
#include "dymsum/orientation_sum.h"
#include "dymsum/planar_boolean.h"
#include "dymsum/planar_operand.h"
#include "dymsum/planar_sum.h"
#include "dymsum/progress.h"
#include "dymsum/region.h"
#include "planar/motion/operand_pair.h"
#include "planar/position/exact_source.h"
#include "planar/region/region.h"
#include "planar/result/planar_sum.h"
#include "planar/sum/minkowski_sum.h"

namespace dymsum::planar {
namespace {

// What lies in R(theta) P (+) Q at some angle of an interval, and what lies in it at all of them, on the safe side.

/// The sums are R(theta) `moves` (+) `stays`.
struct RotatedOperands {
  Region moves, stays;
};

constexpr std::size_t kMostOrientations = 4096;

double radius_of(const Region& region) {
  double radius = 0;
  for_each_chain(region.data(), [&](const std::vector<Point>& points) {
    for (const Point& v : points) radius = std::max(radius, std::hypot(v.x, v.y));
  });
  return radius * (1 + 0x1p-50);
}

/// An octagon about a disc, its vertices 1.083 radii away from the centre.
Region octagon(double radius) {
  // The slope of its sides is tan(pi / 8), rounded up, of a radius larger than what that and products lose.
  const double a = radius * (1 + 0x1p-40), b = a * 0.41421356237309515;
  return Region::create({{{{{a, -b}, {a, b}, {b, a}, {-b, a}, {-a, b}, {-a, -b}, {-b, -a}, {b, -a}}, {}}}, {}, {}})
      .value();
}

/// Orientations of an interval, and how far a point of the rotating operand is from where it stands at the nearest one.
struct Steps {
  std::vector<Orientation> orientations;
  double rho = 0;
};

Result<Steps> steps_of(const RotatedOperands& operands, const Orientation& a, const Orientation& b, double tolerance) {
  if (!(tolerance > 0) || !std::isfinite(tolerance))
    return Error{ErrorCode::out_of_range, "the tolerance must be positive, not " + std::to_string(tolerance), {}};
  if (a == b) return Steps{{a}, 0};
  constexpr double kCircle = 2 * std::numbers::pi, kCorner = 1.09;  // how far an octagon reaches, in radii
  double width = b.radians() - a.radians();
  if (width <= 0) width += kCircle;
  const double radius = radius_of(operands.moves), wanted = std::ceil(kCorner * radius * width / (1.9 * tolerance));
  if (!(wanted <= static_cast<double>(kMostOrientations)))
    return Error{ErrorCode::out_of_range,
                 "a tolerance of " + std::to_string(tolerance) + " takes more than " +
                     std::to_string(kMostOrientations) + " orientations",
                 {}};
  const auto count = std::max<std::size_t>(1, static_cast<std::size_t>(wanted));
  const double half = width / (2 * static_cast<double>(count)), off = half * 0x1p-8;
  Steps steps;
  for (std::size_t k = 0; k < count; ++k) {
    const double at = a.radians() + half * (2 * static_cast<double>(k) + 1);
    const Result<Orientation> theta = Orientation::nearest(at, std::max(off, Orientation::kAngularError));
    if (!theta) return theta.error();
    steps.orientations.push_back(*theta);
  }
  // A chord is shorter than its arc; angles are known within 2^-50, and sums of them err by as little.
  steps.rho = radius * (half + off + 0x1p-44);
  return steps;
}

/// sum_at(theta) for all orientations.
template <class SumAt>
Result<std::vector<PlanarSum>> sums_at(const Steps& steps, const Progress& progress, const SumAt& sum_at) {
  std::vector<PlanarSum> sums;
  for (const Orientation& theta : steps.orientations) {
    const double fraction = static_cast<double>(sums.size()) / static_cast<double>(steps.orientations.size());
    if (progress && !progress("orientations", fraction)) return cancelled();
    Result<PlanarSum> sum = sum_at(theta);
    if (!sum) return sum.error();
    sums.push_back(*std::move(sum));
  }
  return sums;
}

Region origin() { return Region::create({{}, {}, {Point{0, 0}}}).value(); }

SumOptions regular() {
  SumOptions options;
  options.semantics = Semantics::regular;
  return options;
}

RotatedOperands rotated_operands(const Region& p, const Region& q, bool p_moves, bool reflect_q) {
  const Region second = reflect_q ? negated(q) : q;
  return p_moves ? RotatedOperands{p, second} : RotatedOperands{second, p};
}

/// As RotationFamily::outer and inner. Between an orientation and the next ones no point of the rotating operand moves
/// by more than rho, so it stays in that operand grown by a disc of rho, and holds it shrunk by one. An octagon about
/// the disc stands for it. Cost: that of 1.1 r w / (2 tolerance) sums, r being how far the rotating operand reaches and
/// w the width of the interval in radians, and of a union of them.
Result<PlanarSum> outer_set(const RotatedOperands& operands, const Orientation& a, const Orientation& b,
                            double tolerance, const Progress& progress) {
  const Result<Steps> steps = steps_of(operands, a, b, tolerance);
  if (!steps) return steps.error();
  const auto sums = sums_at(*steps, progress, [&](const Orientation& theta) {
    const Result<PlanarSum> sum = rotated_sum(operands.moves, operands.stays, theta);
    return sum && steps->rho > 0 ? minkowski_sum(*sum, octagon(steps->rho)) : sum;
  });
  if (!sums) return sums.error();
  if (sums->size() == 1) return sums->front();
  return united(std::vector<PlanarOperand>(sums->begin(), sums->end()));
}

Result<PlanarSum> inner_set(const RotatedOperands& operands, const Orientation& a, const Orientation& b,
                            double tolerance, const Progress& progress) {
  const Result<Steps> steps = steps_of(operands, a, b, tolerance);
  if (!steps) return steps.error();
  const auto sums = sums_at(*steps, progress, [&](const Orientation& theta) {
    Result<PlanarSum> rotated = rotated_sum(operands.moves, origin(), theta, regular());
    if (rotated && steps->rho > 0) rotated = erode(*rotated, octagon(steps->rho), regular());
    return rotated ? minkowski_sum(*rotated, operands.stays, regular()) : rotated;
  });
  if (!sums) return sums.error();
  if (sums->size() == 1) return sums->front();
  return intersection(std::vector<PlanarOperand>(sums->begin(), sums->end()), regular());
}

/// The region moved, where that rounds nothing. Errors: unsupported_operand with the vertex.
Result<Region> translated_exactly(const Region& region, Point by) {
  std::optional<Point> rounded;
  const auto exact_sum = [](double a, double b) {
    const double sum = a + b, part = sum - a;
    return std::isfinite(sum) && (a - (sum - part)) + (b - part) == 0;
  };
  for_each_chain(region.data(), [&](const std::vector<Point>& points) {
    for (const Point& v : points)
      if (!exact_sum(v.x, by.x) || !exact_sum(v.y, by.y)) rounded = v;
  });
  if (!rounded) return translated(region, by.x, by.y);
  Error error{ErrorCode::unsupported_operand, "a vertex moved by the centre of rotation is no double", {}};
  error.evidence.x = rounded->x;
  error.evidence.y = rounded->y;
  return error;
}

}  // namespace
}  // namespace dymsum::planar

namespace dymsum {

using namespace planar;

class RotationFamily::State {
 public:
  State(CspaceObstacle made, std::shared_ptr<const OperandPair> pair, Region first, Region second, FamilyOptions given)
      : obstacle(std::move(made)),
        base(std::move(pair)),
        p(std::move(first)),
        q(std::move(second)),
        options(std::move(given)),
        loops(obstacle),
        positions(*ObstacleInternals::of(obstacle).base, obstacle),
        structured(p.touching_points().empty() && q.touching_points().empty() && !obstacle.may_have_tight_curves()) {}

  CspaceObstacle obstacle;
  std::shared_ptr<const OperandPair> base;  ///< of P and Q as contacts name them
  Region p, q;
  FamilyOptions options;
  SlabLoops loops;
  RotatedPositions positions;
  bool structured;  ///< slices are what patches say, and nothing else
  FamilyWork work;

  bool p_moves() const { return options.moving == MovingOperand::p; }
  /// A contact of the obstacle as one of P and Q.
  Contact named(const Contact& c) const {
    if (!p_moves()) return c;
    const bool of_obstacle = c.kind == Contact::Kind::edge_of_p;
    return {of_obstacle ? Contact::Kind::edge_of_q : Contact::Kind::edge_of_p, c.q, c.p};
  }
  PlanarSum in_slab(std::uint32_t slab, const Orientation& theta) const;

 private:
  SumVertex vertex(std::uint32_t patch, std::uint32_t follower, Rotor rotor, const ExactSource& source,
                   double& error) const;
};

namespace {

/// Whether a ring runs counter-clockwise: the corner at its smallest vertex bends as it does. In doubles by its area,
/// where that is larger than all errors.
bool is_counter_clockwise(const SumRing& ring, const ExactSource& source, double error) {
  const std::vector<SumVertex>& v = ring.vertices;
  double area = 0, length = 0, reach = 0;
  for (std::size_t k = 0; k < v.size(); ++k) {
    const Point a = v[k].at, b = v[(k + 1) % v.size()].at, o = v[0].at;
    area += (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
    length += std::abs(b.x - a.x) + std::abs(b.y - a.y);
    reach = std::max({reach, std::abs(a.x - o.x), std::abs(a.y - o.y)});
  }
  // Each position moves by its error, and what is summed has some roundings for each vertex.
  const double rounded = exact::kRoundoff * 16 * static_cast<double>(v.size()) * reach * (length + reach);
  if (std::abs(area) > 8 * error * (length + static_cast<double>(v.size()) * error) + rounded) return area > 0;
  const VertexOrder order(source, error);
  std::size_t least = 0;
  for (std::size_t k = 1; k < v.size(); ++k)
    if (order.compare(v[k], v[least]) < 0) least = k;
  const auto spot = [&](std::size_t k) { return make_spot(source.position(v[k % v.size()])); };
  return orientation(spot(least + v.size() - 1), spot(least), spot(least + 1)) > 0;
}

}  // namespace

SumVertex RotationFamily::State::vertex(std::uint32_t patch, std::uint32_t follower, Rotor rotor,
                                        const ExactSource& source, double& error) const {
  SumVertex v;
  v.in = named(obstacle.patches()[patch].contact);
  v.out = named(obstacle.patches()[follower].contact);
  const RotatedPositions::Corner& corner = positions.corner_of(patch);
  v.corner_p = p_moves() ? corner.q : corner.p;
  v.corner_q = p_moves() ? corner.p : corner.q;
  const RotatedPositions::Placed placed = positions.end(patch, follower, rotor);
  v.at = placed.at;
  if (placed.error < INFINITY) {
    error = std::max(error, placed.error);
    return v;
  }
  const ExactSource::Position at = source.position(v);
  v.at = {exact::round_to_double(at.x), exact::round_to_double(at.y)};
  error = std::max(error, exact::kRoundoff * std::max(std::abs(v.at.x), std::abs(v.at.y)) + exact::kSubnormal);
  return v;
}

PlanarSum RotationFamily::State::in_slab(std::uint32_t slab, const Orientation& theta) const {
  PlanarSum sum;
  const auto source = std::make_shared<FrameSource>(base, theta);
  exact_source(sum) = source;
  const SlabLoops::Loops found = loops.in(slab);
  const Rotor rotor = rotor_of(theta);
  std::vector<SumRing> rings;
  std::vector<std::uint8_t> outer;
  std::uint32_t first = 0;
  for (const std::uint32_t end : found.ends) {
    SumRing& ring = rings.emplace_back();
    for (std::uint32_t k = first; k < end; ++k)
      ring.vertices.push_back(
          vertex(found.patches[k], found.patches[k + 1 == end ? first : k + 1], rotor, *source, sum.at_error));
    first = end;
  }
  for (const SumRing& ring : rings) outer.push_back(is_counter_clockwise(ring, *source, sum.at_error));
  sum.parts = group_rings(std::move(rings), outer, *source, sum.at_error);
  canonicalize(sum.parts, *source, sum.at_error);
  return sum;
}

RotationFamily::RotationFamily(std::unique_ptr<const State> state) : state_(std::move(state)) {}
RotationFamily::RotationFamily(RotationFamily&&) noexcept = default;
RotationFamily& RotationFamily::operator=(RotationFamily&&) noexcept = default;
RotationFamily::~RotationFamily() = default;

Result<RotationFamily> RotationFamily::create(const Region& p, const Region& q, const FamilyOptions& options) {
  const Stopwatch watch;
  for (const Region* r : {&p, &q})
    if (!r->polylines().empty() || !r->points().empty())
      return Error{ErrorCode::unsupported_operand, "families are of operands without polylines and points", {}};
  // The obstacle is O (+) -R(theta) robot.
  const bool p_moves = options.moving == MovingOperand::p;
  const Region robot = p_moves ? negated(p) : options.reflect_q ? q : negated(q);
  const Region stays = !p_moves ? p : options.reflect_q ? negated(q) : q;
  ObstacleOptions made;
  made.progress = options.progress;
  made.memory = options.memory;
  Result<CspaceObstacle> obstacle = CspaceObstacle::create(robot, stays, made);
  if (!obstacle) return obstacle.error();
  PairOptions pair;
  pair.moved = p_moves ? 0 : 1;
  pair.reflect_q = options.reflect_q;
  Result<std::shared_ptr<const OperandPair>> base = pair_of_regions(p, q, pair);
  if (!base) return base.error();
  FamilyOptions at_rest = options;
  at_rest.progress = {};
  auto state = std::make_unique<State>(*std::move(obstacle), *std::move(base), p, q, std::move(at_rest));
  FamilyWork& work = state->work;
  work.events = work.visible = state->obstacle.angles().size();
  work.cells = std::max<std::uint64_t>(1, work.events);
  work.kept = state->structured ? work.cells : 0;
  work.names = state->obstacle.patches().size();
  work.bytes = state->loops.bytes();
  work.ms = watch.ms();
  return RotationFamily(std::move(state));
}

Result<RotationFamily> RotationFamily::create(const Region& p, const Region& q, Point centre,
                                              const FamilyOptions& options) {
  const bool p_moves = options.moving == MovingOperand::p;
  // R(theta)(P - c) + c: what c adds is added to the operand that stands still.
  const double sign = options.reflect_q && p_moves ? -1 : 1;
  const Result<Region> moves = translated_exactly(p_moves ? p : q, {-centre.x, -centre.y});
  const double own = options.reflect_q && !p_moves ? -1 : 1;
  const Result<Region> stays = translated_exactly(p_moves ? q : p, {sign * own * centre.x, sign * own * centre.y});
  if (!moves) return moves.error();
  if (!stays) return stays.error();
  return p_moves ? create(*moves, *stays, options) : create(*stays, *moves, options);
}

const Region& RotationFamily::p() const { return state_->p; }
const Region& RotationFamily::q() const { return state_->q; }
const FamilyOptions& RotationFamily::options() const { return state_->options; }
const std::vector<EventAngle>& RotationFamily::angles() const { return state_->obstacle.angles(); }
const FamilyWork& RotationFamily::work() const { return state_->work; }

std::optional<std::uint32_t> RotationFamily::cell_of(const Orientation& theta) const {
  return state_->obstacle.slab_of(theta);
}

Result<PlanarSum> RotationFamily::at(const Orientation& theta) const {
  const std::optional<std::uint32_t> slab = cell_of(theta);
  if (slab && state_->structured) return state_->in_slab(*slab, theta);
  SumOptions options;
  options.semantics = state_->options.semantics;
  return placed_sum(state_->base->placed(theta), options);
}

std::optional<EventAngle> RotationFamily::next(const Orientation& theta) const {
  if (angles().empty()) return std::nullopt;
  if (const std::optional<std::uint32_t> slab = cell_of(theta)) return angles()[(*slab + 1) % angles().size()];
  const ExactAngle at = exact_angle(theta);
  const auto& exact = ObstacleInternals::of(state_->obstacle).exact_angles;
  for (std::size_t k = 0; k < exact.size(); ++k)
    if (compare(exact[k], at) > 0) return angles()[k];
  return angles()[0];
}

std::vector<Lifetime> RotationFamily::lifetimes() const {
  std::vector<Lifetime> lives;
  const std::uint32_t cells = static_cast<std::uint32_t>(std::max<std::size_t>(1, angles().size()));
  for (const Patch& patch : state_->obstacle.patches()) {
    Lifetime life;
    life.feature = FamilyFeature::edge;
    life.in = life.out = state_->named(patch.contact);
    const bool always = patch.begin == Patch::kNone;
    life.first_cell = always ? 0 : patch.begin;
    life.last_cell = always ? cells - 1 : (patch.end + cells - 1) % cells;
    lives.push_back(life);
  }
  return lives;
}

namespace {

RotatedOperands operands_of(const Region& p, const Region& q, const FamilyOptions& options) {
  return rotated_operands(p, q, options.moving == MovingOperand::p, options.reflect_q);
}

}  // namespace

Result<PlanarSum> RotationFamily::outer(const Orientation& a, const Orientation& b, double tolerance) const {
  return outer_set(operands_of(state_->p, state_->q, state_->options), a, b, tolerance, {});
}

Result<PlanarSum> RotationFamily::inner(const Orientation& a, const Orientation& b, double tolerance) const {
  return inner_set(operands_of(state_->p, state_->q, state_->options), a, b, tolerance, {});
}

Result<PlanarSum> outer_rotated_sum(const Region& p, const Region& q, const Orientation& a, const Orientation& b,
                                    double tolerance, const FamilyOptions& options) {
  return outer_set(operands_of(p, q, options), a, b, tolerance, options.progress);
}

Result<PlanarSum> inner_rotated_sum(const Region& p, const Region& q, const Orientation& a, const Orientation& b,
                                    double tolerance, const FamilyOptions& options) {
  return inner_set(operands_of(p, q, options), a, b, tolerance, options.progress);
}

}  // namespace dymsum
