#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/poll.h"
#include "exact/orient.h"
#include "shape/decompose/cut_search.h"
#include "shape/decompose/wall_set.h"

namespace dymsum::shape {

// The region with its cuts as a planar graph: points, sections of edges and cuts between them.

/// A vertex of the graph, exactly and with bounds.
struct Spot {
  RationalPoint at;
  exact::Interval x, y;
};

/// A section of an edge or of a cut inside the region, between neighbouring points.
struct WallSection {
  std::uint32_t from, to;  ///< points, in the direction of the wall
  std::uint32_t wall;      ///< edges, then cuts
};

struct Sections {
  std::vector<Spot> spots;  ///< the vertices of the region first
  std::vector<Wall> walls;  ///< edges, then cuts
  std::uint32_t edges = 0;
  std::vector<WallSection> all;
};
Sections make_sections(const RingTable& table, const std::vector<PlacedCut>& cuts);

/// Half-edge 2s runs along section s, 2s + 1 against it. The one that follows with the same piece on the left; for
/// those against an edge, which bound nothing, any number.
std::vector<std::uint32_t> following(const Sections& sections);

/// The sign of a.x - b.x and of a.y - b.y. Exact.
int compare_x(const Spot& a, const Spot& b);
int compare_y(const Spot& a, const Spot& b);
/// The sign of (b - a) x (c - a). Exact.
int turn_sign(const Spot& a, const Spot& b, const Spot& c);

namespace {

constexpr std::uint32_t kNew = std::numeric_limits<std::uint32_t>::max();

/// A position along an edge or a cut.
struct Position {
  Rational t;
  std::uint32_t cut;      ///< the cut that ends there, or passes
  std::uint32_t passage;  ///< kNew: its end
};

class SectionMaker {
 public:
  SectionMaker(const RingTable& table, const std::vector<PlacedCut>& cuts)
      : table_(table), cuts_(cuts), ends_(cuts.size(), kNew), passages_(cuts.size()) {
    made_.edges = std::uint32_t(table.at.size());
    for (std::uint32_t v = 0; v < table.at.size(); ++v) {
      made_.spots.push_back(
          {rational_point(table.at[v]), exact::Interval(table.at[v].x), exact::Interval(table.at[v].y)});
      made_.walls.push_back(edge_wall(table.at[v], table.at[table.next[v]], v, table.ring[v]));
    }
    for (std::uint32_t c = 0; c < cuts.size(); ++c)
      made_.walls.push_back(cut_wall(table.at[cuts[c].cut.vertex], cuts[c].cut.to, c, table.ring[cuts[c].cut.vertex]));
  }

  Sections run() {
    position_on_edges();
    std::vector<std::vector<std::uint32_t>> ends_at(cuts_.size());
    for (std::uint32_t c = 0; c < cuts_.size(); ++c)
      if (cuts_[c].cut.end == Cut::End::cut) ends_at[cuts_[c].cut.index].push_back(c);
    for (std::uint32_t c = 0; c < cuts_.size(); ++c) cut_sections(c, ends_at[c]);
    return std::move(made_);
  }

 private:
  std::uint32_t add_spot(const RationalPoint& at) {
    made_.spots.push_back({at, bounds_of(at.x), bounds_of(at.y)});
    return std::uint32_t(made_.spots.size() - 1);
  }

  /// Numbers the points where cuts meet the boundary, equal ones alike, and adds the sections of edges.
  void position_on_edges() {
    std::vector<std::vector<Position>> positions(made_.edges);
    for (std::uint32_t c = 0; c < cuts_.size(); ++c) {
      const Cut& cut = cuts_[c].cut;
      if (cut.end == Cut::End::vertex) ends_[c] = cut.index;
      if (cut.end == Cut::End::edge) positions[cut.index].push_back({cuts_[c].t, c, kNew});
      for (std::uint32_t p = 0; p < cuts_[c].over.size(); ++p) {
        const Passage& passage = cuts_[c].over[p];
        passages_[c].push_back(passage.at_vertex ? passage.index : kNew);
        if (!passage.at_vertex) positions[passage.index].push_back({passage.on_edge, c, p});
      }
    }
    for (std::uint32_t e = 0; e < made_.edges; ++e) {
      std::sort(positions[e].begin(), positions[e].end(), [](const Position& a, const Position& b) {
        return a.t != b.t ? a.t < b.t : std::pair(a.cut, a.passage) < std::pair(b.cut, b.passage);
      });
      std::uint32_t last = e;
      for (std::size_t i = 0; i < positions[e].size(); ++i) {
        const Position& position = positions[e][i];
        const PlacedCut& cut = cuts_[position.cut];
        if (i == 0 || position.t != positions[e][i - 1].t) {
          const std::uint32_t spot = add_spot(position.passage == kNew ? cut.cut.to : cut.over[position.passage].at);
          made_.all.push_back({last, spot, e});
          last = spot;
        }
        (position.passage == kNew ? ends_[position.cut] : passages_[position.cut][position.passage]) = last;
      }
      made_.all.push_back({last, table_.next[e], e});
    }
  }

