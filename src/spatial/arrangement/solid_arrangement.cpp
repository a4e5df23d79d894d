#include "spatial/arrangement/solid_arrangement.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "base/memory_budget.h"

namespace dymsum::spatial {

namespace {

/// Facets joined by overlapping boxes within one plane.
std::vector<PlaneGroup> plane_groups(const FacetTable& table, const Contacts& contacts,
                                     std::vector<std::uint32_t>& group_of) {
  std::vector<std::uint32_t> parent(table.facets.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t f) {
    while (parent[f] != f) f = parent[f] = parent[parent[f]];
    return f;
  };
  for (const auto& [f, g] : contacts.coplanar) parent[root(f)] = root(g);
  std::vector<PlaneGroup> groups;
  std::size_t count = 0;
  for (std::uint32_t f = 0; f < parent.size(); ++f) count += root(f) == f;
  groups.reserve(count);
  std::vector<std::uint32_t> index(table.facets.size(), kNoId);
  group_of.resize(table.facets.size());
  for (std::uint32_t f = 0; f < table.facets.size(); ++f) {
    const std::uint32_t r = root(f);
    if (index[r] == kNoId) {
      index[r] = static_cast<std::uint32_t>(groups.size());
      groups.push_back({table.facets[f].plane, {}, {}, 0, {}});
    }
    group_of[f] = index[r];
    groups[index[r]].facets.push_back(f);
  }
  return groups;
}

int dropped_axis(const Plane& plane) {
  const double x = std::abs(plane.n.x), y = std::abs(plane.n.y), z = std::abs(plane.n.z);
  return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

/// Upright planes through facet edges: by edge and axis.
class UprightPlanes {
 public:
  explicit UprightPlanes(SumSpace& space) : space_(space), of_(3 * space.edges().size(), kNoId) {}

  void want(EdgeId edge, int axis) {
    PlaneId& id = of_[3 * edge + static_cast<std::size_t>(axis)];
    if (id != kNoId) return;
    id = static_cast<PlaneId>(sources_.size());
    const SumEdge& e = space_.edges()[edge];
    const DirectionSource u = e.from.q == e.to.q ? DirectionSource{DirectionSource::Of::p, e.from.p, e.to.p}
                                                 : DirectionSource{DirectionSource::Of::q, e.from.q, e.to.q};
    sources_.push_back({e.from, u, {DirectionSource::Of::axis, static_cast<std::uint32_t>(axis), 0}, false});
  }
  void make(int threads) { first_ = space_.add_planes(sources_, threads); }
  PlaneId get(EdgeId edge, int axis) const { return first_ + of_[3 * edge + static_cast<std::size_t>(axis)]; }

 private:
  SumSpace& space_;
  std::vector<PlaneId> of_;
  std::vector<PlaneSource> sources_;
  PlaneId first_ = 0;
};

/// Planes across facet edges. Of a group that nothing cuts only their sides are requested, now and then: there the
/// plane of a neighbour serves.
class CutPlanes {
 public:
  CutPlanes(SumSpace& space, const FacetTable& table, const Contacts& contacts, std::span<const PlaneCut> cuts,
            const std::vector<std::uint32_t>& group_of, std::span<const PlaneGroup> groups, int threads)
      : space_(space), table_(table), group_of_(group_of), upright_(space), uncut_(groups.size()) {
    for (std::size_t g = 0; g < groups.size(); ++g) uncut_[g] = groups[g].facets.size() == 1;
    for (const Contact& c : contacts.contacts) uncut_[group_of[c.f]] = uncut_[group_of[c.g]] = false;
    for (const PlaneCut& c : cuts) uncut_[group_of[c.facet]] = false;
    list_facets();
    for (std::uint32_t i = 0; i < table.facets.size(); ++i) {
      const TableFacet& f = table.facets[i];
      for (int k = 0; k < f.facet.corners; ++k)
        if (!table.is_inner(f.edge[k]) && neighbour(i, k) == kNoId)
          upright_.want(f.edge[k], dropped_axis(space.plane(f.plane)));
    }
    upright_.make(threads);
  }

  /// The facet edge from `a` at corner k of facet i to `b` at the next one as a segment.
  PlaneSegment segment(std::uint32_t i, int k, PointId a, PointId b) const {
    const TableFacet& f = table_.facets[i];
    const std::uint32_t other = neighbour(i, k);
    bool along = false;  // whether the way is n x n_cut
    PlaneId cut = 0;
    if (other != kNoId) {
      // The facet is to the left of the edge vector w, and w = l (n x n_cut), so that it lies below the cut where l >
      // 0.
      cut = table_.facets[other].plane;
      along = space_.side(cut, f.facet.corner[(k + 2) % f.facet.corners]) * f.side < 0;
    } else {
      const Plane& plane = space_.plane(f.plane);
      const int axis = dropped_axis(plane);
      const bool up = (axis == 0 ? plane.n.x : axis == 1 ? plane.n.y : plane.n.z) > 0;
      // n x (e x axis) = e n_axis: along the edge where the normal points up.
      cut = upright_.get(f.edge[k], axis), along = f.forward[k] == up;
    }
    // The facet is to the left of its facet edge seen against its own normal.
    const int inside = (along ? 1 : -1) * f.side;
    return {along ? a : b, along ? b : a, cut, static_cast<std::int8_t>(inside), f.side, f.edge[k], false, false};
  }

 private:
  /// Two facets at every edge of sums, where there are.
  void list_facets() {
    facets_.assign(space_.edges().size(), {kNoId, kNoId});
    for (std::uint32_t i = 0; i < table_.facets.size(); ++i)
      for (int k = 0; k < table_.facets[i].facet.corners; ++k) {
        auto& [first, second] = facets_[table_.facets[i].edge[k]];
        (first == kNoId ? first : second) = i;
      }
  }
  /// Another facet, in another plane, at a facet edge of a facet that nothing cuts; kNoId for none.
  std::uint32_t neighbour(std::uint32_t facet, int facet_edge) const {
    if (!uncut_[group_of_[facet]]) return kNoId;
    const auto [first, second] = facets_[table_.facets[facet].edge[facet_edge]];
    const std::uint32_t other = first == facet ? second : first;
    return other != kNoId && table_.facets[other].plane != table_.facets[facet].plane ? other : kNoId;
  }

  const SumSpace& space_;
  const FacetTable& table_;
  const std::vector<std::uint32_t>& group_of_;
  UprightPlanes upright_;
  std::vector<bool> uncut_;                           // per group
  std::vector<std::array<std::uint32_t, 2>> facets_;  // per edge of sums
};

/// Lists the edges of all planes by their ends: sorted by the smaller end, for each by the other one.
void collect_edges(SolidArrangement& all, StageWatch& watch) {
  std::vector<std::uint32_t> begin(all.points.size() + 1, 0);
  const auto for_each = [&](auto f) {
    for (std::uint32_t g = 0; g < all.groups.size(); ++g) {
      const PlaneGroup& group = all.groups[g];
      for (std::uint32_t e = 0; e < group.cells.edges.size(); ++e) {
        const PointId a = all.point(group, group.cells.edges[e].a), b = all.point(group, group.cells.edges[e].b);
        f(std::min(a, b), std::max(a, b), EdgeUse{g, e});
      }
    }
  };
  for_each([&](PointId a, PointId, EdgeUse) { ++begin[a + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  struct Use {
    PointId b;
    EdgeUse use;
  };
  std::vector<Use> uses(begin.back());
  std::vector<std::uint32_t> at(begin.begin(), begin.end() - 1);
  for_each([&](PointId a, PointId b, EdgeUse use) { uses[at[a]++] = {b, use}; });
  base::free_memory(at);
  watch.run_intervals(all.points.size(), 1024, [&](std::size_t, std::size_t from, std::size_t to) {
    for (std::size_t a = from; a < to; ++a)
      std::sort(uses.begin() + begin[a], uses.begin() + begin[a + 1], [](const Use& x, const Use& y) {
        return std::tie(x.b, x.use.group, x.use.edge) < std::tie(y.b, y.use.group, y.use.edge);
      });
  });
  std::size_t edges = 0;
  for (PointId a = 0; a + 1 < begin.size(); ++a)
    for (std::uint32_t k = begin[a]; k < begin[a + 1]; ++k) edges += k == begin[a] || uses[k].b != uses[k - 1].b;
  all.edge_uses.reserve(uses.size()), all.edge_ends.reserve(edges), all.first_use.reserve(edges + 1);
  for (PointId a = 0; a + 1 < begin.size(); ++a) {
    const auto first = uses.begin() + begin[a], last = uses.begin() + begin[a + 1];
    for (auto u = first; u != last; ++u) {
      if (u == first || u->b != (u - 1)->b) {
        all.edge_ends.push_back({a, u->b});
        all.first_use.push_back(static_cast<std::uint32_t>(all.edge_uses.size()));
      }
      all.edge_uses.push_back(u->use);
    }
  }
  all.first_use.push_back(static_cast<std::uint32_t>(all.edge_uses.size()));
}

/// The memory of cells, with that of the lists of edges and points that are made later.
std::size_t bytes_of(const PlaneCells& cells) {
  return sizeof(PlaneGroup) + cells.cells.size() * (sizeof(Cell) + 8) +
         cells.edges.size() * (sizeof(CellEdge) + 2 * sizeof(EdgeUse) + 12) + cells.half_edges.size() * 4 +
         cells.loops.size() * 4 + cells.found.size() * (2 * sizeof(PointSource) + sizeof(PointId));
}

/// What cuts the planes: segments of group g are list[begin[g] .. begin[g + 1]).
struct GroupSegments {
  std::vector<std::uint32_t> begin;
  std::vector<PlaneSegment> list;
};

/// Two facets of different planes that meet, from and to points that are listed beside this.
struct Meeting {
  std::uint32_t f, g;
  bool from_inner, to_inner;
};

/// Facet edges that are no inner ones, contacts in both planes, and cuts. Names their points: corners first, then ends
/// of contacts, then those of cuts.
GroupSegments segments_by_group(const FacetTable& table, Contacts contacts, std::span<const PlaneCut> cuts,
                                const CutPlanes& across, const std::vector<std::uint32_t>& group_of,
                                SolidArrangement& result, StageWatch& watch) {
  std::vector<PointSource> sources;
  sources.reserve(4 * table.facets.size() + 2 * contacts.contacts.size());
  for (const TableFacet& f : table.facets)
    for (int k = 0; k < f.facet.corners; ++k)
      sources.push_back({PointSource::Kind::sum, f.facet.corner[k].p, f.facet.corner[k].q, 0});
  std::vector<Meeting> meetings;
  meetings.reserve(contacts.contacts.size());
  for (const Contact& c : contacts.contacts) {
    sources.push_back(c.from), sources.push_back(c.to);
    meetings.push_back({c.f, c.g, c.from_inner, c.to_inner});
  }
  for (const PlaneCut& c : cuts) sources.push_back(c.from), sources.push_back(c.to);
  base::free_memory(contacts.contacts, contacts.coplanar);
  const std::vector<PointId> ids = result.points.add(sources, watch);
  base::free_memory(sources);

  GroupSegments of;
  of.begin.assign(result.groups.size() + 1, 0);
  for (std::uint32_t i = 0; i < table.facets.size(); ++i)
    for (int k = 0; k < table.facets[i].facet.corners; ++k)
      of.begin[group_of[i] + 1] += table.is_inner(table.facets[i].edge[k]) ? 0 : 1;
  for (const Meeting& m : meetings) ++of.begin[group_of[m.f] + 1], ++of.begin[group_of[m.g] + 1];
  for (const PlaneCut& c : cuts) ++of.begin[group_of[c.facet] + 1];
  std::partial_sum(of.begin.begin(), of.begin.end(), of.begin.begin());
  of.list.resize(of.begin.back());
  std::vector<std::uint32_t> next(of.begin.begin(), of.begin.end() - 1);
  const auto add = [&](std::uint32_t facet, const PlaneSegment& segment) {
    of.list[next[group_of[facet]]++] = segment;
  };
  std::size_t at = 0;
  for (std::uint32_t i = 0; i < table.facets.size(); ++i) {
    const TableFacet& f = table.facets[i];
    const int n = f.facet.corners;
    for (int k = 0; k < n; ++k)
      if (!table.is_inner(f.edge[k]))
        add(i, across.segment(i, k, ids[at + static_cast<std::size_t>(k)],
                              ids[at + static_cast<std::size_t>((k + 1) % n)]));
    at += static_cast<std::size_t>(n);
  }
  for (const Meeting& m : meetings) {
    const PointId from = ids[at++], to = ids[at++];
    add(m.f, {from, to, table.facets[m.g].plane, 0, 1, kNoId, m.from_inner, m.to_inner});
    add(m.g, {to, from, table.facets[m.f].plane, 0, 1, kNoId, m.to_inner, m.from_inner});
  }
  for (const PlaneCut& c : cuts) {
    const PointId from = ids[at++], to = ids[at++];
    add(c.facet, {from, to, c.plane, 0, 1, kNoId, c.from_inner, c.to_inner});
  }
  return of;
}

/// The cells of every plane.
void cut_planes(SumSpace& space, GroupSegments segments, SolidArrangement& result, StageWatch& watch) {
  constexpr std::size_t kPart = 64;
  const std::size_t count = result.groups.size();
  watch.run((count + kPart - 1) / kPart, [&](std::size_t part) {
    PlaneArranger arranger(space, result.points);
    std::size_t bytes = 0;
    for (std::size_t g = part * kPart; g < std::min(count, (part + 1) * kPart); ++g) {
      const PlaneSegment* of = segments.list.data();
      result.groups[g].cells =
          arranger.run(result.groups[g].plane, {of + segments.begin[g], of + segments.begin[g + 1]});
      bytes += bytes_of(result.groups[g].cells);
    }
    watch.hold(bytes);
  });
}

/// Crossings get names, as the same point is found in several planes; cells are numbered through.
void name_crossings(SolidArrangement& result, StageWatch& watch) {
  std::size_t found = 0;
  for (const PlaneGroup& group : result.groups) found += group.cells.found.size();
  std::vector<PointSource> sources;
  sources.reserve(found);
  for (PlaneGroup& group : result.groups) {
    sources.insert(sources.end(), group.cells.found.begin(), group.cells.found.end());
    group.names.resize(group.cells.found.size());
    base::free_memory(group.cells.found);
  }
  const std::vector<PointId> names = result.points.add(sources, watch);
  std::size_t at = 0;
  for (PlaneGroup& group : result.groups) {
    for (PointId& name : group.names) name = names[at++];
    group.first_cell = result.cell_count;
    result.cell_count += static_cast<std::uint32_t>(group.cells.cells.size());
  }
}

void add_sheets(std::span<const Sheet> sheets, SolidArrangement& result, StageWatch& watch) {
  std::vector<PointSource> sources;
  for (const Sheet& sheet : sheets)
    for (const auto& ends : sheet.rim)
      for (const SumPoint s : ends) sources.push_back({PointSource::Kind::sum, s.p, s.q, 0});
  const std::vector<PointId> ids = result.points.add(sources, watch);
  std::size_t at = 0;
  for (const Sheet& sheet : sheets) {
    PlaneGroup& group = result.groups.emplace_back();
    group.first_cell = result.cell_count++;
    group.cells.known = static_cast<PointId>(result.points.size());
    group.cells.cells.push_back({1, 0, 0, 0});
    for (std::size_t k = 0; k < sheet.rim.size(); ++k, at += 2) {
      const PointId a = ids[at], b = ids[at + 1];
      CellEdge edge{std::min(a, b), std::max(a, b)};
      (a < b ? edge.left : edge.right) = 0;
      group.cells.edges.push_back(edge);
    }
  }
}

}  // namespace

std::uint32_t SolidArrangement::group_of(std::uint32_t cell) const {
  const auto at = std::upper_bound(groups.begin(), groups.end(), cell,
                                   [](std::uint32_t c, const PlaneGroup& g) { return c < g.first_cell; });
  return static_cast<std::uint32_t>(at - groups.begin()) - 1;
}

SolidArrangement arrange(SumSpace& space, const FacetTable& table, Contacts contacts, StageWatch& watch,
                         std::span<const PlaneCut> cuts, std::span<const Sheet> sheets) {
  SolidArrangement result(space);
  std::vector<std::uint32_t> group_of;
  result.groups = plane_groups(table, contacts, group_of);
  const CutPlanes across(space, table, contacts, cuts, group_of, result.groups, watch.threads());
  GroupSegments segments = segments_by_group(table, std::move(contacts), cuts, across, group_of, result, watch);
  base::free_memory(group_of);
  cut_planes(space, std::move(segments), result, watch);
  name_crossings(result, watch);
  if (!sheets.empty()) add_sheets(sheets, result, watch);
  collect_edges(result, watch);
  return result;
}

}  // namespace dymsum::spatial
