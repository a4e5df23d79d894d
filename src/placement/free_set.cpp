#include "placement/free_set.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>

#include "planar/position/exact_source.h"
#include "planar/result/pieces.h"
#include "planar/result/planar_sum.h"

namespace dymsum::placement {
namespace {

/// Positions of vertices that are named by their indices, as Contact::p of their edges and as their corners.
class SiteSource final : public ExactSource {
 public:
  explicit SiteSource(std::vector<std::shared_ptr<const PlacedSet>> sets) : sets_(std::move(sets)) {}
  SumVertex add(const Site& site) {
    const auto index = static_cast<std::uint32_t>(sites_.size());
    sites_.push_back(site);
    SumVertex v;
    v.at = {site.near.x.midpoint(), site.near.y.midpoint()};
    v.in = v.out = {Contact::Kind::edge_of_p, index, 0};
    v.corner_p = index;
    v.corner_q = 0;
    return v;
  }

  Position position(const SumVertex& v) const override { return planar::reduced(homogeneous(v)); }
  Homogeneous homogeneous(const SumVertex& v) const override { return exact_position(sites_[v.corner_p]); }
  int compare_x(const SumVertex& a, const SumVertex& b) const override {
    return compare(sites_[a.corner_p], sites_[b.corner_p], 0);
  }
  int compare_y(const SumVertex& a, const SumVertex& b) const override {
    return compare(sites_[a.corner_p], sites_[b.corner_p], 1);
  }

 private:
  std::vector<std::shared_ptr<const PlacedSet>> sets_;
  std::vector<Site> sites_;
};

/// Positions, each once, by x, then y.
class Nodes {
 public:
  struct Node {
    Site at;
    std::vector<std::uint32_t> touches;
  };

  /// An index of a position, to be made one of a node by `node_of`.
  std::uint32_t add(const FreeNode& n) {
    const auto id = [](const PlacedSet* set) { return set == nullptr ? kNone : set->id(); };
    const Key key{id(n.at.set), n.at.index, id(n.at.other), n.at.other_index};
    const auto [it, added] = known_.try_emplace(key, static_cast<std::uint32_t>(sites_.size()));
    if (added) sites_.push_back({n.at, {}});
    auto& touches = sites_[it->second].touches;
    touches.insert(touches.end(), n.touches.begin(), n.touches.end());
    return it->second;
  }

  void sort() {
    std::vector<std::uint32_t> order(sites_.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) order[k] = k;
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      const int x = compare(sites_[a].at, sites_[b].at, 0);
      return x != 0 ? x < 0 : compare(sites_[a].at, sites_[b].at, 1) < 0;
    };
    std::sort(order.begin(), order.end(), before);
    node_of_.resize(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (k == 0 || before(order[k - 1], order[k])) nodes_.push_back(std::move(sites_[order[k]]));
      else merge(nodes_.back(), sites_[order[k]]);
      node_of_[order[k]] = static_cast<std::uint32_t>(nodes_.size() - 1);
    }
    for (Node& n : nodes_) {
      std::sort(n.touches.begin(), n.touches.end());
      n.touches.erase(std::unique(n.touches.begin(), n.touches.end()), n.touches.end());
    }
  }
  std::uint32_t node_of(std::uint32_t index) const { return node_of_[index]; }
  const std::vector<Node>& all() const { return nodes_; }

 private:
  using Key = std::array<std::uint32_t, 4>;
  struct Hash {
    std::size_t operator()(const Key& k) const {
      std::uint64_t h = 0;
      for (const std::uint32_t v : k) h = (h ^ v) * 0x9e3779b97f4a7c15u, h ^= h >> 29;
      return static_cast<std::size_t>(h);
    }
  };
  // Of two names of a position that of the smaller ids stays, so that the order of sorting decides nothing.
  static void merge(Node& to, const Node& from) {
    const auto name = [](const Site& s) {
      return std::tuple(s.set->id(), s.index, s.other == nullptr ? kNone : s.other->id(), s.other_index);
    };
    if (name(from.at) < name(to.at)) to.at = from.at;
    to.touches.insert(to.touches.end(), from.touches.begin(), from.touches.end());
  }

