#include "dymsum/obstacle_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/double_text.h"
#include "base/poll.h"
#include "cspace/events/walked_rings.h"
#include "cspace/mesh/obstacle_rails.h"

namespace dymsum::cspace {
namespace {

// Closing the mesh of an obstacle at one event angle.

/// A corner of a closed walk, and the patch of the edge that leaves it.
struct WalkCorner {
  std::uint32_t joint = 0, patch = 0;
};

/// A vertex of the mesh and the patch of the edge that leaves it.
struct RingCorner {
  std::uint32_t vertex = 0, patch = 0;
};

/// Closes rings of one station by triangles whose edges are those of the ring and, twice, others: the smallest ear is
/// cut off until nothing is left, which never leaves the lines of a ring that encloses nothing. Edges that are there
/// already are avoided. O(n^2).
class RingCloser {
 public:
  explicit RingCloser(ObstacleMesh& mesh) : mesh_(mesh) {}
  void add_edge(std::uint32_t a, std::uint32_t b);
  void close(std::vector<RingCorner> ring);

 private:
  double cost(const std::vector<RingCorner>& ring, std::size_t at) const;
  bool has_edge(std::uint32_t a, std::uint32_t b) const;
  void add_triangle(const RingCorner& a, const RingCorner& b, const RingCorner& c);

  ObstacleMesh& mesh_;
  std::unordered_set<std::uint64_t> edges_;
};

using PieceAt = std::unordered_map<std::uint32_t, std::uint32_t>;

/// Walks the edges of a station, each once.
class Walker {
 public:
  Walker(const ObstacleLayout& layout, const Station& station) : layout_(layout), station_(station) {
    for (const std::uint32_t k : station.ending) out_below_[layout.pieces[k].joint[0]] = k;
    for (const std::uint32_t k : station.beginning) in_above_[layout.pieces[k].joint[1]] = k;
  }

  std::vector<std::vector<WalkCorner>> walks() {
    std::vector<std::vector<WalkCorner>> found;
    for (const std::uint32_t k : station_.ending)
      if (out_below_.contains(layout_.pieces[k].joint[0])) walk(layout_.pieces[k].joint[0], true, found);
    for (const std::uint32_t k : station_.beginning)
      if (in_above_.contains(layout_.pieces[k].joint[1])) walk(layout_.pieces[k].joint[1], false, found);
    return found;
  }

 private:
  /// Nothing for a walk that does not come back: the mesh stays open there.
  void walk(std::uint32_t joint, bool forward, std::vector<std::vector<WalkCorner>>& found) {
    const std::uint32_t start = joint;
    const bool start_forward = forward;
    std::vector<WalkCorner> corners;
    do {
      PieceAt& edges = forward ? out_below_ : in_above_;
      const auto at = edges.find(joint);
      if (at == edges.end()) return;
      const Piece& piece = layout_.pieces[at->second];
      corners.push_back({joint, piece.patch});
      joint = piece.joint[forward ? 1 : 0];
      edges.erase(at);
      const std::uint32_t beyond = forward ? layout_.above(station_, joint) : layout_.below(station_, joint);
      if (beyond == kNobody) continue;
      joint = beyond;
      forward = !forward;
    } while (joint != start || forward != start_forward);
    found.push_back(std::move(corners));
  }

  const ObstacleLayout& layout_;
  const Station& station_;
  PieceAt out_below_, in_above_;  // by the joint at which the walk enters the edge
};

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
}

/// The edges of the pieces that end, run forwards, and of those that begin, run backwards, as closed walks: a walk
/// turns from the ones to the others wherever a joint is there on both sides. Between two such joints the boundary
/// before and the boundary after are the same set, so every walk goes along each of its lines as often in either
/// direction.
std::vector<std::vector<WalkCorner>> closing_walks(const ObstacleLayout& layout, const Station& station) {
  return Walker(layout, station).walks();
}

void RingCloser::add_edge(std::uint32_t a, std::uint32_t b) { edges_.insert(edge_key(a, b)); }

bool RingCloser::has_edge(std::uint32_t a, std::uint32_t b) const { return edges_.contains(edge_key(a, b)); }

/// Twice the area of the ear at a corner; an edge there and back costs less than nothing, and a taken edge everything.
double RingCloser::cost(const std::vector<RingCorner>& ring, std::size_t at) const {
  const std::size_t n = ring.size();
  const std::uint32_t before = ring[(at + n - 1) % n].vertex, after = ring[(at + 1) % n].vertex;
  if (before == after) return -1;
  const Configuration &a = mesh_.vertices[before], &b = mesh_.vertices[ring[at].vertex], &c = mesh_.vertices[after];
  const double area = std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  return n > 3 && has_edge(before, after) ? std::numeric_limits<double>::max() : area;
}

void RingCloser::add_triangle(const RingCorner& a, const RingCorner& b, const RingCorner& c) {
  mesh_.triangles.push_back({{a.vertex, b.vertex, c.vertex}, b.patch, true});
}

void RingCloser::close(std::vector<RingCorner> ring) {
  while (ring.size() > 2) {
    const std::size_t n = ring.size();
    std::size_t best = 0;
    double least = cost(ring, 0);
    for (std::size_t k = 1; k < n; ++k)
      if (const double c = cost(ring, k); c < least) best = k, least = c;
    const std::size_t before = (best + n - 1) % n, after = (best + 1) % n;
    if (ring[before].vertex == ring[after].vertex) {
      ring[before].patch = ring[after].patch;
      for (const std::size_t k : {std::max(best, after), std::min(best, after)})
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(k));
      continue;
    }
    add_triangle(ring[before], ring[best], ring[after]);
    if (n == 3) return;
    add_edge(ring[before].vertex, ring[after].vertex);
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(best));
  }
}

}  // namespace
}  // namespace dymsum::cspace

