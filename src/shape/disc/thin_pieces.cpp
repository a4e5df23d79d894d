#include "shape/disc/thin_pieces.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <utility>

#include "shape/disc/disc_positions.h"

namespace dymsum::shape {
namespace {

using exact::Interval;
using exact::RootExpression;

/// The direction whose passes are counted. Any one does: edges along it are rare, and zeros take long.
constexpr int kFixed[] = {1021, 577};

template <class T>
Vector<T> left_of(const Vector<T>& v) {
  return {-v.y, v.x};
}
template <class T>
Vector<T> right_of(const Vector<T>& v) {
  return {v.y, -v.x};
}

/// Directions as vectors in a number type.
template <class T>
class HeadingVectors {
 public:
  explicit HeadingVectors(const DiscPositions& positions) : positions_(positions) {}

  Vector<T> of(const Heading& heading) const {
    if (heading.of == Heading::Of::edge) {
      const Site& site = positions_.complex().sites[heading.site];
      return between<T>(site.a, site.b);
    }
    if (heading.of == Heading::Of::vertex)
      return left_of(centre(heading.disc, positions_.complex().sites[heading.site].a));
    const Point origin = touched_by(heading.disc);
    const Vector<T> d = minus(centre(heading.other, origin), centre(heading.disc, origin));
    return right_of(heading.of == Heading::Of::touch ? d : crossing(d, radius(), !heading.entered));
  }

 private:
  T radius() const;
  Vector<T> centre(const CornerDisc& disc, Point origin) const;

  Point touched_by(const CornerDisc& disc) const {
    const Complex& complex = positions_.complex();
    const std::uint32_t edge = disc.at_node ? complex.spokes[complex.first_spoke[disc.index]].edge : disc.index;
    return complex.sites[complex.edges[edge].left].a;
  }

  const DiscPositions& positions_;
};

template <>
Interval HeadingVectors<Interval>::radius() const {
  return positions_.level().near;
}
template <>
RootExpression HeadingVectors<RootExpression>::radius() const {
  return positions_.level().exact;
}

template <>
Vector<Interval> HeadingVectors<Interval>::centre(const CornerDisc& disc, Point origin) const {
  if (!disc.at_node) return centre_on_edge(positions_.complex(), disc.index, positions_.level().near, origin);
  const Point c = positions_.complex().nodes[disc.index].centre;
  const double off = positions_.at_error();
  return {Interval(c.x - off, c.x + off) - Interval(origin.x), Interval(c.y - off, c.y + off) - Interval(origin.y)};
}
template <>
Vector<RootExpression> HeadingVectors<RootExpression>::centre(const CornerDisc& disc, Point origin) const {
  return positions_.exact_centre_from(disc, origin);
}

/// Counts the passes of one ring.
class PassCount {
 public:
  PassCount(const DiscPositions& positions, Bend bend)
      : positions_(positions), near_(positions), exact_(positions), bend_(bend) {}

  int of(const Headings& headings) {
    bool before = is_behind(headings.back()[1]);
    for (const auto& [start, end] : headings) {
      const bool at_start = is_behind(start);
      add(before, at_start, bend_ == Bend::clockwise ? Bend::counter_clockwise : Bend::clockwise);
      before = at_start;
      if (start.of == Heading::Of::edge && start == end) continue;  // straight on
      before = is_behind(end);
      add(at_start, before, bend_);
      if (bend_ == Bend::counter_clockwise && at_start == before && is_isolated(start) && is_long_way(start, end))
        ++count_;
    }
    return count_;
  }

 private:
  /// Whether a direction is half a turn or less clockwise of the fixed one, but not that one itself.
  bool is_behind(const Heading& heading) const {
    const auto across = [](const auto& v) {
      using T = std::decay_t<decltype(v.x)>;
      return T(kFixed[0]) * v.y - T(kFixed[1]) * v.x;
    };
    if (const auto side = sign_of(across(near_.of(heading))); side && *side != 0) return *side < 0;
    const Vector<RootExpression> v = exact_.of(heading);
    const int side = exact::sign_of(across(v));
    return side != 0 ? side < 0 : exact::sign_of(v.x) < 0;
  }

