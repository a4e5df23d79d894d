// Opening and closing: the region's boundary as far as discs of the radius touch it, and arcs about those at the ends.
#include <cmath>
#include <numbers>
#include <utility>

#include "base/union_find.h"
#include "shape/disc/disc_arcs.h"
#include "shape/disc/level_set.h"
#include "shape/disc/nested_rings.h"
#include "shape/disc/run_pieces.h"

namespace dymsum::shape {

namespace {

/// One boundary ring between the discs, on the right, and what they do not reach.
struct DiscBoundary {
  std::vector<DiscPiece> pieces;
  std::uint32_t item = kNoIndex;  ///< one of its runs' items, or of the loop it is
  std::uint32_t arc = kNoIndex;   ///< one of its arcs
};

class DiscBoundaries {
 public:
  DiscBoundaries(const DiscPlaces& places, const BoundaryOrder& order, std::uint32_t cut)
      : places_(places), order_(order), cut_(cut),
        rings_(level_rings(places.complex(), order, places.level(), cut, Connected::region, false)),
        arcs_(corner_arcs(places, order, rings_, cut)),
        run_done_(rings_.runs.size(), 0), fragment_done_(arcs_.fragments.size(), 0) {}

  std::vector<DiscBoundary> make() {
    std::vector<DiscBoundary> made;
    for (std::uint32_t run = 0; run < rings_.runs.size(); ++run)
      if (!run_done_[run]) made.push_back(from_run(run));
    for (std::uint32_t f = 0; f < arcs_.fragments.size(); ++f) {
      if (fragment_done_[f]) continue;
      DiscBoundary ring;
      follow(kNoIndex, f, ring);
      made.push_back(std::move(ring));
    }
    return made;
  }

  const ArcSet& arcs() const { return arcs_; }
  const LevelRings& rings() const { return rings_; }

 private:
  DiscBoundary from_run(std::uint32_t run) {
    DiscBoundary ring;
    if (rings_.runs[run].whole()) {
      run_done_[run] = 1;
      ring.item = order_.first_item[rings_.runs[run].loop];
      append_whole(run, ring);
    } else {
      ring.item = rings_.runs[run].from;
      follow(run, kNoIndex, ring);
    }
    return ring;
  }

  void append_whole(std::uint32_t run, DiscBoundary& ring) const {
    Pieces pieces;
    append_in_place(places_, order_, rings_.runs[run], pieces);
    ring.pieces = std::move(pieces.list);
  }

  /// From a run or a fragment once round.
  void follow(std::uint32_t run, std::uint32_t fragment, DiscBoundary& ring) {
    while (run != kNoIndex ? !run_done_[run] : !fragment_done_[fragment]) {
      if (run != kNoIndex) {
        run_done_[run] = 1;
        if (ring.item == kNoIndex) ring.item = rings_.runs[run].from;
        Pieces pieces;
        append_in_place(places_, order_, rings_.runs[run], pieces);
        ring.pieces.insert(ring.pieces.end(), pieces.list.begin(), pieces.list.end());
        const std::uint32_t arc = arcs_.arc_at_end[order_.items[rings_.runs[run].to].edge];
        fragment = arcs_.first[arc];
        // Where the arc's beginning is covered, by a disc that touches the same vertex, the boundary goes on at the
        // vertex with the next places of it.
        run = fragment == ArcFragment::kContact ? next_run(rings_.runs[run].to) : kNoIndex;
      } else {
        fragment_done_[fragment] = 1;
        ring.arc = arcs_.fragments[fragment].arc;
        ring.pieces.push_back(arc_piece(arcs_.fragments[fragment]));
        const ArcFragment& here = arcs_.fragments[fragment];
        if (here.end == ArcFragment::kContact) run = rings_.run_from[arcs_.arcs[here.arc].out];
        else fragment = here.next;
      }
    }
  }

  std::uint32_t next_run(std::uint32_t item) const {
    const Complex& complex = places_.complex();
    do {
      item = order_.next(complex, item);
    } while (!(order_.items[item].up && crosses(complex.edges[order_.items[item].edge], cut_)));
    return rings_.run_from[order_.items[item].edge];
  }

