#include "spatial/arrangement/contacts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/memory_budget.h"
#include "spatial/arrangement/near_pairs.h"

namespace dymsum::spatial {
namespace {

void share_planes(const SumSpace& space, PlaneId first, FacetTable& table, StageWatch& watch) {
  const std::vector<exact::Residue> hash = space.plane_hashes(first, table.facets.size());
  std::vector<std::uint32_t> order(hash.size());
  std::iota(order.begin(), order.end(), 0u);
  watch.sort(order, [&](std::uint32_t a, std::uint32_t b) { return std::tie(hash[a], a) < std::tie(hash[b], b); });
  // The leaders of the planes with one hash, nearly always one; they stand after those with the hash 0, which may be
  // any plane and come first.
  std::vector<std::uint32_t> leaders;
  std::size_t wild = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k == 0 || hash[order[k]] != hash[order[k - 1]]) {
      if (k > 0 && hash[order[k - 1]] == 0) wild = leaders.size();
      leaders.resize(wild);
    }
    TableFacet& facet = table.facets[order[k]];
    facet.plane = first + order[k], facet.side = 1;
    int same = 0;
    for (const std::uint32_t leader : leaders) {
      same = space.same_plane(first + leader, facet.plane);
      if (same == 0) continue;
      facet.plane = first + leader, facet.side = static_cast<std::int8_t>(same);
      break;
    }
    if (same == 0) leaders.push_back(order[k]);
  }
}

/// Edges once, in the order in which facets have them.
void share_edges(SumSpace& space, FacetTable& table) {
  const auto before = static_cast<EdgeId>(space.edges().size());
  std::vector<SumEdge> edges;
  std::vector<std::uint32_t> slots(std::bit_ceil(4 * table.facets.size() + 1), kNoId);  // open addressing
  for (TableFacet& facet : table.facets) {
    const int n = facet.facet.corners;
    for (int k = 0; k < n; ++k) {
      SumEdge edge{facet.facet.corner[k], facet.facet.corner[(k + 1) % n]};
      facet.forward[k] = edge.from < edge.to;
      if (!facet.forward[k]) std::swap(edge.from, edge.to);
      const auto pair = [](SumPoint s) { return static_cast<std::uint64_t>(s.p) << 32 | s.q; };
      const std::uint64_t mixed = pair(edge.from) * 0x9e3779b97f4a7c15ULL + pair(edge.to) * 0xd6e8feb86659fd93ULL;
      std::size_t at = (mixed >> 32) & (slots.size() - 1);
      while (slots[at] != kNoId && edges[slots[at]] != edge) at = (at + 1) & (slots.size() - 1);
      if (slots[at] == kNoId) {
        slots[at] = static_cast<std::uint32_t>(edges.size());
        edges.push_back(edge);
      }
      facet.edge[k] = before + slots[at];
    }
  }
  space.add_edges(edges);
}

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
}

/// The edges of solid parts between two triangles in one plane, and no others: true in the map.
std::unordered_map<std::uint64_t, bool> flat_edges(const SolidOperand& solid) {
  std::unordered_map<std::uint64_t, bool> flat;
  for (const Wedge& w : solid.wedges)
    if (w.bend == Wedge::Bend::flat && !w.is_segment() && w.left < solid.first_plate)
      flat.emplace(edge_key(w.from, w.to), true);
  if (flat.empty()) return flat;
  // What else meets there makes it an edge like others.
  std::unordered_map<std::uint64_t, int> wedges;
  for (const Wedge& w : solid.wedges)
    if (const auto at = flat.find(edge_key(w.from, w.to)); at != flat.end() && ++wedges[at->first] > 1)
      at->second = false;
  return flat;
}

}  // namespace

void find_inner_edges(const SumSpace& space, const SolidOperand& p, const SolidOperand& q, FacetTable& table) {
  const std::unordered_map<std::uint64_t, bool> flat[2] = {flat_edges(p), flat_edges(q)};
  if (flat[0].empty() && flat[1].empty()) return;
  std::vector<int> balance(space.edges().size(), 0);  // of facets to either side
  for (const TableFacet& f : table.facets)
    for (int k = 0; k < f.facet.corners; ++k) balance[f.edge[k]] += f.forward[k] ? 1 : -1;
  table.inner.assign(space.edges().size(), false);
  for (EdgeId e = 0; e < balance.size(); ++e) {
    const SumEdge& edge = space.edges()[e];
    const bool of_p = edge.from.q == edge.to.q;
    const std::uint64_t key = of_p ? edge_key(edge.from.p, edge.to.p) : edge_key(edge.from.q, edge.to.q);
    const auto at = flat[of_p ? 0 : 1].find(key);
    table.inner[e] = balance[e] == 0 && at != flat[of_p ? 0 : 1].end() && at->second;
  }
}

