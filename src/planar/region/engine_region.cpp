#include "planar/region/engine_region.h"

#include <algorithm>

#include "exact/orient.h"
#include "planar/region/region_sweep.h"

namespace dymsum::planar {
namespace {

// A ring vertex that may be a cut inside an edge.
struct Node {
  Point at;
  std::uint32_t vertex_index, edge_index;  // of the vertex here, of the edge that starts here
  std::uint32_t next;
  bool cut;
};

bool inside_edge(Point a, Point b, Point z) {
  if (z.x < std::min(a.x, b.x) || z.x > std::max(a.x, b.x) || z.y < std::min(a.y, b.y) || z.y > std::max(a.y, b.y))
    return false;
  return z != a && z != b && exact::orient_sign(a, b, z) == 0;
}

class Separation {
 public:
  Separation(const RegionData& data, const std::vector<Point>& touching) {
    for (const Part& part : data.parts) {
      add_ring(part.outer, touching);
      for (const Ring& hole : part.holes) add_ring(hole, touching);
    }
    for (const Point& z : touching) pair_at(z);
    result.touching = true;
    collect(data);
  }

  EngineRegion result;

 private:
  void add_ring(const Ring& ring, const std::vector<Point>& touching) {
    const std::uint32_t begin = static_cast<std::uint32_t>(nodes_.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], b = ring[i + 1 == ring.size() ? 0 : i + 1];
      add_node(a, index_, false);
      std::vector<Point> cuts;
      for (const Point& z : touching)
        if (inside_edge(a, b, z)) cuts.push_back(z);
      std::sort(cuts.begin(), cuts.end(), [](Point u, Point v) { return u.x != v.x ? u.x < v.x : u.y < v.y; });
      if (b.x < a.x || (b.x == a.x && b.y < a.y)) std::reverse(cuts.begin(), cuts.end());
      for (const Point& z : cuts) add_node(z, index_, true);
      ++index_;
    }
    nodes_.back().next = begin;
  }
  void add_node(Point at, std::uint32_t number, bool cut) {
    nodes_.push_back({at, number, number, static_cast<std::uint32_t>(nodes_.size() + 1), cut});
  }

  // Around z, counter-clockwise, region sectors run from a way out to a way in; afterwards each visit of z has one of
  // them.
  void pair_at(Point z) {
    struct Ray {
      Point to;
      std::uint32_t node;  // the node at z (out) or before z (in)
      bool out;
    };
    std::vector<Ray> rays;
    std::uint32_t vertex = 0;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      const Node& n = nodes_[i];
      if (n.at == z) rays.push_back({nodes_[n.next].at, i, true});
      if (nodes_[n.next].at == z) rays.push_back({n.at, i, false});
      // Two edges cannot touch in both their interiors: some strand has a vertex here.
      if (n.at == z && !n.cut) vertex = n.vertex_index;
    }
    const auto half = [&](const Ray& r) { return r.to.y > z.y || (r.to.y == z.y && r.to.x > z.x) ? 0 : 1; };
    std::sort(rays.begin(), rays.end(), [&](const Ray& a, const Ray& b) {
      return half(a) != half(b) ? half(a) < half(b) : exact::orient_sign(z, a.to, b.to) > 0;
    });
    std::vector<std::pair<std::uint32_t, std::uint32_t>> joined;
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (!rays[i].out) joined.emplace_back(rays[i].node, rays[(i + rays.size() - 1) % rays.size()].node);
    for (const auto& [in, out] : joined) nodes_[in].next = out;
    for (const Ray& r : rays)
      if (r.out && nodes_[r.node].cut) nodes_[r.node].vertex_index = vertex;
  }

  void collect(const RegionData& data) {
    std::vector<std::vector<std::uint32_t>> rings;
    std::vector<bool> seen(nodes_.size(), false);
    RingList list;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      if (seen[i]) continue;
      std::vector<std::uint32_t> ring;
      Ring points;
      for (std::uint32_t at = i; !seen[at]; at = nodes_[at].next) {
        seen[at] = true;
        ring.push_back(at);
        points.push_back(nodes_[at].at);
      }
      list.add(points);
      rings.push_back(std::move(ring));
    }
    const RingLayout layout = layout_rings(list);
    const auto points_of = [&](std::size_t r) {
      Ring ring;
      for (const std::uint32_t n : rings[r]) ring.push_back(nodes_[n].at);
      return ring;
    };
    const auto number = [&](std::size_t r) {
      for (const std::uint32_t n : rings[r]) {
        result.vertex_indices.push_back(nodes_[n].vertex_index);
        result.edge_indices.push_back(nodes_[n].edge_index);
      }
    };
    for (std::size_t r = 0; r < rings.size(); ++r) {
      if (!layout.rings[r].counter_clockwise) continue;
      result.own.parts.push_back({points_of(r), {}});
      number(r);
      for (std::size_t h = 0; h < rings.size(); ++h)
        if (layout.rings[h].container == r && !layout.rings[h].counter_clockwise) {
          result.own.parts.back().holes.push_back(points_of(h));
          number(h);
        }
    }
    append_lower(data);
  }
  void append_lower(const RegionData& data) {
    result.own.polylines = data.polylines;
    result.own.points = data.points;
    std::size_t rest = data.points.size();
    for (const Polyline& line : data.polylines) rest += line.size();
    for (std::size_t i = 0; i < rest; ++i, ++index_) {
      result.vertex_indices.push_back(index_);
      result.edge_indices.push_back(index_);
    }
  }

  std::vector<Node> nodes_;
  std::uint32_t index_ = 0;
};

}  // namespace

EngineRegion separate_touching(const RegionData& data, const std::vector<Point>& touching_points) {
  if (!touching_points.empty()) return Separation(data, touching_points).result;
  EngineRegion same;
  same.borrowed = &data;
  return same;
}

}  // namespace dymsum::planar
