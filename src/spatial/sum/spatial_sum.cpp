#include "spatial/sum/spatial_sum.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <new>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/memory_budget.h"
#include "base/parallel.h"
#include "base/poll.h"
#include "dymsum/convex_memory.h"
#include "dymsum/spatial_sum.h"
#include "exact/big.h"
#include "spatial/boundary/collision.h"
#include "spatial/convex/convex_sum.h"
#include "spatial/convex/nearest_positions.h"
#include "spatial/convolution/predicted_cost.h"
#include "spatial/sum/solid_boundary.h"
#include "spatial/sum/solid_faces.h"
#include "spatial/sum/sum_source.h"
#include "spatial/sum/thin_sums.h"
#include "spatial/sum/vertex_signs.h"

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

namespace dymsum::spatial {
namespace {

// What a sum of solids went through, for pictures.

/// A space's doubles in the operands' own coordinates, rounded.
class World {
 public:
  explicit World(const SumSpace& space) {
    for (int axis = 0; axis < 3; ++axis) {
      const SumSpace::Line line = space.line(axis);
      unit_[axis] = std::ldexp(1.0, line.unit), offset_[axis] = line.p_offset + line.q_offset;
    }
  }
  Point3 operator()(Vec3 v) const {
    return {v.x * unit_[0] + offset_[0], v.y * unit_[1] + offset_[1], v.z * unit_[2] + offset_[2]};
  }

 private:
  double unit_[3], offset_[3];
};

/// Throws OverBudget.
SpatialTrace trace_of(const SolidBoundary& boundary, StageWatch& watch) {
  SpatialTrace trace;
  watch.hold(boundary.table.facets.size() * (sizeof(SpatialTrace::Facet) + 4 * sizeof(Point3)));
  trace.facets.reserve(boundary.table.facets.size());
  const SumSpace& space = *boundary.space;
  const World world(space);
  for (const TableFacet& f : boundary.table.facets) {
    SpatialTrace::Facet& facet = trace.facets.emplace_back();
    facet.corners.reserve(static_cast<std::size_t>(f.facet.corners));
    facet.kind = static_cast<SpatialTrace::Facet::Kind>(f.facet.kind);
    for (int k = 0; k < f.facet.corners; ++k) facet.corners.push_back(world(space.approx(f.facet.corner[k])));
  }
  const SolidArrangement& arrangement = *boundary.arrangement;
  // What runs through facets, not around them.
  const auto inside = [&](std::uint32_t edge) {
    const auto uses = arrangement.uses(edge);
    return std::any_of(uses.begin(), uses.end(), [&](EdgeUse use) {
      const CellEdge& e = arrangement.edge(use);
      return e.left != kNoId && e.right != kNoId;
    });
  };
  watch.hold(arrangement.edge_ends.size() * sizeof(trace.pieces[0]));
  trace.pieces.reserve(arrangement.edge_ends.size());
  for (std::uint32_t edge = 0; edge < arrangement.edge_ends.size(); ++edge) {
    if (!inside(edge)) continue;
    const auto [a, b] = arrangement.edge_ends[edge];
    trace.pieces.push_back({world(arrangement.points.approx(a).at), world(arrangement.points.approx(b).at)});
  }
  return trace;
}

}  // namespace
}  // namespace dymsum::spatial

