// Opening and closing: the region's boundary as far as discs of the radius touch it, and arcs about those at the ends.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "base/scratch.h"
#include "shape/disc/disc_positions.h"
#include "shape/disc/disc_set.h"
#include "shape/disc/growing_disc.h"
#include "shape/disc/level_rings.h"
#include "shape/disc/run_pieces.h"
#include "shape/disc/thin_pieces.h"

namespace dymsum::shape {
namespace {

// The parts in which holes lie, where what the rings touch does not decide.

/// A ring with the set on its left, and what is known of the part that it bounds.
struct PlacedRing {
  DiscRing ring;
  bool outer = false;
  std::vector<std::uint32_t> sites;    ///< piece -> the site that the corner at its start lies on, if that is a contact
  std::optional<std::uint32_t> owner;  ///< rings with the same one bound one part
  std::optional<Point> anchor;         ///< a vertex of the region in that part
};

using exact::Interval;

using exact::RootExpression;

/// The exact corners of rings, relative to a position of the region.
class ExactCorners {
 public:
  ExactCorners(const DiscPositions& positions, Point origin) : positions_(positions), origin_(origin) {}

  LazyVector at(const PlacedRing& ring, std::size_t piece) const {
    const DiscCorner& corner = ring.ring.pieces[piece].from;
    if (corner.kind == DiscCorner::Kind::vertex) return vertex(corner.at);
    const double off = positions_.at_error();
    const Vector<Interval> near{Interval(corner.at.x - off, corner.at.x + off) - Interval(origin_.x),
                                Interval(corner.at.y - off, corner.at.y + off) - Interval(origin_.y)};
    if (corner.kind == DiscCorner::Kind::crossing) return {near, [this, corner] { return crossing_at(corner); }};
    const Site& site = positions_.complex().sites[ring.sites[piece]];
    return {near, [this, corner, &site] { return contact_at(corner, site); }};
  }
  LazyVector vertex(Point p) const {
    return {between<Interval>(origin_, p), [this, p] { return between<RootExpression>(origin_, p); }};
  }

 private:
  /// The position at which corner.disc is entered from corner.other, clockwise, or touched.
  Vector<RootExpression> crossing_at(const DiscCorner& corner) const {
    const auto c = positions_.exact_centre_from(corner.disc, origin_),
               d = positions_.exact_centre_from(corner.other, origin_);
    const auto between = minus(d, c);
    const RootExpression half(0.5),
        room = positions_.level().exact * positions_.level().exact - half * half * dot(between, between);
    if (exact::sign_of(room) == 0) return plus(c, {half * between.x, half * between.y});  // they touch
    return plus(c, crossing(between, positions_.level().exact, true));
  }
  Vector<RootExpression> contact_at(const DiscCorner& corner, const Site& edge) const {
    const auto n = long_normal<RootExpression>(edge);
    const RootExpression fraction = positions_.level().exact / sqrt(dot(n, n));
    return minus(positions_.exact_centre_from(corner.disc, origin_),
                 Vector<RootExpression>{n.x * fraction, n.y * fraction});
  }

