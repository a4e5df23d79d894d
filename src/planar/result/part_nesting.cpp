#include "planar/result/part_nesting.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>

#include "planar/position/exact_source.h"
#include "planar/position/ring_containment.h"

namespace dymsum::planar {

namespace {

/// The smaller of the rotations of a ring that start at i and j, vertex by vertex.
std::size_t smaller_rotation(const std::vector<SumVertex>& ring, std::size_t i, std::size_t j,
                             const VertexOrder& order) {
  const std::size_t n = ring.size();
  for (std::size_t k = 0; k < n; ++k) {
    const int sign = order.compare(ring[(i + k) % n], ring[(j + k) % n]);
    if (sign != 0) return sign < 0 ? i : j;
  }
  return i;
}

std::size_t canonical_start(const std::vector<SumVertex>& ring, const VertexOrder& order) {
  const std::size_t n = ring.size();
  const SumVertex* const v = ring.data();
  std::size_t best = 0;
  for (std::size_t k = 1; k < n; ++k) {
    if (order.provably_right(v[k], v[best])) continue;
    const int sign = order.compare(ring[k], ring[best]);
    if (sign < 0) best = k;
    if (sign == 0) best = smaller_rotation(ring, best, k, order);
  }
  return best;
}

void rotate_to_start(SumRing& ring, const VertexOrder& order) {
  const auto start = static_cast<std::ptrdiff_t>(canonical_start(ring.vertices, order));
  if (start != 0) std::rotate(ring.vertices.begin(), ring.vertices.begin() + start, ring.vertices.end());
}

int compare_rings(const SumRing& a, const SumRing& b, const VertexOrder& order) {
  const std::size_t common = std::min(a.vertices.size(), b.vertices.size());
  for (std::size_t k = 0; k < common; ++k)
    if (const int sign = order.compare(a.vertices[k], b.vertices[k]); sign != 0) return sign;
  return a.vertices.size() < b.vertices.size() ? -1 : a.vertices.size() > b.vertices.size();
}

/// The innermost of the outer rings that contain a hole.
std::size_t parent_of(const SumRing& hole, const std::vector<const SumRing*>& outers, const std::vector<RingBox>& boxes,
                      const ExactSource& source, double at_error) {
  const RingBox box = box_of(hole, at_error);
  std::optional<std::size_t> parent;
  for (std::size_t i = 0; i < outers.size(); ++i) {
    if (boxes_disjoint(box, boxes[i]) || !ring_contains(*outers[i], hole, source, at_error)) continue;
    if (!parent || ring_contains(*outers[*parent], *outers[i], source, at_error)) parent = i;
  }
  if (!parent) throw std::logic_error("group_rings: a hole lies in no outer ring");
  return *parent;
}

}  // namespace

std::vector<SumPart> group_rings(std::vector<SumRing> rings, std::span<const std::uint8_t> is_outer,
                                 const ExactSource& source, double at_error) {
  if (rings.size() != is_outer.size()) throw std::logic_error("group_rings: one entry of is_outer per ring");
  std::vector<SumPart> parts;
  if (rings.size() == 1 && is_outer[0] != 0) {
    parts.emplace_back().outer = std::move(rings[0]);
    return parts;
  }
  std::vector<const SumRing*> outers;
  std::vector<std::size_t> part_of(rings.size());
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (is_outer[i] == 0) continue;
    part_of[i] = outers.size();
    outers.push_back(&rings[i]);
  }
  if (outers.empty() && !rings.empty()) throw std::logic_error("group_rings: a hole lies in no outer ring");
  if (outers.size() > 1 && outers.size() < rings.size()) {
    std::vector<RingBox> boxes;
    for (const SumRing* outer : outers) boxes.push_back(box_of(*outer, at_error));
    for (std::size_t i = 0; i < rings.size(); ++i)
      if (is_outer[i] == 0) part_of[i] = parent_of(rings[i], outers, boxes, source, at_error);
  }
  parts.resize(outers.size());
  for (std::size_t i = 0; i < rings.size(); ++i) {
    SumPart& part = parts[part_of[i]];
    if (is_outer[i] != 0) part.outer = std::move(rings[i]);
    else part.holes.push_back(std::move(rings[i]));
  }
  return parts;
}

void canonicalize(std::vector<SumPart>& parts, const ExactSource& source, double at_error) {
  const VertexOrder order(source, at_error);
  const auto before = [&](const SumRing& a, const SumRing& b) { return compare_rings(a, b, order) < 0; };
  for (SumPart& part : parts) {
    rotate_to_start(part.outer, order);
    for (SumRing& hole : part.holes) rotate_to_start(hole, order);
    std::sort(part.holes.begin(), part.holes.end(), before);
  }
  std::sort(parts.begin(), parts.end(), [&](const SumPart& a, const SumPart& b) { return before(a.outer, b.outer); });
}

void canonicalize(std::vector<SumSegment>& segments, const ExactSource& source, double at_error) {
  const VertexOrder order(source, at_error);
  const auto compare = [&](const SumSegment& a, const SumSegment& b) {
    const int sign = order.compare(a.from, b.from);
    return sign != 0 ? sign : order.compare(a.to, b.to);
  };
  for (SumSegment& s : segments)
    if (order.compare(s.to, s.from) < 0) std::swap(s.from, s.to);
  std::stable_sort(segments.begin(), segments.end(),
                   [&](const SumSegment& a, const SumSegment& b) { return compare(a, b) < 0; });
  const auto same = [&](const SumSegment& a, const SumSegment& b) { return compare(a, b) == 0; };
  segments.erase(std::unique(segments.begin(), segments.end(), same), segments.end());
}

void canonicalize(std::vector<SumVertex>& points, const ExactSource& source, double at_error) {
  const VertexOrder order(source, at_error);
  std::stable_sort(points.begin(), points.end(),
                   [&](const SumVertex& a, const SumVertex& b) { return order.compare(a, b) < 0; });
  const auto same = [&](const SumVertex& a, const SumVertex& b) { return order.compare(a, b) == 0; };
  points.erase(std::unique(points.begin(), points.end(), same), points.end());
}

}  // namespace dymsum::planar
