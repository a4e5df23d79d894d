#include "spatial/convex/nearest_places.h"

#include <algorithm>
#include <cmath>

#include "exact/rounding_bound.h"
#include "spatial/gauss/relative_map.h"

namespace dymsum::spatial {
namespace {

using base::DoublePair;

/// Of a coordinate, times the sizes of its terms: a matrix entry is a quotient, times a quotient (3); times a
/// coordinate (1); three terms are added (2), then two coordinates (1). Beyond first order, and for the sizes, which
/// are added up in doubles, once more as much.
constexpr double kPlaceError = 2 * (3 + 1 + 2 + 1) * base::kPairError;
/// Coordinates of these sizes neither overflow nor lose error terms: factors are within 2^64 and 2^-64, entries of
/// rotations that are not zero at least 2^-62.
constexpr double kSmallest = 0x1p-400, kLargest = 0x1p400;

DoublePair pair_of(const exact::BigInteger& v) {
  const double high = exact::round_to_double(exact::BigRational(v));
  return {high, exact::round_to_double(exact::BigRational(v - exact::BigInteger(high)))};
}
DoublePair pair_of(std::int64_t v) {
  const auto high = static_cast<double>(v / 4);  // below 2^61, so that what is left is an integer of this type
  return base::exact_sum(4 * high, static_cast<double>(v - 4 * static_cast<std::int64_t>(high)));
}

std::array<DoublePair, 9> matrix_of(const SolidPose& pose) {
  const std::array<std::int64_t, 9> n = pose.rotation.matrix();
  const DoublePair norm = pair_of(pose.rotation.norm());
  std::array<DoublePair, 9> m;
  for (std::size_t k = 0; k < 9; ++k) m[k] = n[k] == 0 ? DoublePair{} : pair_of(n[k]) / norm;
  const PoseFactors factors = PoseFactors::of(pose);
  if (!factors.scaled) return m;
  for (std::size_t k = 0; k < 9; ++k) m[k] = m[k] * (pair_of(factors.num[k % 3]) / pair_of(factors.den[k % 3]));
  return m;
}

bool is_ordinary(const Point3& p) {
  for (const double c : {p.x, p.y, p.z})
    if (c != 0 && !(std::abs(c) >= kSmallest && std::abs(c) <= kLargest)) return false;
  return true;
}

}  // namespace

NearestPlaces::NearestPlaces(const ConvexOperands& source, const SolidPose& p, const SolidPose& q) {
  for (const ConvexOperands::Operand& operand : source.operand)
    if (!operand.exact.empty() || !std::all_of(operand.vertices.begin(), operand.vertices.end(), is_ordinary)) return;
  tells_ = true;
  for (std::size_t op = 0; op < 2; ++op) {
    const std::array<DoublePair, 9> m = matrix_of(op == 0 ? p : q);
    posed_[op].reserve(source.operand[op].vertices.size());
    for (const Point3& v : source.operand[op].vertices) {
      Position& at = posed_[op].emplace_back();
      const std::array<double, 3> c{v.x, v.y, v.z};
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t k = 0; k < 3; ++k) {
          const DoublePair term = m[3 * r + k] * DoublePair{c[k], 0};
          at[r].at = k == 0 ? term : at[r].at + term;
          at[r].size += std::abs(term.high);
        }
    }
  }
}

std::optional<Point3> NearestPlaces::operator()(std::uint32_t p, std::uint32_t q) const {
  if (!tells_) return std::nullopt;
  std::array<double, 3> nearest;
  for (std::size_t r = 0; r < 3; ++r) {
    const Coordinate &a = posed_[0][p][r], &b = posed_[1][q][r];
    const DoublePair sum = a.at + b.at;
    // Rounding is monotone: where both ends of the interval round to one double, the exact value between them does.
    // The ends are rounded outwards in their low parts, and then once.
    const double error = kPlaceError * (a.size + b.size);
    const double below = sum.high + (sum.low - error), above = sum.high + (sum.low + error);
    if (!(below == above)) return std::nullopt;
    nearest[r] = above == 0 ? 0 : above;
  }
  return Point3{nearest[0], nearest[1], nearest[2]};
}

}  // namespace dymsum::spatial
