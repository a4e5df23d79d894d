#include "dymsum/uncertain.h"

#include <string>
#include <utility>

#include "dymsum/orientation_sum.h"
#include "dymsum/planar_boolean.h"
#include "dymsum/rotation_family.h"
#include "dymsum/scaling_family.h"
#include "dymsum/set_check.h"
#include "uncertain/disc_polygons.h"
#include "uncertain/uncertain_internals.h"
#include "uncertain/variant_sets.h"

namespace dymsum {

Region uncertain::parts_of(const Region& region) { return Region::create({region.parts(), {}, {}}).value(); }

namespace {

using uncertain::has_thin_parts;
using uncertain::parts_of;

Region origin() { return Region::create({{}, {}, {{0, 0}}}).value(); }

}  // namespace

Result<PlanarSum> uncertain::closed_set(const PlanarOperand& set, const SumOptions& options) {
  return minkowski_sum(set, origin(), options);
}

Result<PlanarSum> uncertain::regular_set(const PlanarOperand& set) {
  SumOptions regular;
  regular.semantics = Semantics::regular;
  const PlanarOperand one[] = {set};
  return united(one, regular);
}

namespace {

Result<PlanarSum> as_set(const Region& region) {
  const PlanarOperand one[] = {region};
  return united(one);
}

/// Of two results the pair.
Result<Uncertain> pair_of(Result<PlanarSum> inner, Result<PlanarSum> outer, double error = 0) {
  if (!inner) return inner.error();
  if (!outer) return outer.error();
  return UncertainInternals::pair(*std::move(inner), *std::move(outer), error);
}

/// The offset by a deviation with a polygon around its disc, or inside of it. Of what is offset inside only parts stay.
Result<PlanarSum> offset_set(const Region& nominal, double deviation, int sides, bool around) {
  if (deviation == 0) return as_set(nominal);
  const double radius = std::abs(deviation);
  const Region disc = around ? uncertain::polygon_around(radius, sides) : uncertain::polygon_inside(radius, sides);
  if (deviation > 0) return minkowski_sum(nominal, disc);
  return erode(parts_of(nominal), disc);
}

}  // namespace

Result<Uncertain> Uncertain::known(const Region& region) {
  Result<PlanarSum> set = as_set(region);
  if (!set) return set.error();
  return UncertainInternals::one(*std::move(set), {region});
}

Result<Uncertain> Uncertain::between(const PlanarOperand& inner, const PlanarOperand& outer) {
  SetCheckOptions options;
  options.semantics = Semantics::closed;
  const Result<PlanarSetCheck> check = check_set(outer, inner, options);
  if (!check) return check.error();
  if (!check->contained()) {
    Error error{ErrorCode::out_of_range, "the inner set does not lie in the outer one", {}};
    error.evidence.x = check->surplus.at.x.to_double();
    error.evidence.y = check->surplus.at.y.to_double();
    return error;
  }
  const PlanarOperand in[] = {inner}, out[] = {outer};
  if (check->contains()) {
    Result<PlanarSum> set = united(in);
    if (!set) return set.error();
    return UncertainInternals::one(*std::move(set));
  }
  return pair_of(united(in), united(out));
}

Result<Uncertain> Uncertain::of_variants(std::vector<Region> variants, const Progress& progress) {
  if (variants.empty()) return Error{ErrorCode::out_of_range, "there are no variants", {}};
  if (variants.size() == 1) return known(variants[0]);
  SumOptions options;
  options.progress = progress;
  Result<uncertain::CommonAndAny> made = uncertain::common_and_any(
      std::vector<PlanarOperand>(variants.begin(), variants.end()), uncertain::differing_box(variants), options);
  if (!made) return made.error();
  uncertain::CommonAndAny both = *std::move(made);
  return UncertainInternals::list(std::move(both.common), std::move(both.any), std::move(variants));
}

Result<Uncertain> Uncertain::of_band(const Region& nominal, const Tolerance& tolerance) {
  const auto [upper, lower, sides] = tolerance;
  for (const double deviation : {upper, lower})
    if (const Result<void> checked = uncertain::check_disc(std::abs(deviation), sides); !checked)
      return checked.error();
  if (lower > upper) return Error{ErrorCode::out_of_range, "the lower deviation is larger than the upper one", {}};
  if (upper == 0 && lower == 0) return known(nominal);
  return pair_of(
      offset_set(nominal, lower, sides, lower < 0), offset_set(nominal, upper, sides, upper > 0),
      std::max(uncertain::polygon_error(std::abs(upper), sides), uncertain::polygon_error(std::abs(lower), sides)));
}

// The family of the region with a point: its sums are the region at every scale.
Result<Uncertain> Uncertain::of_scales(const Region& nominal, const Scale& low, const Scale& high) {
  const Result<ScalingFamily> family = ScalingFamily::create(nominal, origin(), low, high);
  if (!family) return family.error();
  if (!(low == high)) return pair_of(family->inner(low, high), family->outer(low, high));
  Result<PlanarSum> set = family->at(low);
  if (!set) return set.error();
  return UncertainInternals::one(*std::move(set));
}

Result<Uncertain> Uncertain::of_angles(const Region& nominal, const Orientation& a, const Orientation& b,
                                       double distance) {
  if (has_thin_parts(nominal))
    return Error{ErrorCode::unsupported_operand, "regions between angles have no polylines and points", {}};
  if (!(a == b))
    return pair_of(inner_rotated_sum(nominal, origin(), a, b, distance),
                   outer_rotated_sum(nominal, origin(), a, b, distance));
  Result<PlanarSum> set = rotated_sum(nominal, origin(), a);
  if (!set) return set.error();
  return UncertainInternals::one(*std::move(set));
}

bool Uncertain::exact() const { return inner_ == outer_ || *inner_ == *outer_; }

Result<PlanarSum> Uncertain::doubtful() const {
  SumOptions regular;
  regular.semantics = Semantics::regular;
  return difference(outer(), inner(), regular);
}

}  // namespace dymsum