  DiscPiece arc_piece(const ArcFragment& fragment) const {
    const Complex& complex = places_.complex();
    const CornerArc& arc = arcs_.arcs[fragment.arc];
    DiscPiece piece;
    piece.of = DiscPiece::Of::disc;
    piece.index = arc.disc.index;
    piece.disc = arc.disc;
    piece.centre = places_.centre(arc.disc);
    const std::uint32_t right = complex.edges[arc.in].right, left = complex.edges[arc.out].left;
    Point from = places_.towards(arc.disc, complex.sites[right]), to = places_.towards(arc.disc, complex.sites[left]);
    if (fragment.end != ArcFragment::kContact)
      to = towards_crossing(places_, arc.disc, arcs_.arcs[fragment.end].disc, true);
    if (fragment.begin == ArcFragment::kContact) {
      piece.from = contact_corner(places_, arc.in, right);
    } else {
      from = towards_crossing(places_, arc.disc, arcs_.arcs[fragment.begin].disc, false);
      piece.from.kind = DiscCorner::Kind::crossing;
      piece.from.disc = arc.disc;
      piece.from.other = arcs_.arcs[fragment.begin].disc;
      piece.from.at = {piece.centre.x + from.x, piece.centre.y + from.y};
    }
    piece.from_angle = std::atan2(from.y, from.x);
    piece.sweep = -turn_between(std::atan2(to.y, to.x), piece.from_angle, std::numbers::pi);
    return piece;
  }

  const DiscPlaces& places_;
  const BoundaryOrder& order_;
  std::uint32_t cut_;
  LevelRings rings_;
  ArcSet arcs_;
  std::vector<std::uint8_t> run_done_, fragment_done_;
};

/// Connected sets of discs: along the complex beyond the cut, and where corner discs overlap. The last element is what
/// is connected through infinity.
UnionFind connected_discs(const Complex& complex, std::uint32_t cut, const ArcSet& arcs) {
  const auto infinity = static_cast<std::uint32_t>(complex.nodes.size());
  UnionFind joined(infinity + 1);
  const auto high = [&](std::uint32_t edge) { return std::min(complex.edges[edge].high, infinity); };
  for (std::uint32_t edge = 0; edge < complex.edges.size(); ++edge)
    if (complex.edges[edge].low >= cut) joined.unite(complex.edges[edge].low, high(edge));
  for (const CornerArc& arc : arcs.arcs) joined.unite(high(arc.in), high(arc.out));
  for (const auto& [a, b] : arcs.overlaps) joined.unite(high(arcs.arcs[a].in), high(arcs.arcs[b].in));
  return joined;
}

}  // namespace

DiscSet opened_set(const DiscPlaces& places, const BoundaryOrder& order, Semantics semantics) {
  const Complex& complex = places.complex();
  const std::uint32_t cut = semantics == Semantics::regular ? places.level().up_to : places.level().below;
  DiscBoundaries boundaries(places, order, cut);
  UnionFind joined = connected_discs(complex, cut, boundaries.arcs());
  std::vector<OwnedRing> made;
  for (DiscBoundary& ring : boundaries.make()) {
    const std::uint32_t edge =
        ring.item != kNoIndex ? order.items[ring.item].edge : boundaries.arcs().arcs[ring.arc].in;
    made.push_back({reversed(std::move(ring.pieces)), joined.root(complex.edges[edge].high)});
  }
  DiscSet set;
  set.parts = parts_of(std::move(made), Corners::clockwise);
  finish(places, set);
  return set;
}

DiscSet closed_set(const DiscPlaces& places, const BoundaryOrder& order, Semantics semantics) {
  const std::uint32_t cut = semantics == Semantics::open ? places.level().below : places.level().up_to;
  DiscBoundaries boundaries(places, order, cut);
  std::vector<DiscRing> made;
  for (DiscBoundary& ring : boundaries.make()) made.push_back({std::move(ring.pieces)});
  DiscSet set;
  set.parts = nested(std::move(made), Corners::counter_clockwise);
  finish(places, set);
  return set;
}

}  // namespace dymsum::shape