  /// Turning by half a turn at most.
  void add(bool from_behind, bool to_behind, Bend bend) {
    if (bend == Bend::counter_clockwise && from_behind && !to_behind) ++count_;
    if (bend == Bend::clockwise && !from_behind && to_behind) --count_;
  }

  bool is_isolated(const Heading& heading) const {
    const std::vector<Site>& sites = positions_.complex().sites;
    const auto shares_loop = [&](std::uint32_t site) {
      return site < sites.size() && sites[site].loop == sites[heading.site].loop;
    };
    return heading.of == Heading::Of::vertex && sites[heading.site].kind == Site::Kind::vertex &&
           !shares_loop(heading.site + 1) && !shares_loop(heading.site - 1);
  }

  /// Whether, of two directions in one half plane, it takes more than half a turn counter-clockwise, past the fixed
  /// direction, or a whole one.
  bool is_long_way(const Heading& from, const Heading& to) const {
    if (const auto side = sign_of(cross(near_.of(from), near_.of(to)))) return *side <= 0;
    return exact::sign_of(cross(exact_.of(from), exact_.of(to))) <= 0;
  }

  const DiscPositions& positions_;
  HeadingVectors<Interval> near_;
  HeadingVectors<RootExpression> exact_;
  Bend bend_;
  int count_ = 0;
};

}  // namespace

bool runs_counter_clockwise(const DiscPositions& positions, const Headings& headings, Bend bend) {
  if (headings.empty()) return bend == Bend::counter_clockwise;
  const int count = PassCount(positions, bend).of(headings);
  if (count != 1 && count != -1) throw std::logic_error("a ring of a disc's set does not go round once");
  return count > 0;
}

namespace {

/// The site on the other side of every edge of a polyline; kNoIndex for what has area beside it.
std::vector<std::uint32_t> other_sides(const Complex& complex) {
  using Ends = std::tuple<double, double, double, double>;
  std::map<Ends, std::uint32_t> edges;
  const auto is_edge = [&](std::uint32_t s) { return complex.sites[s].kind == Site::Kind::edge; };
  for (std::uint32_t s = 0; s < complex.sites.size(); ++s)
    if (const Site& site = complex.sites[s]; is_edge(s)) edges[{site.a.x, site.a.y, site.b.x, site.b.y}] = s;
  std::vector<std::uint32_t> other(complex.sites.size(), kNoIndex);
  for (std::uint32_t s = 0; s < complex.sites.size(); ++s) {
    const Site& site = complex.sites[s];
    const auto found = is_edge(s) ? edges.find({site.b.x, site.b.y, site.a.x, site.a.y}) : edges.end();
    if (found != edges.end()) other[s] = found->second;
  }
  return other;
}

struct Corner {
  DiscCorner corner;
  std::uint32_t site = kNoIndex;  ///< where a contact lies
};

/// A corner on a segment, and how far along it lies, times the segment's length.
struct Stop {
  Corner at;
  Interval near;
  std::function<RootExpression()> exact;
};

int compare(const Stop& a, const Stop& b) {
  if (const auto sign = sign_of(a.near - b.near)) return *sign;
  return exact::sign_of(a.exact() - b.exact());
}

/// A piece of a ring in a graph of all of them.
struct HalfPiece {
  DiscPiece piece;
  std::array<Heading, 2> headings;
  Corner from, to;
  std::uint32_t next = kNoIndex, previous = kNoIndex;
  bool gone = false;
};

class ThinPieceFinder {
 public:
  ThinPieceFinder(const DiscPositions& positions, const std::vector<DiscBoundary>& rings)
      : positions_(positions), other_(other_sides(positions.complex())) {
    for (const DiscBoundary& ring : rings) add(ring);
  }

