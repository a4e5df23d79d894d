#include "planar/frame/local_edges.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "base/union_find.h"

namespace dymsum::planar {

namespace {

/// A piece between two nodes, with the segments that run along it: from `low` to `high`, and back. One at least.
struct LocalPiece {
  std::uint32_t low = 0, high = 0;
  std::uint32_t ahead = kNone, back = kNone;
  bool both() const { return ahead != kNone && back != kNone; }
  std::uint32_t any() const { return ahead != kNone ? ahead : back; }
  bool forward() const { return ahead != kNone; }
};

/// A piece as it leaves a node.
struct Ray {
  std::uint32_t piece = 0;
  std::uint32_t segment = 0;
  bool with = false;             ///< the segment's direction leaves the node
  bool out = false, in = false;  ///< segments leave along it, arrive along it
};

/// A segment that does not end at a node: its rays there, as indices among the node's.
struct Passing {
  std::uint32_t after = 0, before = 0;
};

class LocalPatches {
 public:
  LocalPatches(const LocalNodes& nodes, LocalOverlap& overlap, Linking linking)
      : nodes_(nodes), overlap_(overlap), linking_(linking) {}

  LocalEdges run() {
    find_pieces();
    links_ = UnionFind(static_cast<std::uint32_t>(pieces_.size()));
    covered_.assign(pieces_.size(), 0);
    if (linking_ == Linking::patches)
      for (std::uint32_t n = 0; n < nodes_.node_count(); ++n)
        if (nodes_.node(n).known && !at_[n].empty()) look_around(n);
    spread();
    query_patches();
    return collect();
  }

 private:
  void find_pieces();
  void look_around(std::uint32_t n);
  std::vector<Ray> rays_at(std::uint32_t n) const;
  bool turns_before(const Ray& a, const Ray& b) const;
  int half(const Ray& r) const;
  void spread();
  void query_patches();
  bool inside_at(std::uint32_t n) const;
  bool inside_halfway(const LocalPiece& p) const;
  bool touches_box(const LocalPiece& p) const { return nodes_.node(p.low).in_box || nodes_.node(p.high).in_box; }
  bool may_be_tight(std::uint32_t n) const;
  LocalEdge rightwards(const LocalPiece& p) const;
  LocalEdges collect() const;

