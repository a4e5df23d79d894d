#include "spatial/convex/kept_solid.h"

#include <algorithm>
#include <utility>

namespace dymsum::spatial {

void KeptVertices::leave(std::span<const std::uint32_t> corners) {
  if (++stamp_ == 0) {
    std::fill(left_.begin(), left_.end(), 0);
    stamp_ = 1;
  }
  for (const std::uint32_t v : corners) {
    left_[v] = stamp_;
    if (--uses_[v] == 0) unused_.push_back(v);
  }
}

std::uint32_t KeptVertices::index_for(VertexPair pair) {
  if (free_.empty()) {
    pairs_.push_back(pair);
    uses_.push_back(0);
    left_.push_back(0);
    return static_cast<std::uint32_t>(pairs_.size() - 1);
  }
  const std::uint32_t v = free_.back();
  free_.pop_back();
  pairs_[v] = pair;
  return v;
}

void KeptVertices::drop_unused(std::vector<std::uint32_t>& gone) {
  gone.clear();
  for (const std::uint32_t v : unused_) {
    if (uses_[v] > 0 || pairs_[v] == kNoPair) continue;
    index_.erase(pairs_[v]);
    pairs_[v] = kNoPair;
    gone.push_back(v);
  }
  unused_.clear();
  std::sort(gone.begin(), gone.end());
  // The smallest one is taken first.
  free_.insert(free_.end(), gone.rbegin(), gone.rend());
}

CrossingSlots::Edges CrossingSlots::edges_now(const Overlay& overlay, std::uint32_t id) {
  if (id >= overlay.crossing_indices() || !overlay.is_crossing(id)) return {};
  return {overlay.crossing(id).p, overlay.crossing(id).q};
}

/// The slots of crossings that differ are handed out again, first to those that had one, then to the others.
void CrossingSlots::keep(const Overlay& overlay) {
  for (std::vector<Moved>* list : {&before_, &now_}) list->clear(), list->reserve(slot_.capacity());
  vacant_.clear(), vacant_.reserve(slot_.capacity());
  for (std::uint32_t id = 0; id < slot_.size(); ++id) {
    const Edges now = edges_now(overlay, id), before = seen(id);
    if (now.key() == before.key()) continue;
    before_.push_back({before.key(), slot_[id]});
    now_.push_back({now.key(), id});
  }
  const auto in_order = [](const Moved& a, const Moved& b) { return a.key != b.key ? a.key < b.key : a.at < b.at; };
  std::sort(before_.begin(), before_.end(), in_order);
  std::sort(now_.begin(), now_.end(), in_order);
  auto was = before_.begin();
  std::size_t others = 0;
  for (const Moved& is : now_) {
    for (; was != before_.end() && was->key < is.key; ++was) vacant_.push_back(was->at);
    if (is.key == Edges().key() || was == before_.end() || was->key != is.key) {
      now_[others++] = is;
      continue;
    }
    slot_[is.at] = was->at;
    ++was;
  }
  for (; was != before_.end(); ++was) vacant_.push_back(was->at);
  // Vacant indices are taken in order, so that most crossings keep theirs.
  std::sort(vacant_.begin(), vacant_.end());
  std::sort(now_.begin(), now_.begin() + static_cast<std::ptrdiff_t>(others),
            [](const Moved& a, const Moved& b) { return a.at < b.at; });
  for (std::size_t k = 0; k < others; ++k) slot_[now_[k].at] = vacant_[k];
}

std::size_t CrossingSlots::bytes() const {
  const auto of = [](const auto&... v) { return (std::size_t{0} + ... + (v.capacity() * sizeof(v[0]))); };
  return of(slot_, seen_, before_, now_, vacant_);
}

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
    for (std::uint32_t f = 0; f < mine.face_count(); ++f) add_facet(edges_of_face(mine, f));
  }
}

void KeptSolid::follow(const Overlay& overlay, const SolidPose& p, const SolidPose& q) {
  SolidChanges& changes = solid_.changes;
  changes.facets.clear();
  changes.vertices_appeared.clear();
  if (solid_.frame > 0) changes.triangles.clear();
  changes.moved = solid_.frame == 0 || !(p == solid_.p_pose) || !(q == solid_.q_pose);
  ++solid_.frame;
  add_crossings(overlay);
  slots_.keep(overlay);
  close_.find(overlay);
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
  positions_.position(vertices_.pairs(), solid_.at);
}

/// Facets for the overlay's crossings, as many as it has indices.
void KeptSolid::add_crossings(const Overlay& overlay) {
  while (slots_.size() < overlay.crossing_indices()) {
    slots_.add();
    add_facet(4);
  }
}