  ThinPieces run() {
    std::map<std::uint32_t, std::vector<std::uint32_t>> on_site;
    for (std::uint32_t h = 0; h < halves_.size(); ++h)
      if (const std::uint32_t s = edge_site(h); s != kNoIndex && other_[s] != kNoIndex) on_site[s].push_back(h);
    for (const auto& [site, halves] : on_site) {
      if (other_[site] < site) continue;
      const auto back = on_site.find(other_[site]);
      if (back != on_site.end()) take_apart(complex().sites[site], {halves, back->second});
    }
    collect();
    return std::move(made_);
  }

 private:
  const Complex& complex() const { return positions_.complex(); }

  void add(const DiscBoundary& ring) {
    if (ring.pieces.empty()) {
      const Site& site = complex().sites[ring.touching.front()];
      DiscCorner corner;
      corner.kind = DiscCorner::Kind::vertex;
      corner.vertex = site.index;
      corner.at = site.a;
      made_.points.push_back(corner);
      return;
    }
    const auto first = static_cast<std::uint32_t>(halves_.size()),
               count = static_cast<std::uint32_t>(ring.pieces.size());
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t next = (k + 1) % count;
      halves_.push_back({ring.pieces[k],
                         ring.headings[k],
                         {ring.pieces[k].from, ring.sites[k]},
                         {ring.pieces[next].from, ring.sites[next]},
                         first + next,
                         first + (k + count - 1) % count});
    }
  }

  /// The site of a piece along an edge.
  std::uint32_t edge_site(std::uint32_t h) const {
    return halves_[h].piece.of == DiscPiece::Of::edge ? halves_[h].headings[0].site : kNoIndex;
  }

  Stop stop_at(const Corner& position, const Site& along) const {
    const auto& [corner, site] = position;
    Stop stop{position, {}, {}};
    const bool at_vertex = corner.kind == DiscCorner::Kind::vertex;
    if (at_vertex || complex().sites[site].kind == Site::Kind::vertex) {
      const Point at = at_vertex ? corner.at : complex().sites[site].a;
      stop.near = dot(between<Interval>(along.a, at), between<Interval>(along.a, along.b));
      stop.exact = [&along, at] {
        return dot(between<RootExpression>(along.a, at), between<RootExpression>(along.a, along.b));
      };
      return stop;
    }
    // The foot of the disc's centre.
    const double off = positions_.at_error();
    const Point c = positions_.centre(corner.disc);
    const Vector<Interval> near{Interval(c.x - off, c.x + off) - Interval(along.a.x),
                                Interval(c.y - off, c.y + off) - Interval(along.a.y)};
    stop.near = dot(near, between<Interval>(along.a, along.b));
    stop.exact = [this, &along, disc = corner.disc] {
      return dot(positions_.exact_centre_from(disc, along.a), between<RootExpression>(along.a, along.b));
    };
    return stop;
  }

