#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/budget_error.h"
#include "dymsum/convex_memory.h"
#include "spatial/convex/convex_state.h"
#include "spatial/convex/exact_places.h"
#include "spatial/sum/sum_edges.h"
#include "spatial/sum/sum_of_solids.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {
namespace {

/// The positions of all vertices over one positive unit.
std::vector<BigVector> numerators(const SolidSum& sum, const ExactPlaces& places) {
  std::vector<BigVector> all;
  for (const SolidSum::Vertex& v : sum.vertices) {
    const BigVector a = places.of(0, v.p), b = places.of(1, v.q);
    all.push_back({a[0] + b[0], a[1] + b[1], a[2] + b[2]});
  }
  return all;
}

ExactPosition position(const BigVector& numerators, const exact::BigRational& unit) {
  const auto of = [&](const exact::BigInteger& n) { return exact::BigRational(exact::BigRational(n) * unit); };
  return {of(numerators[0]), of(numerators[1]), of(numerators[2])};
}

/// The facet and about as many vertices as a SolidSum, with exact positions.
constexpr std::size_t kBytesPerConvexFacet = 400;

using Kind = SolidFeature::Kind;

SolidFeature feature(std::uint32_t a, std::uint32_t b) {
  if (a == b) return {Kind::vertex, a, 0};
  return {Kind::edge, std::min(a, b), std::max(a, b)};
}

/// Along an edge of a convex sum one edge touches a vertex, or two parallel edges touch.
SolidContact between(const SolidSum::Vertex& a, const SolidSum::Vertex& b) {
  return {feature(a.p, b.p), feature(a.q, b.q)};
}

}  // namespace

Result<SolidSum> small_convex_sum(const Mesh& p, const Mesh& q, std::uint64_t memory) {
  const Result<ConvexSum> sum = convex_sum_within(p, q, memory);
  if (!sum) return sum.error();
  const std::uint64_t bytes = memory == 0 ? 0 : sum->bytes() + sum->facet_count().all * kBytesPerConvexFacet;
  if (bytes > memory) return base::budget_error("the sum of convex solids takes at least", bytes, memory);
  return sum->sum();
}

// The facets of a convex sum are its faces: whole, without holes, and nothing is tight.
SpatialSum boundary_of(const SolidSum& convex) {
  const ExactPlaces places(ConvexSumInternals::operands(convex), convex.p_pose, convex.q_pose);
  const std::vector<BigVector> at = numerators(convex, places);
  std::vector<std::uint32_t> order(at.size()), name(at.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return at[a] < at[b]; });

  SpatialSum sum;
  auto sorted = std::make_shared<SpatialPositions>();
  for (std::uint32_t k = 0; k < order.size(); ++k) {
    name[order[k]] = k;
    sorted->listed.push_back(position(at[order[k]], places.unit()));
    const Point3& nearest = sum.vertices.emplace_back(convex.at[order[k]]);
    const SolidSum::Vertex& pair = convex.vertices[order[k]];
    sum.vertex_contacts.push_back(SolidContact{{Kind::vertex, pair.p, 0}, {Kind::vertex, pair.q, 0}});
    const double size = std::max({std::abs(nearest.x), std::abs(nearest.y), std::abs(nearest.z)});
    sum.at_error = std::max(sum.at_error, size * 0x1p-53 + 0x1p-1074);
  }
  SpatialSumInternals::set_positions(sum, std::move(sorted));

  for (const SolidFacet& facet : convex.facets) {
    std::vector<std::uint32_t> loop;
    for (const std::uint32_t v : facet.vertices) loop.push_back(name[v]);
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    sum.faces.push_back({{std::move(loop)}, facet.p, facet.q, 0});
  }
  std::sort(sum.faces.begin(), sum.faces.end(),
            [](const SpatialFace& a, const SpatialFace& b) { return a.loops < b.loops; });
  sum.shells = 1;
  sum.edges = edges_of(sum.faces);
  for (SpatialEdge& edge : sum.edges)
    edge.contact = between(convex.vertices[order[edge.from]], convex.vertices[order[edge.to]]);
  return sum;
}

}  // namespace dymsum::spatial
