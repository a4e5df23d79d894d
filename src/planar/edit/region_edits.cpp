#include "planar/edit/region_edits.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "exact/orient.h"
#include "planar/region/region.h"
#include "planar/region/region_sweep.h"
#include "planar/region/region_validate.h"

namespace dymsum::planar {
namespace {

Error out_of_range(std::string message) { return {ErrorCode::out_of_range, std::move(message), {}}; }

std::string text(std::uint32_t n) { return std::to_string(n); }

// The chain of a vertex, with its position there and the index of the chain's first vertex.
struct ChainPosition {
  std::vector<Point>* chain = nullptr;
  std::size_t at = 0;
  std::uint32_t first = 0;
  bool ring = false;
};

ChainPosition find_vertex(RegionData& data, std::uint32_t vertex) {
  ChainPosition found;
  std::size_t rings = 0;
  for (const Part& part : data.parts) rings += 1 + part.holes.size();
  std::uint32_t first = 0;
  std::size_t chain_index = 0;
  for_each_chain(data, [&](std::vector<Point>& chain) {
    const auto n = static_cast<std::uint32_t>(chain.size());
    if (found.chain == nullptr && vertex < first + n) found = {&chain, vertex - first, first, chain_index < rings};
    first += n;
    ++chain_index;
  });
  return found;
}

Error on_no_ring(std::uint32_t vertex) {
  return out_of_range("vertex " + text(vertex) + " is a point or on a polyline, and can only be moved");
}

Result<ChainPosition> ring_vertex(RegionData& data, std::uint32_t vertex) {
  const ChainPosition at = find_vertex(data, vertex);
  if (at.chain == nullptr) return out_of_range("there is no vertex " + text(vertex));
  if (!at.ring) return on_no_ring(vertex);
  return at;
}

void insert_vertices(EditedData& edited, const ChainPosition& at, std::size_t k, Point p) {
  at.chain->insert(at.chain->begin() + static_cast<std::ptrdiff_t>(k), p);
  edited.changes.origins.insert(edited.changes.origins.begin() + static_cast<std::ptrdiff_t>(at.first + k), kNone);
}

Result<void> extrude(const Edit& edit, EditedData& edited) {
  const Result<ChainPosition> first = ring_vertex(edited.data, edit.vertex);
  if (!first) return first.error();
  const Result<ChainPosition> last = ring_vertex(edited.data, edit.last);
  if (!last) return last.error();
  if (first->chain != last->chain) return out_of_range("the ends of a chain are on two rings");
  if (first->at == last->at) return out_of_range("a chain to extrude has an edge at least");
  std::vector<Point>& ring = *first->chain;
  const std::size_t n = ring.size();
  std::vector<Point> moved;
  for (std::size_t k = first->at;; k = k + 1 == n ? 0 : k + 1) {
    moved.push_back({ring[k].x + edit.at.x, ring[k].y + edit.at.y});
    if (k == last->at) break;
  }
  for (std::size_t i = 1; i + 1 < moved.size(); ++i) ring[(first->at + i) % n] = moved[i];
  // The later one first, so that the other's index stays.
  const auto before_last = [&] { insert_vertices(edited, *last, last->at, moved.back()); };
  const auto after_first = [&] { insert_vertices(edited, *first, first->at + 1, moved.front()); };
  if (last->at > first->at) {
    before_last();
    after_first();
  } else {
    after_first();
    before_last();
  }
  return {};
}

std::uint32_t first_of_part(const RegionData& data, std::size_t part) {
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < part; ++i) {
    first += static_cast<std::uint32_t>(data.parts[i].outer.size());
    for (const Ring& hole : data.parts[i].holes) first += static_cast<std::uint32_t>(hole.size());
  }
  return first;
}

std::uint32_t size_of(const Part& part) {
  std::uint32_t n = static_cast<std::uint32_t>(part.outer.size());
  for (const Ring& hole : part.holes) n += static_cast<std::uint32_t>(hole.size());
  return n;
}

Result<void> edit_parts(const Edit& edit, EditedData& edited) {
  RegionData& data = edited.data;
  VertexOrigins& origins = edited.changes.origins;
  const auto at = [&](std::uint32_t k) { return origins.begin() + static_cast<std::ptrdiff_t>(k); };
  if (edit.kind == EditKind::add_part) {
    origins.insert(at(first_of_part(data, data.parts.size())), size_of(edit.added), kNone);
    data.parts.push_back(edit.added);
    return {};
  }
  if (edit.part >= data.parts.size()) return out_of_range("there is no part " + text(edit.part));
  Part& part = data.parts[edit.part];
  const std::uint32_t first = first_of_part(data, edit.part);
  if (edit.kind == EditKind::remove_part) {
    origins.erase(at(first), at(first + size_of(part)));
    data.parts.erase(data.parts.begin() + edit.part);
    return {};
  }
  if (edit.kind == EditKind::add_hole) {
    origins.insert(at(first + size_of(part)), edit.added.outer.size(), kNone);
    part.holes.push_back(edit.added.outer);
    return {};
  }
  if (edit.hole >= part.holes.size())
    return out_of_range("part " + text(edit.part) + " has no hole " + text(edit.hole));
  std::uint32_t from = first + static_cast<std::uint32_t>(part.outer.size());
  for (std::uint32_t h = 0; h < edit.hole; ++h) from += static_cast<std::uint32_t>(part.holes[h].size());
  origins.erase(at(from), at(from + static_cast<std::uint32_t>(part.holes[edit.hole].size())));
  part.holes.erase(part.holes.begin() + edit.hole);
  return {};
}

Result<void> edit_vertex(const Edit& edit, EditedData& edited) {
  const ChainPosition at = find_vertex(edited.data, edit.vertex);
  if (at.chain == nullptr) return out_of_range("there is no vertex " + text(edit.vertex));
  std::vector<Point>& chain = *at.chain;
  if (edited.changes.moved && only_moves(edit)) {
    const auto before = std::lower_bound(edited.changes.moved->begin(), edited.changes.moved->end(), edit.vertex);
    if (before == edited.changes.moved->end() || *before != edit.vertex)
      edited.changes.moved->insert(before, edit.vertex);
  }
  if (edit.kind == EditKind::move) {
    chain[at.at] = edit.at;
    return {};
  }
  if (!at.ring) return on_no_ring(edit.vertex);
  if (edit.kind == EditKind::insert) {
    insert_vertices(edited, at, at.at + 1, edit.at);
  } else if (edit.kind == EditKind::remove) {
    // An edit after this one may bring a vertex to a ring that has too few now, but to one that is there.
    if (chain.size() == 1) return out_of_range("the ring of vertex " + text(edit.vertex) + " has no vertex to spare");
    chain.erase(chain.begin() + static_cast<std::ptrdiff_t>(at.at));
    edited.changes.origins.erase(edited.changes.origins.begin() + edit.vertex);
  } else {
    const std::size_t n = chain.size();
    const Point a = chain[at.at == 0 ? n - 1 : at.at - 1], b = chain[at.at + 1 == n ? 0 : at.at + 1], v = chain[at.at];
    chain[at.at] = {(a.x - v.x) + b.x, (a.y - v.y) + b.y};
  }
  return {};
}

}  // namespace

