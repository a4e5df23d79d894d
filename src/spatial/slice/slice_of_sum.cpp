#include <algorithm>
#include <cmath>

#include "base/double_text.h"
#include "base/memory_budget.h"
#include "base/poll.h"
#include "dymsum/solid_slice.h"
#include "exact/big.h"
#include "spatial/convolution/stage_watch.h"
#include "spatial/slice/slice_region.h"

namespace dymsum {

namespace {

/// Whether the plane meets the box of the sum.
bool within(const Mesh& p, const Mesh& q, double z) {
  const auto a = bounds(p), b = bounds(q);
  const exact::BigRational at = exact::exact_value(z);
  return exact::exact_value(a[2]) + exact::exact_value(b[2]) <= at &&
         at <= exact::exact_value(a[5]) + exact::exact_value(b[5]);
}

}  // namespace

Result<SolidSlice> slice_of_sum(const Mesh& p, const Mesh& q, double z, const SpatialOptions& options) {
  if (!std::isfinite(z))
    return Error{ErrorCode::not_finite, "the height of a slice must be finite, not " + base::general_text(z, 6), {}};
  SolidSlice slice;
  slice.z = z;
  if (p.has_thin_parts() || q.has_thin_parts())
    return Error{ErrorCode::unsupported_operand, "slices are of solids without thin parts", {}};
  if (p.empty() || q.empty() || !within(p, q, z)) return slice;
  const spatial::SolidOperand a = spatial::solid_operand(p.data()), b = spatial::solid_operand(q.data());
  SpatialStats stats;
  spatial::StageWatch watch(options, stats);
  try {
    watch.begin("convolution");
    spatial::SlicePlane plane = spatial::slice_plane(a, b, z, watch);
    watch.begin("collisions");
    const spatial::Collision collision(*plane.space, a, b);
    const spatial::SliceStates states = spatial::slice_states(plane, collision);
    slice.stats = {plane.space->bits(), plane.facets, plane.table.facets.size(), plane.cells.cells.size(),
                   collision.tests()};
    spatial::collect_region(std::move(plane), states, a, b, slice);
  } catch (const Cancelled&) {
    return cancelled();
  } catch (const spatial::OverBudget& e) {
    return base::budget_error("the slice takes at least", e.bytes, options.memory);
  } catch (const spatial::NoGridForSlice& e) {
    return e.error;
  }
  return slice;
}

}  // namespace dymsum