void find_inner_edges(const SumSpace& space, FacetTable& table) {
  struct Beside {
    std::uint32_t facets = 0, first = 0;
    bool forward = false, inner = false;
  };
  std::vector<Beside> edges(space.edges().size());
  for (std::uint32_t i = 0; i < table.facets.size(); ++i) {
    const TableFacet& f = table.facets[i];
    for (int k = 0; k < f.facet.corners; ++k) {
      Beside& at = edges[f.edge[k]];
      const TableFacet& first = table.facets[at.first];
      at.inner = ++at.facets == 2 && first.plane == f.plane && first.side == f.side && at.forward != f.forward[k];
      if (at.facets == 1) at.first = i, at.forward = f.forward[k];
    }
  }
  table.inner.resize(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) table.inner[e] = edges[e].inner;
}

FacetTable facet_table(SumSpace& space, const ReducedConvolution& convolution, StageWatch& watch) {
  FacetTable table;
  table.facets.reserve(convolution.facets.size());
  for (const SumFacet& facet : convolution.facets) table.facets.push_back({facet, 0, 1, {}, {}});
  share_planes(space, space.add_planes(convolution.planes, watch.threads()), table, watch);
  share_edges(space, table);
  return table;
}

namespace {

/// An end of the interval that a facet has on another one's plane: where `facet_edge` (from corner k to k + 1) meets
/// the plane, along which the height over the plane rises by the sign `rise`; `corner` where that is a corner.
struct End {
  int facet_edge = -1, rise = 0, corner = -1;
};

struct Chord {
  End from, to;
};

/// The nearest doubles of a facet's corners.
using Corners = std::array<Vec3, 4>;

Corners corners_of(const SumSpace& space, const TableFacet& f) {
  Corners corners;
  for (int k = 0; k < f.facet.corners; ++k) corners[static_cast<std::size_t>(k)] = space.approx(f.facet.corner[k]);
  return corners;
}

/// The interval of facet f on a plane, in the direction n_f x n_plane. None where they do not meet.
std::optional<Chord> chord(const SumSpace& space, const TableFacet& f, const Corners& corners, PlaneId plane) {
  const int n = f.facet.corners;
  const Plane& cut = space.plane(plane);
  const double error = cut.slack + cut.norm1 * space.sum_radius();
  int s[4];
  bool above = false, below = false, on = false;
  for (int k = 0; k < n; ++k) {
    const double height = dot(cut.n, corners[static_cast<std::size_t>(k)]) - cut.d;
    s[k] = height > error ? 1 : height < -error ? -1 : space.side(plane, f.facet.corner[k]);
    above |= s[k] > 0, below |= s[k] < 0, on |= s[k] == 0;
  }
  if (!on && !(above && below)) return std::nullopt;
  Chord result;
  // Counter-clockwise about the plane's normal the facet edge leaves the upper side at the interval's end and comes
  // back at its beginning.
  const auto take = [&](bool end, End e) { (end == (f.side > 0) ? result.to : result.from) = e; };
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n, before = (k + n - 1) % n;
    if (s[k] * s[next] < 0) take(s[k] > 0, {k, s[next] - s[k] > 0 ? 1 : -1, -1});
    if (s[k] != 0) continue;
    // The facet edge after or before the corner that leaves the plane; one does.
    const End here = s[next] != 0 ? End{k, s[next], k} : End{before, -s[before], k};
    if (s[before] == 0) {
      // The side `before` lies in the plane: it runs backward where the facet is above.
      take(s[next] < 0, here);
    } else if (s[next] == 0) {
      take(s[before] > 0, here);
    } else if (s[before] == s[next]) {
      result = {here, here};
    } else {
      take(s[before] > 0, here);
    }
  }
  return result;
}

SumEdge facet_edge(const TableFacet& f, int k) {
  return {f.facet.corner[k], f.facet.corner[(k + 1) % f.facet.corners]};
}

/// A facet with its corners.
struct Placed {
  const TableFacet& facet;
  const Corners& at;
};

