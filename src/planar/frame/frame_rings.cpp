#include "planar/frame/frame_rings.h"

#include <algorithm>
#include <bit>
#include <unordered_map>

#include "planar/result/planar_sum.h"

namespace dymsum::planar {
std::vector<const SumRing*> rings_of(const PlanarSum& sum) {
  std::vector<const SumRing*> rings;
  for (const SumPart& part : sum.parts) {
    rings.push_back(&part.outer);
    for (const SumRing& hole : part.holes) rings.push_back(&hole);
  }
  return rings;
}

std::uint64_t mixed(std::uint64_t h, std::uint64_t v) {
  h ^= v + 0x9e3779b97f4a7c15u + (h << 6) + (h >> 2);
  h *= 0xff51afd7ed558ccdu;
  return h ^ (h >> 32);
}

std::uint64_t key(const Contact& c) { return mixed(mixed(static_cast<std::uint64_t>(c.kind), c.p), c.q); }

std::uint64_t key(const SumVertex& v) {
  const auto both = [](std::uint32_t a, std::uint32_t b) { return (static_cast<std::uint64_t>(a) << 32) | b; };
  const auto spread = [](std::uint64_t h, std::uint64_t by) {
    h *= by;
    return h ^ (h >> 32);
  };
  std::uint64_t h = spread(both(v.in.p, v.in.q) ^ (static_cast<std::uint64_t>(v.in.kind) << 63), 0xff51afd7ed558ccdu);
  h = spread(h + (both(v.out.p, v.out.q) ^ (static_cast<std::uint64_t>(v.out.kind) << 63)), 0xc4ceb9fe1a85ec53u);
  return spread(h + both(v.corner_p, v.corner_q), 0x9e3779b97f4a7c15u);
}

std::vector<std::size_t> place_rings(std::vector<SumRing> rings, const std::vector<std::uint8_t>& outer,
                                     PlanarSum& sum) {
  std::vector<std::size_t> indices;
  if (std::count(outer.begin(), outer.end(), std::uint8_t{1}) != 1) {
    // Several parts: the rings go through the grouping of the static engine, and are recognised by their first
    // vertices.
    std::unordered_map<std::uint64_t, std::size_t> index_at;
    for (std::size_t i = 0; i < rings.size(); ++i) index_at[key(rings[i].vertices[0])] = i;
    sum.parts = group_rings(std::move(rings), outer, *exact_source(sum), sum.at_error);
    canonicalize(sum.parts, *exact_source(sum), sum.at_error);
    for (const SumRing* ring : rings_of(sum)) indices.push_back(index_at.at(key(ring->vertices[0])));
    return indices;
  }
  SumPart part;
  std::vector<std::size_t> holes;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (!outer[i]) {
      holes.push_back(i);
      continue;
    }
    part.outer = std::move(rings[i]);
    indices.push_back(i);
  }
  // Rings share no vertices where nothing touches, so their first vertices order them.
  const VertexOrder order(*exact_source(sum), sum.at_error);
  std::sort(holes.begin(), holes.end(), [&](std::size_t a, std::size_t b) {
    return order.compare(rings[a].vertices[0], rings[b].vertices[0]) < 0;
  });
  for (const std::size_t i : holes) {
    part.holes.push_back(std::move(rings[i]));
    indices.push_back(i);
  }
  sum.parts.push_back(std::move(part));
  return indices;
}

namespace {

/// Vertices by their keys, with the first ring that has each.
class VertexOwners {
 public:
  static constexpr std::uint32_t kNobody = 0xffffffff;
  explicit VertexOwners(const std::vector<const SumRing*>& rings) {
    std::size_t n = 0;
    for (const SumRing* ring : rings) n += ring->vertices.size();
    slots_.assign(std::bit_ceil(2 * n + 1), {0, kNobody});
    for (std::uint32_t i = 0; i < rings.size(); ++i)
      for (const SumVertex& v : rings[i]->vertices) {
        const std::uint64_t k = key(v);
        Slot& slot = slots_[find(k)];
        if (slot.ring == kNobody) slot = {k, i};
      }
  }
  std::uint32_t ring(const SumVertex& v) const { return slots_[find(key(v))].ring; }

