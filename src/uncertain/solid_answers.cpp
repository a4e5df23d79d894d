// Questions about solids that are not known exactly.
#include <limits>
#include <utility>
#include <vector>

#include "dymsum/solid_erosion.h"
#include "uncertain/deciding.h"
#include "uncertain/uncertain_solid_internals.h"

namespace dymsum {
namespace {

using uncertain::Question;

auto solid_candidates(const UncertainSolid& u, bool outer) { return uncertain::candidates<SpatialOperand>(u, outer); }

/// The same of questions that hold for larger P and Q where they hold for smaller ones.
Result<UncertainAnswer> decide_growing(const UncertainSolid& p, const UncertainSolid& q,
                                       const Question<SpatialOperand>& question) {
  const Result<bool> hardest = question(uncertain::inner_solid(p), uncertain::inner_solid(q));
  if (!hardest) return hardest.error();
  return uncertain::decide(p, q, false, *hardest, question);
}

Mesh point_at_origin() { return Mesh::with_thin_parts({{{0, 0, 0}}, {{0}}}).value(); }

/// Whether a position belongs to an erosion: to the regular part or to what is tight.
Result<bool> lies_in_fit(const Result<SpatialSum>& positions, const RationalPoint3& at) {
  if (!positions) return positions.error();
  if (uncertain::is_empty(*positions)) return false;
  const Mesh origin = point_at_origin();
  return contains(SpatialOperand(*positions), SpatialOperand(origin), at, Semantics::closed);
}

Result<SolidDistance> solid_distance(const SpatialOperand& p, const SpatialOperand& q, const RationalPoint3& at,
                                     bool contacts) {
  SolidDistance distance;
  distance.distance = std::numeric_limits<double>::infinity();
  if (uncertain::is_empty(p) || uncertain::is_empty(q)) return distance;
  DepthOptions options;
  options.contacts = contacts;
  Result<SolidDepth> depth = SolidDepth::create(p, q, options);
  if (!depth) return depth.error();
  SolidDepth pair = *std::move(depth);
  return pair.at(at);
}

Result<SolidClearanceBound> solid_bound(const UncertainSolid& p, const UncertainSolid& q, const RationalPoint3& at,
                                        bool least) {
  return uncertain::extreme<SolidClearanceBound>(
      solid_candidates(p, least), solid_candidates(q, least), least,
      [&](const SpatialOperand& a, const SpatialOperand& b) { return solid_distance(a, b, at, true); });
}

double signed_distance(const SolidDistance& d) { return d.meeting == Meeting::overlapping ? -d.distance : d.distance; }

}  // namespace

Result<UncertainAnswer> contains(const UncertainSolid& p, const UncertainSolid& q, const RationalPoint3& z,
                                 Semantics semantics) {
  return decide_growing(p, q, [&](const SpatialOperand& a, const SpatialOperand& b) -> Result<bool> {
    if (uncertain::is_empty(a) || uncertain::is_empty(b)) return false;
    return dymsum::contains(a, b, z, semantics);
  });
}

Result<UncertainAnswer> collides(const UncertainSolid& p, const UncertainSolid& q, const RationalPoint3& at) {
  return decide_growing(p, q, [&](const SpatialOperand& a, const SpatialOperand& b) -> Result<bool> {
    const Result<SolidDistance> distance = solid_distance(a, b, at, false);
    if (!distance) return distance.error();
    return distance->meeting == Meeting::overlapping;
  });
}

Result<UncertainAnswer> fits_at(const UncertainSolid& p, const UncertainSolid& q, const RationalPoint3& at) {
  const Result<UncertainSolid> positions = erode(p, q);
  if (!positions) return positions.error();
  const Result<bool> everywhere = lies_in_fit(positions->inner(), at);
  if (!everywhere) return everywhere.error();
  return uncertain::decide(p, q, true, *everywhere,
                           Question<SpatialOperand>([&](const SpatialOperand& a, const SpatialOperand& b) {
                             return lies_in_fit(erode(a, b), at);
                           }));
}

Result<UncertainSolidFit> fits_anywhere(const UncertainSolid& container, const UncertainSolid& part,
                                        const SpatialOptions& options) {
  Result<UncertainSolid> positions = erode(container, part, options);
  if (!positions) return positions.error();
  UncertainSolidFit fit{{}, *std::move(positions), std::nullopt};
  const SpatialSum& everywhere = fit.positions.inner();
  if (!uncertain::is_empty(everywhere)) fit.common = everywhere.exact(0);
  Result<UncertainAnswer> answer =
      uncertain::decide(container, part, true, fit.common.has_value(),
                        Question<SpatialOperand>([&](const SpatialOperand& a, const SpatialOperand& b) -> Result<bool> {
                          const Result<SpatialSum> set = erode(a, b, options);
                          if (!set) return set.error();
                          return !uncertain::is_empty(*set);
                        }));
  if (!answer) return answer.error();
  fit.answer = *std::move(answer);
  return fit;
}

double UncertainSolidClearance::least_signed() const { return signed_distance(least.distance); }
double UncertainSolidClearance::most_signed() const { return signed_distance(most.distance); }

Result<UncertainSolidClearance> clearance(const UncertainSolid& p, const UncertainSolid& q, const RationalPoint3& at) {
  Result<SolidClearanceBound> least = solid_bound(p, q, at, true);
  if (!least) return least.error();
  Result<SolidClearanceBound> most = solid_bound(p, q, at, false);
  if (!most) return most.error();
  return UncertainSolidClearance{*std::move(least), *std::move(most)};
}

}  // namespace dymsum
