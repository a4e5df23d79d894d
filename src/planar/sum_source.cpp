#include "planar/sum_source.h"

#include <algorithm>

namespace dymsum::planar {

void number_region(const EngineRegion& engine_region, std::uint32_t op, Numbering& out) {
  const RegionData& region = engine_region.data;
  std::uint32_t size = 0;
  for (const auto* numbers : {&engine_region.vertex_number, &engine_region.edge_number})
    for (const std::uint32_t n : *numbers) size = n == SumVertex::kNone ? size : std::max(size, n + 1);
  out.vertex[op].assign(size, 0);
  out.edge[op].assign(size, {0, 0});
  const auto set = [&](std::uint32_t source, std::uint32_t from, std::uint32_t to) {
    const std::uint32_t v = engine_region.vertex_number[source], e = engine_region.edge_number[source];
    if (v != SumVertex::kNone) out.vertex[op][v] = source;
    if (e != SumVertex::kNone) out.edge[op][e] = {from, to};
  };
  std::uint32_t at = 0;
  const auto ring = [&](const Ring& r) {
    const std::uint32_t n = static_cast<std::uint32_t>(r.size());
    for (std::uint32_t i = 0; i < n; ++i) set(at + i, at + i, at + (i + 1 == n ? 0 : i + 1));
    at += n;
  };
  for (const Part& part : region.parts) {
    ring(part.outer);
    for (const Ring& hole : part.holes) ring(hole);
  }
  for (const Polyline& line : region.polylines) {
    const std::uint32_t n = static_cast<std::uint32_t>(line.size());
    // The last vertex starts no edge.
    for (std::uint32_t i = 0; i < n; ++i) set(at + i, at + (i + 1 < n ? i : i - 1), at + (i + 1 < n ? i + 1 : i));
    at += n;
  }
  for (std::size_t i = 0; i < region.points.size(); ++i, ++at) set(at, at, at);
}

Segment SumSource::segment(const Contact& contact) const {
  const bool of_p = contact.kind == Contact::Kind::edge_of_p;
  const auto [from, to] = numbering_.edge[of_p ? 0 : 1][of_p ? contact.p : contact.q];
  return {{of_p ? 0u : 1u, from, to}, numbering_.vertex[of_p ? 1 : 0][of_p ? contact.q : contact.p]};
}

ExactSource::Position SumSource::position(const SumVertex& vertex) const {
  Place place;
  if (vertex.corner_p != SumVertex::kNone) {
    const Pair corner{numbering_.vertex[0][vertex.corner_p], numbering_.vertex[1][vertex.corner_q]};
    // Any segment through the corner carries it; a point + point has none.
    Lattice::Position p = lattice_->position(corner);
    return {std::move(p.x), std::move(p.y)};
  }
  place.on = segment(vertex.in);
  place.first.kind = Cut::Kind::crossing;
  place.first.by = segment(vertex.out);
  Lattice::Position p = lattice_->position(place);
  return {std::move(p.x), std::move(p.y)};
}

}  // namespace dymsum::planar
