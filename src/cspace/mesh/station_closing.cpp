#include "cspace/mesh/station_closing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace dymsum::cspace {
namespace {

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

}  // namespace

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

}  // namespace dymsum::cspace