namespace dymsum {

// What can be said of the mesh of an obstacle without the obstacle.

namespace {

/// An edge from its smaller to its larger vertex, and which way a triangle runs along it.
struct Use {
  std::uint64_t edge = 0;
  bool forward = false;
  friend auto operator<=>(const Use&, const Use&) = default;
};

std::vector<Use> uses_of(const ObstacleMesh& mesh) {
  std::vector<std::uint32_t> same(mesh.vertices.size());
  std::iota(same.begin(), same.end(), 0u);
  for (const auto& [bottom, top] : mesh.seam) same[bottom] = top;
  std::vector<Use> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (const ObstacleTriangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t a = same[t.vertices[k]], b = same[t.vertices[(k + 1) % 3]];
      uses.push_back({(std::min(a, b) << 32) | std::max(a, b), a < b});
    }
  }
  std::sort(uses.begin(), uses.end());
  return uses;
}

}  // namespace

MeshClosure closure(const ObstacleMesh& mesh) {
  MeshClosure found;
  const std::vector<Use> uses = uses_of(mesh);
  for (std::size_t k = 0; k < uses.size();) {
    std::uint64_t forward = 0, backward = 0;
    const std::uint64_t edge = uses[k].edge;
    for (; k < uses.size() && uses[k].edge == edge; ++k) ++(uses[k].forward ? forward : backward);
    ++found.edges;
    found.open += forward != backward ? 1 : 0;
    found.crowded += forward == backward && forward > 1 ? 1 : 0;
  }
  for (const ObstacleTriangle& t : mesh.triangles) {
    if (!t.closing) continue;
    const Configuration &a = mesh.vertices[t.vertices[0]], &b = mesh.vertices[t.vertices[1]],
                        &c = mesh.vertices[t.vertices[2]];
    found.closing_area += std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
  }
  return found;
}

/// The flow of (x, 0, 0) through the triangles; nothing flows through the end planes.
double enclosed_volume(const ObstacleMesh& mesh) {
  double volume = 0;
  for (const ObstacleTriangle& t : mesh.triangles) {
    const Configuration &a = mesh.vertices[t.vertices[0]], &b = mesh.vertices[t.vertices[1]],
                        &c = mesh.vertices[t.vertices[2]];
    const double normal_x = (b.y - a.y) * (c.theta - a.theta) - (b.theta - a.theta) * (c.y - a.y);
    volume += (a.x + b.x + c.x) / 6 * normal_x;
  }
  return volume;
}

MeshData mesh_data(const ObstacleMesh& mesh) {
  MeshData data;
  const double scale = mesh.extent / (2 * std::numbers::pi);
  for (const Configuration& v : mesh.vertices) data.vertices.push_back({v.x, v.y, v.theta * scale});
  for (const ObstacleTriangle& t : mesh.triangles) data.faces.push_back({t.vertices[0], t.vertices[1], t.vertices[2]});
  return data;
}

namespace {

using namespace cspace;
constexpr int kMostHalvings = 12;  // of one chord: a curve that runs away needs no more to be seen

struct RobotSizes {
  double radius = 0;         ///< of the circle about the origin that its vertices stay in
  std::vector<double> edge;  ///< lengths by edges
};

RobotSizes robot_sizes(const Region& robot) {
  RobotSizes sizes;
  const auto add = [&](const Ring& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point &a = ring[k], &b = ring[(k + 1) % ring.size()];
      sizes.radius = std::max(sizes.radius, std::hypot(a.x, a.y));
      sizes.edge.push_back(std::hypot(b.x - a.x, b.y - a.y));
    }
  };
  planar::for_each_ring(robot, add);
  return sizes;
}