  const DiscPositions& positions_;
  Point origin_;
};

LazyVector difference(const LazyVector& a, const LazyVector& b) {
  return {minus(a.near, b.near), [a, b] { return minus(a.exact(), b.exact()); }};
}

/// Whether a position of another ring, or a vertex in the part that this bounds, lies within a ring: by the edges that
/// a ray from it towards +x crosses. Between an arc and its chord lies nothing of the set, as the arc bends into it:
/// chords wind as often, and never meet the position.
bool winds_about(const DiscPositions& positions, const PlacedRing& ring, const PlacedRing& inner) {
  const Point origin = inner.anchor.value_or(positions.complex().sites.front().a);
  const ExactCorners corners(positions, origin);
  const LazyVector z = inner.anchor ? corners.vertex(origin) : corners.at(inner, 0);
  const std::size_t n = ring.ring.pieces.size();
  int winding = 0;
  LazyVector a = difference(corners.at(ring, n - 1), z);
  bool a_above = sign_of_y(a) > 0;
  for (std::size_t i = 0; i < n; ++i) {
    LazyVector b = difference(corners.at(ring, i), z);
    const bool b_above = sign_of_y(b) > 0;
    if (a_above != b_above && (sign_of_cross(a, b) > 0) == b_above) winding += b_above ? 1 : -1;
    a = std::move(b);
    a_above = b_above;
  }
  return winding != 0;
}

/// Of two rings around a hole, which do not cross, one lies within the other.
std::size_t innermost_around(const DiscPositions& positions, const std::vector<const PlacedRing*>& outer,
                             const PlacedRing& hole) {
  if (outer.size() == 1) return 0;
  std::optional<std::size_t> innermost;
  for (std::size_t i = 0; i < outer.size(); ++i)
    if (winds_about(positions, *outer[i], hole) &&
        (!innermost || winds_about(positions, *outer[*innermost], *outer[i])))
      innermost = i;
  if (!innermost) throw std::logic_error("a hole lies in no part");
  return *innermost;
}

/// Parts of rings that do not cross: every hole goes to the part of its owner or, where no outer ring has that, to the
/// innermost outer ring around it. Exact. Requires: arcs are concave as seen from the set, and outer rings have
/// different owners. Cost: one pass over all outer rings for each hole that no owner tells about.
std::vector<DiscPart> nested(const DiscPositions& positions, std::vector<PlacedRing> rings) {
  std::vector<DiscPart> parts;
  std::vector<const PlacedRing*> outer;
  std::vector<PlacedRing*> holes;
  std::map<std::uint32_t, std::size_t> part_of;
  for (PlacedRing& ring : rings) {
    if (!ring.outer) {
      holes.push_back(&ring);
      continue;
    }
    if (ring.owner && !part_of.try_emplace(*ring.owner, parts.size()).second)
      throw std::logic_error("a part of a closing has two outer rings");
    outer.push_back(&ring);
    parts.push_back({ring.ring, {}});
  }
  for (PlacedRing* hole : holes) {
    const auto known = hole->owner ? part_of.find(*hole->owner) : part_of.end();
    const std::size_t part = known != part_of.end() ? known->second : innermost_around(positions, outer, *hole);
    parts[part].holes.push_back(std::move(hole->ring));
  }
  return parts;
}

}  // namespace

// Opening and closing: the region's boundary as far as discs of the radius touch it, and arcs about those at the ends.

namespace {

class DiscBoundaries {
 public:
  /// Of a closing, what is connected is the region, of an opening the discs.
  DiscBoundaries(const DiscPositions& positions, const BoundaryOrder& order, std::uint32_t cut, Connected side)
      : positions_(positions),
        order_(order),
        cut_(cut),
        rings_(level_rings(positions.complex(), order, positions.level(), cut, Connected::region, false)),
        arcs_(corner_arcs(positions, order, rings_)) {
    cut_arcs(positions, cut, arcs_);
    run_done_.assign(rings_.runs.size(), 0);
    settle_touches(side);
    for (const ArcFragment& fragment : arcs_.fragments) fragment_done_.push_back(fragment.joined ? 1 : 0);
  }

  std::vector<DiscBoundary> make() {
    std::vector<DiscBoundary> made;
    for (std::uint32_t run = 0; run < rings_.runs.size(); ++run)
      if (!run_done_[run]) made.push_back(rings_.runs[run].whole() ? whole(run) : followed({run, kNoIndex}));
    for (std::uint32_t f = 0; f < arcs_.fragments.size(); ++f)
      if (!fragment_done_[f]) made.push_back(followed({kNoIndex, f}));
    return made;
  }

  const ArcSet& arcs() const { return arcs_; }

 private:
  /// What a boundary goes on with: a run, or a fragment of an arc.
  struct Next {
    std::uint32_t run = kNoIndex, fragment = kNoIndex;
  };