  struct Stop {
    Rational t;
    std::uint32_t spot;     ///< kNew: not numbered yet
    std::uint32_t passage;  ///< kNew: none
    std::uint32_t ending;   ///< the cut that ends there, kNew: none
  };

  /// Numbers the points where later cuts end at this one.
  void cut_sections(std::uint32_t c, const std::vector<std::uint32_t>& ending) {
    const std::uint32_t wall = made_.edges + c;
    std::vector<Stop> stops{{Rational(0), cuts_[c].cut.vertex, kNew, kNew}};
    for (std::uint32_t p = 0; p < passages_[c].size(); ++p)
      stops.push_back({cuts_[c].over[p].on_cut, passages_[c][p], p, kNew});
    stops.push_back({Rational(1), ends_[c], kNew, kNew});
    for (const std::uint32_t d : ending) stops.push_back({cuts_[d].t, kNew, kNew, d});
    std::stable_sort(stops.begin(), stops.end(), [](const Stop& a, const Stop& b) { return a.t < b.t; });
    bool inside = true;
    std::uint32_t last = stops.front().spot;
    for (std::size_t i = 1; i < stops.size(); ++i) {
      Stop& stop = stops[i];
      if (stop.spot == kNew) stop.spot = stop.t == stops[i - 1].t ? last : add_spot(cuts_[stop.ending].cut.to);
      if (stop.ending != kNew) ends_[stop.ending] = stop.spot;
      if (inside && stop.spot != last) made_.all.push_back({last, stop.spot, wall});
      if (stop.passage != kNew) inside = cuts_[c].over[stop.passage].enters;
      last = stop.spot;
    }
  }

  const RingTable& table_;
  const std::vector<PlacedCut>& cuts_;
  Sections made_;
  std::vector<std::uint32_t> ends_;                   ///< cut -> point
  std::vector<std::vector<std::uint32_t>> passages_;  ///< cut -> points
};

/// Compares the directions of half-edges, counter-clockwise from the positive x axis. Exact.
class Directions {
 public:
  explicit Directions(const Sections& sections) : sections_(sections) {}

  bool before(std::uint32_t g, std::uint32_t h) const {
    const bool lower = is_lower(g);
    if (lower != is_lower(h)) return !lower;
    const int sign = cross(wall(g), wall(h));
    return ((g ^ h) & 1) == 0 ? sign > 0 : sign < 0;
  }

 private:
  const Wall& wall(std::uint32_t h) const { return sections_.walls[sections_.all[h / 2].wall]; }
  static int along(double a, double b, const exact::Interval& bounds, const Rational* end) {
    if (end == nullptr) return (b > a) - (b < a);
    if (const std::optional<int> sign = sign_of(bounds - exact::Interval(a))) return *sign;
    return (*end - Rational::of(a).value()).sign();
  }
  bool is_lower(std::uint32_t h) const {
    const Wall& w = wall(h);
    const int dy = along(w.a.y, w.b.y, w.by, w.to ? &w.to->y : nullptr);
    const int d = dy != 0 ? dy : along(w.a.x, w.b.x, w.bx, w.to ? &w.to->x : nullptr);
    return (h & 1) == 0 ? d < 0 : d > 0;
  }
  static int cross(const Wall& v, const Wall& w) {
    if (!v.to && !w.to) return exact::cross_sign(v.a, v.b, w.a, w.b);
    const exact::Interval vx = v.bx - exact::Interval(v.a.x), vy = v.by - exact::Interval(v.a.y),
                          wx = w.bx - exact::Interval(w.a.x), wy = w.by - exact::Interval(w.a.y);
    if (const std::optional<int> sign = sign_of(vx * wy - vy * wx)) return *sign;
    const RationalPoint a = v.from(), b = v.end(), c = w.from(), d = w.end();
    return ((b.x - a.x) * (d.y - c.y) - (b.y - a.y) * (d.x - c.x)).sign();
  }