  std::vector<Node> sites_, nodes_;
  std::vector<std::uint32_t> node_of_;
  std::unordered_map<Key, std::uint32_t, Hash> known_;
};

/// A piece of the boundary of parts, which runs against its edge: free positions lie on its left.
struct Arc {
  EdgeOf edge;
  std::uint32_t from = 0, to = 0;
};

/// Arcs as rings: at a position that several pass, one that arrives goes on with the next one clockwise, across free
/// positions; rings that come back to a position are cut there.
class ArcRings {
 public:
  ArcRings(const std::vector<Arc>& arcs, std::size_t nodes) : arcs_(arcs), next_(arcs.size(), kNone) {
    std::vector<std::vector<Ray>> rays(nodes);
    for (std::uint32_t a = 0; a < arcs.size(); ++a) {
      rays[arcs[a].from].push_back({a, true});
      rays[arcs[a].to].push_back({a, false});
    }
    for (std::vector<Ray>& at : rays) link(at);
  }

  std::vector<std::vector<std::uint32_t>> rings() const {
    std::vector<std::vector<std::uint32_t>> out;
    std::vector<std::uint8_t> seen(arcs_.size(), 0);
    for (std::uint32_t start = 0; start < arcs_.size(); ++start) {
      std::vector<std::uint32_t> path;
      std::unordered_map<std::uint32_t, std::size_t> at;  // node -> arcs of the path before it
      for (std::uint32_t a = start; !seen[a]; a = next_[a]) {
        seen[a] = 1;
        path.push_back(a);
        at.try_emplace(arcs_[a].from, path.size() - 1);
        const auto meets = at.find(arcs_[a].to);
        if (meets == at.end()) continue;
        const std::size_t first = meets->second;
        out.emplace_back(path.begin() + static_cast<std::ptrdiff_t>(first), path.end());
        for (const std::uint32_t b : out.back()) at.erase(arcs_[b].from);
        path.resize(first);
      }
    }
    return out;
  }

 private:
  struct Ray {
    std::uint32_t arc;
    bool leaves;  // it points against its edge then, away from the node
  };

  void link(std::vector<Ray>& rays) {
    if (rays.size() > 2)
      std::sort(rays.begin(), rays.end(), [&](const Ray& a, const Ray& b) {
        const EdgeOf f = arcs_[a.arc].edge, g = arcs_[b.arc].edge;
        const int ha = half_plane(f) ^ (a.leaves ? 1 : 0), hb = half_plane(g) ^ (b.leaves ? 1 : 0);
        return ha != hb ? ha < hb : turn(f, g) * (a.leaves == b.leaves ? 1 : -1) > 0;
      });
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (!rays[i].leaves) next_[rays[i].arc] = rays[(i + rays.size() - 1) % rays.size()].arc;
  }

  const std::vector<Arc>& arcs_;
  std::vector<std::uint32_t> next_;
};

class SetBuilder {
 public:
  explicit SetBuilder(std::vector<std::shared_ptr<const PlacedSet>> sets)
      : source_(std::make_shared<SiteSource>(std::move(sets))) {}

  FreeSet run(std::span<const FreeBoundary* const> boundaries) {
    gather(boundaries);
    const auto count = nodes_.all().size();
    vertices_.resize(count);
    make_parts(count);
    make_thin();
    out_.set.at_error = error_;
    planar::canonicalize(out_.set.parts, *source_, error_);
    exact_source(out_.set) = source_;
    for (std::uint32_t n = 0; n < count; ++n)
      if (vertices_[n].used) out_.vertices.push_back({vertices_[n].of, vertices_[n].vertex, nodes_.all()[n].touches});
    return std::move(out_);
  }

 private:
  struct Made {
    bool made = false, used = false;
    SetVertex::Of of = SetVertex::Of::part;
    SumVertex vertex;
  };

  void gather(std::span<const FreeBoundary* const> boundaries) {
    struct Ends {
      const FreePiece* piece;
      std::uint32_t from, to;
    };
    std::vector<Ends> ends;
    std::vector<std::uint32_t> alone;
    for (const FreeBoundary* b : boundaries) {
      for (const FreePiece& p : b->pieces) ends.push_back({&p, nodes_.add(p.from), nodes_.add(p.to)});
      for (const FreeNode& n : b->nodes) alone.push_back(nodes_.add(n));
    }
    nodes_.sort();
    std::vector<std::uint8_t> met(nodes_.all().size(), 0);
    for (const Ends& e : ends) {
      const std::uint32_t from = nodes_.node_of(e.from), to = nodes_.node_of(e.to);
      met[from] = met[to] = 1;
      auto& list = e.piece->beside ? arcs_ : thin_;
      list.push_back({e.piece->edge, to, from});
    }
    for (const std::uint32_t k : alone)
      if (const std::uint32_t n = nodes_.node_of(k); !met[n]) met[n] = 1, points_.push_back(n);
  }