  /// Where two discs touch, boundaries go on along their discs; those of a closing turn to the other disc, so that what
  /// is pinched there comes apart. Where one boundary then passes the place twice the other way cuts it into two: rings
  /// are simple, and touch. What goes on along its disc has no corner there.
  void settle_touches(Connected side) {
    const auto swap_next = [&](std::uint32_t f, std::uint32_t g) {
      std::swap(arcs_.fragments[f].next, arcs_.fragments[g].next);
    };
    const bool turns = side == Connected::region;
    if (turns)
      for (const auto& [f, g] : arcs_.touches) swap_next(f, g);
    for (const auto& touch : arcs_.touches) {
      const std::uint32_t f = joined_into(arcs_, touch[0]), g = joined_into(arcs_, touch[1]);
      Next at = after({kNoIndex, f});
      while (at.fragment != f && at.fragment != g) at = after(at);
      const bool twice = at.fragment == g;
      if (twice) swap_next(f, g);
      if (turns != twice) continue;
      join(arcs_, f);
      join(arcs_, g);
    }
  }

  /// What follows on a boundary.
  Next after(Next at) const {
    if (at.run != kNoIndex) {
      const std::uint32_t to = rings_.runs[at.run].to, arc = arcs_.arc_after[order_.items[to].edge];
      return arc == kNoIndex ? next_along(to) : start_of(arc);
    }
    const ArcFragment& fragment = arcs_.fragments[at.fragment];
    const CornerArc& arc = arcs_.arcs[fragment.arc];
    if (fragment.end != kNoIndex) return {kNoIndex, fragment.next};
    if (arc.next != kNoIndex) return start_of(arc.next);
    return {rings_.run_from[arc.out], kNoIndex};
  }

  DiscBoundary whole(std::uint32_t run) {
    run_done_[run] = 1;
    Pieces pieces;
    append_in_place(positions_, order_, rings_.runs[run], pieces);
    const std::uint32_t loop = rings_.runs[run].loop, item = order_.first_item[loop];
    // A convex region alone sees nothing outside.
    const bool has_edge = item < order_.first_item[loop + 1];
    DiscBoundary ring;
    ring.sites.assign(pieces.list.size(), kNoIndex);
    ring.pieces = std::move(pieces.list);
    ring.headings = std::move(pieces.headings);
    ring.touching = {order_.first_site[loop]};
    if (has_edge) ring.edge = order_.items[item].edge;
    return ring;
  }

  /// Once round.
  DiscBoundary followed(Next at) {
    DiscBoundary ring;
    for (; at.run != kNoIndex ? !run_done_[at.run] : !fragment_done_[at.fragment]; at = after(at)) {
      if (at.run != kNoIndex) append_run(at.run, ring);
      else append_fragment(at.fragment, ring);
    }
    return ring;
  }

  void append_run(std::uint32_t run, DiscBoundary& ring) {
    run_done_[run] = 1;
    ring.edge = order_.items[rings_.runs[run].from].edge;
    Pieces pieces;
    append_in_place(positions_, order_, rings_.runs[run], pieces);
    ring.touching.push_back(order_.items[rings_.runs[run].from].site);
    // Of a run only the first piece can begin at a contact, on the first site.
    ring.sites.resize(ring.sites.size() + pieces.list.size(), ring.touching.back());
    ring.pieces.insert(ring.pieces.end(), pieces.list.begin(), pieces.list.end());
    ring.headings.insert(ring.headings.end(), pieces.headings.begin(), pieces.headings.end());
  }

  void append_fragment(std::uint32_t f, DiscBoundary& ring) {
    fragment_done_[f] = 1;
    const ArcFragment& fragment = arcs_.fragments[f];
    const CornerArc& arc = arcs_.arcs[fragment.arc];
    if (ring.edge == kNoIndex) ring.edge = arcs_.disc_edge[arc.disc];
    ring.pieces.push_back(arc_piece(fragment));
    ring.headings.push_back(
        {heading_at(arc, arc.start, fragment.begin, fragment.touches_at_begin ? How::touched : How::left),
         heading_at(arc, arc.stop, fragment.end, fragment.touches_at_end ? How::touched : How::entered)});
    ring.sites.push_back(arc.start);
    if (fragment.begin == kNoIndex) ring.touching.push_back(arc.start);
    if (fragment.end == kNoIndex) ring.touching.push_back(arc.stop);
  }

