#include "shape/disc/run_pieces.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace dymsum::shape {

namespace {

constexpr double kPi = std::numbers::pi;

double angle_of(Point v) { return std::atan2(v.y, v.x); }

/// The sites of a run in the order of the walk, each with its index and whether the run begins and ends on it.
template <class Use>
void for_each_site(const DiscPositions& positions, const BoundaryOrder& order, const Run& run, const Use& use) {
  const std::uint32_t first = order.first_site[run.loop], sites = order.first_site[run.loop + 1] - first;
  std::uint32_t begin = 0, count = sites;
  if (!run.whole()) {
    begin = order.items[run.from].site - first;
    count = (order.items[run.to].site - first + sites - begin) % sites + 1;
    // Both ends on one site, but the last one in front of the first: once round.
    if (count == 1 && run.to < run.from && sites > 1) count = sites + 1;
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t index = first + (begin + i) % sites;
    use(positions.complex().sites[index], index, i == 0 && !run.whole(), i + 1 == count && !run.whole());
  }
}

/// A full turn where both ends are one direction; what doubles do not decide, the exact vectors do.
double turn_about_point(const DiscPositions& positions, const CornerDisc& from, const CornerDisc& to, Point centre,
                        double turn) {
  constexpr double kClear = 1e-9;  // far beyond the error of two angles
  if (turn > kClear && turn < 2 * kPi - kClear) return turn;
  const auto u = positions.exact_centre_from(from, centre), v = positions.exact_centre_from(to, centre);
  const int side = exact::sign_of(cross(u, v));
  if (side > 0) return turn > kPi ? turn - 2 * kPi : turn;
  if (side < 0) return turn > kPi ? turn : turn + 2 * kPi;
  return 2 * kPi;
}

DiscCorner vertex_corner(std::uint32_t vertex, Point at) {
  DiscCorner corner;
  corner.kind = DiscCorner::Kind::vertex;
  corner.vertex = vertex;
  corner.at = at;
  return corner;
}

/// `known` is one whose position may be the same.
DiscCorner centre_corner(const DiscPositions& positions, std::uint32_t edge, const DiscCorner& known) {
  DiscCorner corner;
  corner.kind = DiscCorner::Kind::centre;
  corner.disc = positions.disc_on(edge);
  if (known.kind == corner.kind && known.disc == corner.disc) return known;
  corner.at = positions.centre(corner.disc);
  return corner;
}

/// The corner at which a moved edge meets the arc about a vertex at one of its ends.
DiscCorner joint_corner(const DiscPositions& positions, const Site& vertex, const Site& edge) {
  const Point n = positions.normal(edge);
  const double r = positions.level().radius;
  return vertex_corner(vertex.index, {vertex.a.x + r * n.x, vertex.a.y + r * n.y});
}

std::uint32_t index_of_neighbour(const DiscPositions& positions, const BoundaryOrder& order, std::uint32_t site,
                                 int step) {
  const std::uint32_t loop = positions.complex().sites[site].loop;
  const std::uint32_t first = order.first_site[loop], last = order.first_site[loop + 1];
  if (step > 0) return site + 1 == last ? first : site + 1;
  return site == first ? last - 1 : site - 1;
}
const Site& neighbour(const DiscPositions& positions, const BoundaryOrder& order, std::uint32_t site, int step) {
  return positions.complex().sites[index_of_neighbour(positions, order, site, step)];
}

DiscCorner joint_with(const DiscPositions& positions, const BoundaryOrder& order, std::uint32_t site, int step) {
  const Site &here = positions.complex().sites[site], &other = neighbour(positions, order, site, step);
  return here.kind == Site::Kind::vertex ? joint_corner(positions, here, other) : joint_corner(positions, other, here);
}

DiscPiece moved_edge(const Site& site, DiscCorner from) {
  DiscPiece piece;
  piece.of = DiscPiece::Of::edge;
  piece.index = site.index;
  piece.heading = angle_of({site.b.x - site.a.x, site.b.y - site.a.y});
  piece.from = from;
  return piece;
}

void append_edge(std::uint32_t site, DiscPiece piece, Pieces& pieces) {
  pieces.list.push_back(std::move(piece));
  pieces.headings.push_back({Heading{Heading::Of::edge, site}, Heading{Heading::Of::edge, site}});
}

/// The vector from the vertex to a corner of its arc.
Point arm(const DiscPositions& positions, const BoundaryOrder& order, std::uint32_t site, const DiscCorner& corner,
          int step) {
  const Point v = positions.complex().sites[site].a;
  if (corner.kind == DiscCorner::Kind::centre) {
    // The difference of two positions does where the disc is not small for where it is. A point tells by its angles
    // whether it has all or nothing of its circle.
    constexpr double kSmall = 0x1p-16;
    const std::uint32_t loop = positions.complex().sites[site].loop;
    const bool alone = order.first_site[loop + 1] - order.first_site[loop] == 1;
    if (!alone && positions.level().radius > kSmall * positions.reach()) return {corner.at.x - v.x, corner.at.y - v.y};
    return positions.centre_from(corner.disc, v);
  }
  return positions.normal(neighbour(positions, order, site, step));
}

/// The heading of an arc about a vertex, at a corner of it: that of the edge on the side of `step`, or about the
/// vertex.
Heading heading_at_corner(const DiscPositions& positions, const BoundaryOrder& order, std::uint32_t site,
                          const DiscCorner& corner, int step) {
  if (corner.kind == DiscCorner::Kind::centre) return {Heading::Of::vertex, site, corner.disc};
  return {Heading::Of::edge, index_of_neighbour(positions, order, site, step)};
}

DiscPiece arc_about_vertex(const DiscPositions& positions, const BoundaryOrder& order, std::uint32_t index,
                           const DiscCorner& from, const DiscCorner& to) {
  const Site& site = positions.complex().sites[index];
  DiscPiece piece;
  piece.of = DiscPiece::Of::vertex;
  piece.index = site.index;
  piece.centre = site.a;
  piece.from = from;
  const bool alone = order.first_site[site.loop + 1] - order.first_site[site.loop] == 1;
  if (from.kind == DiscCorner::Kind::none) {
    piece.sweep = 2 * kPi;
    return piece;
  }
  piece.from_angle = angle_of(arm(positions, order, index, from, -1));
  const double to_angle = angle_of(arm(positions, order, index, to, 1));
  piece.sweep = turn_between(piece.from_angle, to_angle, alone ? 2 * kPi : kPi);
  if (alone) piece.sweep = turn_about_point(positions, from.disc, to.disc, site.a, piece.sweep);
  return piece;
}

/// Whether the disc at an end of a run touches where the site there goes over into the next one: nothing of it is in
/// the run.
bool empty_at_end(const DiscPositions& positions, const BoundaryOrder& order, std::uint32_t item, bool begins) {
  const Complex& complex = positions.complex();
  const BoundaryItem& here = order.items[item];
  const std::uint32_t high = complex.edges[here.edge].high;
  if (high == kNoIndex || !positions.level().holds(high)) return false;
  const BoundaryItem& inner = order.items[begins ? order.next(complex, item) : order.previous(complex, item)];
  return inner.site != here.site || crosses(complex.edges[inner.edge], positions.level().below);
}

}  // namespace

