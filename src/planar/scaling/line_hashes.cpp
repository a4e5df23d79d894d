#include "planar/scaling/line_hashes.h"

#include "planar/frames/frame_rings.h"

namespace dymsum::planar {

std::uint64_t combinatorial_hash(const PlanarSum& sum, const OperandPair& base, const ExactForms& forms,
                                 LineHashes& known) {
  for (std::size_t op = 0; op < 2; ++op) {
    known.edges[op].fill(base.operands[op].edge_number);
    known.vertices[op].fill(base.operands[op].vertex_number);
  }
  // Lines instead of contacts: where segments coincide at every scale, any of them may be named.
  const auto segment = [&](const Contact& c) {
    const bool of_p = c.kind == Contact::Kind::edge_of_p;
    const std::size_t op = of_p ? 0 : 1;
    const Operand &o = base.operands[op], &other = base.operands[1 - op];
    return Segment{o.edge(known.edges[op][of_p ? c.p : c.q]), other.source[known.vertices[1 - op][of_p ? c.q : c.p]]};
  };
  const auto line = [&](const Contact& c) {
    const auto [it, fresh] = known.lines.try_emplace(key(c), 0);
    if (fresh) it->second = forms.line_hash(segment(c));
    return it->second;
  };
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