  const LocalNodes& nodes_;
  LocalOverlap& overlap_;
  Linking linking_;
  base::CountedArray<LocalPiece> pieces_;
  std::vector<std::vector<std::uint32_t>> at_;        // node -> pieces
  std::vector<std::vector<std::uint32_t>> segments_;  // node -> segments through it
  UnionFind links_;
  std::vector<std::uint8_t> covered_;
};

void LocalPatches::find_pieces() {
  std::map<std::pair<std::uint32_t, std::uint32_t>, LocalPiece> found;
  segments_.resize(nodes_.node_count()), at_.resize(nodes_.node_count());
  for (std::uint32_t s = 0; s < nodes_.segment_count(); ++s) {
    const std::vector<std::uint32_t>& along = nodes_.along(s);
    for (const std::uint32_t n : along) segments_[n].push_back(s);
    for (std::size_t k = 0; k + 1 < along.size(); ++k) {
      const std::uint32_t low = std::min(along[k], along[k + 1]), high = std::max(along[k], along[k + 1]);
      LocalPiece& piece = found[{low, high}];
      piece.low = low, piece.high = high;
      std::uint32_t& segment = along[k] == low ? piece.ahead : piece.back;
      segment = std::min(segment, s);
    }
  }
  for (const auto& [ends, piece] : found) {
    at_[piece.low].push_back(static_cast<std::uint32_t>(pieces_.size()));
    at_[piece.high].push_back(static_cast<std::uint32_t>(pieces_.size()));
    pieces_.push_back(piece);
  }
}

/// 0 for directions from 0 up to half a turn, 1 for the others.
int LocalPatches::half(const Ray& r) const {
  const int sign = r.with ? 1 : -1, y = sign * nodes_.direction(r.segment, 1);
  return y != 0 ? (y < 0 ? 1 : 0) : (sign * nodes_.direction(r.segment, 0) < 0 ? 1 : 0);
}

bool LocalPatches::turns_before(const Ray& a, const Ray& b) const {
  const int ha = half(a), hb = half(b);
  if (ha != hb) return ha < hb;
  return nodes_.cross(a.segment, b.segment) * (a.with == b.with ? 1 : -1) > 0;
}

/// Counter-clockwise.
std::vector<Ray> LocalPatches::rays_at(std::uint32_t n) const {
  std::vector<Ray> rays;
  for (const std::uint32_t k : at_[n]) {
    const LocalPiece& p = pieces_[k];
    const bool low = p.low == n;
    const bool ahead = p.ahead != kNone, back = p.back != kNone;
    rays.push_back({k, p.any(), p.forward() == low, low ? ahead : back, low ? back : ahead});
  }
  std::sort(rays.begin(), rays.end(), [&](const Ray& a, const Ray& b) { return turns_before(a, b); });
  return rays;
}

/// Sector k lies between ray k and the next one. On the left of a segment lies the sum. So a piece whose right side is
/// known to lie in the sum does too, unless segments of both directions run along it; and what bounds one sector with
/// its right sides bounds the sum where that sector lies outside: all of it, or nothing.
void LocalPatches::look_around(std::uint32_t n) {
  const std::vector<Ray> rays = rays_at(n);
  const std::size_t count = rays.size();
  std::vector<std::uint8_t> inside(count, 0);
  const auto before = [&](std::size_t k) { return (k + count - 1) % count; };
  for (std::size_t k = 0; k < count; ++k) {
    if (rays[k].out) inside[k] = 1;
    if (rays[k].in) inside[before(k)] = 1;
  }
  for (const std::uint32_t s : segments_[n]) {
    const std::vector<std::uint32_t>& along = nodes_.along(s);
    if (along.front() == n || along.back() == n) continue;
    const auto at = std::find(along.begin(), along.end(), n);
    const auto ray_to = [&](std::uint32_t m) {
      for (std::size_t k = 0; k < count; ++k)
        if (const LocalPiece& p = pieces_[rays[k].piece]; p.low == m || p.high == m) return k;
      return count;
    };
    const std::size_t first = ray_to(*(at + 1)), last = ray_to(*(at - 1));
    for (std::size_t k = first; k != last; k = (k + 1) % count) {
      inside[k] = 1;
      if (k != first) covered_[rays[k].piece] = 1;
    }
  }
  for (std::size_t k = 0; k < count; ++k) {
    const Ray& ray = rays[k];
    if (ray.out && ray.in) continue;
    if (inside[ray.out ? before(k) : k] != 0) covered_[ray.piece] = 1;
    else links_.unite(ray.piece, rays[ray.out ? before(k) : (k + 1) % count].piece);
  }
}

/// What is known of a piece holds for its patch.
void LocalPatches::spread() {
  std::vector<std::uint8_t> patch(pieces_.size(), 0);
  for (std::uint32_t k = 0; k < pieces_.size(); ++k)
    if (covered_[k] != 0) patch[links_.root(k)] = 1;
  for (std::uint32_t k = 0; k < pieces_.size(); ++k) covered_[k] = patch[links_.root(k)];
}

bool LocalPatches::inside_at(std::uint32_t n) const {
  const LocalNode& node = nodes_.node(n);
  return overlap_.holds(nodes_.posed(), {node.x, node.y, node.off, [&] { return nodes_.exact(n); }});
}

bool LocalPatches::inside_halfway(const LocalPiece& p) const {
  const LocalNode &a = nodes_.node(p.low), &b = nodes_.node(p.high);
  return overlap_.holds(nodes_.posed(), {(a.x + b.x) / 2, (a.y + b.y) / 2, std::max(a.off, b.off) + PosedRegions::kOff,
                                         [&] { return halfway(nodes_.exact(p.low), nodes_.exact(p.high)); }});
}

void LocalPatches::query_patches() {
  std::vector<std::uint32_t> queried(pieces_.size(), kNone);  // by patch: the piece that is queried
  const auto within = [&](const LocalPiece& p) { return nodes_.node(p.low).in_box && nodes_.node(p.high).in_box; };
  const auto order = [&](std::uint32_t k) { return within(pieces_[k]) ? 0 : touches_box(pieces_[k]) ? 1 : 2; };
  for (std::uint32_t k = 0; k < pieces_.size(); ++k) {
    std::uint32_t& best = queried[links_.root(k)];
    if (best == kNone || order(k) < order(best)) best = k;
  }
  for (std::uint32_t root = 0; root < pieces_.size(); ++root) {
    const std::uint32_t k = queried[root];
    if (k == kNone || covered_[k] != 0 || !touches_box(pieces_[k])) continue;
    covered_[root] = inside_halfway(pieces_[k]) ? 1 : 0;
  }
  for (std::uint32_t k = 0; k < pieces_.size(); ++k) covered_[k] = covered_[links_.root(k)];
}

/// Nothing there bounds the sum. Where one segment ends alone, where two meet and no more, or cross, the position is
/// covered with what is around it.
bool LocalPatches::may_be_tight(std::uint32_t n) const {
  if (!nodes_.node(n).in_box || at_[n].empty()) return false;
  if (std::any_of(at_[n].begin(), at_[n].end(), [&](std::uint32_t k) { return covered_[k] == 0; })) return false;
  if (linking_ == Linking::none) return true;
  if (at_[n].size() < 3) return false;
  const auto passes = [&](std::uint32_t s) { return nodes_.along(s).front() != n && nodes_.along(s).back() != n; };
  return segments_[n].size() != 2 || !passes(segments_[n][0]) || !passes(segments_[n][1]);
}

/// The one of both directions that leads to the right, or straight up.
LocalEdge LocalPatches::rightwards(const LocalPiece& p) const {
  const int x = nodes_.direction(p.ahead, 0);
  const bool ahead = x != 0 ? x > 0 : nodes_.direction(p.ahead, 1) > 0;
  return ahead ? LocalEdge{p.low, p.high, p.ahead} : LocalEdge{p.high, p.low, p.back};
}

LocalEdges LocalPatches::collect() const {
  LocalEdges edges;
  for (std::uint32_t k = 0; k < pieces_.size(); ++k) {
    const LocalPiece& p = pieces_[k];
    if (covered_[k] != 0 || !nodes_.node(p.low).in_box || !nodes_.node(p.high).in_box) continue;
    if (p.both()) edges.tight.push_back(rightwards(p));
    else edges.boundary.push_back(p.forward() ? LocalEdge{p.low, p.high, p.ahead} : LocalEdge{p.high, p.low, p.back});
  }
  for (std::uint32_t n = 0; n < nodes_.node_count(); ++n)
    if (may_be_tight(n) && !inside_at(n)) edges.tight_points.push_back(n);
  return edges;
}

}  // namespace

LocalEdges local_edges(const LocalNodes& nodes, LocalOverlap& overlap, Linking linking) {
  return LocalPatches(nodes, overlap, linking).run();
}

std::vector<LocalEdge> joined(const LocalNodes& nodes, std::vector<LocalEdge> edges) {
  const auto same_line = [&](const LocalEdge& a, const LocalEdge& b) {
    if (nodes.cross(a.segment, b.segment) != 0) return false;
    const int axis = nodes.direction(a.segment, 0) != 0 ? 0 : 1;
    return nodes.direction(a.segment, axis) == nodes.direction(b.segment, axis);
  };
  std::map<std::uint32_t, std::vector<std::size_t>> leaving;
  for (std::size_t k = 0; k < edges.size(); ++k) leaving[edges[k].from].push_back(k);
  std::vector<std::size_t> next(edges.size(), edges.size());
  std::vector<std::uint8_t> continues(edges.size(), 0);
  for (std::size_t k = 0; k < edges.size(); ++k)
    if (const auto list = leaving.find(edges[k].to); list != leaving.end())
      for (const std::size_t j : list->second)
        if (same_line(edges[k], edges[j])) next[k] = j, continues[j] = 1;
  std::vector<LocalEdge> result;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    if (continues[k] != 0) continue;
    LocalEdge edge = edges[k];
    for (std::size_t j = next[k]; j < edges.size(); j = next[j]) {
      edge.to = edges[j].to;
      edge.segment = std::min(edge.segment, edges[j].segment);
    }
    result.push_back(edge);
  }
  return result;
}

}  // namespace dymsum::planar
