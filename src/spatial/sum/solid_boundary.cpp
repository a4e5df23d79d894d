#include "spatial/sum/solid_boundary.h"

#include <chrono>

#include "base/parallel.h"
#include "spatial/boundary/cell_links.h"

namespace dymsum::spatial {

namespace {

class Stages {
 public:
  Stages(const SpatialOptions& options, SpatialStats& stats) : options_(options), stats_(stats) {}

  /// Ends the stage before it and begins one.
  void begin(std::string_view name) {
    const auto now = std::chrono::steady_clock::now();
    if (!stats_.stages.empty())
      stats_.stages.back().ms = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    if (name.empty()) return;
    stats_.stages.push_back({name, 0});
    if (options_.progress && !options_.progress(name, 0)) throw Cancelled{};
  }

 private:
  const SpatialOptions& options_;
  SpatialStats& stats_;
  std::chrono::steady_clock::time_point last_;
};

template <class F>
void for_each_cell(const SolidArrangement& arrangement, F f) {
  for (const PlaneGroup& group : arrangement.groups)
    for (std::uint32_t c = 0; c < group.cells.cells.size(); ++c) f(group, group.first_cell + c, group.cells.cells[c]);
}

/// Patches whose front lies outside: one collision test each.
void judge_patches(SolidBoundary& result, const CellLinks& links, const Collision& collision) {
  enum class Verdict : std::uint8_t { unknown, outside, covered };
  std::vector<Verdict> verdict(links.patches, Verdict::unknown);
  for_each_cell(*result.arrangement, [&](const PlaneGroup& group, std::uint32_t id, const Cell& cell) {
    const std::uint32_t patch = links.patch[id];
    if (patch == kNoId) return;
    if (verdict[patch] == Verdict::unknown) {
      const bool meets = collision.meets(flag_at(*result.arrangement, group, cell, cell.front > 0 ? 1 : -1));
      verdict[patch] = meets ? Verdict::covered : Verdict::outside;
    }
    result.boundary[id] = verdict[patch] == Verdict::outside;
  });
  result.patch = links.patch;
}

/// Every cell by itself: facets of one direction, and nothing in front.
void judge_cells(SolidBoundary& result, const Collision& collision) {
  for_each_cell(*result.arrangement, [&](const PlaneGroup& group, std::uint32_t id, const Cell& cell) {
    const bool above = !collision.meets(flag_at(*result.arrangement, group, cell, 1));
    const bool below = !collision.meets(flag_at(*result.arrangement, group, cell, -1));
    result.boundary[id] = above != below;
  });
}

/// Behind a facet of two thin parts need not be anything: each cell is given the directions that its two sides tell,
/// none where they are alike.
void look_at_both_sides(SolidArrangement& arrangement, const Collision& collision) {
  for (PlaneGroup& group : arrangement.groups) {
    for (Cell& cell : group.cells.cells) {
      const bool above = collision.meets(flag_at(arrangement, group, cell, 1));
      const bool below = collision.meets(flag_at(arrangement, group, cell, -1));
      cell.front = below && !above;
      cell.back = above && !below;
    }
  }
}

}  // namespace

Flag flag_at(const SolidArrangement& arrangement, const PlaneGroup& group, const Cell& cell, int side) {
  const std::uint32_t h = group.cells.half_edges[group.cells.loops[cell.first_loop]];
  const CellEdge& e = group.cells.edges[h / 2];
  const PointId at = arrangement.point(group, h & 1 ? e.b : e.a);
  const auto way = static_cast<std::int8_t>((e.along ? 1 : -1) * (h & 1 ? -1 : 1));
  return {arrangement.points.source(at), group.plane, e.cut, way, 1, static_cast<std::int8_t>(side)};
}

SolidBoundary solid_boundary(const SolidOperand& p, const SolidOperand& q, const SpatialOptions& options,
                             SpatialStats& stats) {
  SolidBoundary result;
  Stages stages(options, stats);
  stages.begin("convolution");
  result.space = make_sum_space(p.vertices, q.vertices);
  const ReducedConvolution convolution = reduced_convolution(*result.space, p, q);
  result.table = facet_table(*result.space, convolution);
  stages.begin("contacts");
  const Contacts contacts = find_contacts(*result.space, result.table);
  stages.begin("arrangement");
  result.arrangement =
      std::make_unique<SolidArrangement>(arrange(*result.space, result.table, contacts, options.threads));
  const Collision collision(*result.space, p, q);
  const bool both_thin = p.has_thin() && q.has_thin();
  if (both_thin) look_at_both_sides(*result.arrangement, collision);
  stages.begin("links");
  const CellLinks links = link_cells(*result.space, *result.arrangement);
  stages.begin("collisions");
  result.boundary.assign(result.arrangement->cell_count, false);
  if (options.engine == SpatialEngine::brute) judge_cells(result, collision);
  else judge_patches(result, links, collision);
  result.patch = links.patch;
  stats.collision_tests = collision.tests();
  stages.begin("tight features");
  if (options.tight && options.semantics != Semantics::regular && !both_thin)
    result.tight = tight_features(*result.space, *result.arrangement, result.boundary, collision);
  stages.begin("");
  stats.bits = result.space->bits();
  stats.face_vertex = convolution.counts.face_vertex, stats.edge_edge = convolution.counts.edge_edge;
  stats.box_pairs = contacts.counts.box_pairs, stats.contacts = contacts.counts.contacts;
  stats.points = result.arrangement->points.size(), stats.cells = result.arrangement->cell_count,
  stats.patches = links.patches;
  stats.tight_tests = result.tight.tests;
  stats.exact_signs = result.space->exact_signs();
  return result;
}

}  // namespace dymsum::spatial