  const SumVertex& vertex(std::uint32_t node, SetVertex::Of of) {
    Made& v = vertices_[node];
    if (!v.made) {
      v.made = true;
      v.of = of;
      Site at = nodes_.all()[node].at;
      const auto wide = [](const Interval& i) {
        return i.high() - i.low() > 0x1p-46 * std::max(std::abs(i.low()), std::abs(i.high()));
      };
      if (wide(at.near.x) || wide(at.near.y)) at.near = near_point(exact_position(at));
      v.vertex = source_->add(at);
      for (const Interval& i : {at.near.x, at.near.y}) error_ = std::max(error_, i.high() - i.low());
    }
    v.used = true;
    return v.vertex;
  }

  void make_parts(std::size_t count) {
    std::vector<SumRing> rings;
    std::vector<std::uint8_t> outer;
    for (const std::vector<std::uint32_t>& arcs : ArcRings(arcs_, count).rings()) {
      std::vector<std::array<std::uint32_t, 2>> corners;  // arcs that arrive and leave
      for (std::size_t k = 0; k < arcs.size(); ++k) {
        const std::uint32_t in = arcs[k], next = arcs[(k + 1) % arcs.size()];
        const EdgeOf f = arcs_[in].edge, g = arcs_[next].edge;
        if (!(f == g) && turn(f, g) != 0) corners.push_back({in, next});
      }
      const auto node = [&](const auto& c) { return arcs_[c[0]].to; };
      const auto least = std::min_element(corners.begin(), corners.end(),
                                          [&](const auto& a, const auto& b) { return node(a) < node(b); });
      outer.push_back(turn(arcs_[(*least)[0]].edge, arcs_[(*least)[1]].edge) > 0);
      SumRing& ring = rings.emplace_back();
      for (const auto& c : corners) ring.vertices.push_back(vertex(node(c), SetVertex::Of::part));
      for (std::size_t k = 0; k < ring.vertices.size(); ++k) {
        ring.vertices[k].in.p = ring.vertices[k == 0 ? ring.vertices.size() - 1 : k - 1].corner_p;
        vertices_[node(corners[k])].vertex = ring.vertices[k];  // as it is in the set
      }
    }
    out_.set.parts = planar::group_rings(std::move(rings), outer, *source_, error_);
  }

  void make_thin() {
    const auto position = [&](std::uint32_t n) { return planar::reduced(exact_position(nodes_.all()[n].at)); };
    std::vector<planar::PieceCandidate> segments;
    std::vector<std::pair<planar::Position, std::uint32_t>> ends;
    for (const Arc& a : thin_) {
      segments.push_back({position(a.from), position(a.to)});
      ends.emplace_back(segments.back().a, a.from);
      ends.emplace_back(segments.back().b, a.to);
    }
    const auto made = [&](const planar::Position& at) {
      const auto it =
          std::find_if(ends.begin(), ends.end(), [&](const auto& e) { return planar::compare(e.first, at) == 0; });
      return vertex(it->second, SetVertex::Of::segment);
    };
    for (const planar::PieceSegment& s : planar::lower_dimensional_pieces({}, segments, {}).segments)
      out_.set.segments.push_back({made(s.from.at), made(s.to.at)});
    std::sort(points_.begin(), points_.end());
    for (const std::uint32_t n : points_) out_.set.points.push_back(vertex(n, SetVertex::Of::point));
    out_.set.tight_segments = out_.set.segments;
    out_.set.tight_points = out_.set.points;
  }

  std::shared_ptr<SiteSource> source_;
  Nodes nodes_;
  std::vector<Arc> arcs_, thin_;
  std::vector<std::uint32_t> points_;
  std::vector<Made> vertices_;
  double error_ = 0;
  FreeSet out_;
};

}  // namespace

FreeSet free_set(std::span<const FreeBoundary* const> boundaries, std::vector<std::shared_ptr<const PlacedSet>> sets) {
  return SetBuilder(std::move(sets)).run(boundaries);
}

}  // namespace dymsum::placement
