#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/scratch.h"
#include "shape/disc/disc_positions.h"
#include "shape/disc/level_rings.h"

namespace dymsum::shape {
namespace {

// The corner discs of one connected part of the complex below a level: how they lie to each other.

/// Discs by their place in `indices`. Directions are from a disc's centre.
class GroupDiscs {
 public:
  /// Requires: indices ascend, and are of arcs.discs; all these outlive this.
  GroupDiscs(const DiscPositions& positions, const ArcSet& arcs, std::vector<std::uint32_t> indices, Point origin);

  /// Whether two discs overlap (1), touch from outside (0) or are apart.
  int meeting(std::uint32_t i, std::uint32_t j) const;
  /// Calls meet(i, j, meeting) for all that overlap or touch. O(n log n) and a sign for discs whose x ranges overlap.
  template <class Meet>
  void for_each_meeting(const Meet& meet) const {
    const std::vector<std::uint32_t> by_x = sorted_by_x();
    for (std::size_t k = 0; k < by_x.size(); ++k)
      for (std::size_t l = k + 1; l < by_x.size() && may_reach(by_x[k], by_x[l]); ++l)
        if (const int sign = meeting(by_x[k], by_x[l]); sign >= 0) meet(by_x[k], by_x[l], sign);
  }

  std::uint32_t local(std::uint32_t disc) const;
  std::uint32_t disc(std::uint32_t i) const { return indices_[i]; }
  std::size_t size() const { return indices_.size(); }

  /// Whether disc j touches this vertex.
  bool touches(std::uint32_t j, const std::optional<Point>& vertex) const;
  LazyVector centre(std::uint32_t i) const { return centres_[i]; }
  /// The vector to the centre of j.
  LazyVector difference(std::uint32_t i, std::uint32_t j) const;
  /// The vector to where the circle of j is crossed, clockwise of its centre or counter-clockwise.
  LazyVector towards_circle(std::uint32_t i, std::uint32_t j, bool clockwise) const;
  /// The vector to where disc i touches a site, at `vertex` if that is none of an edge.
  LazyVector towards_contact(std::uint32_t i, std::uint32_t site, const std::optional<Point>& vertex) const;

 private:
  LazyVector centre_of(const CornerDisc& disc) const;
  std::vector<Point> vertices_of(const CornerDisc& disc) const;
  std::vector<std::uint32_t> sorted_by_x() const;
  bool may_reach(std::uint32_t i, std::uint32_t j) const;

