#include "spatial/sum/sum_of_convex_solids.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/memory_budget.h"
#include "dymsum/convex_memory.h"
#include "spatial/convex/convex_sum.h"
#include "spatial/convex/nearest_positions.h"
#include "spatial/sum/sum_source.h"

namespace dymsum {
namespace spatial {
namespace {

/// A facet and about as many vertices while the sum is put together.
constexpr std::size_t kBytesPerConvexFacet = 400;

using Kind = SolidFeature::Kind;

/// Facets from their smallest vertex on, sorted by their vertices: by the first two, an edge of one facet.
std::vector<SpatialFace> faces_of(ConvexFacets& all, const std::vector<std::uint32_t>& name) {
  for (std::uint32_t& corner : all.corners) corner = name[corner];
  std::vector<std::uint32_t> begin(name.size() + 1, 0);  // by the first vertex
  for (const ConvexFacets::Facet& facet : all.facets) {
    const auto from = all.corners.begin() + static_cast<std::ptrdiff_t>(facet.first), to = from + facet.count;
    std::rotate(from, std::min_element(from, to), to);
    ++begin[*from + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  struct Start {
    std::uint32_t second, facet;
    auto operator<=>(const Start&) const = default;
  };
  std::vector<Start> order(all.facets.size());
  std::vector<std::uint32_t> at(begin.begin(), begin.end() - 1);
  for (std::uint32_t f = 0; f < all.facets.size(); ++f) {
    const std::uint32_t* corners = all.corners.data() + all.facets[f].first;
    order[at[corners[0]]++] = {corners[1], f};
  }
  std::vector<SpatialFace> faces(order.size());
  for (std::size_t v = 0; v + 1 < begin.size(); ++v) std::sort(order.begin() + begin[v], order.begin() + begin[v + 1]);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const ConvexFacets::Facet& facet = all.facets[order[k].facet];
    const auto from = all.corners.begin() + static_cast<std::ptrdiff_t>(facet.first);
    faces[k].loops.emplace_back(from, from + facet.count);
    faces[k].p = facet.p, faces[k].q = facet.q;
  }
  return faces;
}

SpatialStats stats_of(const Overlay& overlay, const std::vector<SpatialFace>& faces) {
  SpatialStats stats;
  stats.bits = tier_bits(overlay.poly(0), overlay.poly(1));
  for (const SpatialFace& face : faces)
    ++(face.p.kind == Kind::edge && face.q.kind == Kind::edge ? stats.edge_edge : stats.face_vertex);
  return stats;
}

Result<SpatialSum> small_sum(const Result<ConvexSum>& sum, std::uint64_t memory) {
  if (!sum) return sum.error();
  const auto bytes = [&](std::size_t facets) { return sum->bytes() + facets * kBytesPerConvexFacet; };
  // Facets are counted where all of the generic sum would be too many.
  if (memory != 0 && bytes(sum->face_vertex_count() + sum->edge_edge_count()) > memory)
    if (const std::uint64_t least = bytes(sum->facet_count().all); least > memory)
      return base::budget_error("the sum of convex solids takes at least", least, memory);
  return sum->sum();
}

}  // namespace

Result<SpatialSum> small_convex_sum(const Mesh& p, const Mesh& q, std::uint64_t memory) {
  return small_sum(convex_sum_within(p, q, memory), memory);
}

Result<SpatialSum> small_convex_sum(const SpatialSum& p, const Mesh& q, std::uint64_t memory) {
  return small_sum(convex_sum_within(p, q, memory), memory);
}

SpatialSum sum_of_overlay(const Overlay& overlay, std::shared_ptr<const ConvexOperands> operands, const SolidPose& p,
                          const SolidPose& q) {
  ConvexFacets facets = assemble(overlay);
  const std::vector<Point3> nearest = nearest_positions(*operands, p, q, facets.vertices);
  const std::vector<std::uint32_t> order = order_by_position(*operands, p, q, facets.vertices, nearest);

  SpatialSum sum;
  std::vector<std::uint32_t> name(order.size());
  std::vector<ConvexSum::Vertex> pairs;
  pairs.reserve(order.size());
  sum.vertices.reserve(order.size());
  sum.vertex_contacts.reserve(order.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) {
    name[order[k]] = k;
    const Point3& at = sum.vertices.emplace_back(nearest[order[k]]);
    const ConvexSum::Vertex& pair = pairs.emplace_back(facets.vertices[order[k]]);
    sum.vertex_contacts.push_back(SolidContact{{Kind::vertex, pair.p, 0}, {Kind::vertex, pair.q, 0}});
    const double size = std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)});
    sum.at_error = std::max(sum.at_error, size * 0x1p-53 + 0x1p-1074);
  }
  sum.faces = faces_of(facets, name);
  sum.shells = 1;
  sum.stats = stats_of(overlay, sum.faces);
  auto positions = std::make_shared<SpatialPositions>();
  positions->convex = std::make_shared<const ConvexPositions>(std::move(operands), p, q, std::move(pairs));
  SpatialSumInternals::set_positions(sum, std::move(positions));
  return sum;
}

}  // namespace spatial

SpatialSum ConvexSum::sum() const {
  return spatial::sum_of_overlay(state_->overlay, state_->source, state_->p_pose, state_->q_pose);
}

}  // namespace dymsum