 private:
  struct Slot {
    std::uint64_t key;
    std::uint32_t ring;
  };
  // The slot of a key, or that in which it would be put.
  std::size_t find(std::uint64_t k) const {
    std::size_t at = k & (slots_.size() - 1);
    while (slots_[at].ring != kNobody && slots_[at].key != k) at = (at + 1) & (slots_.size() - 1);
    return at;
  }
  std::vector<Slot> slots_;
};

}  // namespace

void RingIdentities::follow(LoopStatus& loop, bool stays, FrameChanges& changes) {
  const std::uint32_t size = loop.corners, before = loop.vertices_before, shared = loop.vertices_shared;
  const auto list = [&](RingChange::Kind kind, std::uint32_t came, std::uint32_t went) {
    changes.rings.push_back({kind, loop.ring, came, went});
  };
  if (loop.ring == 0) {
    loop.ring = next_++;
    list(RingChange::Kind::appeared, size, 0);
  } else if (before != size || shared != size) {
    list(RingChange::Kind::reshaped, size - shared, before - shared);
  } else if (!stays) {
    list(RingChange::Kind::moved, 0, 0);
  }
}

void RingIdentities::follow(std::span<LoopStatus* const> kept, bool stays, FrameChanges& changes) {
  for (LoopStatus* loop : kept) follow(*loop, stays, changes);
}

std::vector<std::uint64_t> RingIdentities::match(const PlanarSum& from, const std::vector<std::uint64_t>& known,
                                                 const PlanarSum& to, bool same_position, FrameChanges& changes) {
  const std::vector<const SumRing*> before = rings_of(from), after = rings_of(to);
  std::vector<std::uint64_t> ids(after.size(), 0);
  std::vector<std::uint8_t> taken(before.size(), 0);
  const VertexOwners owner(before);
  for (std::size_t i = 0; i < after.size(); ++i) {
    std::uint32_t shared = 0;
    std::size_t ring = before.size();
    for (const SumVertex& v : after[i]->vertices) {
      const std::uint32_t was = owner.ring(v);
      if (was == VertexOwners::kNobody) continue;
      if (ring == before.size() && !taken[was]) ring = was;
      shared += was == ring;
    }
    LoopStatus loop;
    loop.corners = static_cast<std::uint32_t>(after[i]->vertices.size());
    if (ring != before.size()) {
      taken[ring] = 1;
      loop.ring = known[ring];
      loop.vertices_before = static_cast<std::uint32_t>(before[ring]->vertices.size());
      loop.vertices_shared = std::min({shared, loop.corners, loop.vertices_before});
    }
    follow(loop, same_position, changes);
    ids[i] = loop.ring;
  }
  for (std::size_t i = 0; i < before.size(); ++i)
    if (!taken[i])
      changes.rings.push_back(
          {RingChange::Kind::disappeared, known[i], 0, static_cast<std::uint32_t>(before[i]->vertices.size())});
  return ids;
}

void finish_changes(const PlanarSum& before, const PlanarSum& after, FrameChanges& changes) {
  const auto more = [](std::size_t now, std::size_t then) {
    return static_cast<std::int64_t>(now) - static_cast<std::int64_t>(then);
  };
  std::sort(changes.rings.begin(), changes.rings.end(),
            [](const RingChange& a, const RingChange& b) { return a.ring < b.ring; });
  changes.tight_points = more(after.tight_points.size(), before.tight_points.size());
  changes.tight_segments = more(after.tight_segments.size(), before.tight_segments.size());
  changes.topology = before.parts.size() != after.parts.size() || before.hole_count() != after.hole_count() ||
                     changes.tight_points != 0 || changes.tight_segments != 0 ||
                     before.segments.size() != after.segments.size() || before.points.size() != after.points.size();
}

}  // namespace dymsum::planar
