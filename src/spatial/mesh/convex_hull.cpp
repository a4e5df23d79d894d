// Convex hulls of points, by random incremental insertion: every point outside keeps one facet it sees; the facets that
// an inserted point sees are replaced by those between it and their horizon (Clarkson, Shor 1989; with one conflict per
// point as in Barber, Dobkin, Huhdanpaa 1996).
//
// A point sees a facet only from strictly outside its plane. A point in a facet's plane is thus treated as a point
// slightly inside, and gets coplanar facets of its own, which the canonical form merges: coplanar, collinear and equal
// points need no further care. A point outside that saw a replaced facet sees one of the new ones: on the way to it
// from a position just above the replaced facet, the new hull is left through a new facet.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/doubles.h"
#include "dymsum/mesh.h"
#include "exact/int.h"
#include "exact/orient.h"
#include "spatial/mesh/mesh_canonical.h"
#include "spatial/mesh/mesh_validate.h"
#include "spatial/mesh/triangulate.h"
#include "spatial/mesh/vec3.h"

namespace dymsum {

// Hulls of meshes that are convex but for rounding, and how far the mesh is from its hull.

namespace spatial {
namespace {

struct LessPoint {
  bool operator()(const Point3& a, const Point3& b) const { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }
};

/// How deep places lie below the planes of a convex mesh. Numerators are exact, so depths have relative errors below
/// 2^-49, however small they are.
class Depths {
 public:
  Depths(const Mesh& hull, std::vector<Point3> points)
      : hull_(hull), points_(std::move(points)), first_(points_.size()) {
    points_.insert(points_.end(), hull.vertices().begin(), hull.vertices().end());
    positions_ = grid_positions(points_);
    for (std::uint32_t f = 0; f < hull.faces().size(); ++f)
      for (const std::uint32_t v : hull.faces()[f]) faces_at_[hull.vertices()[v]].push_back(f);
  }

  /// Planes below which to look for a point: those through it where it is a corner of the hull, else the nearest one.
  const std::vector<std::uint32_t>& planes_near(std::uint32_t point) {
    const auto corner = faces_at_.find(points_[point]);
    return corner != faces_at_.end() ? corner->second : faces_at_[points_[point]] = {nearest(point)};
  }
  double depth(std::uint32_t point, std::uint32_t face) const {
    return with_coordinates(positions_, [&](auto c) { return depth_as<decltype(c)>(point, face); });
  }
  bool is_corner(std::uint32_t point) const {
    return std::binary_search(hull_.vertices().begin(), hull_.vertices().end(), points_[point], LessPoint());
  }

 private:
  template <class C>
  double depth_as(std::uint32_t point, std::uint32_t face) const {
    const Face& f = hull_.faces()[face];
    const auto at = [&](std::size_t i) { return positions_.position<C>(static_cast<std::uint32_t>(first_) + f[i]); };
    const auto n = exact::cross(at(1) - at(0), at(2) - at(1));
    const auto below = exact::dot(n, at(0) - positions_.position<C>(point));
    if (sign(below) == 0) return 0;
    const int top = bit_length(n);
    if constexpr (std::is_same_v<C, exact::Big>) {
      // Grids as fine as the least doubles have more units than doubles count: both are scaled to about 1.
      const int deep = bit_length(below);
      return std::ldexp(rounded(below, -deep) / length(rounded(n, -top)), positions_.exponent + deep - top);
    } else {
      return std::ldexp(to_double(below) / length(rounded(n, -top)), positions_.exponent - top);
    }
  }
  std::uint32_t nearest(std::uint32_t point) const {
    std::uint32_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t f = 0; f < hull_.faces().size(); ++f) {
      const double d = depth(point, f);
      if (d >= least) continue;
      least = d;
      best = f;
    }
    return best;
  }

  const Mesh& hull_;
  std::vector<Point3> points_;  // the mesh's, then the hull's
  std::size_t first_;           // of the hull's
  GridPositions positions_;
  std::map<Point3, std::vector<std::uint32_t>, LessPoint> faces_at_;
};

/// Planes to look at for a face: those near its corners, but of corners where more than kMany meet only those of the
/// one where fewest do. The planes at one corner go all round there, so one of them is above the face.
std::vector<std::uint32_t> planes_above(Depths& depths, const Face& face) {
  constexpr std::size_t kMany = 12;
  const std::vector<std::uint32_t>* fewest = &depths.planes_near(face[0]);
  std::vector<std::uint32_t> planes;
  for (const std::uint32_t v : face) {
    const std::vector<std::uint32_t>& near = depths.planes_near(v);
    if (near.size() < fewest->size()) fewest = &near;
    if (near.size() <= kMany && face.size() <= kMany) planes.insert(planes.end(), near.begin(), near.end());
  }
  planes.insert(planes.end(), fewest->begin(), fewest->end());
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  return planes;
}

/// A bound of how far the points that a face spans lie below the hull: below one plane no point is deeper than the
/// deepest corner.
double depth_of(Depths& depths, const Face& face) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t f : planes_above(depths, face)) {
    double deepest = 0;
    for (const std::uint32_t v : face) {
      deepest = std::max(deepest, depths.depth(v, f));
      if (deepest >= least) break;
    }
    least = std::min(least, deepest);
  }
  return least;
}

