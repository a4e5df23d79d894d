#include "spatial/convex/kept_solid.h"

#include <algorithm>

namespace dymsum::spatial {
namespace {

constexpr std::uint32_t kNothing = ~std::uint32_t{0};

std::uint32_t edges_of_face(const Polytope& p, std::uint32_t f) {
  std::uint32_t n = 0;
  HalfEdge h = p.first[f];
  do {
    ++n;
    h = p.next[h];
  } while (h != p.first[f]);
  return n;
}

}  // namespace

KeptSolid::KeptSolid(const Overlay& overlay, const ConvexOperands& operands)
    : p_faces_(overlay.poly(0).face_count()),
      q_faces_(overlay.poly(1).face_count()),
      positions_(operands, {overlay.poly(0).source_vertex, overlay.poly(1).source_vertex}) {
  for (int op = 0; op < 2; ++op) {
    const Polytope& mine = overlay.poly(op);
    extreme_[op].assign(mine.face_count(), kNothing);
    for (std::uint32_t f = 0; f < mine.face_count(); ++f) {
      solid_.facets.emplace_back();
      room_.push_back(0);
      allot(facet_of(op, f), edges_of_face(mine, f));
    }
  }
}

void KeptSolid::follow(const Overlay& overlay, const SolidPose& p, const SolidPose& q) {
  SolidChanges& changes = solid_.changes;
  changes.facets.clear();
  changes.vertices_appeared.clear();
  changes.vertices_disappeared.clear();
  if (solid_.frame > 0) changes.triangles.clear();
  changes.moved = solid_.frame == 0 || !(p == solid_.p_pose) || !(q == solid_.q_pose);
  ++solid_.frame;
  add_crossings(overlay);
  keep_slots(overlay);
  find_close(overlay);
  follow_faces(overlay);
  follow_crossings(overlay);
  const auto in_order = [](const FacetChange& a, const FacetChange& b) {
    return a.facet != b.facet ? a.facet < b.facet : a.kind > b.kind;  // disappeared, then appeared
  };
  std::sort(changes.facets.begin(), changes.facets.end(), in_order);
  drop_unused_vertices();
  name_new_vertices(overlay);
  join_ranges();
  if (!changes.moved && changes.vertices_appeared.empty()) return;
  solid_.p_pose = p;
  solid_.q_pose = q;
  positions_.pose(p, q);
  positions_.position(pair_, solid_.at);
}

/// Facets for the overlay's crossings, as many as it has indices.
void KeptSolid::add_crossings(const Overlay& overlay) {
  while (crossed_.size() < overlay.crossing_indices()) {
    slot_.push_back(static_cast<std::uint32_t>(crossed_.size()));
    crossed_.push_back({kNothing, kNothing});
    solid_.facets.emplace_back();
    room_.push_back(0);
    allot(static_cast<std::uint32_t>(solid_.facets.size() - 1), 4);
  }
  before_.reserve(slot_.capacity());
  now_.reserve(slot_.capacity());
  vacant_.reserve(slot_.capacity());
}

KeptSolid::Edges KeptSolid::edges_now(const Overlay& overlay, std::uint32_t id) {
  if (id >= overlay.crossing_indices() || !overlay.is_crossing(id)) return {kNothing, kNothing};
  return {overlay.crossing(id).p, overlay.crossing(id).q};
}

/// What was made anew, or went and came back, has another index now: its facet stays. The slots of crossings that
/// differ are handed out again, first to those that had one, then to the others.
void KeptSolid::keep_slots(const Overlay& overlay) {
  before_.clear();
  now_.clear();
  vacant_.clear();
  for (std::uint32_t id = 0; id < slot_.size(); ++id) {
    const Edges now = edges_now(overlay, id), before = crossed_[slot_[id]];
    if (now.key() == before.key()) continue;
    before_.push_back({before.key(), slot_[id]});
    now_.push_back({now.key(), id});
  }
  const auto in_order = [](const Moved& a, const Moved& b) { return a.key != b.key ? a.key < b.key : a.at < b.at; };
  std::sort(before_.begin(), before_.end(), in_order);
  std::sort(now_.begin(), now_.end(), in_order);
  const std::uint64_t nothing = Edges{kNothing, kNothing}.key();
  auto was = before_.begin();
  std::size_t others = 0;
  for (const Moved& is : now_) {
    for (; was != before_.end() && was->key < is.key; ++was) vacant_.push_back(was->at);
    if (is.key == nothing || was == before_.end() || was->key != is.key) {
      now_[others++] = is;
      continue;
    }
    slot_[is.at] = was->at;
    ++was;
  }
  for (; was != before_.end(); ++was) vacant_.push_back(was->at);
  // In order, so that most keep theirs.
  std::sort(vacant_.begin(), vacant_.end());
  std::sort(now_.begin(), now_.begin() + static_cast<std::ptrdiff_t>(others),
            [](const Moved& a, const Moved& b) { return a.at < b.at; });
  for (std::size_t k = 0; k < others; ++k) slot_[now_[k].at] = vacant_[k];
}

/// A facet differs from what the overlay's words say only where something is truly zero. A face of the walker has a
/// level edge only where doubles cannot prove that all fall. A crossing is improper where the circle of the walker's
/// edge goes through a face at the other edge, which doubles cannot exclude then, or where its arc only begins or ends
/// there, at a face of the first kind. A face of the other operand has a level edge only where an arc of the walker
/// goes through its direction: then some arc from there is crossed by it, after the infinitesimal rotation, as its arcs
/// leave in directions that no half-plane holds, and that crossing is improper; or it faces the same way as a face of
/// the walker.
void KeptSolid::find_close(const Overlay& overlay) {
  look_before_.swap(look_);
  look_.assign(solid_.facets.size(), Look::plain);
  look_before_.resize(look_.size(), Look::plain);
  const int w = overlay.walker();
  const Polytope &mine = overlay.poly(w), &other = overlay.poly(1 - w);
  for (std::uint32_t f = 0; f < mine.face_count(); ++f) {
    if (overlay.provably_extreme(f)) continue;
    look_[facet_of(w, f)] = Look::close;
    HalfEdge h = mine.first[f];
    do {
      for (std::uint32_t id = overlay.first_crossing(w, h / 2); id != kNoCrossing; id = overlay.crossing(id).next[w])
        look_[facet_of(id)] = Look::close;
      h = mine.next[h];
    } while (h != mine.first[f]);
  }
  for (std::uint32_t id = 0; id < overlay.crossing_indices(); ++id) {
    if (!overlay.is_crossing(id) || overlay.provably_crosses(id)) continue;
    const std::uint32_t e = edge_of(1 - w, overlay.crossing(id));
    look_[facet_of(id)] = Look::close;
    look_[facet_of(1 - w, other.face[2 * e])] = look_[facet_of(1 - w, other.face[2 * e + 1])] = Look::close;
  }
  for (const Overlay::FacePair& pair : overlay.pairs())
    look_[facet_of(0, pair.p)] = look_[facet_of(1, pair.q)] = Look::close;
}

void KeptSolid::follow_faces(const Overlay& overlay) {
  for (int op = 0; op < 2; ++op)
    for (std::uint32_t f = 0; f < overlay.poly(op).face_count(); ++f) {
      const std::uint32_t facet = facet_of(op, f), v = overlay.extreme(op, f);
      const bool close = look_[facet] == Look::close;
      if (!close && look_before_[facet] == Look::plain && extreme_[op][f] == v) continue;
      extreme_[op][f] = v;
      corners_.clear();
      const FacetFeatures features =
          close ? append_face(overlay, op, f, corners_) : append_face_and_vertex(overlay, op, f, corners_);
      change(facet, features, true);
    }
}

void KeptSolid::follow_crossings(const Overlay& overlay) {
  for (std::uint32_t id = 0; id < crossed_.size(); ++id) {
    const std::uint32_t facet = facet_of(id);
    const Edges now = edges_now(overlay, id);
    const bool is_there = now.p != kNothing;
    const bool close = look_[facet] == Look::close;
    Edges& before = crossed_[slot_[id]];
    if (!close && look_before_[facet] == Look::plain && now.p == before.p && now.q == before.q) continue;
    const bool same = now.key() == before.key();
    before = now;
    corners_.clear();
    FacetFeatures features;
    if (is_there && (!close || crosses_properly(overlay, overlay.crossing(id))))
      features = append_crossing(overlay, overlay.crossing(id), corners_);
    change(facet, features, same);
  }
}

/// To corners_. `same`: made by the same faces or edges as before.
void KeptSolid::change(std::uint32_t facet, const FacetFeatures& features, bool same) {
  if (same && is_as_before(facet)) return;
  ConvexSolid::Facet& f = solid_.facets[facet];
  const std::uint32_t before = f.count, now = static_cast<std::uint32_t>(corners_.size());
  if (before == 0 && now == 0) return;
  if (++stamp_ == 0) {
    std::fill(seen_.begin(), seen_.end(), 0);
    stamp_ = 1;
  }
  for (const std::uint32_t v : solid_.corners_of(facet)) {
    seen_[v] = stamp_;
    if (--uses_[v] == 0) unused_.push_back(v);
  }
  if (now > room_[facet]) allot(facet, std::max(now, 2 * room_[facet]));
  std::uint32_t kept = 0;
  for (std::uint32_t k = 0; k < now; ++k) {
    const std::uint32_t v = vertex_of(corners_[k]);
    ++uses_[v];
    kept += seen_[v] == stamp_;
    solid_.corners[f.first + k] = v;
  }
  f.count = now;
  f.p = features.p;
  f.q = features.q;
  note(facet, same, {before, now, kept});
}

/// The same vertices in the same order, from whichever on.
bool KeptSolid::is_as_before(std::uint32_t facet) const {
  const std::span<const std::uint32_t> before = solid_.corners_of(facet);
  if (before.size() != corners_.size()) return false;
  if (before.empty()) return true;
  const auto is = [this](std::uint32_t v, const VertexPair& pair) { return pair_[v] == pair; };
  std::size_t first = 0;
  while (first < corners_.size() && !is(before[0], corners_[first])) ++first;
  const auto start = corners_.begin() + static_cast<std::ptrdiff_t>(first);
  const auto after = before.begin() + (corners_.end() - start);
  return start != corners_.end() && std::equal(before.begin(), after, start, is) &&
         std::equal(after, before.end(), corners_.begin(), is);
}

/// Room for so many corners, at the end.
void KeptSolid::allot(std::uint32_t facet, std::uint32_t corners) {
  ConvexSolid::Facet& f = solid_.facets[facet];
  if (room_[facet] > 0) solid_.changes.triangles.push_back({f.first_triangle, room_[facet] - 2});
  room_[facet] = corners;
  f.first = static_cast<std::uint32_t>(solid_.corners.size());
  f.first_triangle = static_cast<std::uint32_t>(solid_.triangle_slots);
  solid_.corners.resize(solid_.corners.size() + corners, ConvexSolid::kFree);
  solid_.triangle_slots += corners - 2;
  solid_.changes.triangles.push_back({f.first_triangle, corners - 2});
}

void KeptSolid::note(std::uint32_t facet, bool same, const Counts& corners) {
  using Kind = FacetChange::Kind;
  std::vector<FacetChange>& changes = solid_.changes.facets;
  const auto [before, now, kept] = corners;
  if (same && before == now && kept == now) {
    changes.push_back({Kind::turned, facet, 0, 0});
  } else if (same && before > 0 && now > 0) {
    changes.push_back({Kind::reshaped, facet, now - kept, before - kept});
  } else {
    if (before > 0) changes.push_back({Kind::disappeared, facet, 0, before});
    if (now > 0) changes.push_back({Kind::appeared, facet, now, 0});
  }
  solid_.facet_count += (now > 0 ? 1 : 0) - (before > 0 ? 1 : 0);
  solid_.changes.triangles.push_back({solid_.facets[facet].first_triangle, room_[facet] - 2});
}

std::uint32_t KeptSolid::vertex_of(VertexPair pair) {
  return index_.find_or_add(pair, [&] {
    std::uint32_t v;
    if (free_vertices_.empty()) {
      v = static_cast<std::uint32_t>(pair_.size());
      pair_.push_back(pair);
      uses_.push_back(0);
      seen_.push_back(0);
      solid_.vertices.emplace_back();
      solid_.at.emplace_back();
    } else {
      v = free_vertices_.back();
      free_vertices_.pop_back();
      pair_[v] = pair;
    }
    ++solid_.vertex_count;
    solid_.changes.vertices_appeared.push_back(v);
    return v;
  });
}

void KeptSolid::drop_unused_vertices() {
  std::vector<std::uint32_t>& gone = solid_.changes.vertices_disappeared;
  for (const std::uint32_t v : unused_) {
    if (uses_[v] > 0 || pair_[v] == kNoPair) continue;
    index_.erase(pair_[v]);
    pair_[v] = kNoPair;
    solid_.vertices[v] = {ConvexSolid::kFree, ConvexSolid::kFree};
    solid_.at[v] = {};
    gone.push_back(v);
  }
  unused_.clear();
  solid_.vertex_count -= gone.size();
  std::sort(gone.begin(), gone.end());
  // The smallest one is taken first.
  free_vertices_.insert(free_vertices_.end(), gone.rbegin(), gone.rend());
}

void KeptSolid::name_new_vertices(const Overlay& overlay) {
  std::vector<std::uint32_t>& fresh = solid_.changes.vertices_appeared;
  std::sort(fresh.begin(), fresh.end());
  for (const std::uint32_t v : fresh)
    solid_.vertices[v] = {overlay.poly(0).source_vertex[pair_[v].p], overlay.poly(1).source_vertex[pair_[v].q]};
}

/// Ranges that touch become one.
void KeptSolid::join_ranges() {
  std::vector<IndexRange>& ranges = solid_.changes.triangles;
  const auto before = [](const IndexRange& a, const IndexRange& b) { return a.first < b.first; };
  if (!std::is_sorted(ranges.begin(), ranges.end(), before)) std::sort(ranges.begin(), ranges.end(), before);
  std::size_t n = 0;
  for (const IndexRange& r : ranges) {
    if (n > 0 && r.first <= ranges[n - 1].first + ranges[n - 1].count)
      ranges[n - 1].count = std::max(ranges[n - 1].count, r.first + r.count - ranges[n - 1].first);
    else ranges[n++] = r;
  }
  ranges.resize(n);
}

std::size_t KeptSolid::bytes() const {
  const auto of = [](const auto&... v) { return (std::size_t{0} + ... + (v.capacity() * sizeof(v[0]))); };
  const SolidChanges& c = solid_.changes;
  return sizeof(*this) + index_.bytes() + positions_.bytes() +
         of(solid_.vertices, solid_.at, solid_.facets, solid_.corners, c.facets, c.vertices_appeared,
            c.vertices_disappeared, c.triangles, extreme_[0], extreme_[1], crossed_, slot_, before_, now_, vacant_,
            look_, look_before_, room_, uses_, pair_, free_vertices_, unused_, corners_, seen_);
}

}  // namespace dymsum::spatial