int twist(const SumSpace& space, const Placed& f, int k, const Placed& g, int l) {
  const auto norm = [&](Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z) + 4 * space.sum_radius(); };
  const auto corner = [](const Placed& p, int i) { return p.at[static_cast<std::size_t>(i % p.facet.facet.corners)]; };
  const Vec3 from = corner(f, k), u = corner(f, k + 1) - from, v = corner(g, l + 1) - corner(g, l),
             w = corner(g, l) - from;
  const double U = norm(u), V = norm(v), W = norm(w);
  const double value = dot(cross(u, v), w);
  const double error = U * V * W * 0x1p-48 + 8 * space.sum_radius() * (U * V + V * W + U * W);
  if (value > error) return 1;
  if (value < -error) return -1;
  const SumEdge a = facet_edge(f.facet, k), b = facet_edge(g.facet, l);
  if (a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to) return 0;
  return space.exact_twist(a, b);
}

/// The sign of the way from f's end to g's end in the direction n_f x n_g: with x on the facet edge e of f and y on h
/// of g, y - x = l (n_f x n_g) and (e x h) . (n_f x n_g) = -(e . n_g) (h . n_f).
int order(const SumSpace& space, const Placed& f, End x, const Placed& g, End y) {
  return -twist(space, f, x.facet_edge, g, y.facet_edge) * x.rise * y.rise;
}

PointSource source(const TableFacet& f, End end, PlaneId plane) {
  if (end.corner >= 0) {
    const SumPoint s = f.facet.corner[end.corner];
    return {PointSource::Kind::sum, s.p, s.q, 0};
  }
  return {PointSource::Kind::edge, f.edge[end.facet_edge], plane, 0};
}

/// Whether the facet goes on after an end, in its neighbour.
bool goes_on(const FacetTable& table, const TableFacet& f, End end) {
  return end.corner < 0 && table.is_inner(f.edge[end.facet_edge]);
}

bool share_edge(const TableFacet& f, const TableFacet& g) {
  for (int i = 0; i < f.facet.corners; ++i)
    for (int j = 0; j < g.facet.corners; ++j)
      if (f.edge[i] == g.edge[j]) return true;
  return false;
}

/// Whether a edge of a facet ends in its plane at a corner, and none inside of a face.
bool ends_facet_edge(const FacetTable& table, const TableFacet& f, int corner) {
  return !table.is_inner(f.edge[corner]) || !table.is_inner(f.edge[(corner + f.facet.corners - 1) % f.facet.corners]);
}
int corner_at(const TableFacet& f, SumPoint point) {
  for (int k = 0; k < f.facet.corners; ++k)
    if (f.facet.corner[k] == point) return k;
  return -1;
}

/// Whether a contact is a point that cuts neither plane: one at which facet edges end in both of them, or where
/// contacts of neighbours go on.
bool cuts_nothing(const FacetTable& table, const Contact& c) {
  if (!c.point()) return false;
  if (c.from_inner) return true;
  if (c.from.kind != PointSource::Kind::sum) return false;
  const TableFacet &f = table.facets[c.f], &g = table.facets[c.g];
  const int i = corner_at(f, {c.from.a, c.from.b}), j = corner_at(g, {c.from.a, c.from.b});
  return i >= 0 && j >= 0 && ends_facet_edge(table, f, i) && ends_facet_edge(table, g, j);
}

/// Whether doubles show that a facet lies to one side of a plane but for one corner.
bool beside(const SumSpace& space, const Placed& f, int corner, PlaneId plane) {
  const Plane& cut = space.plane(plane);
  const double error = cut.slack + cut.norm1 * space.sum_radius();
  bool above = true, below = true;
  for (int k = 0; k < f.facet.facet.corners; ++k) {
    if (k == corner) continue;
    const double height = dot(cut.n, f.at[static_cast<std::size_t>(k)]) - cut.d;
    above = above && height > error, below = below && height < -error;
  }
  return above || below;
}

/// Whether two facets have a corner in common, by its name, and doubles show that they have no other point in common
/// and that it cuts nothing: as most neighbours.
bool only_share_corner(const SumSpace& space, const FacetTable& table, const Placed& f, const Placed& g) {
  for (int i = 0; i < f.facet.facet.corners; ++i) {
    const int j = corner_at(g.facet, f.facet.facet.corner[i]);
    if (j < 0) continue;
    return ends_facet_edge(table, f.facet, i) && ends_facet_edge(table, g.facet, j) &&
           (beside(space, f, i, g.facet.plane) || beside(space, g, j, f.facet.plane));
  }
  return false;
}

