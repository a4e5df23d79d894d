#include "dymsum/planar_sum.h"

#include <array>

#include "planar/sum_engine.h"

namespace dymsum {
namespace {

using planar::EngineRegion;
using planar::separate_touching;

Result<PlanarSum> sum_of(const EngineRegion& p, const EngineRegion& q, const SumOptions& options) {
  Result<planar::SumState> state = planar::compute_boundary(p, q, options);
  if (!state.ok()) return state.error();
  return planar::finish_sum(std::move(state).value(), planar::number_both(p, q), options);
}

EngineRegion engine_region(const Region& r) { return separate_touching(r.data(), r.touching_points()); }

// Appends b; its numbers follow those of a.
void append(EngineRegion& a, const EngineRegion& b, std::uint32_t first_number) {
  if (a.data == RegionData{}) {
    a = b;
    return;
  }
  // Parts, polylines and points of both interleave in the numbering order of region data: rebuild the number lists group by group.
  const auto split = [](const EngineRegion& r) {
    std::array<std::size_t, 3> count{};
    for (const Part& part : r.data.parts) {
      count[0] += part.outer.size();
      for (const Ring& hole : part.holes) count[0] += hole.size();
    }
    for (const Polyline& line : r.data.polylines) count[1] += line.size();
    count[2] = r.data.points.size();
    return count;
  };
  const auto ca = split(a), cb = split(b);
  EngineRegion out;
  std::size_t ia = 0, ib = 0;
  for (int group = 0; group < 3; ++group) {
    for (std::size_t k = 0; k < ca[group]; ++k, ++ia) {
      out.vertex_number.push_back(a.vertex_number[ia]);
      out.edge_number.push_back(a.edge_number[ia]);
    }
    for (std::size_t k = 0; k < cb[group]; ++k, ++ib) {
      out.vertex_number.push_back(first_number + b.vertex_number[ib]);
      out.edge_number.push_back(first_number + b.edge_number[ib]);
    }
  }
  const auto join = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  out.data = std::move(a.data);
  join(out.data.parts, b.data.parts);
  join(out.data.polylines, b.data.polylines);
  join(out.data.points, b.data.points);
  a = std::move(out);
}

}  // namespace

Result<PlanarSum> minkowski_sum(const Region& p, const Region& q, const SumOptions& options) {
  return sum_of(engine_region(p), engine_region(q), options);
}

Result<PlanarSum> nfp(const Region& a, const Region& b, const SumOptions& options) {
  return minkowski_sum(a, negated(b), options);
}

Result<PlanarSum> union_of(const std::vector<Region>& regions, const SumOptions& options) {
  EngineRegion all;
  std::uint32_t first_number = 0;
  for (const Region& r : regions) {
    append(all, engine_region(r), first_number);
    first_number += static_cast<std::uint32_t>(r.vertex_count());
  }
  return sum_of(all, separate_touching({{}, {}, {Point{0, 0}}}, {}), options);
}

}  // namespace dymsum