/// A vertex of the strip of a piece; theta is its height.
struct OnRail {
  std::uint32_t vertex = 0;
  double theta = 0;
};

class MeshBuilder {
 public:
  MeshBuilder(const CspaceObstacle& obstacle, const ObstacleMeshOptions& options)
      : obstacle_(obstacle), options_(options), layout_(lay_out(obstacle)), sizes_(robot_sizes(obstacle.robot())) {
    // The farthest vertex of the robot points in every direction once.
    const auto [x0, y0, x1, y1] = bounds(obstacle.obstacle());
    mesh_.extent = std::max(x1 - x0, y1 - y0) + 2 * sizes_.radius;
    mesh_.tolerance = options.tolerance * mesh_.extent;
  }

  Result<ObstacleMesh> build() {
    on_rail_.resize(layout_.rails.size());
    for (std::uint32_t k = 0; k < layout_.rails.size(); ++k) {
      if (k % 256 == 0 && stopped("curves", k, layout_.rails.size())) return cancelled();
      place_rail(k);
    }
    for (std::uint32_t k = 0; k < layout_.pieces.size(); ++k) {
      if (k % 256 == 0 && stopped("patches", k, layout_.pieces.size())) return cancelled();
      add_strip(k);
    }
    close_stations();
    join_planes();
    return std::move(mesh_);
  }

 private:
  bool stopped(const char* stage, std::size_t done, std::size_t all) const {
    return options_.progress && !options_.progress(stage, static_cast<double>(done) / static_cast<double>(all));
  }
  std::uint32_t seam() const { return static_cast<std::uint32_t>(layout_.stations.size()); }
  /// Planes are numbered from the bottom: plane k lies below layer k.
  double height(std::uint32_t plane) const {
    return plane == 0 ? -std::numbers::pi : layout_.stations[plane - 1].theta;
  }

  Point position(const Rail& rail, double theta) const {
    if (theta == -std::numbers::pi) theta = std::numbers::pi;  // bit by bit the same
    const std::vector<Patch>& patches = obstacle_.patches();
    if (rail.before != kNobody) return obstacle_.ends(patches[layout_.pieces[rail.before].patch], theta)[1];
    return obstacle_.ends(patches[layout_.pieces[rail.after].patch], theta)[0];
  }

  std::uint32_t add_vertex(Point at, double theta) {
    mesh_.vertices.push_back({at.x, at.y, theta});
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }

  /// Above the bottom plane a joint goes by its name in the layer below, where it has one.
  std::pair<std::uint32_t, std::uint32_t> key_of(std::uint32_t joint, std::uint32_t plane) const {
    if (plane == 0) return {joint, plane};
    const auto& names = layout_.stations[plane - 1].name_below;
    const auto named = names.find(joint);
    return {named == names.end() ? joint : named->second, plane};
  }

  std::uint32_t shared_vertex(const Rail& rail, std::uint32_t plane) {
    const auto [at, fresh] = shared_.try_emplace(key_of(rail.joint, plane), 0);
    if (fresh) at->second = add_vertex(position(rail, height(plane)), height(plane));
    return at->second;
  }

  /// The vertex at pi over one at -pi.
  std::uint32_t top_of(std::uint32_t joint) {
    const auto [at, fresh] = shared_.try_emplace(key_of(joint, seam()), 0);
    if (fresh) {
      const Configuration& bottom = mesh_.vertices[shared_.at({joint, 0})];
      at->second = add_vertex({bottom.x, bottom.y}, std::numbers::pi);
    }
    return at->second;
  }

  void join_planes() {
    for (const auto& [key, bottom] : shared_) {
      if (key.second != 0) continue;
      const std::uint32_t top = top_of(key.first);
      mesh_.vertices[bottom] = {mesh_.vertices[top].x, mesh_.vertices[top].y, -std::numbers::pi};
      mesh_.seam.push_back({bottom, top});
    }
  }

  /// The full turn is cut into 2^k steps for a piece, so that steps of neighbours fit.
  int halvings(std::uint32_t piece) const {
    if (piece == kNobody) return 0;
    const Patch& patch = obstacle_.patches()[layout_.pieces[piece].patch];
    const double length = patch.rotating() ? sizes_.edge.at(patch.contact.q) : 0;
    int k = 2;
    const auto error = [&](double step) { return length * step / 4 + sizes_.radius * step * step / 8; };
    while (k < 40 && error(std::ldexp(2 * std::numbers::pi, -k)) > mesh_.tolerance) ++k;
    return k;
  }

