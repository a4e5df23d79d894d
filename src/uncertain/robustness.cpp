#include "dymsum/robustness.h"

#include <cmath>
#include <limits>
#include <utility>

#include "dymsum/planar_sum.h"
#include "dymsum/set_check.h"
#include "dymsum/sum_locator.h"
#include "exact/big.h"
#include "uncertain/uncertain_internals.h"

namespace dymsum {
namespace {

/// Half of a gap. Both regions approach each other by it until they touch.
Robustness half_of(const PlanarDistance& distance) {
  Robustness robustness;
  robustness.holds = distance.meeting != Meeting::overlapping;
  robustness.ways = distance.ways;
  if (!robustness.holds) return robustness;
  robustness.squared = distance.squared / Rational(4);
  robustness.radius = exact::root_to_double(exact::exact_value(robustness.squared));
  return robustness;
}

/// The boundary of a region as closed polylines, and for each of their vertices the one of the region: the first vertex
/// of a ring stands at the end of its polyline too.
struct Boundary {
  Region region;
  std::vector<std::uint32_t> vertex;
};

Boundary boundary_of(const Region& region) {
  Boundary boundary;
  RegionData data;
  std::uint32_t first = 0;
  const auto add = [&](const Ring& ring) {
    Polyline line = ring;
    line.push_back(ring[0]);
    data.polylines.push_back(std::move(line));
    const auto count = static_cast<std::uint32_t>(ring.size());
    for (std::uint32_t k = 0; k <= count; ++k) boundary.vertex.push_back(first + k % count);
    first += count;
  };
  for (const Part& part : region.parts()) {
    add(part.outer);
    for (const Ring& hole : part.holes) add(hole);
  }
  boundary.region = Region::create(std::move(data)).value();
  return boundary;
}

}  // namespace

Result<Robustness> robustness_of_free(const Region& p, const Region& q, const RationalPoint& at) {
  if (p.empty() || q.empty()) {
    Robustness robustness;
    robustness.holds = true;
    robustness.radius = std::numeric_limits<double>::infinity();
    return robustness;
  }
  const Result<PlanarDepth> depth = PlanarDepth::create(p, q);
  if (!depth) return depth.error();
  return half_of(depth->at(at));
}

// A part that lies in the container does not cross its boundary, and is as far from all that is outside as it is from
// the boundary.
Result<Robustness> robustness_of_fit(const Region& container, const Region& part, const RationalPoint& at) {
  if (uncertain::has_thin_parts(part))
    return Error{ErrorCode::unsupported_operand, "the part has polylines or points: its clearance wants area", {}};
  const Result<PlanarSum> positions = erode(container, part);
  if (!positions) return positions.error();
  if (!SumLocator(*positions).contains_rational(at)) return Robustness{};
  const Boundary boundary = boundary_of(container);
  const Result<PlanarDepth> depth = PlanarDepth::create(boundary.region, part);
  if (!depth) return depth.error();
  Robustness robustness = half_of(depth->at(at));
  for (PlanarWay& way : robustness.ways)
    for (PlanarTouch& touch : way.contacts) touch.p.index = boundary.vertex[touch.p.index];
  return robustness;
}

// The positions at which every part that is changed by r fits into every container that is are those of the erosion by
// a disc of 2 r: what of the erosion is that far from the outside of it.
Result<RobustFit> most_robust_fit(const Region& container, const Region& part) {
  const Result<PlanarSum> positions = erode(container, part);
  if (!positions) return positions.error();
  RobustFit best;
  best.fits = !uncertain::is_empty(*positions);
  if (!best.fits) return best;
  if (positions->parts.empty()) {
    best.at = positions->exact(positions->segments.empty() ? positions->points[0] : positions->segments[0].from);
    return best;
  }
  const Result<PlanarOffsetCheck> check = check_offset(*positions, Region(), DiscSide::inside);
  if (!check) return check.error();
  const PlanarExcess& furthest = check->between;
  best.at = furthest.at;
  best.squared = furthest.squared / Rational(4);
  best.radius = exact::root_to_double(exact::exact_value(best.squared));
  best.at_most = furthest.exact ? best.radius : furthest.at_most / 2;
  best.exact = furthest.exact;
  return best;
}

}  // namespace dymsum