Result<void> apply(const Edit& edit, EditedData& edited) {
  switch (edit.kind) {
    case EditKind::move:
    case EditKind::insert:
    case EditKind::remove:
    case EditKind::invert:
      return edit_vertex(edit, edited);
    case EditKind::extrude:
      return extrude(edit, edited);
    default:
      return edit_parts(edit, edited);
  }
}

namespace {

// The rings of edited data, against those of the region before.
class NewEdges {
 public:
  NewEdges(const RegionData& before, const EditedData& edited) : edited_(edited) {
    add_rings(before, old_);
    add_rings(edited.data, now_);
    for (const Part& part : edited.data.parts) {
      outer_.push_back(1);
      outer_.insert(outer_.end(), part.holes.size(), 0);
    }
  }

  /// Whether the edited data are provably valid, as those before were.
  bool proved() {
    if (now_.empty() || now_.size() != old_.size()) return false;
    changed_.assign(now_.size(), 0);
    still_.assign(now_.size(), kNone);
    if (edited_.changes.moved) {
      find_moves();
    } else {
      for (std::uint32_t r = 0; r < now_.size(); ++r) {
        if (now_[r].size < 3) return false;
        find_changes(r);
      }
    }
    find_near();
    for (const RingEdge e : new_)
      if (!apart(e)) return false;
    for (std::uint32_t r = 0; r < now_.size(); ++r)
      if (changed_[r] && !keeps_its_side(r)) return false;
    return true;
  }