double turn_between(double from_angle, double to_angle, double most) {
  double turn = std::fmod(to_angle - from_angle, 2 * kPi);
  if (turn < 0) turn += 2 * kPi;
  if (turn == 0) return 0;  // not -0
  return most < 2 * kPi && turn > most + kPi / 4 ? 0 : turn;
}

Heading heading_at_contact(const DiscPositions& positions, const CornerDisc& disc, std::uint32_t site) {
  if (positions.complex().sites[site].kind == Site::Kind::edge) return {Heading::Of::edge, site};
  return {Heading::Of::vertex, site, disc};
}

DiscCorner contact_corner(const DiscPositions& positions, const CornerDisc& disc, std::uint32_t site) {
  DiscCorner corner;
  corner.kind = DiscCorner::Kind::contact;
  corner.disc = disc;
  const Site& s = positions.complex().sites[site];
  if (s.kind == Site::Kind::vertex) return vertex_corner(s.index, s.a);
  corner.at = positions.contact(corner.disc, s);
  return corner;
}

void append_moved(const DiscPositions& positions, const BoundaryOrder& order, const Run& run, Pieces& pieces) {
  DiscCorner from;
  const bool whole = run.whole();
  const bool circle = whole && order.first_site[run.loop + 1] - order.first_site[run.loop] == 1;
  if (!whole) from = centre_corner(positions, order.items[run.from].edge, pieces.end);
  else if (!circle) from = joint_with(positions, order, order.first_site[run.loop], -1);
  for_each_site(positions, order, run, [&](const Site& site, std::uint32_t index, bool, bool ends) {
    DiscCorner to;
    if (ends) to = centre_corner(positions, order.items[run.to].edge, {});
    else if (!circle) to = joint_with(positions, order, index, 1);
    if (site.kind == Site::Kind::edge) {
      append_edge(index, moved_edge(site, from), pieces);
    } else {
      pieces.list.push_back(arc_about_vertex(positions, order, index, from, to));
      if (!circle)
        pieces.headings.push_back(
            {heading_at_corner(positions, order, index, from, -1), heading_at_corner(positions, order, index, to, 1)});
    }
    from = to;
  });
  pieces.end = from;
}

void append_in_place(const DiscPositions& positions, const BoundaryOrder& order, const Run& run, Pieces& pieces) {
  for_each_site(positions, order, run, [&](const Site& site, std::uint32_t index, bool begins, bool ends) {
    if (site.kind == Site::Kind::vertex) return;
    if (begins && empty_at_end(positions, order, run.from, true)) return;
    if (ends && empty_at_end(positions, order, run.to, false)) return;
    const auto end_of_edge = [&](int step, Point at) {
      return vertex_corner(neighbour(positions, order, index, step).kind == Site::Kind::vertex
                               ? neighbour(positions, order, index, step).index
                               : kNoIndex,
                           at);
    };
    append_edge(
        index,
        moved_edge(site, begins ? contact_corner(positions, positions.disc_on(order.items[run.from].edge), index)
                                : end_of_edge(-1, site.a)),
        pieces);
    pieces.end =
        ends ? contact_corner(positions, positions.disc_on(order.items[run.to].edge), index) : end_of_edge(1, site.b);
  });
}

}  // namespace dymsum::shape
