#include "planar/frames/frame_rings.h"

#include <algorithm>
#include <unordered_map>

#include "planar/part_nesting.h"

namespace dymsum::planar {
namespace {

bool same_rings(const SumRing& a, const SumRing& b) {
  return std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(),
                    [](const SumVertex& u, const SumVertex& v) {
                      return u.in == v.in && u.out == v.out && u.corner_p == v.corner_p && u.corner_q == v.corner_q;
                    });
}

}  // namespace

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
  return mixed(mixed(key(v.in), key(v.out)), v.corner_p == SumVertex::kNone ? 0 : mixed(v.corner_p, v.corner_q));
}

std::size_t smallest_vertex(const std::vector<SumVertex>& v, const VertexOrder& order, double at_error) {
  std::size_t first = 0;
  for (std::size_t j = 1; j < v.size(); ++j)
    if (v[j].at.x - v[first].at.x <= 2 * at_error && order.compare(v[j], v[first]) < 0) first = j;
  return first;
}

std::vector<std::size_t> place_rings(std::vector<SumRing> rings, const std::vector<std::uint8_t>& outer, PlanarSum& sum) {
  std::vector<std::size_t> numbers;
  if (std::count(outer.begin(), outer.end(), std::uint8_t{1}) != 1) {
    // Several parts: the rings go through the grouping of the static engine, and are recognised by their first vertices.
    std::unordered_map<std::uint64_t, std::size_t> number_at;
    for (std::size_t i = 0; i < rings.size(); ++i) number_at[key(rings[i].vertices[0])] = i;
    sum.parts = group_rings(std::move(rings), outer, *sum.source, sum.at_error);
    canonicalize(sum.parts, *sum.source, sum.at_error);
    for (const SumRing* ring : rings_of(sum)) numbers.push_back(number_at.at(key(ring->vertices[0])));
    return numbers;
  }
  SumPart part;
  std::vector<std::size_t> holes;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (!outer[i]) {
      holes.push_back(i);
      continue;
    }
    part.outer = std::move(rings[i]);
    numbers.push_back(i);
  }
  // Rings share no vertices where nothing touches, so their first vertices order them.
  const VertexOrder order(*sum.source, sum.at_error);
  std::sort(holes.begin(), holes.end(),
            [&](std::size_t a, std::size_t b) { return order.compare(rings[a].vertices[0], rings[b].vertices[0]) < 0; });
  for (const std::size_t i : holes) {
    part.holes.push_back(std::move(rings[i]));
    numbers.push_back(i);
  }
  sum.parts.push_back(std::move(part));
  return numbers;
}

std::vector<std::uint64_t> RingIdentities::match(const PlanarSum& from, const std::vector<std::uint64_t>& known, const PlanarSum& to,
                                                 bool same_place, FrameChanges& changes) {
  const std::vector<const SumRing*> before = rings_of(from), after = rings_of(to);
  std::vector<std::uint64_t> ids(after.size(), 0);
  std::vector<std::uint8_t> taken(before.size(), 0);
  std::vector<std::pair<std::uint64_t, std::size_t>> owner;  // vertex -> ring before, sorted
  for (std::size_t i = 0; i < before.size(); ++i)
    for (const SumVertex& v : before[i]->vertices) owner.emplace_back(key(v), i);
  std::sort(owner.begin(), owner.end());
  for (std::size_t i = 0; i < after.size(); ++i) {
    std::uint32_t shared = 0;
    std::size_t ring = before.size();
    for (const SumVertex& v : after[i]->vertices) {
      const std::uint64_t k = key(v);
      const auto it = std::lower_bound(owner.begin(), owner.end(), k, [](const auto& entry, std::uint64_t want) { return entry.first < want; });
      if (it == owner.end() || it->first != k) continue;
      if (ring == before.size() && !taken[it->second]) ring = it->second;
      shared += it->second == ring;
    }
    const auto size = static_cast<std::uint32_t>(after[i]->vertices.size());
    if (ring == before.size()) {
      ids[i] = next_++;
      changes.rings.push_back({RingChange::Kind::appeared, ids[i], size, 0});
      continue;
    }
    taken[ring] = 1;
    ids[i] = known[ring];
    const auto old = static_cast<std::uint32_t>(before[ring]->vertices.size());
    shared = std::min({shared, size, old});
    const bool same = size == old && shared == size && same_rings(*before[ring], *after[i]);
    if (!same || !same_place)
      changes.rings.push_back({same ? RingChange::Kind::moved : RingChange::Kind::reshaped, ids[i], size - shared, old - shared});
  }
  for (std::size_t i = 0; i < before.size(); ++i)
    if (!taken[i])
      changes.rings.push_back({RingChange::Kind::disappeared, known[i], 0, static_cast<std::uint32_t>(before[i]->vertices.size())});
  return ids;
}

void finish_changes(const PlanarSum& before, const PlanarSum& after, FrameChanges& changes) {
  const auto more = [](std::size_t now, std::size_t then) { return static_cast<std::int64_t>(now) - static_cast<std::int64_t>(then); };
  std::sort(changes.rings.begin(), changes.rings.end(), [](const RingChange& a, const RingChange& b) { return a.ring < b.ring; });
  changes.tight_points = more(after.tight_points.size(), before.tight_points.size());
  changes.tight_segments = more(after.tight_segments.size(), before.tight_segments.size());
  changes.topology = before.parts.size() != after.parts.size() || before.hole_count() != after.hole_count() || changes.tight_points != 0 ||
                     changes.tight_segments != 0 || before.segments.size() != after.segments.size() ||
                     before.points.size() != after.points.size();
}

}  // namespace dymsum::planar