  /// Where the start of an arc is covered, by a disc that touches the same vertex, the boundary goes on at that vertex.
  Next start_of(std::uint32_t arc) const {
    if (arcs_.first[arc] != kNoIndex) return {kNoIndex, arcs_.first[arc]};
    return next_along(order_.item_of[arcs_.arcs[arc].edge][1]);
  }

  /// The next place of a walk, after those of an item, at which a run begins, or an arc of a disc that touches there
  /// without room to move.
  Next next_along(std::uint32_t item) const {
    const Complex& complex = positions_.complex();
    for (;;) {
      item = order_.next(complex, item);
      const BoundaryItem& here = order_.items[item];
      const Edge& edge = complex.edges[here.edge];
      if (here.up && crosses(edge, cut_)) return {rings_.run_from[here.edge], kNoIndex};
      const std::uint32_t node = here.up ? edge.high : edge.low;
      const std::uint32_t arc = positions_.level().holds(node) ? arc_after(here.edge, node) : kNoIndex;
      if (arc != kNoIndex) return start_of(arc);
    }
  }

  /// The arc about a node across the edge of the complex that comes clockwise after this one.
  std::uint32_t arc_after(std::uint32_t edge, std::uint32_t node) const {
    const Complex& complex = positions_.complex();
    std::uint32_t spoke = complex.first_spoke[node];
    while (complex.spokes[spoke].edge != edge) ++spoke;
    const Spoke& next =
        complex.spokes[spoke == complex.first_spoke[node] ? complex.first_spoke[node + 1] - 1 : spoke - 1];
    return arcs_.arc_across[next.edge][next.up ? 0 : 1];
  }

  enum class How : std::uint8_t { entered, left, touched };
  /// The heading at an end of a fragment: of its arc, at a contact, or where another disc is met.
  Heading heading_at(const CornerArc& arc, std::uint32_t site, std::uint32_t other, How how) const {
    const CornerDisc& disc = arcs_.discs[arc.disc];
    if (other == kNoIndex) return heading_at_contact(positions_, disc, site);
    return {how == How::touched ? Heading::Of::touch : Heading::Of::crossing, kNoIndex, disc, arcs_.discs[other],
            how == How::entered};
  }

  DiscPiece arc_piece(const ArcFragment& fragment) const {
    const Complex& complex = positions_.complex();
    const CornerArc& arc = arcs_.arcs[fragment.arc];
    const CornerDisc& disc = arcs_.discs[arc.disc];
    DiscPiece piece;
    piece.of = DiscPiece::Of::disc;
    piece.index = disc.index;
    piece.disc = disc;
    piece.centre = positions_.centre(disc);
    Point from, to;
    if (fragment.end == kNoIndex) to = positions_.towards(disc, complex.sites[arc.stop]);
    else if (fragment.touches_at_end) to = towards_touch(positions_, disc, arcs_.discs[fragment.end]);
    else to = towards_crossing(positions_, disc, arcs_.discs[fragment.end], true);
    if (fragment.begin == kNoIndex) {
      from = positions_.towards(disc, complex.sites[arc.start]);
      piece.from = contact_corner(positions_, disc, arc.start);
    } else {
      const CornerDisc& left = arcs_.discs[fragment.begin];
      from = fragment.touches_at_begin ? towards_touch(positions_, disc, left)
                                       : towards_crossing(positions_, disc, left, false);
      piece.from.kind = DiscCorner::Kind::crossing;
      piece.from.disc = disc;
      piece.from.other = arcs_.discs[fragment.begin];
      piece.from.at = {piece.centre.x + from.x, piece.centre.y + from.y};
    }
    piece.from_angle = std::atan2(from.y, from.x);
    piece.sweep = 0 - turn_between(std::atan2(to.y, to.x), piece.from_angle, std::numbers::pi);
    return piece;
  }

