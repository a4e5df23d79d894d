// Depth and distance of two solids of any shape.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "depth/boundary_distance.h"
#include "depth/nearest_positions.h"
#include "depth/ray_exit.h"
#include "dymsum/penetration_depth.h"
#include "exact/big.h"

namespace dymsum {
namespace {

using depth::DepthOperands;
using depth::DepthProbe;
using depth::ExactFrame;
using depth::FacetView;
using depth::RationalVector;
using exact::BigRational;
using spatial::Vec3;

RationalVector exact_vector(const RationalPoint3& v) {
  return {exact::exact_value(v.x), exact::exact_value(v.y), exact::exact_value(v.z)};
}
/// Requires finite coordinates.
RationalPoint3 fractions_of(const Point3& v) { return {*Rational::of(v.x), *Rational::of(v.y), *Rational::of(v.z)}; }

bool is_finite_vector(const Point3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

FacetView view_from(const DepthOperands& o, const RationalVector& at) {
  const Vec3 from = o.scaled(at);
  const double size = std::max({std::abs(from.x), std::abs(from.y), std::abs(from.z), 1.0});
  return {o, from, size * 0x1p-32};
}

SolidDistance distance_with(const DepthOperands& o, std::vector<RationalVector> moves, const RationalVector& from,
                            bool overlapping) {
  SolidDistance result;
  const RationalVector& v = moves.front();
  const BigRational square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  result.meeting = overlapping ? Meeting::overlapping : square == 0 ? Meeting::touching : Meeting::apart;
  result.squared = exact::to_rational(square);
  result.distance = exact::root_to_double(square);
  result.at_least = result.distance;
  result.ways = depth::ways_of(std::move(moves), from, o.touching.get());
  return result;
}

}  // namespace

bool operator==(const SolidDistance& a, const SolidDistance& b) {
  const auto same_sense = [](const SolidWay& x, const SolidWay& y) {
    return x.move == y.move && x.direction == y.direction && x.contacts == y.contacts;
  };
  return a.meeting == b.meeting && a.squared == b.squared && a.distance == b.distance && a.complete == b.complete &&
         a.at_least == b.at_least && std::equal(a.ways.begin(), a.ways.end(), b.ways.begin(), b.ways.end(), same_sense);
}

Result<SolidDepth> SolidDepth::create(const Mesh& p, const Mesh& q, const DepthOptions& options) {
  if (options.threads < 0)
    return Error{ErrorCode::out_of_range, "threads must be at least 0, not " + std::to_string(options.threads), {}};
  Result<std::shared_ptr<const DepthOperands>> operands = depth::depth_operands(p, q, options);
  if (!operands) return operands.error();
  return SolidDepth(*std::move(operands));
}

SolidDepth::SolidDepth(std::shared_ptr<const DepthOperands> operands)
    : operands_(std::move(operands)), probe_(std::make_unique<DepthProbe>(*operands_)) {}
SolidDepth::SolidDepth(const SolidDepth& other) : SolidDepth(other.operands_) {}
SolidDepth& SolidDepth::operator=(const SolidDepth& other) { return *this = SolidDepth(other); }
SolidDepth::SolidDepth(SolidDepth&&) noexcept = default;
SolidDepth& SolidDepth::operator=(SolidDepth&&) noexcept = default;
SolidDepth::~SolidDepth() = default;

std::size_t SolidDepth::facet_count() const { return operands_->facets.size(); }

SolidDistance SolidDepth::at(Point3 q_moved_by, double time_limit) {
  if (!is_finite_vector(q_moved_by)) throw std::invalid_argument("SolidDepth::at: the translation is not finite");
  return at(fractions_of(q_moved_by), time_limit);
}

template <std::same_as<RationalPoint3> Move>
SolidDistance SolidDepth::at(const Move& q_moved_by, double time_limit) {
  if (!(time_limit >= 0)) throw std::invalid_argument("SolidDepth::at: the time limit is below 0");
  const DepthOperands& o = *operands_;
  const RationalVector from = exact_vector(q_moved_by);
  FacetView view = view_from(o, from);
  view.balls = probe_->balls();
  const bool overlapping = probe_->provably_overlaps(view.from, view.slack) || probe_->overlaps(from);
  if (o.engine == DepthEngine::boundary)
    return distance_with(o, depth::nearest_on_boundary(*o.sum, from), from, overlapping);
  const ExactFrame frame(o.p.vertices, o.q.vertices, o.exponent, from);
  // Of convex solids the nearest facet is the answer on both sides of it.
  const bool covers = overlapping && !o.convex;
  const depth::NearestPositions found = nearest_positions(view, frame, *probe_, covers, time_limit);
  if (found.all.empty()) {
    SolidDistance result;
    result.meeting = overlapping ? Meeting::overlapping : Meeting::apart;
    result.complete = false;
    result.distance = std::ldexp(found.at_most, o.scale), result.at_least = std::ldexp(found.at_least, o.scale);
    result.work = found.work;
    return result;
  }
  std::vector<RationalVector> moves;
  for (const depth::ExactPosition& x : found.all) moves.push_back(frame.relative(x));
  SolidDistance result = distance_with(o, std::move(moves), from, overlapping);
  result.work = found.work;
  return result;
}

template SolidDistance SolidDepth::at(const RationalPoint3&, double);

Rational SolidDepth::along(Point3 q_moved_by, Point3 direction) {
  if (!is_finite_vector(q_moved_by) || !is_finite_vector(direction))
    throw std::invalid_argument("SolidDepth::along: wants finite vectors");
  return along(fractions_of(q_moved_by), fractions_of(direction));
}

template <std::same_as<RationalPoint3> Move>
Rational SolidDepth::along(const Move& q_moved_by, const Move& direction) {
  if (direction == RationalPoint3{}) throw std::invalid_argument("SolidDepth::along: wants a direction");
  const DepthOperands& o = *operands_;
  const RationalVector from = exact_vector(q_moved_by);
  if (!probe_->overlaps(from)) return 0;
  const ExactFrame frame(o.p.vertices, o.q.vertices, o.exponent, from);
  return exact::to_rational(depth::exit_along(view_from(o, from), frame, *probe_, exact_vector(direction), from));
}
template Rational SolidDepth::along(const RationalPoint3&, const RationalPoint3&);

}  // namespace dymsum
