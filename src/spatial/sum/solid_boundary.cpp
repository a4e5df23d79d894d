#include "spatial/sum/solid_boundary.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/memory_budget.h"
#include "spatial/boundary/collision.h"

namespace dymsum::spatial {
namespace {

constexpr std::int8_t kNoWall = 2;  // of a cell's facing: it is looked through

}  // namespace

CellLinks link_cells(const SumSpace& space, const SolidArrangement& arrangement, StageWatch& watch,
                     const ArrangementScope* scope) {
  const std::uint32_t covered = arrangement.cell_count;
  std::vector<std::int8_t> facing;  // 1 where the free side is the normal's, -1 the other one, 0 none
  facing.reserve(covered);
  for (const PlaneGroup& group : arrangement.groups)
    for (const Cell& cell : group.cells.cells)
      facing.push_back(cell.front > 0 ? cell.back > 0 ? 0 : 1 : cell.back > 0 ? -1 : kNoWall);
  for (std::uint32_t c = 0; c < covered && scope != nullptr; ++c)
    if (!scope->cells[c]) facing[c] = kNoWall;

  constexpr std::size_t kPart = 2048;
  const std::size_t edges = arrangement.edge_ends.size();
  std::vector<std::vector<std::array<std::uint32_t, 2>>> joins((edges + kPart - 1) / kPart);
  watch.run(joins.size(), [&](std::size_t part) {
    EdgeWedges wedges(space, arrangement, [&](std::uint32_t cell) { return facing[cell] != kNoWall; });
    // The cell whose free side that is, or what is covered.
    const auto free = [&](CellSide s) { return facing[s.cell] == s.side ? s.cell : covered; };
    for (std::size_t e = part * kPart; e < std::min(edges, (part + 1) * kPart); ++e) {
      if (scope != nullptr && !scope->edges[e]) continue;
      wedges.for_each(static_cast<std::uint32_t>(e), [&](CellSide a, CellSide b) {
        const std::uint32_t x = free(a), y = free(b);
        if (x != y) joins[part].push_back({x, y});
      });
    }
  });

  std::vector<std::uint32_t> parent(covered + 1);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t c) {
    while (parent[c] != c) c = parent[c] = parent[parent[c]];
    return c;
  };
  for (std::uint32_t c = 0; c < covered; ++c)
    if (facing[c] == 0) parent[root(c)] = root(covered);
  for (const auto& part : joins)
    for (const auto& [x, y] : part) parent[root(x)] = root(y);

  CellLinks links;
  links.patch.assign(covered, kNoId);
  std::vector<std::uint32_t> index(parent.size(), kNoId);
  const std::uint32_t buried = root(covered);
  for (std::uint32_t c = 0; c < covered; ++c) {
    const std::uint32_t r = root(c);
    if (r == buried || facing[c] == kNoWall) continue;
    if (index[r] == kNoId) index[r] = links.patches++;
    links.patch[c] = index[r];
  }
  return links;
}