/// The contact itself, its ends as points, and its segments in two planes, before they are cut.
constexpr std::size_t kBytesPerContact = sizeof(Contact) + 2 * (sizeof(PointSource) + sizeof(PointId)) + 2 * 24;

/// What two boxes have in common, or a position of the second one.
Box common(const Box& a, const Box& b) {
  const auto within = [&](Vec3 v) {
    return Vec3{std::clamp(v.x, b.low.x, b.high.x), std::clamp(v.y, b.low.y, b.high.y),
                std::clamp(v.z, b.low.z, b.high.z)};
  };
  return {within(a.low), within(a.high)};
}

Box box_of(const SumSpace& space, const TableFacet& f, const Corners& corners) {
  Box box;
  for (int k = 0; k < f.facet.corners; ++k) box.add(corners[static_cast<std::size_t>(k)]);
  box.grow(space.sum_radius());
  return box;
}

std::optional<Contact> contact(const SumSpace& space, const FacetTable& table, std::uint32_t i, const Corners& i_at,
                               std::uint32_t j, const Corners& j_at) {
  const TableFacet &f = table.facets[i], &g = table.facets[j];
  const Placed at_f{f, i_at}, at_g{g, j_at};
  const std::optional<Chord> a = chord(space, f, i_at, g.plane);
  if (!a) return std::nullopt;
  std::optional<Chord> b = chord(space, g, j_at, f.plane);
  if (!b) return std::nullopt;
  std::swap(b->from, b->to);  // in the direction n_f x n_g
  // The later beginning and the earlier end; of equal ones a corner.
  const int begin = order(space, at_f, a->from, at_g, b->from);
  const int end = order(space, at_f, a->to, at_g, b->to);
  const bool begin_f = begin < 0 || (begin == 0 && a->from.corner >= 0),
             end_f = end > 0 || (end == 0 && a->to.corner >= 0);
  // The interval of f begins and ends in order, and so does that of g: only mixed ends can be out of order.
  int length = 1;
  if (begin_f && !end_f) length = order(space, at_f, a->from, at_g, b->to);
  if (!begin_f && end_f) length = -order(space, at_f, a->to, at_g, b->from);
  if (length < 0) return std::nullopt;
  // Where both end at one position, both have to go on.
  const auto inner = [&](End x, End y, int direction) {
    return (direction > 0 || goes_on(table, f, x)) && (direction < 0 || goes_on(table, g, y));
  };
  Contact result{i,
                 j,
                 begin_f ? source(f, a->from, g.plane) : source(g, b->from, f.plane),
                 end_f ? source(f, a->to, g.plane) : source(g, b->to, f.plane),
                 inner(a->from, b->from, begin),
                 inner(a->to, b->to, -end)};
  if (length == 0) {
    // One point: by a corner where there is one.
    if (result.from.kind == PointSource::Kind::sum) result.to = result.from;
    else result.from = result.to;
    result.from_inner = result.to_inner = result.from_inner && result.to_inner;
  }
  return result;
}

}  // namespace

std::optional<Contact> contact(const SumSpace& space, const FacetTable& table, std::uint32_t f, std::uint32_t g) {
  return contact(space, table, f, corners_of(space, table.facets[f]), g, corners_of(space, table.facets[g]));
}

std::vector<PlaneCut> plane_cuts(const SumSpace& space, const FacetTable& table, std::span<const PlaneId> planes) {
  std::vector<PlaneCut> cuts;
  for (std::uint32_t i = 0; i < table.facets.size(); ++i) {
    const TableFacet& f = table.facets[i];
    for (const PlaneId plane : planes) {
      bool off = false;
      for (int k = 0; k < f.facet.corners; ++k) off |= space.side(plane, f.facet.corner[k]) != 0;
      const std::optional<Chord> c = off ? chord(space, f, corners_of(space, f), plane) : std::nullopt;
      if (!c) continue;
      const PlaneCut cut{i,
                         plane,
                         source(f, c->from, plane),
                         source(f, c->to, plane),
                         goes_on(table, f, c->from),
                         goes_on(table, f, c->to)};
      if (!(cut.from == cut.to)) cuts.push_back(cut);
    }
  }
  return cuts;
}

