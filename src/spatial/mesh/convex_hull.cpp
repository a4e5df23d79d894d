// Convex hulls of points, by random incremental insertion: every point outside keeps one facet it sees; the facets that
// an inserted point sees are replaced by those between it and their horizon (Clarkson, Shor 1989; with one conflict per
// point as in Barber, Dobkin, Huhdanpaa 1996).
//
// A point sees a facet only from strictly outside its plane. A point in a facet's plane is thus treated as a point
// slightly inside, and gets coplanar facets of its own, which the canonical form merges: coplanar, collinear and equal
// points need no further care. A point outside that saw a replaced facet sees one of the new ones: on the way to it
// from a position just above the replaced facet, the new hull is left through a new facet.
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "dymsum/mesh.h"
#include "exact/orient.h"
#include "spatial/mesh/mesh_canonical.h"
#include "spatial/mesh/mesh_validate.h"

namespace dymsum {

namespace spatial {

namespace {

constexpr std::uint32_t kNoIndex = 0xffffffff;

/// A triangle, counter-clockwise seen from outside; neighbour[i] is across the edge from vertex[i].
struct Facet {
  std::array<std::uint32_t, 3> vertex;
  std::array<std::uint32_t, 3> neighbour{kNoIndex, kNoIndex, kNoIndex};
  std::vector<std::uint32_t> outside;  ///< points that keep this facet
  bool alive = true;
  std::uint32_t seen_by = kNoIndex;  ///< the last inserted point that saw the facet
};

/// The same order for the same number of points everywhere (splitmix64).
std::vector<std::uint32_t> shuffled(std::size_t count) {
  std::vector<std::uint32_t> order(count);
  std::uint64_t state = 1;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    const std::size_t j = (z ^ (z >> 31)) % (i + 1);
    order[i] = order[j];
    order[j] = static_cast<std::uint32_t>(i);
  }
  return order;
}

class Hull {
 public:
  explicit Hull(std::span<const Point3> points) : points_(points), facet_of_(points.size(), kNoIndex) {}

  /// False when all points lie in one plane.
  bool build() {
    const std::vector<std::uint32_t> order = shuffled(points_.size());
    const auto simplex = first_simplex(order);
    if (!simplex) return false;
    start(*simplex);
    for (const std::uint32_t p : order) {
      for (std::uint32_t f = 0; f < 4 && facet_of_[p] == kNoIndex; ++f) assign(p, f);
    }
    for (const std::uint32_t p : order) {
      if (facet_of_[p] != kNoIndex) insert(p);
    }
    return true;
  }

  MeshData result() const {
    MeshData data;
    data.vertices.assign(points_.begin(), points_.end());
    for (const Facet& facet : facets_) {
      if (facet.alive) data.faces.emplace_back(facet.vertex.begin(), facet.vertex.end());
    }
    return data;
  }

 private:
  bool sees(std::uint32_t p, const Facet& f) const {
    return exact::orient3_sign(points_[f.vertex[0]], points_[f.vertex[1]], points_[f.vertex[2]], points_[p]) > 0;
  }

  std::optional<std::array<std::uint32_t, 4>> first_simplex(const std::vector<std::uint32_t>& order) const {
    std::array<std::uint32_t, 4> s{};
    std::size_t found = 0;
    for (const std::uint32_t p : order) {
      const Point3& q = points_[p];
      const bool further = found == 0   ? true
                           : found == 1 ? q != points_[s[0]]
                           : found == 2 ? !exact::collinear(points_[s[0]], points_[s[1]], q)
                                        : exact::orient3_sign(points_[s[0]], points_[s[1]], points_[s[2]], q) != 0;
      if (!further) continue;
      s[found++] = p;
      if (found == 4) return s;
    }
    return std::nullopt;
  }

