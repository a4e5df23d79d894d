#include "planar/scaling/line_hashes.h"

#include "planar/frames/frame_rings.h"

namespace dymsum::planar {

LineHashes::LineHashes(std::shared_ptr<const OperandPair> base)
    : base_(std::move(base)),
      forms_(*base_),
      edges_{FirstIndices(base_->operands[0].edge_number), FirstIndices(base_->operands[1].edge_number)},
      vertices_{FirstIndices(base_->operands[0].vertex_number), FirstIndices(base_->operands[1].vertex_number)} {}

Segment LineHashes::segment(const Contact& c) const {
  const bool of_p = c.kind == Contact::Kind::edge_of_p;
  const std::size_t op = of_p ? 0 : 1;
  const Operand &o = base_->operands[op], &other = base_->operands[1 - op];
  return Segment{o.edge(edges_[op][of_p ? c.p : c.q]), other.source[vertices_[1 - op][of_p ? c.q : c.p]]};
}

std::uint64_t LineHashes::line(const Contact& c) {
  const auto [it, fresh] = lines_.try_emplace(key(c), 0);
  if (fresh) it->second = forms_.line_hash(segment(c));
  return it->second;
}

// Lines instead of contacts: where segments coincide at every scale, any of them may be named.
std::uint64_t LineHashes::of(const PlanarSum& sum) {
  std::uint64_t total = sum.parts.size();
  for (const SumRing* ring : rings_of(sum)) {
    std::uint64_t h = ring->vertices.size();
    for (const SumVertex& v : ring->vertices) h += mixed(line(v.in), line(v.out));
    total += mixed(h, 1);
  }
  for (const SumSegment& s : sum.tight_segments) total += mixed(line(s.from.in), 2);
  total += 3 * sum.tight_points.size() + 5 * sum.segments.size() + 7 * sum.points.size();
  return total;
}

}  // namespace dymsum::planar
