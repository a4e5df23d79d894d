#include "spatial/local/local_boundary.h"

#include <algorithm>

#include "spatial/boundary/cell_links.h"

namespace dymsum::spatial {

namespace {

using Scopes = ClipWalls::Scopes;

bool overlaps_at(SumSpace& space, const exact::BigInteger& scale, const Collision& collision, const Centre& centre) {
  const std::optional<PointSource> at =
      space.add_position({centre.at[0] * scale, centre.at[1] * scale, centre.at[2] * scale});
  return at && collision.overlaps({*at, 0, 0, 0, 0, 0});
}

class LocalStages {
 public:
  LocalStages(SolidBoundary& result, const Scopes& scopes, const Collision& collision, StageWatch& watch)
      : result_(result), arrangement_(*result.arrangement), scopes_(scopes), collision_(collision), watch_(watch) {}

  /// One test for each patch in the larger box.
  void judge_patches() {
    const ArrangementScope linked{{}, scopes_.within_linked, scopes_.within.cells};
    const CellLinks links = link_cells(*result_.space, arrangement_, watch_, &linked);
    enum class Verdict : std::uint8_t { unknown, outside, covered };
    std::vector<Verdict> verdict(links.patches, Verdict::unknown);
    result_.boundary.assign(arrangement_.cell_count, false);
    for_each_cell([&](const PlaneGroup& group, std::uint32_t id, const Cell& cell) {
      if (links.patch[id] == kNoId) return;
      Verdict& known = verdict[links.patch[id]];
      if (known == Verdict::unknown) known = is_free(group, cell, facing(cell)) ? Verdict::outside : Verdict::covered;
      result_.boundary[id] = known == Verdict::outside;
    });
  }

  /// Every cell by itself.
  void judge_cells() {
    result_.boundary.assign(arrangement_.cell_count, false);
    for_each_cell([&](const PlaneGroup& group, std::uint32_t id, const Cell& cell) {
      result_.boundary[id] = is_free(group, cell, 1) != is_free(group, cell, -1);
    });
  }

  /// Finds tight features in the larger box, so that all is known around what lies in the box; keeps only what lies
  /// there.
  void find_tight(bool every_position) {
    const ArrangementScope looked_at{scopes_.inside.points, scopes_.within.edges, scopes_.within.cells};
    result_.tight = tight_features(*result_.space, result_.table, arrangement_, result_.boundary, collision_,
                                   every_position, watch_, &looked_at);
    std::erase_if(result_.tight.cells, [&](std::uint32_t c) { return !scopes_.inside.cells[c]; });
    std::erase_if(result_.tight.segments, [&](const std::array<PointId, 2>& s) {
      return !scopes_.inside.points[s[0]] || !scopes_.inside.points[s[1]];
    });
  }

  /// Cells of the boundary that lie in the box, in pieces that hang together there.
  void keep_inside() {
    const ArrangementScope linked{{}, scopes_.inside_linked, scopes_.inside.cells};
    result_.patch = link_cells(*result_.space, arrangement_, watch_, &linked).patch;
    for (std::uint32_t c = 0; c < arrangement_.cell_count; ++c)
      if (!scopes_.inside.cells[c]) result_.boundary[c] = false;
  }

  bool is_empty() const {
    return std::find(result_.boundary.begin(), result_.boundary.end(), true) == result_.boundary.end() &&
           result_.tight.cells.empty() && result_.tight.segments.empty() && result_.tight.points.empty();
  }

 private:
  template <class F>
  void for_each_cell(F f) const {
    for (const PlaneGroup& group : arrangement_.groups)
      for (std::uint32_t c = 0; c < group.cells.cells.size(); ++c) f(group, group.first_cell + c, group.cells.cells[c]);
  }
  static int facing(const Cell& cell) { return cell.front > 0 ? 1 : -1; }
  bool is_free(const PlaneGroup& group, const Cell& cell, int side) const {
    if (collision_.tests() % 16 == 15) watch_.query(0);
    return !collision_.meets(flag_at(arrangement_, group, cell, side));
  }

  SolidBoundary& result_;
  const SolidArrangement& arrangement_;
  const Scopes& scopes_;
  const Collision& collision_;
  StageWatch& watch_;
};

}  // namespace

bool comes_near(const SumSpace& space, const SumFacet& facet, const Box& box) {
  Box of;
  for (int k = 0; k < facet.corners; ++k) of.add(space.approx(facet.corner[static_cast<std::size_t>(k)]));
  return overlap(of, box);
}

LocalBoundary local_boundary(PosedSpace& space, ReducedConvolution convolution, const SolidPair& pair, ClipWalls& walls,
                             const Centre& centre, const SpatialOptions& options, SpatialStats& stats,
                             StageWatch& watch) {
  const bool brute = options.engine == SpatialEngine::brute;
  const auto vertices = static_cast<std::uint32_t>(pair.p.vertices.size());
  LocalBoundary local;
  SolidBoundary& result = local.boundary;
  result.space = std::move(space.space);
  result.table = facet_table(*result.space, convolution, watch);
  if (!brute) find_inner_edges(*result.space, pair.p, pair.q, result.table);
  walls.add_planes(*result.space, vertices);
  watch.begin("contacts");
  const Box reach = walls.reach(*result.space, vertices);
  Contacts contacts = find_contacts(*result.space, result.table, watch, brute ? nullptr : &reach);
  stats.box_pairs = contacts.counts.box_pairs, stats.contacts = contacts.counts.contacts;
  watch.begin("arrangement");
  const std::vector<PlaneCut> cuts = plane_cuts(*result.space, result.table, walls.planes());
  result.arrangement =
      std::make_unique<SolidArrangement>(arrange(*result.space, result.table, std::move(contacts), watch, cuts));
  const Scopes scopes = walls.scopes(*result.space, *result.arrangement);
  watch.begin("collisions");
  const Collision collision(*result.space, pair.p, pair.q);
  LocalStages stages(result, scopes, collision, watch);
  if (brute) stages.judge_cells();
  else stages.judge_patches();
  stats.collision_tests = collision.tests();
  watch.begin("tight features");
  if (options.tight) stages.find_tight(brute);
  stages.keep_inside();
  if (centre.always || stages.is_empty())
    local.centre_inside = overlaps_at(*result.space, space.scale, collision, centre);
  watch.begin("");
  stats.bits = result.space->bits();
  stats.points = result.arrangement->points.size(), stats.cells = result.arrangement->cell_count;
  stats.tight_tests = result.tight.tests;
  stats.double_pair_signs = result.space->signs().at(exact::Rung::double_pairs);
  stats.exact_signs = result.space->signs().exact();
  return local;
}

}  // namespace dymsum::spatial
