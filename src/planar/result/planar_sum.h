// The last step of every planar sum: from what an engine found to the canonical result, and the exact positions
// behind it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "dymsum/planar_sum.h"
#include "dymsum/trace.h"
#include "planar/boundary/boundary.h"
#include "planar/boundary/winding_boundary.h"
#include "planar/convolution/convolution.h"
#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"
#include "planar/position/exact_source.h"

namespace dymsum::planar {

// The last step of every planar sum: from what an engine found to the canonical result.

// A planar sum in the making: what its stages hand on.

struct SumState : PlacedPair {
  SumState() = default;
  explicit SumState(PlacedPair placed) : PlacedPair(std::move(placed)) { stats.tier_bits = lattice->tier_bits; }

  RawBoundary boundary;
  SumStats stats;
  std::unique_ptr<PlanarTrace> trace;  ///< where one is to be recorded
};

/// Whether stages are timed: of small sums they are not.
inline bool timed(const SumState& state) { return state.p->size() + state.q->size() > 100; }

// Exact positions of the vertices of a sum, from the provenance they carry.

class SumSource final : public ExactSource {
 public:
  SumSource(std::shared_ptr<const Lattice> lattice, std::shared_ptr<const Operand> p, std::shared_ptr<const Operand> q)
      : lattice_(std::move(lattice)), operands_{std::move(p), std::move(q)} {}

  Position position(const SumVertex& vertex) const override;
  Homogeneous homogeneous(const SumVertex& vertex) const override;
  std::optional<NearFrame> near_frame() const override { return lattice_->near_frame(); }
  NearPosition near(const SumVertex& vertex) const override;
  std::optional<Point> rounded_once(const SumVertex& vertex) const override;
  int compare_x(const SumVertex& a, const SumVertex& b) const override;
  int compare_y(const SumVertex& a, const SumVertex& b) const override;

  /// Whether a position lies on the closed segment that a contact names.
  bool on_contact(const Contact& contact, const Position& at) const;
  /// A contact that carries a position on a ring edge whose first and last contacts are given. Requires: `at` lies on
  /// that edge.
  Contact contact_at(const Contact& first, const Contact& last, const Position& at) const;

 private:
  Segment segment(const Contact& contact) const;
  bool on_segment(const Segment& s, const Position& at) const;
  Pair corner(const SumVertex& v) const;
  SegmentPosition crossing(const SumVertex& v) const;
  int compare(const SumVertex& a, const SumVertex& b, int axis) const;

  std::shared_ptr<const Lattice> lattice_;
  std::array<std::shared_ptr<const Operand>, 2> operands_;
};

// What makes parts of boundary rings, and the canonical order of rings, holes, parts and features.

// Everywhere below `at_error` bounds |at - exact position| in each coordinate, for every vertex handed in. Doubles that
// are further apart than that allows decide; the source decides the rest.

/// Groups rings into parts: each hole goes to the innermost outer ring that contains it. Requires: rings do not cross
/// (they may touch at points), is_outer has one entry per ring, every hole lies inside an outer ring; throws
/// std::logic_error otherwise. Parts come in the order of their outer rings.
/// Cost: O(rings) with one outer ring; otherwise O(h n) for h holes and n vertices of outer rings whose boxes overlap.
std::vector<SumPart> group_rings(std::vector<SumRing> rings, std::span<const std::uint8_t> is_outer,
                                 const ExactSource& source, double at_error);

/// The canonical form: every ring starts at its lexicographically smallest vertex (where it visits that several times,
/// at the visit after which the ring continues smallest), holes and parts are sorted by their vertices in ring order.
/// Cost: O(n + r log r) for n vertices of r rings; the source is queried only about vertices that doubles cannot order.
void canonicalize(std::vector<SumPart>& parts, const ExactSource& source, double at_error);

/// from < to, sorted by from, then to; equal segments once. Provenance of `from` and `to` travels with them.
void canonicalize(std::vector<SumSegment>& segments, const ExactSource& source, double at_error);

/// Sorted; equal points once.
void canonicalize(std::vector<SumVertex>& points, const ExactSource& source, double at_error);

// The stages of a sum as data for pictures: dymsum/trace.h.

void trace_stages(const Soup& soup, const InteriorMask* mask, const Arrangement& arrangement, const SortedLoops& loops,
                  const ReducedConvolution& convolution, PlanarTrace& trace);
/// The same of a sum by winding numbers.
void trace_windings(const Soup& soup, const SegmentGraph& graph, const std::vector<BoundaryEdges>& rings,
                    PlanarTrace& trace);

/// Canonical order, parts, tight features, lower-dimensional pieces.
PlanarSum finish_sum(SumState&& state, const SumOptions& options);

/// A vertex is named by its index, as Contact::p of its edges and as its corner.
class ListedPositions final : public ExactSource {
 public:
  explicit ListedPositions(std::vector<Homogeneous> at) : at_(std::move(at)) {}

  Position position(const SumVertex& v) const override { return reduced(at_[v.corner_p]); }
  Homogeneous homogeneous(const SumVertex& v) const override { return at_[v.corner_p]; }

 private:
  std::vector<Homogeneous> at_;
};

}  // namespace dymsum::planar
