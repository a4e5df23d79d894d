#include "dymsum/planar_sum.h"

#include "planar/sum_engine.h"

namespace dymsum {
namespace {

using planar::Numbering;

Result<PlanarSum> sum_of(const RegionData& p, const RegionData& q, const SumOptions& options) {
  Result<planar::SumState> state = planar::compute_boundary(p, q, options);
  if (!state.ok()) return state.error();
  Numbering numbering;
  planar::number_region(p, 0, numbering);
  planar::number_region(q, 1, numbering);
  return planar::finish_sum(std::move(state).value(), std::move(numbering), options);
}

}  // namespace

Result<PlanarSum> minkowski_sum(const Region& p, const Region& q, const SumOptions& options) {
  return sum_of(p.data(), q.data(), options);
}

Result<PlanarSum> nfp(const Region& a, const Region& b, const SumOptions& options) {
  return sum_of(a.data(), negated(b).data(), options);
}

Result<PlanarSum> union_of(const std::vector<Region>& regions, const SumOptions& options) {
  RegionData all;
  for (const Region& r : regions) {
    all.parts.insert(all.parts.end(), r.parts().begin(), r.parts().end());
    all.polylines.insert(all.polylines.end(), r.polylines().begin(), r.polylines().end());
    all.points.insert(all.points.end(), r.points().begin(), r.points().end());
  }
  return sum_of(all, RegionData{{}, {}, {Point{0, 0}}}, options);
}

}  // namespace dymsum