namespace dymsum {
namespace {

/// The reference takes operands as they are.
spatial::FlatFeatures flat_features(const SpatialOptions& options) {
  return options.engine == SpatialEngine::brute ? spatial::FlatFeatures::kept : spatial::FlatFeatures::merged;
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

Result<SpatialSum> spatial::sum_of_sets(const MeshData& p, const std::vector<bool>& thin_p, const MeshData& q,
                                        const std::vector<bool>& thin_q, const SpatialOptions& options) {
  SolidOperand operands[2];
  base::parallel_parts(2, options.threads, [&](std::size_t k) {
    operands[k] =
        k == 0 ? solid_operand(p, thin_p, flat_features(options)) : solid_operand(q, thin_q, flat_features(options));
  });
  return sum_of_operands(operands[0], operands[1], options);
}

Result<SpatialSum> spatial::sum_of_solids(const MeshData& p, const MeshData& q, const SpatialOptions& options) {
  return sum_of_sets(p, {}, q, {}, options);
}

Result<SpatialSum> spatial::sum_of_solids(const Mesh& p, const Mesh& q, const SpatialOptions& options) {
  Result<SpatialSum> sum = sum_of_sets(p.data(), p.thin_faces(), q.data(), q.thin_faces(), options);
  if (sum && sum->vertices.empty() && p.has_thin_parts() && q.has_thin_parts())
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
    if (options.tight && options.semantics == Semantics::closed && a.has_thin() && b.has_thin())
      spatial::add_thin_sums(sum, *boundary.space, a, b);
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

// Whether positions lie in the sum of two solids, by definition.

namespace {

using spatial::Flag;
using spatial::PointSource;

Error error_of(const char* message) { return {ErrorCode::unsupported_operand, message, {}}; }

}  // namespace

Result<std::vector<bool>> spatial::positions_in_sum(SumSpace& space, const SolidOperand& p, const SolidOperand& q,
                                                    std::span<const ExactPosition> positions, Semantics semantics,
                                                    const Progress& progress) {
  const bool open = semantics == Semantics::open;
  if (p.has_thin() && q.has_thin()) {
    if (semantics == Semantics::regular)
      return error_of(
          "both operands have parts without volume: what of their sum is near its interior cannot be asked");
    if (open && find_thin_crossing(space, p, q))
      return error_of("both operands have parts without volume that can cross: they have no open sum");
  }
  const Collision collision(space, p, q);
  std::vector<bool> inside(positions.size());
  for (std::size_t k = 0; k < positions.size(); ++k) {
    if (progress && !progress("positions", static_cast<double>(k) / static_cast<double>(positions.size())))
      return cancelled();
    const std::optional<PointSource> at = space.add_position(positions[k]);
    if (!at) continue;
    const Flag flag{*at, 0, 0, 0, 0, 0};
    inside[k] = open ? collision.overlaps(flag) : collision.touches(flag);
  }
  return inside;
}

Result<std::vector<bool>> contains_each(const Mesh& p, const Mesh& q, std::span<const RationalPoint3> positions,
                                        Semantics semantics, const Progress& progress) {
  if (p.empty() || q.empty()) return std::vector<bool>(positions.size());
  const spatial::SolidOperand a = spatial::solid_operand(p.data(), p.thin_faces(), spatial::FlatFeatures::kept),
                              b = spatial::solid_operand(q.data(), q.thin_faces(), spatial::FlatFeatures::kept);
  std::unique_ptr<spatial::SumSpace> space;
  try {
    space = spatial::make_sum_space(p.vertices(), q.vertices());
  } catch (const std::invalid_argument& e) {
    return error_of(e.what());
  }
  std::vector<spatial::ExactPosition> at;
  for (const RationalPoint3& z : positions)
    at.push_back({exact::exact_value(z.x), exact::exact_value(z.y), exact::exact_value(z.z)});
  return spatial::positions_in_sum(*space, a, b, at, semantics, progress);
}

Result<bool> contains(const Mesh& p, const Mesh& q, const Point3& z, Semantics semantics) {
  const Result<Rational> x = Rational::of(z.x), y = Rational::of(z.y), height = Rational::of(z.z);
  if (!x || !y || !height) return false;
  const RationalPoint3 at{*x, *y, *height};
  const Result<std::vector<bool>> inside = contains_each(p, q, std::span(&at, 1), semantics);
  if (!inside) return inside.error();
  return static_cast<bool>(inside->front());
}

// A convex sum as an operand of the next one, from its exact positions.

namespace {

using exact::Big;
using exact::BigInteger;

/// The sum's exact vertices and faces. Errors: unsupported_operand where positions are not multiples of a power of two.
Result<spatial::ExactSolid> exact_solid(const SpatialSum& sum) {
  const spatial::ConvexPositions* positions = spatial::SpatialSumInternals::convex(sum);
  if (!positions) return Error{ErrorCode::unsupported_operand, "this sum was not made of convex solids", {}};
  const exact::BigRational unit = positions->unit() / spatial::SpatialSumInternals::positions(sum).scale;
  const BigInteger num = numerator(unit), den = denominator(unit);
  if (den != BigInteger(1) << msb(den))
    return Error{ErrorCode::unsupported_operand,
                 "a turned or scaled sum, whose positions are no binary fractions, cannot be an operand",
                 {}};
  spatial::ExactSolid solid;
  solid.exponent = -static_cast<int>(msb(den));
  for (const spatial::BigVector& at : positions->numerators())
    solid.vertices.push_back(
        {Big(BigInteger(at[0] * num)), Big(BigInteger(at[1] * num)), Big(BigInteger(at[2] * num))});
  for (const SpatialFace& f : sum.faces) solid.faces.push_back(f.loops[0]);
  return solid;
}

}  // namespace

Result<ConvexSum> ConvexSum::create(const SpatialSum& p, const Mesh& q) { return convex_sum_within(p, q, 0); }

Result<ConvexSum> convex_sum_within(const SpatialSum& p, const Mesh& q, std::uint64_t memory) {
  Result<spatial::ExactSolid> solid = exact_solid(p);
  if (!solid) return solid.error();
  Result<spatial::Polytope> b = spatial::make_polytope(q);
  if (!b) return b.error();
  auto source = std::make_shared<spatial::ConvexOperands>();
  source->operand[0].exact = solid->vertices;
  source->operand[0].exponent = solid->exponent;
  source->operand[1].vertices = q.vertices();
  return spatial::ConvexSumInternals::of(std::make_shared<const spatial::Polytope>(spatial::make_polytope(*solid)),
                                         std::make_shared<const spatial::Polytope>(std::move(b).value()),
                                         std::move(source), memory);
}

}  // namespace dymsum
