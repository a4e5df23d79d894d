// Erosions by results and of results: the complement in a frame is a difference, and its sum with the reflected operand
// leaves the erosion free. Openings and closings are two steps, of which the second takes the result of the first.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "planar/boolean/planar_boolean.h"
#include "planar/region/region.h"
#include "planar/result/result_region.h"
#include "planar/sum/erode.h"
#include "planar/sum/minkowski_sum.h"

namespace dymsum {
namespace {

using Bounds = std::array<double, 4>;

bool is_empty(const Region& region) { return region.empty(); }
bool is_empty(const PlanarSum& sum) { return sum.parts.empty() && sum.segments.empty() && sum.points.empty(); }
bool is_thin(const Region& region) { return !region.polylines().empty() || !region.points().empty(); }
bool is_thin(const PlanarSum& sum) { return !sum.segments.empty() || !sum.points.empty(); }

template <class F>
auto of_set(const PlanarOperand& operand, F f) {
  return std::visit([&](const auto* set) { return f(*set); }, operand.set());
}

Bounds bounds_of(const Region& region) { return bounds(region); }
// These bounds hold the exact positions.
Bounds bounds_of(const PlanarSum& sum) {
  constexpr double kMost = std::numeric_limits<double>::infinity();
  Bounds b{kMost, kMost, -kMost, -kMost};
  const auto add = [&](const SumVertex& v) {
    const double e = sum.at_error;
    b = {std::min(b[0], v.at.x - e), std::min(b[1], v.at.y - e), std::max(b[2], v.at.x + e),
         std::max(b[3], v.at.y + e)};
  };
  for (const SumPart& part : sum.parts) std::for_each(part.outer.vertices.begin(), part.outer.vertices.end(), add);
  for (const SumSegment& s : sum.segments) {
    add(s.from);
    add(s.to);
  }
  std::for_each(sum.points.begin(), sum.points.end(), add);
  // Sums of an extent and its error are rounded.
  for (std::size_t k = 0; k < 4; ++k) b[k] = std::nextafter(b[k], k < 2 ? -kMost : kMost);
  return b;
}

std::optional<Error> not_erodible(const PlanarOperand& p, const Bounds& bp, const Bounds& bq) {
  if (of_set(p, [](const auto& set) { return is_thin(set); }))
    return Error{ErrorCode::unsupported_operand, "only a set without segments and points can be eroded", {}};
  for (const Bounds& b : {bp, bq})
    for (const double c : b)
      if (!(std::abs(c) <= planar::kLargestFramed))
        return Error{ErrorCode::unsupported_operand,
                     "a coordinate is larger than 2^996, too large to look for room inside a region",
                     {}};
  return std::nullopt;
}

constexpr std::uint32_t kCorners = 4;  // of the frame, which comes first

/// The square frame without P, with the indices of P.
Result<planar::EngineRegion> outside_of(const PlanarOperand& p, double margin, const SumOptions& options) {
  const double m = margin;
  const Result<Region> frame = Region::create({{{{{-m, -m}, {m, -m}, {m, m}, {-m, m}}, {}}}, {}, {}});
  if (!frame) return frame.error();
  planar::BooleanTerms terms;
  planar::append_difference(planar::terms_of_parts(*frame), planar::terms_of_parts(p), terms);
  SumOptions regular;
  regular.semantics = Semantics::regular;
  regular.progress = options.progress;
  const Result<PlanarSum> outside = planar::evaluate(std::move(terms), regular);
  if (!outside) return outside.error();
  std::vector<std::uint32_t> vertices, edges;
  const auto add_ring = [&](const SumRing& ring) {
    const auto name = [](std::uint32_t joined) { return joined < kCorners ? SumVertex::kNone : joined - kCorners; };
    for (const SumVertex& v : ring.vertices) {
      vertices.push_back(name(v.corner_p));
      edges.push_back(name(v.out.p));
    }
  };
  for (const SumPart& part : outside->parts) {
    add_ring(part.outer);
    std::for_each(part.holes.begin(), part.holes.end(), add_ring);
  }
  planar::EngineRegion region = planar::region_of_result(*outside);
  for (std::uint32_t& v : region.vertex_indices) v = vertices[v];
  for (std::uint32_t& e : region.edge_indices) e = edges[e];
  return region;
}

}  // namespace

Result<PlanarSum> erode(const PlanarOperand& p, const PlanarOperand& q, const SumOptions& options) {
  const auto* const* region_p = std::get_if<const Region*>(&p.set());
  const auto* const* region_q = std::get_if<const Region*>(&q.set());
  if (region_p != nullptr && region_q != nullptr) return erode(**region_p, **region_q, options);
  const auto empty = [](const auto& set) { return is_empty(set); };
  if (of_set(q, empty)) return Error{ErrorCode::unsupported_operand, "every position holds the empty region", {}};
  if (of_set(p, empty)) return minkowski_sum(p, q, options);  // empty too
  const auto around = [](const auto& set) { return bounds_of(set); };
  const Bounds bp = of_set(p, around), bq = of_set(q, around);
  if (std::optional<Error> error = not_erodible(p, bp, bq)) return *std::move(error);
  const Result<planar::EngineRegion> outside =
      outside_of(p, planar::frame_margin(bp, bq, planar::Turning::none), options);
  if (!outside) return outside.error();
  Result<planar::SumState> computed = planar::compute_boundary(
      planar::make_operand(*outside, 0), planar::taken_operand(q, 1, true), planar::options_inside(options));
  if (!computed) return computed.error();
  return planar::inside_of_frame(std::move(computed).value(), options);
}

namespace {

/// The options of the first of two steps: what is tight counts, but with regular semantics.
SumOptions options_between(const SumOptions& options) {
  SumOptions between = options;
  if (between.semantics == Semantics::open) between.semantics = Semantics::closed;
  between.trace = false;
  return between;
}

}  // namespace

Result<PlanarSum> opening(const PlanarOperand& p, const PlanarOperand& q, const SumOptions& options) {
  const Result<PlanarSum> fit = erode(p, q, options_between(options));
  if (!fit) return fit;
  return minkowski_sum(*fit, q, options);
}

Result<PlanarSum> closing(const PlanarOperand& p, const PlanarOperand& q, const SumOptions& options) {
  const Result<PlanarSum> sum = minkowski_sum(p, q, options_between(options));
  if (!sum) return sum;
  return erode(*sum, q, options);
}

}  // namespace dymsum
