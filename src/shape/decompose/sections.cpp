#include "shape/decompose/sections.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "exact/orient.h"

namespace dymsum::shape {
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

}  // namespace dymsum::shape
