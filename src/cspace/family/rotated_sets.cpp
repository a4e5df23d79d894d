#include "cspace/family/rotated_sets.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "base/poll.h"
#include "dymsum/orientation_sum.h"
#include "dymsum/planar_boolean.h"
#include "dymsum/planar_operand.h"
#include "planar/region/region.h"

namespace dymsum::planar {
namespace {

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

}  // namespace

RotatedOperands rotated_operands(const Region& p, const Region& q, bool p_moves, bool reflect_q) {
  const Region second = reflect_q ? negated(q) : q;
  return p_moves ? RotatedOperands{p, second} : RotatedOperands{second, p};
}

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

}  // namespace dymsum::planar