  const Sections& sections_;
};

}  // namespace

Sections make_sections(const RingTable& table, const std::vector<PlacedCut>& cuts) {
  return SectionMaker(table, cuts).run();
}

std::vector<std::uint32_t> following(const Sections& sections) {
  const auto halves = std::uint32_t(2 * sections.all.size());
  const auto origin = [&](std::uint32_t h) { return h % 2 == 0 ? sections.all[h / 2].from : sections.all[h / 2].to; };
  std::vector<std::uint32_t> first(sections.spots.size() + 1, 0), around(halves), next(halves);
  for (std::uint32_t h = 0; h < halves; ++h) ++first[origin(h) + 1];
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<std::uint32_t> filled(first);
  for (std::uint32_t h = 0; h < halves; ++h) around[filled[origin(h)]++] = h;
  const Directions directions(sections);
  for (std::size_t p = 0; p + 1 < first.size(); ++p) {
    const std::uint32_t begin = first[p], end = first[p + 1];
    if (end - begin > 2)
      std::sort(around.begin() + begin, around.begin() + end,
                [&](std::uint32_t g, std::uint32_t h) { return directions.before(g, h); });
    // Arriving against a half-edge, the way on with the same face on the left is the one before it.
    for (std::uint32_t k = begin; k < end; ++k) next[around[k] ^ 1] = around[k == begin ? end - 1 : k - 1];
  }
  return next;
}

int compare_x(const Spot& a, const Spot& b) {
  if (const std::optional<int> sign = sign_of(a.x - b.x)) return *sign;
  return (a.at.x - b.at.x).sign();
}
int compare_y(const Spot& a, const Spot& b) {
  if (const std::optional<int> sign = sign_of(a.y - b.y)) return *sign;
  return (a.at.y - b.at.y).sign();
}
int turn_sign(const Spot& a, const Spot& b, const Spot& c) {
  if (const std::optional<int> sign = sign_of((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x))) return *sign;
  return ((b.at.x - a.at.x) * (c.at.y - a.at.y) - (b.at.y - a.at.y) * (c.at.x - a.at.x)).sign();
}

namespace {

constexpr std::uint32_t kNowhere = std::numeric_limits<std::uint32_t>::max();

using Loop = std::vector<std::uint32_t>;

/// A loop that passes a point twice, as simple ones that touch there.
std::vector<Loop> simple_loops(const Loop& loop, std::vector<std::uint32_t>& position) {
  std::vector<Loop> made;
  Loop open;
  for (const std::uint32_t p : loop) {
    if (position[p] != kNowhere) {
      const auto first = open.begin() + position[p];
      for (auto q = first; q != open.end(); ++q) position[*q] = kNowhere;
      made.emplace_back(first, open.end());
      open.erase(first, open.end());
    }
    position[p] = std::uint32_t(open.size());
    open.push_back(p);
  }
  for (const std::uint32_t p : open) position[p] = kNowhere;
  made.push_back(std::move(open));
  return made;
}

class PieceMaker {
 public:
  explicit PieceMaker(const Sections& sections) : spots_(sections.spots) {}

  /// Takes the simple loops of one cycle: one of them, if any, is the outer ring of a piece, the others are its holes.
  void add_cycle(std::vector<Loop> loops) {
    std::optional<std::size_t> outer;
    for (std::size_t i = 0; i < loops.size(); ++i) {
      begin_lowest(loops[i]);
      if (is_outer(loops[i])) outer = i;
    }
    std::vector<Loop>* holes = &loose_;
    if (outer) {
      pieces_.push_back({std::move(loops[*outer]), {}});
      holes = &pieces_.back().holes;
    }
    for (std::size_t i = 0; i < loops.size(); ++i)
      if (!outer || i != *outer) holes->push_back(std::move(loops[i]));
  }

  std::vector<Piece> run(const Poll& poll) {
    std::vector<PlainBox> boxes;
    if (!loose_.empty())
      for (const LoopPiece& piece : pieces_) boxes.push_back(box_of(piece.outer));
    for (Loop& hole : loose_) {
      poll(0);
      holder_of(hole.front(), boxes).holes.push_back(std::move(hole));
    }
    for (LoopPiece& piece : pieces_)
      std::sort(piece.holes.begin(), piece.holes.end(), [this](const Loop& a, const Loop& b) { return before(a, b); });
    std::sort(pieces_.begin(), pieces_.end(),
              [this](const LoopPiece& a, const LoopPiece& b) { return before(a.outer, b.outer); });
    std::vector<Piece> made;
    for (const LoopPiece& piece : pieces_) {
      made.push_back({ring_of(piece.outer), {}});
      for (const Loop& hole : piece.holes) made.back().holes.push_back(ring_of(hole));
    }
    return made;
  }

 private:
  struct LoopPiece {
    Loop outer;
    std::vector<Loop> holes;
  };
  struct PlainBox {
    double x0, x1, y0, y1;
  };