  void place_rail(std::uint32_t index) {
    const Rail& rail = layout_.rails[index];
    std::vector<OnRail>& chain = on_rail_[index];
    const double from = height(rail.first), to = height(rail.last + 1);
    chain.push_back({shared_vertex(rail, rail.first), from});
    const double step = std::ldexp(2 * std::numbers::pi, -std::max(halvings(rail.before), halvings(rail.after)));
    for (double k = std::floor((from + std::numbers::pi) / step) + 1;; ++k) {
      const double theta = k * step - std::numbers::pi;
      if (theta >= to - step / 1024) break;
      if (theta > from + step / 1024) extend(chain, rail, {0, theta}, kMostHalvings);
    }
    extend(chain, rail, {shared_vertex(rail, rail.last + 1), to}, kMostHalvings);
  }

  /// Appends `next` and what it takes to get there. A new vertex is added where it has none.
  void extend(std::vector<OnRail>& chain, const Rail& rail, OnRail next, int halvings_left) {
    const OnRail from = chain.back();
    const bool known = next.theta == height(rail.last + 1);
    const Point at =
        known ? Point{mesh_.vertices[next.vertex].x, mesh_.vertices[next.vertex].y} : position(rail, next.theta);
    const double midpoint = from.theta + (next.theta - from.theta) / 2;
    if (halvings_left > 0 && midpoint > from.theta && midpoint < next.theta) {
      const Configuration& a = mesh_.vertices[from.vertex];
      const Point m = position(rail, midpoint);
      if (std::hypot(m.x - (a.x + at.x) / 2, m.y - (a.y + at.y) / 2) > mesh_.tolerance) {
        extend(chain, rail, {0, midpoint}, halvings_left - 1);
        extend(chain, rail, next, halvings_left - 1);
        return;
      }
    }
    if (!known) next.vertex = add_vertex(at, next.theta);
    chain.push_back(next);
  }

  std::vector<OnRail> side(std::uint32_t piece, int which) const {
    std::vector<OnRail> chain;
    for (const std::uint32_t rail : layout_.rails_of_piece[piece][static_cast<std::size_t>(which)]) {
      const std::vector<OnRail>& more = on_rail_[rail];
      chain.insert(chain.end(), more.begin() + (chain.empty() ? 0 : 1), more.end());
    }
    return chain;
  }

  /// Triangles between the two sides of a piece, from below, the lower next vertex first.
  void add_strip(std::uint32_t index) {
    const std::uint32_t patch = layout_.pieces[index].patch;
    const std::vector<OnRail> left = side(index, 0), right = side(index, 1);
    if (left.empty() || right.empty()) return;
    std::size_t l = 0, r = 0;
    while (l + 1 < left.size() || r + 1 < right.size()) {
      const bool on_right = l + 1 == left.size() || (r + 1 < right.size() && right[r + 1].theta <= left[l + 1].theta);
      const std::uint32_t next = on_right ? right[r + 1].vertex : left[l + 1].vertex;
      mesh_.triangles.push_back({{left[l].vertex, right[r].vertex, next}, patch, false});
      ++(on_right ? r : l);
    }
  }

  void close_stations() {
    for (std::uint32_t k = 0; k < layout_.stations.size(); ++k) close(layout_.stations[k], k + 1);
  }

  void close(const Station& station, std::uint32_t plane) {
    const auto vertex = [&](std::uint32_t joint) {
      return plane == seam() ? top_of(joint) : shared_.at(key_of(joint, plane));
    };
    RingCloser closer(mesh_);
    for (const auto* pieces : {&station.ending, &station.beginning})
      for (const std::uint32_t k : *pieces)
        closer.add_edge(vertex(layout_.pieces[k].joint[0]), vertex(layout_.pieces[k].joint[1]));
    for (const std::vector<WalkCorner>& walk : closing_walks(layout_, station)) {
      std::vector<RingCorner> ring;
      for (const WalkCorner& corner : walk) ring.push_back({vertex(corner.joint), corner.patch});
      closer.close(std::move(ring));
    }
  }

  const CspaceObstacle& obstacle_;
  const ObstacleMeshOptions& options_;
  ObstacleLayout layout_;
  RobotSizes sizes_;
  ObstacleMesh mesh_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> shared_;  // (joint, plane) -> vertex
  std::vector<std::vector<OnRail>> on_rail_;
};

}  // namespace

Result<ObstacleMesh> obstacle_mesh(const CspaceObstacle& obstacle, const ObstacleMeshOptions& options) {
  // The user's, for the picture: how fine patches are tessellated. No sign depends on it.
  if (!(options.tolerance >= 1e-6 && options.tolerance <= 1))
    return Error{ErrorCode::out_of_range,
                 "the tolerance must be from 1e-6 to 1, not " + base::general_text(options.tolerance, 6),
                 {}};
  return MeshBuilder(obstacle, options).build();
}

}  // namespace dymsum
