#include "planar/sum_source.h"

namespace dymsum::planar {

void number_region(const RegionData& region, std::uint32_t op, Numbering& out) {
  std::uint32_t at = 0;
  const auto ring = [&](const Ring& r) {
    const std::uint32_t n = static_cast<std::uint32_t>(r.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      out.vertex[op].push_back(at + i);
      out.edge[op].push_back({at + i, at + (i + 1 == n ? 0 : i + 1)});
    }
    at += n;
  };
  for (const Part& part : region.parts) {
    ring(part.outer);
    for (const Ring& hole : part.holes) ring(hole);
  }
  for (const Polyline& line : region.polylines) {
    const std::uint32_t n = static_cast<std::uint32_t>(line.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      out.vertex[op].push_back(at + i);
      // The last vertex starts no edge; its entry keeps the numbering dense.
      out.edge[op].push_back(i + 1 < n ? std::array{at + i, at + i + 1} : std::array{at + i - 1, at + i});
    }
    at += n;
  }
  for (std::size_t i = 0; i < region.points.size(); ++i, ++at) {
    out.vertex[op].push_back(at);
    out.edge[op].push_back({at, at});
  }
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