 private:
  struct View {
    const Point* at;
    std::uint32_t first, size;  // `first`: the index of its first vertex in the region
    Point operator[](std::uint32_t k) const { return at[k]; }
    std::uint32_t next(std::uint32_t k) const { return k + 1 == size ? 0 : k + 1; }
    std::uint32_t prev(std::uint32_t k) const { return k == 0 ? size - 1 : k - 1; }
  };
  struct RingEdge {
    std::uint32_t ring, k;
    friend bool operator==(const RingEdge&, const RingEdge&) = default;
  };

  static void add_rings(const RegionData& data, std::vector<View>& views) {
    std::uint32_t first = 0;
    const auto add = [&](const Ring& ring) {
      views.push_back({ring.data(), first, static_cast<std::uint32_t>(ring.size())});
      first += views.back().size;
    };
    for (const Part& part : data.parts) {
      add(part.outer);
      for (const Ring& hole : part.holes) add(hole);
    }
  }

  // Every vertex is the one it was: the edges at those that moved.
  void find_moves() {
    std::uint32_t r = 0, first_moved = kNone;  // of the ring
    for (const std::uint32_t v : *edited_.changes.moved) {
      while (v >= now_[r].first + now_[r].size) ++r;
      const std::uint32_t k = v - now_[r].first, before = now_[r].prev(k);
      if (new_.empty() || !(new_.back() == RingEdge{r, before})) new_.push_back({r, before});
      // The first vertex has listed the last edge.
      const bool listed = k + 1 == now_[r].size && changed_[r] && now_[r].first == first_moved;
      if (!changed_[r]) first_moved = v;
      if (!listed) new_.push_back({r, k});
      changed_[r] = 1;
    }
    gone_ = new_;
    auto moved = edited_.changes.moved->begin();
    for (r = 0; r < now_.size(); ++r)
      for (std::uint32_t k = 0; k < now_[r].size && still_[r] == kNone; ++k) {
        while (moved != edited_.changes.moved->end() && *moved < now_[r].first + k) ++moved;
        if (moved == edited_.changes.moved->end() || *moved != now_[r].first + k) still_[r] = k;
      }
  }

  // The vertex of ring r before that vertex k of it is, or kNone where it moved, is new or comes from another ring.
  std::uint32_t before(std::uint32_t r, std::uint32_t k) const {
    const std::uint32_t was = edited_.changes.origins[now_[r].first + k];
    if (was == kNone || was < old_[r].first || was >= old_[r].first + old_[r].size) return kNone;
    return old_[r][was - old_[r].first] == now_[r][k] ? was - old_[r].first : kNone;
  }

  // Edges of a ring that are new, and those that are gone.
  void find_changes(std::uint32_t r) {
    std::vector<std::uint8_t> kept(old_[r].size, 0);
    bool changed = old_[r].size != now_[r].size;
    for (std::uint32_t k = 0; k < now_[r].size; ++k) {
      const std::uint32_t was = before(r, k), then = before(r, now_[r].next(k));
      if (was != kNone) still_[r] = k;
      if (was != kNone && then != kNone && old_[r].next(was) == then) {
        kept[was] = 1;
        continue;
      }
      changed = true;
      new_.push_back({r, k});
    }
    changed_[r] = changed;
    for (std::uint32_t k = 0; k < kept.size(); ++k)
      if (!kept[k]) gone_.push_back({r, k});
  }

  // The edges whose boxes meet the box of all new ones.
  void find_near() {
    if (new_.empty()) return;
    Point low = now_[new_[0].ring][new_[0].k], high = low;
    for (const RingEdge e : new_)
      for (const Point p : {now_[e.ring][e.k], now_[e.ring][now_[e.ring].next(e.k)]}) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      }
    for (std::uint32_t s = 0; s < now_.size(); ++s) {
      const View ring = now_[s];
      Point c = ring[ring.size - 1];
      std::uint32_t k = ring.size - 1;
      for (std::uint32_t next = 0; next < ring.size; k = next++) {
        const Point from = std::exchange(c, ring[next]);
        if (std::max(from.x, c.x) >= low.x && std::min(from.x, c.x) <= high.x && std::max(from.y, c.y) >= low.y &&
            std::min(from.y, c.y) <= high.y)
          near_.push_back({{s, k}, from, c});
      }
    }
  }