namespace {

std::vector<Corners> all_corners(const SumSpace& space, const FacetTable& table, StageWatch& watch) {
  watch.hold(table.facets.size() * (sizeof(Box) + sizeof(Corners)));
  std::vector<Corners> corners(table.facets.size());
  watch.run_intervals(corners.size(), 1024, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) corners[f] = corners_of(space, table.facets[f]);
  });
  return corners;
}

/// The contacts of those pairs.
Contacts contacts_of(const SumSpace& space, const FacetTable& table, std::vector<Corners> corners, NearPairs near,
                     StageWatch& watch) {
  constexpr std::size_t kPart = 256;
  const std::size_t count = table.facets.size();
  std::vector<Contacts> parts((count + kPart - 1) / kPart);
  watch.run(parts.size(), [&](std::size_t part) {
    Contacts& some = parts[part];
    for (std::size_t k = part * kPart; k < std::min(count, (part + 1) * kPart); ++k) {
      const auto f = static_cast<std::uint32_t>(k);
      some.counts.box_pairs += near.of(k).size();
      for (const std::uint32_t g : near.of(k)) {
        if (table.facets[f].plane == table.facets[g].plane) {
          add_counted(some.coplanar, {f, g}, watch);
        } else if (!share_edge(table.facets[f], table.facets[g]) &&
                   !only_share_corner(space, table, {table.facets[f], corners[f]}, {table.facets[g], corners[g]})) {
          const std::optional<Contact> c = contact(space, table, f, corners[f], g, corners[g]);
          if (c && !cuts_nothing(table, *c)) add_counted(some.contacts, *c, watch, kBytesPerContact);
        }
      }
    }
    give_back((some.contacts.capacity() - some.contacts.size()) * kBytesPerContact +
                  (some.coplanar.capacity() - some.coplanar.size()) * sizeof(some.coplanar[0]),
              watch);
    some.contacts.shrink_to_fit(), some.coplanar.shrink_to_fit();
  });
  Contacts result;
  near = {};
  base::free_memory(corners);
  std::size_t contacts = 0, coplanar = 0;
  for (const Contacts& some : parts) contacts += some.contacts.size(), coplanar += some.coplanar.size();
  result.contacts.reserve(contacts), result.coplanar.reserve(coplanar);
  for (Contacts& part : parts) {
    const Contacts some = std::exchange(part, {});
    result.contacts.insert(result.contacts.end(), some.contacts.begin(), some.contacts.end());
    result.coplanar.insert(result.coplanar.end(), some.coplanar.begin(), some.coplanar.end());
    result.counts.box_pairs += some.counts.box_pairs;
  }
  result.counts.contacts = result.contacts.size();
  return result;
}

}  // namespace

Contacts find_contacts(const SumSpace& space, const FacetTable& table, StageWatch& watch, const Box* within) {
  std::vector<Corners> corners = all_corners(space, table, watch);
  std::vector<Box> boxes(table.facets.size());
  watch.run_intervals(boxes.size(), 1024, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) {
      boxes[f] = box_of(space, table.facets[f], corners[f]);
      if (within != nullptr) boxes[f] = common(boxes[f], *within);
    }
  });
  NearPairs near = near_pairs(boxes, watch);
  base::free_memory(boxes);
  return contacts_of(space, table, std::move(corners), std::move(near), watch);
}

Contacts find_contacts_between(const SumSpace& space, const FacetTable& table, NearPairs near, StageWatch& watch) {
  Contacts result = contacts_of(space, table, all_corners(space, table, watch), std::move(near), watch);
  // The facets at every edge of sums as a list, the last one first.
  struct AtEdge {
    std::uint32_t facet;
    std::uint32_t before;
  };
  std::vector<AtEdge> list;
  list.reserve(3 * table.facets.size());
  std::vector<std::uint32_t> last(space.edges().size(), kNoId);
  for (std::uint32_t f = 0; f < table.facets.size(); ++f) {
    const TableFacet& facet = table.facets[f];
    for (int k = 0; k < facet.facet.corners; ++k) {
      std::uint32_t& at = last[facet.edge[k]];
      for (std::uint32_t i = at; i != kNoId; i = list[i].before)
        if (table.facets[list[i].facet].plane == facet.plane) result.coplanar.push_back({list[i].facet, f});
      list.push_back({f, at});
      at = static_cast<std::uint32_t>(list.size() - 1);
    }
  }
  return result;
}

}  // namespace dymsum::spatial
