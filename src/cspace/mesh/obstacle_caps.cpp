// The planes at -pi and at pi of an obstacle's mesh as faces: what makes it a closed surface in space. The edges of a
// cap are those that the mesh leaves open in its plane, so it closes whatever is rounded. Which walks and bridges are
// taken is decided in doubles: a choice that roundings spoil makes triangles overlap by roundings, and opens nothing.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "dymsum/obstacle_mesh.h"

namespace dymsum {
namespace {

using Ring3 = std::vector<std::uint32_t>;  // vertices of the mesh, interior on the left

double cross(Point o, Point a, Point b) { return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x); }

/// One plane, looked at from outside.
class Cap {
 public:
  Cap(const ObstacleMesh& mesh, bool top) : mesh_(mesh), top_(top) {
    for (const auto& [bottom, above] : mesh.seam) in_plane_[top ? above : bottom] = true;
    for (const ObstacleTriangle& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k) use(t.vertices[k], t.vertices[(k + 1) % 3]);
  }

  /// Simple polygons, or such that touch themselves at vertices and along bridges to their holes.
  std::vector<Ring3> rings() {
    std::vector<Ring3> outer, holes;
    for (Ring3& walk : walks()) (area(walk) < 0 ? holes : outer).push_back(std::move(walk));
    std::stable_sort(holes.begin(), holes.end(),
                     [&](const Ring3& a, const Ring3& b) { return rightmost(a).x > rightmost(b).x; });
    for (Ring3& hole : holes) join(outer, std::move(hole));
    return outer;
  }

 private:
  Point at(std::uint32_t v) const { return {mesh_.vertices[v].x, top_ ? mesh_.vertices[v].y : -mesh_.vertices[v].y}; }

  /// The cap runs along an edge against the triangle that uses it.
  void use(std::uint32_t a, std::uint32_t b) {
    if (!in_plane_.contains(a) || !in_plane_.contains(b)) return;
    const auto same_sense = open_.find({a, b});
    if (same_sense == open_.end()) {
      ++open_[{b, a}];
    } else if (--same_sense->second == 0) {
      open_.erase(same_sense);
    }
  }

  double direction(std::uint32_t from, std::uint32_t to) const {
    return std::atan2(at(to).y - at(from).y, at(to).x - at(from).x);
  }

  /// The open edges as closed walks: at a vertex of several the one that bounds the same wedge of the interior.
  std::vector<Ring3> walks() {
    std::multimap<std::uint32_t, std::uint32_t> out;
    for (const auto& [edge, n] : open_)
      for (int k = 0; k < n; ++k) out.insert(edge);
    std::vector<Ring3> found;
    while (!out.empty()) {
      const auto first = out.begin();
      std::uint32_t from = first->first, v = first->second;
      Ring3 ring{from};
      for (auto next = leaving(out, from, v); next != first && next != out.end(); next = leaving(out, from, v)) {
        ring.push_back(v);
        from = v;
        v = next->second;
        out.erase(next);
      }
      out.erase(first);
      found.push_back(std::move(ring));
    }
    return found;
  }

  std::multimap<std::uint32_t, std::uint32_t>::iterator leaving(std::multimap<std::uint32_t, std::uint32_t>& out,
                                                                std::uint32_t from, std::uint32_t v) const {
    const auto [begin, end] = out.equal_range(v);
    if (begin == end) return out.end();  // as many leave as arrive, unless the mesh has gaps elsewhere
    const double back = direction(v, from), turn = 2 * std::acos(-1.0);
    const auto clockwise = [&](const auto& edge) {
      const double angle = std::fmod(back - direction(v, edge.second) + 2 * turn, turn);
      return angle == 0 ? turn : angle;
    };
    return std::min_element(begin, end, [&](const auto& a, const auto& b) { return clockwise(a) < clockwise(b); });
  }