namespace {

template <class F>
void for_each_cell(const SolidArrangement& arrangement, F f) {
  for (const PlaneGroup& group : arrangement.groups)
    for (std::uint32_t c = 0; c < group.cells.cells.size(); ++c) f(group, group.first_cell + c, group.cells.cells[c]);
}

/// Patches whose front lies outside: one collision test each.
void judge_patches(SolidBoundary& result, const CellLinks& links, const Collision& collision, StageWatch& watch) {
  enum class Verdict : std::uint8_t { unknown, outside, covered };
  std::vector<Verdict> verdict(links.patches, Verdict::unknown);
  for_each_cell(*result.arrangement, [&](const PlaneGroup& group, std::uint32_t id, const Cell& cell) {
    const std::uint32_t patch = links.patch[id];
    if (patch == kNoId) return;
    if (verdict[patch] == Verdict::unknown) {
      if (collision.tests() % 16 == 15) watch.query(0);
      const bool meets = collision.meets(flag_at(*result.arrangement, group, cell, cell.front > 0 ? 1 : -1));
      verdict[patch] = meets ? Verdict::covered : Verdict::outside;
    }
    result.boundary[id] = verdict[patch] == Verdict::outside;
  });
  result.patch = links.patch;
}

/// Every cell by itself: facets of one direction, and nothing in front.
void judge_cells(SolidBoundary& result, const Collision& collision, StageWatch& watch) {
  for_each_cell(*result.arrangement, [&](const PlaneGroup& group, std::uint32_t id, const Cell& cell) {
    if (id % 16 == 15) watch.query(static_cast<double>(id) / result.arrangement->cell_count);
    const bool above = !collision.meets(flag_at(*result.arrangement, group, cell, 1));
    const bool below = !collision.meets(flag_at(*result.arrangement, group, cell, -1));
    result.boundary[id] = above != below;
  });
}

/// Facets deep inside the open sum bound nothing, and without them off the facets there still are only cells of the
/// open sum and cells of the outside.
std::size_t drop_inner(ReducedConvolution& convolution, const InnerCells& inner, StageWatch& watch) {
  if (inner.empty()) return 0;
  std::vector<std::uint8_t> inside(convolution.facets.size());
  watch.run_intervals(inside.size(), 512, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) inside[f] = inner.hold(convolution.facets[f]);
  });
  std::size_t kept = 0;
  for (std::size_t f = 0; f < convolution.facets.size(); ++f) {
    if (inside[f] != 0) continue;
    convolution.facets[kept] = convolution.facets[f];
    convolution.planes[kept++] = convolution.planes[f];
  }
  const std::size_t dropped = convolution.facets.size() - kept;
  convolution.facets.resize(kept), convolution.planes.resize(kept);
  return dropped;
}

/// Behind a facet of two thin parts need not be anything: each cell is given the directions that its two sides tell,
/// both where it lies in the sum, none where it lies outside.
void look_at_both_sides(SolidArrangement& arrangement, const Collision& collision, StageWatch& watch) {
  for (PlaneGroup& group : arrangement.groups) {
    for (Cell& cell : group.cells.cells) {
      if (collision.tests() % 16 == 15) watch.query(0);
      const bool above = collision.meets(flag_at(arrangement, group, cell, 1));
      const bool below = collision.meets(flag_at(arrangement, group, cell, -1));
      cell.front = below;
      cell.back = above;
    }
  }
}

/// After that: the cells that closed operands hold by parts without volume alone. Nothing of the sum lies on either
/// side of them.
TightFeatures cells_of_thin_parts(const SolidArrangement& arrangement, const Collision& collision, StageWatch& watch) {
  TightFeatures found;
  for_each_cell(arrangement, [&](const PlaneGroup& group, std::uint32_t id, const Cell& cell) {
    if (cell.front != 0 || cell.back != 0) return;
    if (++found.tests % 16 == 0) watch.query(0);
    if (collision.touches(flag_at(arrangement, group, cell, 0))) found.cells.push_back(id);
  });
  return found;
}

}  // namespace

std::uint64_t table_bytes(std::size_t facets) { return facets * (sizeof(TableFacet) + 900); }

void find_cells(SolidBoundary& boundary, SpatialStats& stats, StageWatch& watch) {
  watch.begin("contacts");
  Contacts contacts = find_contacts(*boundary.space, boundary.table, watch);
  stats.box_pairs = contacts.counts.box_pairs, stats.contacts = contacts.counts.contacts;
  watch.begin("arrangement");
  boundary.arrangement =
      std::make_unique<SolidArrangement>(arrange(*boundary.space, boundary.table, std::move(contacts), watch));
}

int inner_boxes_across(std::size_t facets) { return facets < 500 ? 0 : facets < 2000 ? 32 : facets < 20000 ? 62 : 126; }

