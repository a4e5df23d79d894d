#include "dymsum/obstacle_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "base/double_text.h"
#include "base/poll.h"
#include "cspace/events/walked_rings.h"
#include "cspace/mesh/obstacle_rails.h"
#include "cspace/mesh/station_closing.h"

namespace dymsum {
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