  const DiscPositions& positions_;
  std::vector<std::uint32_t> indices_;
  Point origin_;
  std::vector<LazyVector> centres_;
  std::vector<std::vector<Point>> vertices_;  ///< that they touch
};

using exact::Interval;

using exact::RootExpression;

GroupDiscs::GroupDiscs(const DiscPositions& positions, const ArcSet& arcs, std::vector<std::uint32_t> indices,
                       Point origin)
    : positions_(positions), indices_(std::move(indices)), origin_(origin) {
  if (indices_.size() < 2) return;
  for (const std::uint32_t disc : indices_) {
    centres_.push_back(centre_of(arcs.discs[disc]));
    vertices_.push_back(vertices_of(arcs.discs[disc]));
  }
}

std::uint32_t GroupDiscs::local(std::uint32_t disc) const {
  return static_cast<std::uint32_t>(std::lower_bound(indices_.begin(), indices_.end(), disc) - indices_.begin());
}

LazyVector GroupDiscs::centre_of(const CornerDisc& disc) const {
  LazyVector made;
  made.exact = [this, disc] { return positions_.exact_centre_from(disc, origin_); };
  if (disc.at_node) {
    const auto v = made.exact();
    made.near = {exact::narrow_interval(v.x), exact::narrow_interval(v.y)};
  } else {
    made.near = centre_on_edge(positions_.complex(), disc.index, positions_.level().near, origin_);
  }
  return made;
}

std::vector<Point> GroupDiscs::vertices_of(const CornerDisc& disc) const {
  const Complex& complex = positions_.complex();
  std::vector<Point> made;
  const auto see = [&](std::uint32_t edge) {
    for (const std::uint32_t site : {complex.edges[edge].left, complex.edges[edge].right})
      if (complex.sites[site].kind == Site::Kind::vertex) made.push_back(complex.sites[site].a);
  };
  if (!disc.at_node) {
    see(disc.index);
  } else {
    for (std::uint32_t i = complex.first_spoke[disc.index]; i < complex.first_spoke[disc.index + 1]; ++i)
      see(complex.spokes[i].edge);
  }
  return made;
}

bool GroupDiscs::touches(std::uint32_t j, const std::optional<Point>& vertex) const {
  return vertex && std::find(vertices_[j].begin(), vertices_[j].end(), *vertex) != vertices_[j].end();
}

std::vector<std::uint32_t> GroupDiscs::sorted_by_x() const {
  std::vector<std::uint32_t> by_x(centres_.size());
  std::iota(by_x.begin(), by_x.end(), 0);
  std::sort(by_x.begin(), by_x.end(), [&](std::uint32_t i, std::uint32_t j) {
    return std::pair(centres_[i].near.x.low(), i) < std::pair(centres_[j].near.x.low(), j);
  });
  return by_x;
}

bool GroupDiscs::may_reach(std::uint32_t i, std::uint32_t j) const {
  const double reach = 2 * positions_.level().near.high();
  return !(centres_[j].near.x.low() - centres_[i].near.x.high() > reach * (1 + 0x1p-50));
}

int GroupDiscs::meeting(std::uint32_t i, std::uint32_t j) const {
  const auto reach = [](const auto& a, const auto& b, const auto& r) {
    const auto d = minus(a, b);
    return r * r - dot(d, d) / (decltype(r * r)(4));
  };
  if (const auto sign = sign_of(reach(centres_[i].near, centres_[j].near, positions_.level().near))) return *sign;
  return exact::sign_of(reach(centres_[i].exact(), centres_[j].exact(), positions_.level().exact));
}

LazyVector GroupDiscs::difference(std::uint32_t i, std::uint32_t j) const {
  LazyVector made;
  made.near = minus(centres_[j].near, centres_[i].near);
  made.exact = [this, i, j] { return minus(centres_[j].exact(), centres_[i].exact()); };
  return made;
}

LazyVector GroupDiscs::towards_circle(std::uint32_t i, std::uint32_t j, bool clockwise) const {
  LazyVector made;
  made.near = crossing(minus(centres_[j].near, centres_[i].near), positions_.level().near, clockwise);
  made.exact = [this, i, j, clockwise] {
    return crossing(minus(centres_[j].exact(), centres_[i].exact()), positions_.level().exact, clockwise);
  };
  return made;
}

LazyVector GroupDiscs::towards_contact(std::uint32_t i, std::uint32_t site, const std::optional<Point>& vertex) const {
  const Site& s = positions_.complex().sites[site];
  LazyVector made;
  if (s.kind == Site::Kind::edge) {
    const auto n = long_normal<Interval>(s);
    made.near = {-n.x, -n.y};
    made.exact = [&s] {
      const auto m = long_normal<RootExpression>(s);
      return Vector<RootExpression>{-m.x, -m.y};
    };
  } else {
    made.near = minus(between<Interval>(origin_, *vertex), centres_[i].near);
    made.exact = [this, i, vertex] { return minus(between<RootExpression>(origin_, *vertex), centres_[i].exact()); };
  }
  return made;
}

// The arcs about one connected part of the complex below a level.

std::vector<std::uint32_t> discs_of(const ArcSet& arcs, const std::vector<std::uint32_t>& members) {
  std::vector<std::uint32_t> discs;
  for (const std::uint32_t arc : members) discs.push_back(arcs.arcs[arc].disc);
  std::sort(discs.begin(), discs.end());
  discs.erase(std::unique(discs.begin(), discs.end()), discs.end());
  return discs;
}

class ArcGroup {
 public:
  ArcGroup(const DiscPositions& positions, ArcSet& arcs, const std::vector<std::uint32_t>& members)
      : arcs_(arcs),
        members_(members),
        discs_(positions, arcs, discs_of(arcs, members), positions.complex().sites[arcs.arcs[members.front()].start].a),
        near_(discs_.size()) {}

  void find() {
    first_ = static_cast<std::uint32_t>(arcs_.fragments.size());
    if (discs_.size() > 1) find_neighbours();
    for (const std::uint32_t arc : members_) {
      if (near_[discs_.local(arcs_.arcs[arc].disc)].empty()) add(arc, kNoIndex, kNoIndex);
      else cut_arc(arc);
    }
    find_touches();
    link();
  }