  /// The four facets of a tetrahedron.
  void start(std::array<std::uint32_t, 4> s) {
    if (exact::orient3_sign(points_[s[0]], points_[s[1]], points_[s[2]], points_[s[3]]) > 0) std::swap(s[1], s[2]);
    // s[3] is below s[0] s[1] s[2]
    facets_.push_back({{s[0], s[1], s[2]}, {2, 3, 1}, {}});
    facets_.push_back({{s[1], s[0], s[3]}, {3, 2, 0}, {}});
    facets_.push_back({{s[2], s[1], s[3]}, {1, 3, 0}, {}});
    facets_.push_back({{s[0], s[2], s[3]}, {2, 1, 0}, {}});
    edge_from_.assign(points_.size(), kNoIndex);
  }

  void assign(std::uint32_t p, std::uint32_t facet) {
    if (!sees(p, facets_[facet])) return;
    facet_of_[p] = facet;
    facets_[facet].outside.push_back(p);
  }

  /// An edge between a facet that the new point sees and one, `beyond`, that it does not.
  struct HorizonEdge {
    std::uint32_t from, to, beyond;
  };

  void insert(std::uint32_t p) {
    const std::vector<HorizonEdge> horizon = remove_seen(p);
    const auto first_new = static_cast<std::uint32_t>(facets_.size());
    for (const HorizonEdge& edge : horizon) {
      edge_from_[edge.from] = static_cast<std::uint32_t>(facets_.size());
      facets_.push_back({{p, edge.from, edge.to}, {edge.beyond, kNoIndex, kNoIndex}, {}});
    }
    for (std::uint32_t f = first_new; f < facets_.size(); ++f) join(f);
    for (const std::uint32_t q : orphans_) {
      facet_of_[q] = kNoIndex;
      for (std::uint32_t f = first_new; q != p && f < facets_.size() && facet_of_[q] == kNoIndex; ++f) assign(q, f);
    }
  }

  /// Links a new facet p, u, v with the one across u v and the new one across v p.
  void join(std::uint32_t f) {
    const auto [p, u, v] = facets_[f].vertex;
    Facet& beyond = facets_[facets_[f].neighbour[0]];
    for (std::size_t i = 0; i < 3; ++i) {
      if (beyond.vertex[i] != u && beyond.vertex[i] != v) beyond.neighbour[i] = f;
    }
    const std::uint32_t after = edge_from_[v];
    facets_[f].neighbour[1] = after;  // across v p, from u
    facets_[after].neighbour[2] = f;  // across p v, from that facet's own end
  }

  /// Removes the facets that p sees, from the one it keeps outwards; what they kept goes to orphans_.
  std::vector<HorizonEdge> remove_seen(std::uint32_t p) {
    std::vector<HorizonEdge> horizon;
    orphans_.clear();
    stack_.assign(1, facet_of_[p]);
    facets_[facet_of_[p]].seen_by = p;
    while (!stack_.empty()) {
      Facet& facet = facets_[stack_.back()];
      stack_.pop_back();
      facet.alive = false;
      orphans_.insert(orphans_.end(), facet.outside.begin(), facet.outside.end());
      std::vector<std::uint32_t>().swap(facet.outside);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t g = facet.neighbour[i];
        if (facets_[g].seen_by == p) continue;
        if (!sees(p, facets_[g])) {
          horizon.push_back({facet.vertex[(i + 1) % 3], facet.vertex[(i + 2) % 3], g});
          continue;
        }
        facets_[g].seen_by = p;
        stack_.push_back(g);
      }
    }
    return horizon;
  }

  std::span<const Point3> points_;
  std::vector<std::uint32_t> facet_of_;   ///< per point the facet it keeps, kNoIndex inside
  std::vector<std::uint32_t> edge_from_;  ///< per vertex the new facet whose horizon edge starts there
  std::vector<Facet> facets_;
  std::vector<std::uint32_t> orphans_, stack_;
};

}  // namespace

}  // namespace spatial

Result<Mesh> convex_hull(std::span<const Point3> points) {
  if (auto error = spatial::check_finite({points.begin(), points.end()})) return *std::move(error);
  spatial::Hull hull(points);
  if (!hull.build()) return Error{ErrorCode::no_area, "all points lie in one plane", {}};
  return spatial::trusted_mesh(spatial::merged_and_sorted(hull.result()), 1);
}

}  // namespace dymsum
