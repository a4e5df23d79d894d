#include "dymsum/spatial_sum.h"

#include <algorithm>
#include <chrono>

#include "spatial/sum/face_triangles.h"
#include "spatial/sum/grid_error.h"
#include "spatial/sum/rounded_surface.h"
#include "spatial/sum/solid_faces.h"
#include "spatial/sum/sum_of_solids.h"
#include "spatial/sum/sum_source.h"
#include "spatial/sum/sum_trace.h"

namespace dymsum {

Result<SpatialSum> minkowski_sum(const Mesh& p, const Mesh& q, const SpatialOptions& options) {
  if (options.engine == SpatialEngine::fast && !options.trace) {
    if (options.progress && !options.progress("convex", 0))
      return Error{ErrorCode::cancelled, "the computation was cancelled", {}};
    if (const Result<SolidSum> convex = convex_sum(p, q)) return spatial::boundary_of(*convex);
  }
  return spatial::sum_of_solids(p.data(), q.data(), options);
}

Result<SpatialSum> spatial::sum_of_solids(const MeshData& p, const MeshData& q, const SpatialOptions& options) {
  SpatialSum sum;
  if (p.faces.empty() || q.faces.empty()) return sum;
  const SolidOperand a = solid_operand(p), b = solid_operand(q);
  try {
    spatial::SolidBoundary boundary = spatial::solid_boundary(a, b, options, sum.stats);
    const auto start = std::chrono::steady_clock::now();
    spatial::assemble(boundary, a, b, sum);
    if (options.trace) sum.trace = trace_of(boundary);
    sum.stats.stages.push_back(
        {"faces", std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count()});
    const_cast<SpatialPositions&>(SpatialSumInternals::positions(sum)).space = std::move(boundary.space);
  } catch (const spatial::Cancelled&) {
    return Error{ErrorCode::cancelled, "the computation was cancelled", {}};
  } catch (const std::invalid_argument&) {
    if (std::optional<Error> error = grid_error(p.vertices, q.vertices)) return *std::move(error);
    throw;
  }
  return sum;
}

RationalPoint3 SpatialSum::exact(std::size_t vertex) const {
  const auto [x, y, z] = positions_->at(vertex);
  return {exact::to_rational(x), exact::to_rational(y), exact::to_rational(z)};
}

Result<SpatialSum::Rounded> SpatialSum::rounded() const {
  Rounded result;
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> name(vertices.size(), kNone);
  spatial::Triangles all = spatial::triangulated(*this);
  for (const spatial::Triangle& t : all.triangles) {
    Face face;
    for (const std::uint32_t v : t) {
      if (name[v] == kNone) {
        name[v] = static_cast<std::uint32_t>(result.mesh.vertices.size());
        const auto [x, y, z] = positions_->at(v);
        result.mesh.vertices.push_back(
            {exact::round_to_double(x), exact::round_to_double(y), exact::round_to_double(z)});
      }
      face.push_back(name[v]);
    }
    result.mesh.faces.push_back(std::move(face));
  }
  result.face = std::move(all.face);
  if (std::optional<Error> error = spatial::rounding_error(result.mesh)) return *std::move(error);
  return result;
}

bool operator==(const SpatialSum& a, const SpatialSum& b) {
  if (a.faces != b.faces || a.tight_faces != b.tight_faces || a.tight_segments != b.tight_segments ||
      a.tight_points != b.tight_points || a.vertices.size() != b.vertices.size())
    return false;
  for (std::size_t k = 0; k < a.vertices.size(); ++k)
    if (a.positions_->at(k) != b.positions_->at(k)) return false;
  return true;
}

}  // namespace dymsum
