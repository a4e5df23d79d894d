#include "dymsum/spatial_sum.h"

#include <algorithm>
#include <cstdio>
#include <new>
#include <string>

#include "base/memory_budget.h"
#include "base/parallel.h"
#include "base/poll.h"
#include "spatial/boundary/thin_crossings.h"
#include "spatial/convolution/predicted_cost.h"
#include "spatial/sum/face_triangles.h"
#include "spatial/sum/grid_error.h"
#include "spatial/sum/solid_faces.h"
#include "spatial/sum/sum_of_convex_solids.h"
#include "spatial/sum/sum_of_solids.h"
#include "spatial/sum/sum_source.h"
#include "spatial/sum/sum_trace.h"
#include "spatial/sum/touching_vertices.h"

namespace dymsum {

namespace {

/// The reference takes operands as they are.
spatial::FlatFeatures flat_features(const SpatialOptions& options) {
  return options.engine == SpatialEngine::brute ? spatial::FlatFeatures::kept : spatial::FlatFeatures::merged;
}

Result<SpatialSum> sum_of_pair(const MeshData& p, const std::vector<bool>& thin_p, const MeshData& q,
                               const std::vector<bool>& thin_q, const SpatialOptions& options) {
  spatial::SolidOperand operands[2];
  base::parallel_parts(2, options.threads, [&](std::size_t k) {
    operands[k] = k == 0 ? spatial::solid_operand(p, thin_p, flat_features(options))
                         : spatial::solid_operand(q, thin_q, flat_features(options));
  });
  return spatial::sum_of_operands(operands[0], operands[1], options);
}

Error no_open_sum(const spatial::ThinCrossing& parts) {
  Error error{ErrorCode::unsupported_operand,
              "this face of P and that of Q have no volume and can cross, for which no open sum is defined",
              {}};
  error.evidence.face = parts.p, error.evidence.other_face = parts.q;
  return error;
}

}  // namespace

Result<SpatialSum> minkowski_sum(const Mesh& p, const Mesh& q, const SpatialOptions& options) {
  if (options.engine == SpatialEngine::fast && !options.trace) {
    if (options.progress && !options.progress("convex", 0)) return cancelled();
    Result<SpatialSum> convex = spatial::small_convex_sum(p, q, options.memory);
    if (convex || convex.error().code == ErrorCode::out_of_memory) return convex;
  }
  return spatial::sum_of_solids(p, q, options);
}

Result<SpatialSum> spatial::sum_of_solids(const MeshData& p, const MeshData& q, const SpatialOptions& options) {
  return sum_of_pair(p, {}, q, {}, options);
}

Result<SpatialSum> spatial::sum_of_solids(const Mesh& p, const Mesh& q, const SpatialOptions& options) {
  Result<SpatialSum> sum = sum_of_pair(p.data(), p.thin_faces(), q.data(), q.thin_faces(), options);
  if (sum && sum->faces.empty() && p.has_thin_parts() && q.has_thin_parts())
    return Error{ErrorCode::unsupported_operand, "the sum of these parts without volume has no volume either", {}};
  return sum;
}

Result<SpatialSum> spatial::sum_of_operands(const SolidOperand& a, const SolidOperand& b,
                                            const SpatialOptions& options) {
  SpatialSum sum;
  if (a.vertices.empty() || b.vertices.empty()) return sum;
  if (options.memory != 0)
    if (const std::uint64_t bytes = predicted_cost(a, b).bytes; bytes > options.memory)
      return base::budget_error("the sum is predicted to take", bytes, options.memory);
  StageWatch watch(options, sum.stats);
  try {
    spatial::SolidBoundary boundary = spatial::solid_boundary(a, b, options, sum.stats, watch);
    watch.begin("faces");
    spatial::assemble(boundary, a, b, sum, watch);
    if (options.trace) sum.trace = trace_of(boundary, watch);
    watch.begin("");
  } catch (const Cancelled&) {
    return cancelled();
  } catch (const spatial::NoOpenSum& e) {
    return no_open_sum(e.parts);
  } catch (const spatial::OverBudget& e) {
    return base::budget_error("the sum takes at least", e.bytes, options.memory);
  } catch (const std::bad_alloc&) {
    return Error{
        ErrorCode::out_of_memory,
        "the sum needs more memory than there is; predicted were " + base::memory_text(predicted_cost(a, b).bytes),
        {}};
  } catch (const std::invalid_argument&) {
    if (std::optional<Error> error = grid_error(a.vertices, b.vertices)) return *std::move(error);
    throw;
  }
  return sum;
}

bool SpatialSum::is_convex() const { return positions_ && positions_->convex; }

RationalPoint3 SpatialSum::exact(std::size_t vertex) const {
  const auto [x, y, z] = positions_->at(vertex);
  return {exact::to_rational(x), exact::to_rational(y), exact::to_rational(z)};
}

SpatialSum::Rounded SpatialSum::drawn() const {
  Rounded result;
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> name(vertices.size(), kNone);
  spatial::Triangles all = spatial::split_at_touching_vertices(*this, spatial::triangulated(*this));
  for (const spatial::Triangle& t : all.triangles) {
    Face face;
    for (const std::uint32_t v : t) {
      if (name[v] == kNone) {
        name[v] = static_cast<std::uint32_t>(result.mesh.vertices.size());
        result.mesh.vertices.push_back(positions_->rounded(v));
        result.vertex.push_back(v);
      }
      face.push_back(name[v]);
    }
    result.mesh.faces.push_back(std::move(face));
  }
  result.face = std::move(all.face);
  return result;
}

std::string SpatialSum::Rounded::to_string() const {
  if (nearest) return "nearest coordinates";
  const auto count = [](std::size_t n, const char* one, const char* many) {
    return std::to_string(n) + (n == 1 ? one : many);
  };
  char within[32];
  std::snprintf(within, sizeof within, "%.2g", distance);
  char volume[48];
  std::snprintf(volume, sizeof volume, ", volume within %.2g", volume_change);
  return count(merged_vertices, " vertex merged, ", " vertices merged, ") +
         count(collapsed_edges, " edge collapsed, ", " edges collapsed, ") + count(bends, " bend, ", " bends, ") +
         count(lost_faces, " face lost", " faces lost") + "; within " + within + volume +
         (topology_kept ? "" : "; the topology has changed");
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