  // Whether an edge provably meets no other one but its neighbours, and does not fold back on them.
  bool apart(RingEdge e) const {
    const View ring = now_[e.ring];
    const std::uint32_t n = ring.next(e.k), before = ring.prev(e.k);
    const Point a = ring[e.k], b = ring[n];
    if (!std::isfinite(a.x - b.x) || !std::isfinite(a.y - b.y) || a == b) return false;
    if (folds(ring[before], a, b) || folds(a, b, ring[ring.next(n)])) return false;
    const double x0 = std::min(a.x, b.x), x1 = std::max(a.x, b.x), y0 = std::min(a.y, b.y), y1 = std::max(a.y, b.y);
    for (const auto& [f, c, d] : near_) {
      if (std::max(c.x, d.x) < x0 || std::min(c.x, d.x) > x1 || std::max(c.y, d.y) < y0 || std::min(c.y, d.y) > y1)
        continue;
      const bool own = f.ring == e.ring && (f.k == e.k || f.k == before || f.k == n);
      if (!own && !one_side(a, b, c, d) && !one_side(c, d, a, b)) return false;
    }
    return true;
  }
  static bool one_side(Point a, Point b, Point c, Point d) {
    const int s = exact::orient_sign(a, b, c);
    return s != 0 && exact::orient_sign(a, b, d) == s;
  }
  static bool folds(Point a, Point b, Point c) {
    return exact::orient_sign(a, b, c) == 0 && exact::dot_sign(a, b, b, c) <= 0;
  }

  // The sense of a ring that crosses nothing is that of its smallest vertex; and no other ring has changed its side of
  // it: one vertex of each that did not move is inside as before.
  bool keeps_its_side(std::uint32_t r) const {
    if (still_[r] == kNone) return false;
    if (counter_clockwise(now_[r]) != (outer_[r] != 0)) return false;
    for (std::uint32_t s = 0; s < now_.size(); ++s) {
      if (s == r) continue;
      if (still_[s] == kNone) return false;
      if (swept(r, now_[s][still_[s]])) return false;
    }
    return true;
  }
  static bool counter_clockwise(const View& ring) {
    std::uint32_t v = 0;
    for (std::uint32_t u = 1; u < ring.size; ++u)
      if (lex_less(ring[u], ring[v])) v = u;
    return exact::orient_sign(ring[ring.prev(v)], ring[v], ring[ring.next(v)]) > 0;
  }
  // Whether a point is inside before or after, but not both: by the edges that are gone and those that are new.
  bool swept(std::uint32_t r, Point p) const {
    bool odd = false;
    const auto pass = [&](const View& ring, std::uint32_t k) {
      const Point a = ring[k], b = ring[ring.next(k)];
      if ((a.y > p.y) == (b.y > p.y)) return;
      if ((exact::orient_sign(a, b, p) > 0) == (b.y > a.y)) odd = !odd;
    };
    for (const RingEdge e : new_)
      if (e.ring == r) pass(now_[r], e.k);
    for (const RingEdge e : gone_)
      if (e.ring == r) pass(old_[r], e.k);
    return odd;
  }

  const EditedData& edited_;
  std::vector<View> old_, now_;
  struct NearEdge {
    RingEdge edge;
    Point from, to;
  };
  std::vector<NearEdge> near_;
  std::vector<RingEdge> new_, gone_;
  std::vector<std::uint8_t> changed_, outer_;  // of rings
  std::vector<std::uint32_t> still_;           // a vertex of each ring that did not move
};

}  // namespace

Result<Region> edited_region(const Region& before, EditedData edited) {
  const bool plain = before.touching_points().empty() && before.polylines().empty() && before.points().empty() &&
                     edited.data.parts.size() == before.parts().size() &&
                     std::equal(before.parts().begin(), before.parts().end(), edited.data.parts.begin(),
                                [](const Part& a, const Part& b) { return a.holes.size() == b.holes.size(); });
  // Where much moved, a sweep over all edges is faster.
  constexpr std::size_t kSweep = 10;
  const bool much = edited.changes.moved && edited.changes.moved->size() * kSweep > before.vertex_count();
  if (plain && !much && NewEdges(before.data(), edited).proved()) return trusted_region(std::move(edited.data), {});
  return Region::create(std::move(edited.data));
}

}  // namespace dymsum::planar