 private:
  /// A part of an arc that another disc covers; of one that touches it a single position. Where the disc touches the
  /// vertex at which the arc starts or stops, it is known to begin or end there: else it does so within the arc, as no
  /// contact lies inside of what a disc covers.
  struct Cover {
    std::uint32_t by = 0;  ///< disc
    LazyVector enter, leave;
    bool at_start = false, at_stop = false;
  };

  void find_neighbours() {
    discs_.for_each_meeting([&](std::uint32_t i, std::uint32_t j, int sign) {
      near_[i].push_back(j);
      near_[j].push_back(i);
      if (sign > 0) arcs_.overlaps.push_back({discs_.disc(i), discs_.disc(j)});
      else touching_.insert(std::minmax(i, j));
    });
  }
  bool are_touching(std::uint32_t i, std::uint32_t j) const { return touching_.count(std::minmax(i, j)) > 0; }

  /// Whether a direction lies in the arc, at neither end of it: where the first sign is open, the second may decide.
  static bool is_within(const LazyVector& start, const LazyVector& v, const LazyVector& stop) {
    const auto first = sign_of(cross(start.near, v.near)), second = sign_of(cross(v.near, stop.near));
    if ((first && *first >= 0) || (second && *second >= 0)) return false;
    return sign_of_cross(start, v) < 0 && sign_of_cross(v, stop) < 0;
  }

  void cut_arc(std::uint32_t index) {
    const CornerArc& arc = arcs_.arcs[index];
    const std::uint32_t i = discs_.local(arc.disc);
    const LazyVector start = discs_.towards_contact(i, arc.start, arc.start_vertex);
    const LazyVector stop = discs_.towards_contact(i, arc.stop, arc.stop_vertex);
    std::vector<Cover> covers;
    for (const std::uint32_t j : near_[i])
      if (auto cover = cover_of(arc, i, j, start, stop)) covers.push_back(std::move(*cover));
    // Where other discs enter at one position any of them comes first: link() knows.
    std::sort(covers.begin(), covers.end(), [&](const Cover& a, const Cover& b) {
      if (a.at_start || b.at_start) return a.at_start != b.at_start ? a.at_start : a.by < b.by;
      const int side = sign_of_cross(a.enter, b.enter);
      return side != 0 ? side < 0 : a.by < b.by;
    });
    const Cover* last = nullptr;  // the one that reaches furthest
    const auto is_beyond = [&](const LazyVector& v) { return !last->at_stop && sign_of_cross(last->leave, v) < 0; };
    for (const Cover& cover : covers) {
      if (last == nullptr ? !cover.at_start : !cover.at_start && is_beyond(cover.enter))
        add(index, last == nullptr ? kNoIndex : last->by, cover.by);
      if (last == nullptr || (cover.at_stop ? !last->at_stop : is_beyond(cover.leave))) last = &cover;
    }
    if (last == nullptr || !last->at_stop) add(index, last == nullptr ? kNoIndex : last->by, kNoIndex);
  }

  /// The cover of an arc of disc i by disc j. Discs touch each other at no contact: both would touch a vertex there,
  /// from two sides, and the region has an angle at it.
  std::optional<Cover> cover_of(const CornerArc& arc, std::uint32_t i, std::uint32_t j, const LazyVector& start,
                                const LazyVector& stop) const {
    if (are_touching(i, j)) {
      const LazyVector position = discs_.difference(i, j);
      if (!is_within(start, position, stop)) return std::nullopt;
      return Cover{discs_.disc(j), position, position};
    }
    Cover cover{discs_.disc(j), discs_.towards_circle(i, j, false), discs_.towards_circle(i, j, true)};
    if (discs_.touches(j, arc.start_vertex)) {
      if (sign_of_cross(discs_.difference(i, j), start) < 0) return std::nullopt;
      cover.at_start = true;
    }
    if (discs_.touches(j, arc.stop_vertex)) {
      if (sign_of_cross(discs_.difference(i, j), stop) > 0) return std::nullopt;
      cover.at_stop = true;
    }
    if (!cover.at_start && !is_within(start, cover.enter, stop)) return std::nullopt;
    return cover;
  }

  void add(std::uint32_t arc, std::uint32_t begin, std::uint32_t end) {
    if (begin == kNoIndex) arcs_.first[arc] = static_cast<std::uint32_t>(arcs_.fragments.size());
    arcs_.fragments.push_back({arc, begin, end, kNoIndex});
  }