  /// The pieces on both sides of one segment, cut where what is thin begins and ends, and without that.
  void take_apart(const Site& along, const std::array<std::vector<std::uint32_t>, 2>& sides) {
    std::vector<Stop> stops;
    for (const std::vector<std::uint32_t>& halves : sides)
      for (const std::uint32_t h : halves)
        stops.push_back(stop_at(halves_[h].from, along)), stops.push_back(stop_at(halves_[h].to, along));
    std::vector<std::size_t> order(stops.size()), index(stops.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return compare(stops[a], stops[b]) < 0; });
    std::vector<std::size_t> positions;  // the first stop at each, ascending
    for (const std::size_t k : order) {
      if (positions.empty() || compare(stops[positions.back()], stops[k]) != 0) positions.push_back(k);
      index[k] = positions.size() - 1;
    }
    // Gap k lies between places k and k + 1.
    std::vector<std::array<std::uint32_t, 2>> pieces(positions.size(), {kNoIndex, kNoIndex});
    const auto is_thin = [&](std::size_t gap) { return pieces[gap][0] != kNoIndex && pieces[gap][1] != kNoIndex; };
    const auto for_each_span = [&](const auto& use) {
      std::size_t stop = 0;
      for (std::size_t side = 0; side < 2; ++side)
        for (const std::uint32_t h : sides[side]) {
          const auto [from, to] = std::minmax(index[stop], index[stop + 1]);
          use(side, h, from, to);
          stop += 2;
        }
    };
    for_each_span([&](std::size_t side, std::uint32_t h, std::size_t from, std::size_t to) {
      for (std::size_t gap = from; gap < to; ++gap) pieces[gap][side] = h;
    });
    for_each_span([&](std::size_t side, std::uint32_t h, std::size_t from, std::size_t to) {
      for (std::size_t n = 0; n < to - from; ++n) {
        const std::size_t gap = side == 0 ? from + n : to - 1 - n;
        pieces[gap][side] = h;
        if (n + 1 == to - from) return;
        if (is_thin(gap) || is_thin(side == 0 ? gap + 1 : gap - 1))
          h = cut(h, stops[positions[side == 0 ? gap + 1 : gap]].at);
      }
    });
    for (std::size_t gap = 0; gap + 1 < positions.size(); ++gap) {
      if (!is_thin(gap)) continue;
      const DiscCorner &from = stops[positions[gap]].at.corner, &to = stops[positions[gap + 1]].at.corner;
      if (gap > 0 && is_thin(gap - 1)) made_.segments.back().to = to;
      else made_.segments.push_back({from, to});
      remove(pieces[gap][0], pieces[gap][1]);
    }
  }

  /// Cuts a piece in two; returns the second.
  std::uint32_t cut(std::uint32_t h, const Corner& position) {
    const auto second = static_cast<std::uint32_t>(halves_.size());
    HalfPiece rest = halves_[h];
    rest.from = halves_[h].to = position;
    rest.piece.from = position.corner;
    rest.previous = h;
    halves_[rest.next].previous = second;
    halves_[h].next = second;
    halves_.push_back(std::move(rest));
    return second;
  }

  void remove(std::uint32_t h, std::uint32_t g) {
    const HalfPiece there = halves_[h], back = halves_[g];
    halves_[h].gone = halves_[g].gone = true;
    if (there.previous != g) join(there.previous, back.next);
    if (back.previous != h) join(back.previous, there.next);
  }
  void join(std::uint32_t first, std::uint32_t second) {
    halves_[first].next = second;
    halves_[second].previous = first;
  }

  void collect() {
    std::vector<std::uint8_t> done(halves_.size(), 0);
    for (std::uint32_t start = 0; start < halves_.size(); ++start) {
      if (done[start] || halves_[start].gone) continue;
      DiscBoundary& ring = made_.rings.emplace_back();
      for (std::uint32_t h = start; !done[h]; h = halves_[h].next) {
        done[h] = 1;
        ring.pieces.push_back(std::move(halves_[h].piece));
        ring.headings.push_back(halves_[h].headings);
        ring.sites.push_back(halves_[h].from.site);
      }
    }
  }

  const DiscPositions& positions_;
  std::vector<std::uint32_t> other_;
  std::vector<HalfPiece> halves_;
  ThinPieces made_;
};

}  // namespace

bool has_thin_walks(const Complex& complex) {
  const std::vector<std::uint32_t> other = other_sides(complex);
  if (std::any_of(other.begin(), other.end(), [](std::uint32_t s) { return s != kNoIndex; })) return true;
  for (std::size_t s = 0; s < complex.sites.size(); ++s) {
    const auto shares_loop = [&](std::size_t t) {
      return t < complex.sites.size() && complex.sites[t].loop == complex.sites[s].loop;
    };
    if (!shares_loop(s + 1) && !shares_loop(s - 1)) return true;
  }
  return false;
}

ThinPieces without_thin_pieces(const DiscPositions& positions, const std::vector<DiscBoundary>& rings) {
  return ThinPieceFinder(positions, rings).run();
}

}  // namespace dymsum::shape