void KeptSolid::follow_faces(const Overlay& overlay) {
  for (int op = 0; op < 2; ++op)
    for (std::uint32_t f = 0; f < overlay.poly(op).face_count(); ++f) {
      const std::uint32_t facet = facet_of(op, f), v = overlay.extreme(op, f);
      const bool close = close_.of_face(op, f), was_close = std::exchange(was_close_[facet], close);
      if (!close && !was_close && extreme_[op][f] == v) continue;
      extreme_[op][f] = v;
      corners_.clear();
      const FacetFeatures features =
          close ? append_face(overlay, op, f, corners_) : append_face_and_vertex(overlay, op, f, corners_);
      change(facet, features, true);
    }
}

void KeptSolid::follow_crossings(const Overlay& overlay) {
  for (std::uint32_t id = 0; id < slots_.size(); ++id) {
    const std::uint32_t facet = facet_of(id);
    const CrossingSlots::Edges now = CrossingSlots::edges_now(overlay, id);
    const bool close = now.is_there() && close_.of_crossing(id);
    const bool was_close = std::exchange(was_close_[facet], close);
    CrossingSlots::Edges& before = slots_.seen(id);
    if (!close && !was_close && now == before) continue;
    const bool same = now.key() == before.key();
    before = now;
    corners_.clear();
    FacetFeatures features;
    if (now.is_there() && (!close || crosses_properly(overlay, overlay.crossing(id))))
      features = append_crossing(overlay, overlay.crossing(id), corners_);
    change(facet, features, same);
  }
}

/// Writes a facet to corners_. `same`: it is made by the same faces or edges as before.
void KeptSolid::change(std::uint32_t facet, const FacetFeatures& features, bool same) {
  if (same && is_as_before(facet)) return;
  ConvexSolid::Facet& f = solid_.facets[facet];
  const std::uint32_t before = f.count, now = static_cast<std::uint32_t>(corners_.size());
  if (before == 0 && now == 0) return;
  vertices_.leave(solid_.corners_of(facet));
  if (now > room_[facet]) allot(facet, std::max(now, 2 * room_[facet]));
  std::uint32_t kept = 0;
  for (std::uint32_t k = 0; k < now; ++k) {
    const std::uint32_t v = vertices_.enter(corners_[k], [this](std::uint32_t fresh) { add_vertex(fresh); });
    kept += vertices_.was_left(v);
    solid_.corners[f.first + k] = v;
  }
  f.count = now;
  f.p = features.p;
  f.q = features.q;
  note(facet, same, {before, now, kept});
}

/// Adds a vertex at an index that was free.
void KeptSolid::add_vertex(std::uint32_t v) {
  if (v == solid_.vertices.size()) {
    solid_.vertices.emplace_back();
    solid_.at.emplace_back();
  }
  ++solid_.vertex_count;
  solid_.changes.vertices_appeared.push_back(v);
}

/// The same vertices in the same order, from whichever on.
bool KeptSolid::is_as_before(std::uint32_t facet) const {
  const std::span<const std::uint32_t> before = solid_.corners_of(facet);
  if (before.size() != corners_.size()) return false;
  if (before.empty()) return true;
  const auto is = [this](std::uint32_t v, const VertexPair& pair) { return vertices_.pairs()[v] == pair; };
  std::size_t first = 0;
  while (first < corners_.size() && !is(before[0], corners_[first])) ++first;
  const auto start = corners_.begin() + static_cast<std::ptrdiff_t>(first);
  const auto after = before.begin() + (corners_.end() - start);
  return start != corners_.end() && std::equal(before.begin(), after, start, is) &&
         std::equal(after, before.end(), corners_.begin(), is);
}

void KeptSolid::add_facet(std::uint32_t corners) {
  solid_.facets.emplace_back();
  room_.push_back(0);
  was_close_.push_back(0);
  allot(static_cast<std::uint32_t>(solid_.facets.size() - 1), corners);
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

void KeptSolid::drop_unused_vertices() {
  std::vector<std::uint32_t>& gone = solid_.changes.vertices_disappeared;
  vertices_.drop_unused(gone);
  solid_.vertex_count -= gone.size();
  for (const std::uint32_t v : gone) {
    solid_.vertices[v] = {ConvexSolid::kFree, ConvexSolid::kFree};
    solid_.at[v] = {};
  }
}

void KeptSolid::name_new_vertices(const Overlay& overlay) {
  std::vector<std::uint32_t>& fresh = solid_.changes.vertices_appeared;
  std::sort(fresh.begin(), fresh.end());
  const std::span<const VertexPair> pairs = vertices_.pairs();
  for (const std::uint32_t v : fresh)
    solid_.vertices[v] = {overlay.poly(0).source_vertex[pairs[v].p], overlay.poly(1).source_vertex[pairs[v].q]};
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
  return sizeof(*this) + close_.bytes() + slots_.bytes() + vertices_.bytes() + positions_.bytes() +
         of(solid_.vertices, solid_.at, solid_.facets, solid_.corners, c.facets, c.vertices_appeared,
            c.vertices_disappeared, c.triangles, extreme_[0], extreme_[1], was_close_, room_, corners_);
}

}  // namespace dymsum::spatial