  std::uint32_t disc_of(const ArcFragment& fragment) const { return arcs_.arcs[fragment.arc].disc; }

  /// Fragments that end where another disc touches their arc, which goes on there: linked to what follows, and in pairs
  /// where the arc of the other disc does so, too. Where that is covered nothing touches.
  void find_touches() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> ending;  // (disc, the one it touches) -> fragment
    if (touching_.empty()) return;
    for (std::uint32_t f = first_; f + 1 < arcs_.fragments.size(); ++f) {
      ArcFragment& here = arcs_.fragments[f];
      const ArcFragment& next = arcs_.fragments[f + 1];
      if (here.end == kNoIndex || here.arc != next.arc || here.end != next.begin) continue;
      if (!are_touching(discs_.local(disc_of(here)), discs_.local(here.end))) continue;
      here.next = f + 1;
      here.touches_at_end = arcs_.fragments[f + 1].touches_at_begin = true;
      ending[{disc_of(here), here.end}] = f;
    }
    for (const auto& [discs, f] : ending) {
      const auto other = ending.find({discs.second, discs.first});
      if (other == ending.end()) join(arcs_, joined_into(arcs_, f));
      else if (discs.first < discs.second) arcs_.touches.push_back({f, other->second});
    }
  }

  /// Finds the fragment that goes on where one enters another disc: that which leaves the first one's disc there. Where
  /// more than two circles meet at the position, it may be one of another disc that begins there.
  void link() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> leaving;  // (disc, the one it leaves) -> fragment
    const auto count = static_cast<std::uint32_t>(arcs_.fragments.size());
    std::vector<std::uint8_t> follows(count - first_, 0);  // another fragment of its arc, where something touches
    for (std::uint32_t f = first_; f < count; ++f)
      if (arcs_.fragments[f].next != kNoIndex) follows[arcs_.fragments[f].next - first_] = 1;
    for (std::uint32_t f = first_; f < count; ++f)
      if (arcs_.fragments[f].begin != kNoIndex && !follows[f - first_] && !arcs_.fragments[f].joined)
        leaving[{disc_of(arcs_.fragments[f]), arcs_.fragments[f].begin}] = f;
    std::vector<std::uint32_t> open;
    for (std::uint32_t f = first_; f < count; ++f) {
      ArcFragment& fragment = arcs_.fragments[f];
      if (fragment.end == kNoIndex || fragment.next != kNoIndex || fragment.joined) continue;
      const auto found = leaving.find({fragment.end, disc_of(fragment)});
      if (found == leaving.end()) {
        open.push_back(f);
      } else {
        fragment.next = found->second;
        leaving.erase(found);
      }
    }
    for (const std::uint32_t f : open) {
      const auto found = beginning_at_end_of(f, leaving);
      arcs_.fragments[f].next = found->second;
      leaving.erase(found);
    }
  }

  LazyVector position(std::uint32_t fragment, bool at_end) const {
    const ArcFragment& f = arcs_.fragments[fragment];
    const std::uint32_t i = discs_.local(disc_of(f)), j = discs_.local(at_end ? f.end : f.begin);
    const LazyVector centre = discs_.centre(i), arm = discs_.towards_circle(i, j, !at_end);
    return {plus(centre.near, arm.near), [centre, arm] { return plus(centre.exact(), arm.exact()); }};
  }

  template <class Left>
  typename Left::iterator beginning_at_end_of(std::uint32_t fragment, Left& left) const {
    const LazyVector end = position(fragment, true);
    std::vector<typename Left::iterator> near;
    for (auto it = left.begin(); it != left.end(); ++it) {
      const auto d = minus(position(it->second, false).near, end.near);
      if (sign_of(d.x).value_or(0) == 0 && sign_of(d.y).value_or(0) == 0) near.push_back(it);
    }
    // The only one near by is the one that there has to be.
    while (near.size() > 1) {
      const auto d = minus(position(near.back()->second, false).exact(), end.exact());
      if (exact::sign_of(d.x) == 0 && exact::sign_of(d.y) == 0) return near.back();
      near.pop_back();
    }
    if (near.empty()) throw std::logic_error("an arc enters a disc and none leaves it");
    return near.front();
  }