  const DiscPositions& positions_;
  const BoundaryOrder& order_;
  std::uint32_t cut_;
  LevelRings rings_;
  ArcSet arcs_;
  std::vector<std::uint8_t> run_done_, fragment_done_;
};

/// Connected sets of discs: along the complex beyond the cut, from nodes of the level to all that rises from them, and
/// where corner discs overlap. The last element is what is connected through infinity.
UnionFind connected_discs(const DiscPositions& positions, std::uint32_t cut, const ArcSet& arcs) {
  const Complex& complex = positions.complex();
  const auto infinity = static_cast<std::uint32_t>(complex.nodes.size());
  UnionFind joined(infinity + 1);
  const auto high = [&](std::uint32_t edge) { return std::min(complex.edges[edge].high, infinity); };
  for (std::uint32_t edge = 0; edge < complex.edges.size(); ++edge) {
    const Edge& e = complex.edges[edge];
    if (e.low >= cut || (positions.level().holds(e.low) && !e.flat)) joined.unite(e.low, high(edge));
  }
  for (const auto& [a, b] : arcs.overlaps) joined.unite(high(arcs.disc_edge[a]), high(arcs.disc_edge[b]));
  return joined;
}

/// Pieces of the region that a closing joins: along its rings, and across edges of the complex below the level where no
/// discs overlap.
UnionFind joined_pieces(const DiscPositions& positions, std::uint32_t cut, const ArcSet& arcs,
                        const std::vector<DiscBoundary>& rings) {
  const Complex& complex = positions.complex();
  std::uint32_t pieces = 0;
  for (const Site& site : complex.sites) pieces = std::max(pieces, site.component + 1);
  UnionFind joined(pieces);
  for (const DiscBoundary& ring : rings)
    for (const std::uint32_t site : ring.touching)
      joined.unite(complex.sites[ring.touching.front()].component, complex.sites[site].component);
  for (const Edge& edge : complex.edges) {
    const bool is_below = edge.low < positions.level().below || (edge.flat && edge.low < cut);
    if (is_below && !arcs.is_split[arcs.part[edge.low]])
      joined.unite(complex.sites[edge.left].component, complex.sites[edge.right].component);
  }
  return joined;
}

}  // namespace

DiscSet opened_set(const DiscPositions& positions, const BoundaryOrder& order, Semantics semantics) {
  const Complex& complex = positions.complex();
  const std::uint32_t cut = semantics == Semantics::regular ? positions.level().up_to : positions.level().below;
  DiscBoundaries boundaries(positions, order, cut, Connected::discs);
  UnionFind joined = connected_discs(positions, cut, boundaries.arcs());
  std::vector<OwnedRing> made;
  for (DiscBoundary& ring : boundaries.make()) {
    const bool outer = !runs_counter_clockwise(positions, ring.headings, Bend::clockwise);
    made.push_back({reversed(std::move(ring.pieces)), joined.root(complex.edges[ring.edge].high), outer});
  }
  DiscSet set;
  set.parts = parts_of(std::move(made));
  finish(positions, set);
  return set;
}

DiscSet closed_set(const DiscPositions& positions, const BoundaryOrder& order, Semantics semantics) {
  const Complex& complex = positions.complex();
  const std::uint32_t cut = semantics == Semantics::open ? positions.level().below : positions.level().up_to;
  DiscBoundaries boundaries(positions, order, cut, Connected::region);
  std::vector<DiscBoundary> rings = boundaries.make();
  DiscSet set;
  if (has_thin_walks(complex)) {
    ThinPieces thin = without_thin_pieces(positions, rings);
    set.segments = std::move(thin.segments), set.points = std::move(thin.points);
    rings = std::move(thin.rings);
  }
  UnionFind joined = joined_pieces(positions, cut, boundaries.arcs(), rings);
  std::vector<PlacedRing> placed;
  for (DiscBoundary& ring : rings) {
    PlacedRing& made = placed.emplace_back();
    made.outer = runs_counter_clockwise(positions, ring.headings, Bend::clockwise);
    made.ring = {std::move(ring.pieces)};
    made.sites = std::move(ring.sites);
    if (ring.touching.empty()) continue;
    const Site& site = complex.sites[ring.touching.front()];
    made.owner = joined.root(site.component);
    made.anchor = site.a;
  }
  set.parts = nested(positions, std::move(placed));
  finish(positions, set);
  return set;
}

}  // namespace dymsum::shape
