#include "planar/edit/region_edits.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

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

Result<ChainPosition> ring_vertex(RegionData& data, std::uint32_t vertex) {
  const ChainPosition at = find_vertex(data, vertex);
  if (at.chain == nullptr) return out_of_range("there is no vertex " + text(vertex));
  if (!at.ring) return out_of_range("vertex " + text(vertex) + " is on no ring");
  return at;
}

void insert_vertices(EditedData& edited, const ChainPosition& at, std::size_t k, Point p) {
  at.chain->insert(at.chain->begin() + static_cast<std::ptrdiff_t>(k), p);
  edited.origins.insert(edited.origins.begin() + static_cast<std::ptrdiff_t>(at.first + k), kNone);
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
  VertexOrigins& origins = edited.origins;
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
  if (edit.kind == EditKind::move) {
    chain[at.at] = edit.at;
    return {};
  }
  if (!at.ring) return out_of_range("vertex " + text(edit.vertex) + " is on no ring");
  if (edit.kind == EditKind::insert) {
    insert_vertices(edited, at, at.at + 1, edit.at);
  } else if (edit.kind == EditKind::remove) {
    if (chain.size() <= 3) return out_of_range("the ring of vertex " + text(edit.vertex) + " has no vertex to spare");
    chain.erase(chain.begin() + static_cast<std::ptrdiff_t>(at.at));
    edited.origins.erase(edited.origins.begin() + edit.vertex);
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
    for_each_chain(before,
                   [&](const std::vector<Point>& chain) { old_.insert(old_.end(), chain.begin(), chain.end()); });
    add_rings(before, old_first_);
    add_rings(edited.data, first_);
    for (const Part& part : edited.data.parts) {
      outer_.push_back(true);
      outer_.insert(outer_.end(), part.holes.size(), false);
    }
    for_each_chain(edited.data,
                   [&](const std::vector<Point>& chain) { now_.insert(now_.end(), chain.begin(), chain.end()); });
  }

  /// Whether the edited data are provably valid, as those before were.
  bool proved() {
    if (first_.size() != old_first_.size() || now_.empty() || now_.size() != first_.back()) return false;
    for (std::size_t r = 0; r + 1 < first_.size(); ++r) {
      if (first_[r + 1] - first_[r] < 3) return false;
      find_changes(r);
    }
    find_near();
    for (const std::uint32_t e : new_)
      if (!apart(e)) return false;
    for (std::size_t r = 0; r + 1 < first_.size(); ++r)
      if (changed_[r] && !keeps_its_side(r)) return false;
    return true;
  }

 private:
  static void add_rings(const RegionData& data, std::vector<std::uint32_t>& first) {
    first.push_back(0);
    const auto add = [&](const Ring& ring) { first.push_back(first.back() + static_cast<std::uint32_t>(ring.size())); };
    for (const Part& part : data.parts) {
      add(part.outer);
      for (const Ring& hole : part.holes) add(hole);
    }
  }
  static std::uint32_t next_in(const std::vector<std::uint32_t>& first, std::size_t r, std::uint32_t v) {
    return v + 1 == first[r + 1] ? first[r] : v + 1;
  }
  bool stays(std::uint32_t v) const {
    const std::uint32_t was = edited_.origins[v];
    return was != kNone && old_[was] == now_[v];
  }

  // Edges of a ring that are new, and those that are gone.
  void find_changes(std::size_t r) {
    std::vector<std::uint8_t> kept(old_first_[r + 1] - old_first_[r], 0);
    std::uint32_t still = kNone;
    bool changed = false;
    for (std::uint32_t v = first_[r]; v < first_[r + 1]; ++v) {
      const std::uint32_t n = next_in(first_, r, v), was = edited_.origins[v];
      if (stays(v)) still = v;
      if (stays(v) && stays(n) && was >= old_first_[r] && was < old_first_[r + 1] &&
          next_in(old_first_, r, was) == edited_.origins[n]) {
        kept[was - old_first_[r]] = 1;
        continue;
      }
      changed = true;
      new_.push_back(v);
      ring_of_new_.push_back(r);
    }
    changed_.push_back(changed || kept.size() != first_[r + 1] - first_[r]);
    still_.push_back(still);
    for (std::uint32_t k = 0; k < kept.size(); ++k)
      if (!kept[k]) gone_.push_back({r, old_first_[r] + k});
  }

  // The edges whose boxes meet the box of all new ones.
  void find_near() {
    if (new_.empty()) return;
    Point low = now_[new_[0]], high = low;
    for (const std::uint32_t e : new_)
      for (const std::uint32_t v : {e, next_in(first_, ring_of(e), e)}) {
        low = {std::min(low.x, now_[v].x), std::min(low.y, now_[v].y)};
        high = {std::max(high.x, now_[v].x), std::max(high.y, now_[v].y)};
      }
    for (std::size_t s = 0; s + 1 < first_.size(); ++s)
      for (std::uint32_t v = first_[s]; v < first_[s + 1]; ++v) {
        const Point c = now_[v], d = now_[next_in(first_, s, v)];
        if (std::max(c.x, d.x) >= low.x && std::min(c.x, d.x) <= high.x && std::max(c.y, d.y) >= low.y &&
            std::min(c.y, d.y) <= high.y)
          near_.push_back({v, c, d});
      }
  }

  // Whether an edge provably meets no other one but its neighbours, and does not fold back on them.
  bool apart(std::uint32_t e) {
    const std::size_t r = ring_of(e);
    const std::uint32_t n = next_in(first_, r, e), before = e == first_[r] ? first_[r + 1] - 1 : e - 1;
    const Point a = now_[e], b = now_[n];
    if (!std::isfinite(a.x - b.x) || !std::isfinite(a.y - b.y) || a == b) return false;
    if (folds(now_[before], a, b) || folds(a, b, now_[next_in(first_, r, n)])) return false;
    const double x0 = std::min(a.x, b.x), x1 = std::max(a.x, b.x), y0 = std::min(a.y, b.y), y1 = std::max(a.y, b.y);
    for (const auto& [f, c, d] : near_) {
      const bool far =
          std::max(c.x, d.x) < x0 || std::min(c.x, d.x) > x1 || std::max(c.y, d.y) < y0 || std::min(c.y, d.y) > y1;
      if (!far && f != e && f != before && f != n && !one_side(a, b, c, d) && !one_side(c, d, a, b)) return false;
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
  std::size_t ring_of(std::uint32_t v) const {
    return static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), v) - first_.begin()) - 1;
  }

  // The sense of a ring that crosses nothing is that of its smallest vertex; and no other ring has changed its side of
  // it: one vertex of each that did not move is inside as before.
  bool keeps_its_side(std::size_t r) const {
    if (still_[r] == kNone) return false;
    if (counter_clockwise(now_, first_, r) != outer_[r]) return false;
    for (std::size_t s = 0; s + 1 < first_.size(); ++s) {
      if (s == r) continue;
      if (still_[s] == kNone) return false;
      if (swept(r, now_[still_[s]])) return false;
    }
    return true;
  }
  static bool counter_clockwise(const std::vector<Point>& points, const std::vector<std::uint32_t>& first,
                                std::size_t r) {
    std::uint32_t v = first[r];
    for (std::uint32_t u = v + 1; u < first[r + 1]; ++u)
      if (lex_less(points[u], points[v])) v = u;
    const std::uint32_t before = v == first[r] ? first[r + 1] - 1 : v - 1;
    return exact::orient_sign(points[before], points[v], points[next_in(first, r, v)]) > 0;
  }
  // Whether a point is inside before or after, but not both: by the edges that are gone and those that are new.
  bool swept(std::size_t r, Point p) const {
    bool odd = false;
    const auto pass = [&](Point a, Point b) {
      if ((a.y > p.y) == (b.y > p.y)) return;
      if ((exact::orient_sign(a, b, p) > 0) == (b.y > a.y)) odd = !odd;
    };
    for (std::size_t k = 0; k < new_.size(); ++k)
      if (ring_of_new_[k] == r) pass(now_[new_[k]], now_[next_in(first_, r, new_[k])]);
    for (const auto& [ring, e] : gone_)
      if (ring == r) pass(old_[e], old_[next_in(old_first_, r, e)]);
    return odd;
  }

  const EditedData& edited_;
  std::vector<Point> old_, now_;
  std::vector<std::uint32_t> old_first_, first_;  // of rings
  struct PlacedEdge {
    std::uint32_t index;
    Point from, to;
  };
  std::vector<PlacedEdge> near_;
  std::vector<std::uint32_t> new_;
  std::vector<std::size_t> ring_of_new_;
  std::vector<std::uint8_t> changed_;
  std::vector<bool> outer_;
  std::vector<std::uint32_t> still_;  // a vertex of each ring that did not move
  std::vector<std::pair<std::size_t, std::uint32_t>> gone_;
};

}  // namespace

Result<Region> edited_region(const Region& before, EditedData edited) {
  const bool plain = before.touching_points().empty() && before.polylines().empty() && before.points().empty() &&
                     edited.data.parts.size() == before.parts().size() &&
                     std::equal(before.parts().begin(), before.parts().end(), edited.data.parts.begin(),
                                [](const Part& a, const Part& b) { return a.holes.size() == b.holes.size(); });
  if (plain && NewEdges(before.data(), edited).proved()) return trusted_region(std::move(edited.data), {});
  return Region::create(std::move(edited.data));
}

}  // namespace dymsum::planar