  double area(const Ring3& ring) const {
    double sum = 0;
    for (std::size_t k = 1; k + 1 < ring.size(); ++k) sum += cross(at(ring[0]), at(ring[k]), at(ring[k + 1]));
    return sum / 2;
  }

  Point rightmost(const Ring3& ring) const {
    return at(*std::max_element(ring.begin(), ring.end(), [&](auto a, auto b) { return at(a).x < at(b).x; }));
  }

  /// Whether the direction from a corner to a point leads into the interior there.
  bool into_interior(const Ring3& ring, std::size_t k, Point to) const {
    const Point v = at(ring[k]), before = at(ring[(k + ring.size() - 1) % ring.size()]),
                after = at(ring[(k + 1) % ring.size()]);
    const bool left_out = cross(v, after, to) >= 0, left_in = cross(before, v, to) >= 0;
    return cross(before, v, after) >= 0 ? left_out && left_in : left_out || left_in;
  }

  struct Hit {
    std::size_t ring = 0, corner = 0;
    double x = INFINITY;
  };

  /// The nearest edge to the right of a point that has the interior on its left.
  Hit nearest_edge(const std::vector<Ring3>& rings, Point m) const {
    Hit best;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      for (std::size_t k = 0; k < rings[r].size(); ++k) {
        const Point a = at(rings[r][k]), b = at(rings[r][(k + 1) % rings[r].size()]);
        if (!(a.y <= m.y && m.y < b.y)) continue;
        const double x = a.x + (b.x - a.x) * ((m.y - a.y) / (b.y - a.y));
        if (x >= m.x && x < best.x) best = {r, a.x > b.x ? k : (k + 1) % rings[r].size(), x};
      }
    }
    return best;
  }

  /// The corner that is seen from m: the end of the nearest edge, or of the corners in front of it that of the flattest
  /// view. Source: Eberly, "Triangulation by Ear Clipping" (2002), section 4.
  std::size_t visible_corner(const Ring3& ring, const Hit& hit, Point m) const {
    const Point end = at(ring[hit.corner]), meeting{hit.x, m.y};
    const double way = end.y < m.y ? -1 : 1;
    std::optional<std::size_t> best;
    double flattest = INFINITY, nearest = INFINITY;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point p = at(ring[k]);
      const bool inside =
          way * cross(m, meeting, p) >= 0 && way * cross(meeting, end, p) >= 0 && way * cross(end, m, p) >= 0;
      if (!inside || !(p.x > m.x || p == m) || !into_interior(ring, k, m)) continue;
      const double slope = p == m ? 0 : std::abs(p.y - m.y) / (p.x - m.x);
      if (slope > flattest || (slope == flattest && p.x >= nearest)) continue;
      best = k, flattest = slope, nearest = p.x;
    }
    return best.value_or(hit.corner);
  }

  void join(std::vector<Ring3>& outer, Ring3 hole) const {
    const auto first = std::max_element(hole.begin(), hole.end(), [&](auto a, auto b) { return at(a).x < at(b).x; });
    const Point m = at(*first);
    const Hit hit = nearest_edge(outer, m);
    if (!std::isfinite(hit.x)) {  // only where roundings put it outside
      outer.push_back(std::move(hole));
      return;
    }
    std::rotate(hole.begin(), first, hole.end());
    Ring3& ring = outer[hit.ring];
    const std::size_t corner = visible_corner(ring, hit, m);
    const std::uint32_t seen = ring[corner];
    hole.push_back(hole.front());
    hole.push_back(seen);
    ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(corner) + 1, hole.begin(), hole.end());
  }

  const ObstacleMesh& mesh_;
  bool top_;
  std::map<std::uint32_t, bool> in_plane_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> open_;
};

}  // namespace

MeshData capped_mesh_data(const ObstacleMesh& mesh) {
  MeshData data = mesh_data(mesh);
  for (const bool top : {false, true})
    for (Ring3& ring : Cap(mesh, top).rings()) data.faces.push_back(std::move(ring));
  return data;
}

}  // namespace dymsum