/// Counts the points strictly inside the hull, and returns how deep the deepest one is.
double count_inside(Depths& depths, std::size_t points, HullReport& report) {
  double deepest = 0;
  for (std::uint32_t v = 0; v < points; ++v) {
    if (depths.is_corner(v)) continue;
    const double depth = depths.depth(v, depths.planes_near(v)[0]);
    report.inside_vertices += depth > 0;
    deepest = std::max(deepest, depth);
  }
  return deepest;
}

/// The points that faces use, each position once, and the faces by these.
struct UsedPoints {
  std::vector<Point3> points;
  std::vector<Face> faces;
  std::size_t unused = 0;
};

UsedPoints used_points(const MeshData& data) {
  std::vector<bool> used(data.vertices.size(), data.faces.empty());
  for (const Face& face : data.faces)
    for (const std::uint32_t v : face) used[v] = true;
  UsedPoints u;
  std::map<Point3, std::uint32_t, LessPoint> index;
  std::vector<std::uint32_t> to(data.vertices.size());
  for (std::size_t v = 0; v < used.size(); ++v) {
    u.unused += !used[v];
    if (!used[v]) continue;
    to[v] = index.try_emplace(data.vertices[v], static_cast<std::uint32_t>(u.points.size())).first->second;
    if (to[v] == u.points.size()) u.points.push_back(data.vertices[v]);
  }
  u.faces = data.faces;
  for (Face& face : u.faces)
    for (std::uint32_t& v : face) v = to[v];
  return u;
}

}  // namespace
}  // namespace spatial

Result<HulledMesh> hulled(const MeshData& data) {
  if (auto error = spatial::check_finite(data.vertices)) return *std::move(error);
  if (auto error = spatial::check_indices(data)) return *std::move(error);
  const spatial::UsedPoints used = spatial::used_points(data);
  if (used.points.empty()) return Error{ErrorCode::no_area, "there are no points to take the hull of", {}};
  Result<Mesh> hull = convex_hull(used.points);
  if (!hull) return hull.error();
  HullReport report;
  report.vertices = used.points.size();
  report.unused_vertices = used.unused;
  spatial::Depths depths(*hull, used.points);
  const double deepest = spatial::count_inside(depths, used.points.size(), report);
  if (data.faces.empty()) report.deviation = deepest;
  for (const Face& face : used.faces)
    if (!face.empty()) report.deviation = std::max(report.deviation, spatial::depth_of(depths, face));
  return HulledMesh{std::move(hull).value(), report};
}

std::string HullReport::to_string() const {
  const auto some = [](std::size_t n, std::size_t all) {
    return std::to_string(n) + " of " + std::to_string(all) + (all == 1 ? " vertex" : " vertices");
  };
  std::string text = some(inside_vertices, vertices) + " inside it, largest deviation ";
  char index[32];
  std::snprintf(index, sizeof index, "%.3g", deviation);
  text += index;
  if (unused_vertices > 0)
    text += ", " + std::to_string(unused_vertices) + (unused_vertices == 1 ? " unused vertex" : " unused vertices") +
            " left out";
  return text;
}

Result<HulledMesh> translated_hull(const Mesh& mesh, double dx, double dy, double dz) {
  if (std::optional<Error> error = convexity_error(mesh)) return *std::move(error);
  HullReport report;
  std::vector<Point3> moved;
  // What rounding a sum loses is a double, but for sums past the range of doubles, which are refused.
  const auto plus = [](double a, double b, double& lost) {
    const double s = a + b, part = s - a;
    lost = (a - (s - part)) + (b - part);
    return s;
  };
  for (const Point3& v : mesh.vertices()) {
    double x = 0, y = 0, z = 0;
    moved.push_back({plus(v.x, dx, x), plus(v.y, dy, y), plus(v.z, dz, z)});
    report.deviation = std::max(report.deviation, base::hypot3(x, y, z));
  }
  Result<Mesh> hull = convex_hull(moved);
  if (!hull) return hull.error();
  report.vertices = moved.size();
  spatial::Depths depths(*hull, std::move(moved));
  spatial::count_inside(depths, report.vertices, report);
  return HulledMesh{std::move(hull).value(), report};
}

TriangulatedMesh triangulated(const Mesh& mesh) {
  spatial::Triangles all = spatial::triangulated(mesh.data());
  MeshData data{mesh.vertices(), {}};
  for (const spatial::Triangle& t : all.triangles) data.faces.emplace_back(t.begin(), t.end());
  if (!mesh.has_thin_parts()) return {spatial::trusted_mesh(std::move(data), mesh.shell_count()), std::move(all.face)};
  for (std::uint32_t f = 0; f < mesh.faces().size(); ++f) {
    if (mesh.faces()[f].size() >= 3) continue;
    data.faces.push_back(mesh.faces()[f]);
    all.face.push_back(f);
  }
  std::vector<bool> thin;
  for (const std::uint32_t f : all.face) thin.push_back(mesh.thin_faces()[f]);
  return {spatial::trusted_mesh(std::move(data), mesh.shell_count(), std::move(thin)), std::move(all.face)};
}

// Convex hulls of points, by random incremental insertion: every point outside keeps one facet it sees; the facets that
// an inserted point sees are replaced by those between it and their horizon (Clarkson, Shor 1989; with one conflict per
// point as in Barber, Dobkin, Huhdanpaa 1996).
//
// A point sees a facet only from strictly outside its plane. A point in a facet's plane is thus treated as a point
// slightly inside, and gets coplanar facets of its own, which the canonical form merges: coplanar, collinear and equal
// points need no further care. A point outside that saw a replaced facet sees one of the new ones: on the way to it
// from a position just above the replaced facet, the new hull is left through a new facet.

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
