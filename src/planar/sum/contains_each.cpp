// Whether many points lie in a sum: one by one while that is cheaper than the sum, else located in it.
#include <optional>

#include "dymsum/sum_locator.h"
#include "planar/operand/prepared_region.h"
#include "planar/operand/sum_bounds.h"
#include "planar/sum/answer_blocks.h"

namespace dymsum {
namespace {

using Answers = Result<std::vector<std::uint8_t>>;

std::size_t thin_vertices(const Region& r) {
  std::size_t count = r.points().size();
  for (const Polyline& line : r.polylines()) count += line.size();
  return count;
}

/// Whether `count` points are expected to take longer one by one than the sum does. Weights are about nanoseconds: a
/// point is placed on a lattice with all vertices; the sum and its locator take time for each reduced segment, and what
/// is thin in both operands is compared with all of the sum and with each other.
bool worth_a_sum(const Region& p, const Region& q, std::size_t count, Semantics semantics) {
  constexpr double kOfVertex = 32, kOfSegment = 512, kOfThin = 16;
  const auto vertices = static_cast<double>(p.vertex_count() + q.vertex_count());
  const double alone = static_cast<double>(count) * kOfVertex * vertices;
  if (alone < kOfSegment * vertices) return false;
  const double thin = semantics == Semantics::closed
                          ? static_cast<double>(thin_vertices(p)) * static_cast<double>(thin_vertices(q))
                          : 0;
  const double reduced = static_cast<double>(convolution_sizes(p, q).reduced) + vertices;
  return alone > kOfSegment * reduced + kOfThin * thin * (thin + reduced);
}

Result<SumLocator> locator_of(const Region& p, const Region& q, Semantics semantics, const Progress& progress) {
  SumOptions options;
  options.semantics = semantics;
  options.progress = progress;
  const Result<PlanarSum> sum = minkowski_sum(p, q, options);
  if (!sum) return sum.error();
  return SumLocator(*sum, semantics);
}

Answers one_by_one(const Region& p, const Region& q, std::span<const Point> points, Semantics semantics, int threads,
                   const Progress& progress) {
  return planar::answer_blocks(points.size(), 256, 16, threads, progress,
                               [&](std::size_t k) { return contains(p, q, points[k], semantics); });
}

/// Why no sum of these operands is queried.
std::optional<Error> refusal(const Region& p, const Region& q) {
  for (const auto& operand : {planar::prepared_operand(p, 0), planar::prepared_operand(q, 1)})
    if (std::optional<Error> error = planar::too_large(*operand)) return error;
  return std::nullopt;
}

/// The doubles that all the points are, if they are.
std::optional<std::vector<Point>> doubles_of(std::span<const RationalPoint> points) {
  std::vector<Point> all;
  for (const RationalPoint& z : points) {
    const Point at{z.x.to_double(), z.y.to_double()};
    const Result<Rational> x = Rational::of(at.x), y = Rational::of(at.y);
    if (!x || !y || !(*x == z.x && *y == z.y)) return std::nullopt;
    all.push_back(at);
  }
  return all;
}

}  // namespace

Answers contains_each(const Region& p, const Region& q, std::span<const Point> points, Semantics semantics, int threads,
                      const Progress& progress) {
  if (p.empty() || q.empty()) return std::vector<std::uint8_t>(points.size());
  if (const std::optional<Error> error = refusal(p, q)) return *error;
  if (!worth_a_sum(p, q, points.size(), semantics)) return one_by_one(p, q, points, semantics, threads, progress);
  const Result<SumLocator> sum = locator_of(p, q, semantics, progress);
  if (!sum) return sum.error();
  return sum->contains_each(points, threads, progress);
}

Answers contains_each(const Region& p, const Region& q, std::span<const RationalPoint> points, Semantics semantics,
                      int threads, const Progress& progress) {
  if (p.empty() || q.empty()) return std::vector<std::uint8_t>(points.size());
  if (const auto doubles = doubles_of(points)) return contains_each(p, q, *doubles, semantics, threads, progress);
  const Result<SumLocator> sum = locator_of(p, q, semantics, progress);
  if (!sum) return sum.error();
  return sum->contains_each(points, threads, progress);
}

}  // namespace dymsum
