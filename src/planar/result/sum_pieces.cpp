#include "planar/result/sum_pieces.h"

#include "planar/operand/contact_of.h"
#include "planar/result/pieces.h"

namespace dymsum::planar {
namespace {

// Sums of a vertex or edge of P and a vertex or edge of Q.
class Candidates {
 public:
  Candidates(const Lattice& lattice, const Operand& p, const Operand& q, PieceCandidates& out)
      : lattice_(lattice), p_(p), q_(q), out_(out) {}

  void add(std::uint32_t i, int dimension_p, std::uint32_t j, int dimension_q) {
    if (dimension_p == 0 && dimension_q == 0) {
      out_.points.push_back(corner(i, j, {}));
    } else if (dimension_p == 0) {
      add_edge_of_q(i, j);
    } else if (dimension_q == 0) {
      add_edge_of_p(i, j);
    } else if (lattice_.cross(p_.edge(i), q_.edge(j)) == 0 && lattice_.dot(p_.edge(i), q_.edge(j)) > 0) {
      // Edge by edge, so that every piece lies on its contact.
      add_edge_of_p(i, j);
      add_edge_of_q(p_.next[i], j);
    }
  }

 private:
  void add_edge_of_p(std::uint32_t e, std::uint32_t j) {
    const Contact line = contact_of({0, e, j}, p_, q_);
    out_.segments.push_back({corner(e, j, line), corner(p_.next[e], j, line)});
  }
  void add_edge_of_q(std::uint32_t i, std::uint32_t f) {
    const Contact line = contact_of({1, f, i}, p_, q_);
    out_.segments.push_back({corner(i, f, line), corner(i, q_.next[f], line)});
  }
  SumVertex corner(std::uint32_t i, std::uint32_t j, const Contact& line) const {
    SumVertex v;
    v.in = v.out = line;
    v.corner_p = p_.vertex_index[i];
    v.corner_q = q_.vertex_index[j];
    v.at = lattice_.to_input(p_.x[i] + q_.x[j], p_.y[i] + q_.y[j]);
    return v;
  }

  const Lattice& lattice_;
  const Operand &p_, &q_;
  PieceCandidates& out_;
};

}  // namespace

PieceCandidates lower_dimensional_candidates(const Lattice& lattice, const Operand& p, const Operand& q) {
  PieceCandidates out;
  Candidates candidates(lattice, p, q, out);
  for (const Component& cp : p.components)
    for (const Component& cq : q.components) {
      if (cp.dimension == 2 || cq.dimension == 2) continue;
      for (std::uint32_t i = cp.first; i < cp.last; ++i)
        for (std::uint32_t j = cq.first; j < cq.last; ++j) candidates.add(i, cp.dimension, j, cq.dimension);
    }
  return out;
}

void merge_pieces(const SumSource& source, const std::vector<SumPart>& parts, const PieceCandidates& candidates,
                  std::vector<SumSegment>& segments, std::vector<SumVertex>& points) {
  if (candidates.segments.empty() && candidates.points.empty()) return;
  std::vector<std::vector<Position>> rings;
  std::vector<const SumRing*> ring_of;
  for (const SumPart& part : parts) {
    ring_of.push_back(&part.outer);
    for (const SumRing& hole : part.holes) ring_of.push_back(&hole);
  }
  for (const SumRing* ring : ring_of) {
    rings.emplace_back();
    for (const SumVertex& v : ring->vertices) rings.back().push_back(source.position(v));
  }
  std::vector<PieceCandidate> lines;
  std::vector<Position> spots;
  for (const SumSegment& s : candidates.segments) lines.push_back({source.position(s.from), source.position(s.to)});
  for (const SumVertex& v : candidates.points) spots.push_back(source.position(v));
  const Pieces pieces = lower_dimensional_pieces(rings, lines, spots);
  const auto vertex = [&](const PieceEnd& end) {
    const SumSegment& candidate = candidates.segments[end.candidate];
    if (end.cut_ring == PieceEnd::kNone) {
      const bool is_a = compare(end.at, lines[end.candidate].a) == 0;
      return is_a ? candidate.from : candidate.to;
    }
    SumVertex v;
    v.in = candidate.from.in;
    const SumRing& ring = *ring_of[end.cut_ring];
    const SumVertex &from = ring.vertices[end.cut_edge], &to = ring.vertices[(end.cut_edge + 1) % ring.vertices.size()];
    v.out = source.contact_at(from.out, to.in, end.at);
    v.at = {exact::round_to_double(end.at.x), exact::round_to_double(end.at.y)};
    return v;
  };
  for (const PieceSegment& s : pieces.segments) segments.push_back({vertex(s.from), vertex(s.to)});
  for (const PiecePoint& p : pieces.points) points.push_back(candidates.points[p.candidate]);
}

}  // namespace dymsum::planar