  ArcSet& arcs_;
  const std::vector<std::uint32_t>& members_;                   ///< arcs
  GroupDiscs discs_;                                            ///< of the arcs
  std::vector<std::vector<std::uint32_t>> near_;                ///< disc -> discs that overlap or touch it
  std::set<std::pair<std::uint32_t, std::uint32_t>> touching_;  ///< the first one before the second one
  std::uint32_t first_ = 0;                                     ///< fragment
};

}  // namespace

void join(ArcSet& arcs, std::uint32_t fragment) {
  ArcFragment& here = arcs.fragments[fragment];
  std::uint32_t after = fragment + 1;
  while (arcs.fragments[after].joined) ++after;
  here.end = arcs.fragments[after].end;
  here.next = arcs.fragments[after].next;
  here.touches_at_end = arcs.fragments[after].touches_at_end;
  arcs.fragments[after].joined = true;
}

std::uint32_t joined_into(const ArcSet& arcs, std::uint32_t fragment) {
  while (arcs.fragments[fragment].joined) --fragment;
  return fragment;
}

namespace {

/// Adds the fragments of these arcs, the overlaps and the touches of their discs.
void cut_group(const DiscPositions& positions, ArcSet& arcs, const std::vector<std::uint32_t>& members) {
  ArcGroup(positions, arcs, members).find();
}

}  // namespace

// What other discs leave of the arcs of corner discs.

namespace {

/// Nodes below the cut by connected parts.
UnionFind parts_below(const Complex& complex, std::uint32_t cut) {
  UnionFind parts(cut);
  for (const Edge& edge : complex.edges)
    if (edge.low < cut && edge.high < cut) parts.unite(edge.low, edge.high);
  return parts;
}

}  // namespace

void cut_arcs(const DiscPositions& positions, std::uint32_t cut, ArcSet& arcs) {
  const Complex& complex = positions.complex();
  UnionFind parts = parts_below(complex, cut);
  for (std::uint32_t node = 0; node < cut; ++node) arcs.part.push_back(parts.root(node));
  arcs.is_split.assign(cut, 0);
  std::map<std::uint32_t, std::vector<std::uint32_t>> groups;
  for (std::uint32_t arc = 0; arc < arcs.arcs.size(); ++arc)
    groups[parts.root(complex.edges[arcs.arcs[arc].edge].low)].push_back(arc);
  arcs.first.assign(arcs.arcs.size(), kNoIndex);
  for (auto& [root, members] : groups) {
    const std::size_t overlaps = arcs.overlaps.size(), touches = arcs.touches.size();
    cut_group(positions, arcs, members);
    arcs.is_split[root] = arcs.overlaps.size() > overlaps || arcs.touches.size() > touches;
  }
}

namespace {

/// formula(centre of other - centre of disc, r) as doubles.
template <class Formula>
Point between_centres(const DiscPositions& positions, const CornerDisc& disc, const CornerDisc& other,
                      const Formula& formula) {
  const Complex& complex = positions.complex();
  const std::uint32_t edge = disc.at_node ? complex.spokes[complex.first_spoke[disc.index]].edge : disc.index;
  const Point origin = complex.sites[complex.edges[edge].left].a;
  if (disc.at_node || other.at_node) {
    const auto v = formula(minus(positions.exact_centre_from(other, origin), positions.exact_centre_from(disc, origin)),
                           positions.level().exact);
    return Point{exact::nearest_double(v.x), exact::nearest_double(v.y)};
  }
  return near_vector(
      [&](const auto& r) {
        return formula(
            minus(centre_on_edge(complex, other.index, r, origin), centre_on_edge(complex, disc.index, r, origin)), r);
      },
      positions.level(), positions.level().radius);
}

}  // namespace

Point towards_crossing(const DiscPositions& positions, const CornerDisc& disc, const CornerDisc& other, bool entered) {
  return between_centres(positions, disc, other,
                         [&](const auto& d, const auto& r) { return crossing(d, r, !entered); });
}

Point towards_touch(const DiscPositions& positions, const CornerDisc& disc, const CornerDisc& other) {
  return between_centres(positions, disc, other, [](const auto& d, const auto& r) {
    const std::decay_t<decltype(r)> half(0.5);
    return std::decay_t<decltype(d)>{half * d.x, half * d.y};
  });
}

}  // namespace dymsum::shape