Flag flag_at(const SolidArrangement& arrangement, const PlaneGroup& group, const Cell& cell, int side) {
  const std::uint32_t h = group.cells.half_edges[group.cells.loops[cell.first_loop]];
  const CellEdge& e = group.cells.edges[h / 2];
  const PointId at = arrangement.point(group, h & 1 ? e.b : e.a);
  const auto direction = static_cast<std::int8_t>((e.along ? 1 : -1) * (h & 1 ? -1 : 1));
  return {arrangement.points.source(at), group.plane, e.cut, direction, 1, static_cast<std::int8_t>(side)};
}

std::unique_ptr<SumSpace> space_of(const SolidOperand& p, const SolidOperand& q) {
  if (p.exact.empty()) return make_sum_space(p.vertices, q.vertices);
  return make_sum_space(p.exact, q.exact, p.exponent);
}

SolidBoundary solid_boundary(const SolidOperand& p, const SolidOperand& q, const SpatialOptions& options,
                             SpatialStats& stats, StageWatch& watch) {
  watch.begin("convolution");
  std::unique_ptr<SumSpace> space = space_of(p, q);
  ReducedConvolution convolution = reduced_convolution(*space, p, q, watch);
  return solid_boundary(std::move(space), std::move(convolution), p, q, {}, options, stats, watch);
}

SolidBoundary solid_boundary(std::unique_ptr<SumSpace> space, ReducedConvolution convolution, const SolidOperand& p,
                             const SolidOperand& q, const ConvolutionHints& hints, const SpatialOptions& options,
                             SpatialStats& stats, StageWatch& watch) {
  SolidBoundary result;
  result.space = std::move(space);
  // What is left out for speed is proved for solids alone.
  const bool fast = options.engine == SpatialEngine::fast && !p.has_thin() && !q.has_thin();
  const int across = fast && !hints.inner_dropped ? inner_boxes_across(convolution.facets.size()) : 0;
  const InnerCells inner(*result.space, p, q, across, watch);
  stats.inner_facets = drop_inner(convolution, inner, watch);
  watch.hold(table_bytes(convolution.facets.size()));
  result.table = facet_table(*result.space, convolution, watch);
  if (fast) find_inner_edges(*result.space, p, q, result.table);
  base::free_memory(convolution.facets, convolution.planes);
  find_cells(result, stats, watch);
  const Collision collision(*result.space, p, q, &inner);
  const bool both_thin = result.either_side = p.has_thin() && q.has_thin();
  if (both_thin && options.semantics == Semantics::open)
    if (const auto crossing = find_thin_crossing(*result.space, p, q)) throw NoOpenSum{*crossing};
  if (both_thin) look_at_both_sides(*result.arrangement, collision, watch);
  watch.begin("links");
  const CellLinks links = link_cells(*result.space, *result.arrangement, watch);
  watch.begin("collisions");
  result.boundary.assign(result.arrangement->cell_count, false);
  if (options.engine == SpatialEngine::brute) judge_cells(result, collision, watch);
  else judge_patches(result, links, collision, watch);
  result.patch = links.patch;
  stats.collision_tests = collision.tests();
  watch.begin("tight features");
  if (options.tight && options.semantics == Semantics::closed && both_thin)
    result.tight = cells_of_thin_parts(*result.arrangement, collision, watch);
  else if (options.tight && options.semantics != Semantics::regular)
    result.tight =
        tight_features(*result.space, result.table, *result.arrangement, result.boundary, collision, !fast, watch);
  watch.begin("");
  stats.bits = result.space->bits();
  stats.face_vertex = convolution.counts.face_vertex, stats.edge_edge = convolution.counts.edge_edge;
  stats.points = result.arrangement->points.size(), stats.cells = result.arrangement->cell_count,
  stats.patches = links.patches;
  stats.tight_tests = result.tight.tests;
  stats.held_bytes = watch.held();
  stats.double_pair_signs = result.space->signs().at(exact::Rung::double_pairs);
  stats.exact_signs = result.space->signs().exact();
  return result;
}

}  // namespace dymsum::spatial
