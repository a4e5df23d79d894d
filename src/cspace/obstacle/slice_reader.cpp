#include "cspace/obstacle/slice_reader.h"

#include <stdexcept>

#include "cspace/events/walk_indices.h"
#include "exact/rounding_bound.h"
#include "planar/boundary/collision.h"
#include "planar/motion/operand_pair.h"
#include "planar/position/exact_source.h"
#include "planar/sum/minkowski_sum.h"

namespace dymsum::planar {
namespace {

// The errors of a position from the lattice's base: that of its double, times the span, which Collision's own slack
// covers as well; and that of the sum of the offsets, times the reach.
constexpr double kPosition = exact::rounding_bound(1, 2), kBase = exact::rounding_bound(1, 2);

// The middle of the loop's first piece.
SegmentPosition position_on_loop(const std::vector<WalkSegment>& loop, const TurningForms& forms,
                                 const PlacedPair& state) {
  const auto exact_segment = [&](const WalkSegment& s) {
    const Operand &o = s.side == 0 ? *state.p : *state.q, &other = s.side == 0 ? *state.q : *state.p;
    return Segment{o.edge(s.edge), other.source[s.vertex]};
  };
  // The cut where the boundary turns from one segment of the loop into the next, `by` the one that is not the first.
  const auto cut = [&](const WalkSegment& from, const WalkSegment& to, const WalkSegment& by) {
    Cut c;
    if (forms.end(from) == TurningForms::start(to)) {
      c.pair = {state.p->source[forms.end(from).p], state.q->source[forms.end(from).q]};
    } else {
      c.kind = Cut::Kind::crossing;
      c.by = exact_segment(by);
    }
    return c;
  };
  SegmentPosition position;
  position.on = exact_segment(loop[0]);
  position.between = true;
  position.first = cut(loop.back(), loop[0], loop.back());
  position.second = cut(loop[0], loop[1], loop[1]);
  const Lattice& lattice = *state.lattice;
  const Lattice::Position p = lattice.position(position);
  const auto in_steps = [&](const auto& v, double low) {
    return exact::round_to_double(exact::BigRational((v - exact::exact_value(low)) / exact::exact_value(lattice.unit)));
  };
  position.x = in_steps(p.x, lattice.base.x);
  position.y = in_steps(p.y, lattice.base.y);
  position.error = kPosition * lattice.span + (lattice.base_reach * kBase + lattice.base_error) / lattice.unit;
  return position;
}

}  // namespace

SliceReader::SliceReader(const TurningForms& forms, std::shared_ptr<const OperandPair> base)
    : forms_(forms), base_(std::move(base)), index_(forms.size(0), forms.size(1)) {
  for (std::uint32_t op = 0; op < 2; ++op) {
    const Operand& o = forms.operand(op);
    walk_vertex_[op].assign(o.vertex_of_index.size(), kNobody);
    walk_edge_[op].assign(o.edge_of_index.size(), kNobody);
    for (std::uint32_t i = 0; i < o.size(); ++i) {
      walk_vertex_[op][o.vertex_index[i]] = i;
      walk_edge_[op][o.edge_index[i]] = i;
    }
  }
}

WalkSegment SliceReader::segment(const Contact& c) const {
  return c.kind == Contact::Kind::edge_of_p ? WalkSegment{0, walk_edge_[0][c.p], walk_vertex_[1][c.q]}
                                            : WalkSegment{1, walk_edge_[1][c.q], walk_vertex_[0][c.p]};
}

std::vector<std::uint32_t> SliceReader::segments(const SumRing& ring) const {
  std::vector<WalkSegment> along;
  const std::size_t n = ring.vertices.size();
  for (std::size_t k = 0; k < n; ++k)
    append_run(segment(ring.vertices[k].out), segment(ring.vertices[k + 1 == n ? 0 : k + 1].in), forms_, along);
  std::vector<std::uint32_t> all;
  for (const WalkSegment& s : along) all.push_back(index_.of(s));
  return all;
}

std::vector<SliceLoop> SliceReader::loops(const Orientation& at) const {
  SumOptions options;
  options.semantics = Semantics::regular;
  const Result<SumState> computed = compute_boundary(base_->placed(at), options);
  if (!computed) throw std::logic_error("SliceReader: a slice failed");
  const RawBoundary& raw = computed->boundary;
  std::vector<SliceLoop> all;
  for (std::size_t l = 0; l < raw.rings.size(); ++l)
    all.push_back({segments(raw.rings[l]), base_->connected && raw.outer[l] != 0});
  return all;
}

PlanarSum SliceReader::slice(const Orientation& at, Semantics semantics) const {
  SumOptions options;
  options.semantics = semantics;
  Result<PlanarSum> sum = placed_sum(base_->placed(at), options);
  if (!sum) throw std::logic_error("SliceReader: a slice failed");
  return std::move(*sum);
}

std::uint32_t SliceReader::cell_at(const SumRing& ring, const BoundaryGraph& graph) const {
  const std::vector<std::uint32_t> all = segments(ring);
  for (std::uint32_t n = graph.first_on(all.front()); n != kNobody; n = graph[n].next_on_segment)
    if (graph[n].left == all.back()) return graph[n].cell;
  throw std::logic_error("SliceReader: a ring of the slice is not on the boundary");
}

SliceReader::Faces SliceReader::faces(const Orientation& at, const BoundaryGraph& graph) const {
  const PlanarSum sum = slice(at, Semantics::regular);
  std::vector<const SumRing*> holes;
  for (const SumPart& part : sum.parts)
    for (const SumRing& hole : part.holes) holes.push_back(&hole);
  Faces faces;
  for (const SumPart& part : sum.parts) {
    const std::uint32_t cell = cell_at(part.outer, graph);
    const SumRing* inside = nullptr;
    for (const SumRing* hole : holes)
      if (ring_contains(*hole, part.outer, *exact_source(sum), sum.at_error) &&
          (inside == nullptr || ring_contains(*inside, *hole, *exact_source(sum), sum.at_error)))
        inside = hole;
    if (inside != nullptr) {
      faces.same.emplace_back(cell, cell_at(*inside, graph));
      continue;
    }
    if (!faces.unbounded.empty()) faces.same.emplace_back(cell, faces.unbounded.back());
    faces.unbounded.push_back(cell);
  }
  return faces;
}

bool SliceReader::is_free(const std::vector<WalkSegment>& loop, const Orientation& at) const {
  const PlacedPair state = base_->placed(at);
  Collision collision(*state.lattice, *state.p, *state.q, true);
  return !collision.overlaps_right_of(position_on_loop(loop, forms_, state));
}

}  // namespace dymsum::planar