  int compare(std::uint32_t p, std::uint32_t q) const {
    if (p == q) return 0;
    const int x = compare_x(spots_[p], spots_[q]);
    return x != 0 ? x : compare_y(spots_[p], spots_[q]);
  }
  /// The order of loops by their points, which are in lexicographic order.
  bool before(const Loop& a, const Loop& b) const {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                        [this](std::uint32_t p, std::uint32_t q) { return compare(p, q) < 0; });
  }
  void begin_lowest(Loop& loop) const {
    const auto lowest = std::min_element(loop.begin(), loop.end(),
                                         [this](std::uint32_t p, std::uint32_t q) { return compare(p, q) < 0; });
    std::rotate(loop.begin(), lowest, loop.end());
  }
  /// Counter-clockwise. The loop turns at its lowest point as it does as a whole, or not at all.
  bool is_outer(const Loop& loop) const {
    const Spot &before = spots_[loop.back()], &at = spots_[loop.front()], &after = spots_[loop[1]];
    return turn_sign(before, at, after) > 0;
  }
  RationalRing ring_of(const Loop& loop) const {
    RationalRing ring;
    for (const std::uint32_t p : loop) ring.push_back(spots_[p].at);
    return ring;
  }

  PlainBox box_of(const Loop& loop) const {
    const Spot& first = spots_[loop.front()];
    PlainBox box{first.x.low(), first.x.high(), first.y.low(), first.y.high()};
    for (const std::uint32_t p : loop) {
      const Spot& s = spots_[p];
      box = {std::min(box.x0, s.x.low()), std::max(box.x1, s.x.high()), std::min(box.y0, s.y.low()),
             std::max(box.y1, s.y.high())};
    }
    return box;
  }
  /// Whether a ray from p to the left crosses the loop an odd number of times.
  bool contains(const Loop& loop, std::uint32_t p) const {
    bool odd = false;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Spot &a = spots_[loop[i]], &b = spots_[loop[i + 1 == loop.size() ? 0 : i + 1]];
      if ((a.x.low() > spots_[p].x.high() && b.x.low() > spots_[p].x.high()) ||
          (a.y.high() < spots_[p].y.low() && b.y.high() < spots_[p].y.low()) ||
          (a.y.low() > spots_[p].y.high() && b.y.low() > spots_[p].y.high()))
        continue;
      const bool up = compare_y(a, spots_[p]) <= 0;
      if (up != (compare_y(b, spots_[p]) > 0)) continue;
      if (turn_sign(a, b, spots_[p]) == (up ? -1 : 1)) odd = !odd;
    }
    return odd;
  }
  bool smaller(const Loop& a, const Loop& b) const {
    const auto wide_area = [this](const Loop& loop) {
      exact::Interval sum;
      const Spot& o = spots_[loop.front()];
      for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        const Spot &p = spots_[loop[i]], &q = spots_[loop[i + 1]];
        sum += (p.x - o.x) * (q.y - o.y) - (q.x - o.x) * (p.y - o.y);
      }
      return sum;
    };
    if (const std::optional<int> sign = sign_of(wide_area(a) - wide_area(b))) return *sign < 0;
    return twice_area(ring_of(a)) < twice_area(ring_of(b));
  }
  /// The piece around the lowest point of a hole: pieces that touch the hole lie to the right of it. Of pieces inside
  /// each other the innermost, which lies in a hole of the other one.
  LoopPiece& holder_of(std::uint32_t p, const std::vector<PlainBox>& boxes) {
    LoopPiece* best = nullptr;
    const Spot& at = spots_[p];
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const PlainBox& box = boxes[i];
      if (at.x.high() < box.x0 || at.x.low() > box.x1 || at.y.high() < box.y0 || at.y.low() > box.y1) continue;
      if (!contains(pieces_[i].outer, p)) continue;
      if (best == nullptr || smaller(pieces_[i].outer, best->outer)) best = &pieces_[i];
    }
    return *best;
  }

  const std::vector<Spot>& spots_;
  std::vector<LoopPiece> pieces_;
  std::vector<Loop> loose_;  ///< holes of cycles without an outer ring
};

}  // namespace

std::vector<Piece> pieces_between(const RingTable& table, const std::vector<PlacedCut>& cuts, const Poll& poll) {
  const Sections sections = make_sections(table, cuts);
  const std::vector<std::uint32_t> next = following(sections);
  std::vector<bool> used(next.size(), false);
  std::vector<std::uint32_t> position(sections.spots.size(), kNowhere);
  PieceMaker pieces(sections);
  for (std::uint32_t h = 0; h < next.size(); ++h) {
    poll.at(h, next.size());
    if (used[h] || (h % 2 == 1 && sections.all[h / 2].wall < sections.edges)) continue;
    Loop loop;
    for (std::uint32_t g = h; !used[g]; g = next[g]) {
      used[g] = true;
      loop.push_back(g % 2 == 0 ? sections.all[g / 2].from : sections.all[g / 2].to);
    }
    pieces.add_cycle(simple_loops(loop, position));
  }
  return pieces.run(poll);
}

}  // namespace dymsum::shape
