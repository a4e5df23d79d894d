#include "shape/disc/disc_arcs.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "base/union_find.h"

namespace dymsum::shape {

namespace {

using exact::Interval;
using exact::RootExpression;

template <class T>
Vector<T> minus(const Vector<T>& a, const Vector<T>& b) {
  return {a.x - b.x, a.y - b.y};
}

/// A vector in intervals, and exactly when these do not decide.
struct LazyVector {
  Vector<Interval> near;
  std::function<Vector<RootExpression>()> exact;
};

int sign_of_cross(const LazyVector& a, const LazyVector& b) {
  if (const auto sign = sign_of(cross(a.near, b.near))) return *sign;
  return exact::sign_of(cross(a.exact(), b.exact()));
}
int sign_of_dot(const LazyVector& a, const LazyVector& b) {
  if (const auto sign = sign_of(dot(a.near, b.near))) return *sign;
  return exact::sign_of(dot(a.exact(), b.exact()));
}

/// Where a circle of radius r is crossed by that about `d`, clockwise of d or counter-clockwise. Requires |d| < 2 r.
template <class T>
Vector<T> crossing(const Vector<T>& d, const T& r, bool clockwise) {
  const T half = T(0.5);
  const T w = sqrt(r * r / dot(d, d) - half * half);
  const T v = clockwise ? -w : w;
  return {half * d.x - d.y * v, half * d.y + d.x * v};
}

/// The arcs about one connected part of the complex below a level.
class ArcGroup {
 public:
  ArcGroup(const DiscPlaces& places, const std::vector<CornerArc>& arcs, std::vector<std::uint32_t> members)
      : places_(places), arcs_(arcs), members_(std::move(members)) {
    const Complex& complex = places.complex();
    origin_ = complex.sites[complex.edges[arcs[members_.front()].in].left].a;
    for (const std::uint32_t arc : members_) centres_.push_back(centre(arcs[arc].disc));
  }

  void find(ArcSet& made) {
    std::vector<std::vector<std::uint32_t>> near(members_.size());
    std::vector<std::uint32_t> by_x(members_.size());
    std::iota(by_x.begin(), by_x.end(), 0);
    std::sort(by_x.begin(), by_x.end(),
              [&](std::uint32_t i, std::uint32_t j) { return centres_[i].near.x.low() < centres_[j].near.x.low(); });
    const double reach = 2 * places_.level().near.high();
    for (std::size_t k = 0; k < by_x.size(); ++k)
      for (std::size_t l = k + 1; l < by_x.size(); ++l) {
        const std::uint32_t i = by_x[k], j = by_x[l];
        if (centres_[j].near.x.low() - centres_[i].near.x.high() > reach * (1 + 0x1p-50)) break;
        if (!overlap(i, j)) continue;
        near[i].push_back(j);
        near[j].push_back(i);
        made.overlaps.push_back({members_[i], members_[j]});
      }
    for (std::uint32_t i = 0; i < members_.size(); ++i) cut_arc(i, near[i], made);
  }

 private:
  /// A part of an arc that another disc covers. Where that touches the vertex at which the arc starts or stops, it is
  /// known to begin or end there.
  struct Cover {
    std::uint32_t by = 0;
    LazyVector enter, leave;
    bool at_start = false, at_stop = false;
  };

  LazyVector centre(const CornerDisc& disc) const {
    LazyVector made;
    made.exact = [this, disc] { return places_.exact_centre_from(disc, origin_); };
    if (disc.at_node) {
      const auto v = made.exact();
      made.near = {exact::narrow_interval(v.x), exact::narrow_interval(v.y)};
    } else {
      made.near = centre_on_edge(places_.complex(), disc.index, places_.level().near, origin_);
    }
    return made;
  }

  bool overlap(std::uint32_t i, std::uint32_t j) const {
    if (arcs_[members_[i]].disc == arcs_[members_[j]].disc) return false;
    const auto reach = [](const auto& a, const auto& b, const auto& r) {
      const auto d = minus(a, b);
      return r * r - dot(d, d) / (decltype(r * r)(4));
    };
    if (const auto sign = sign_of(reach(centres_[i].near, centres_[j].near, places_.level().near))) return *sign > 0;
    return exact::sign_of(reach(centres_[i].exact(), centres_[j].exact(), places_.level().exact)) > 0;
  }

  LazyVector towards_circle(std::uint32_t i, std::uint32_t j, bool clockwise) const {
    LazyVector made;
    made.near = crossing(minus(centres_[j].near, centres_[i].near), places_.level().near, clockwise);
    made.exact = [this, i, j, clockwise] {
      return crossing(minus(centres_[j].exact(), centres_[i].exact()), places_.level().exact, clockwise);
    };
    return made;
  }

  LazyVector towards_site(std::uint32_t i, const Site& site) const {
    LazyVector made;
    if (site.kind == Site::Kind::edge) {
      const auto n = long_normal<Interval>(site);
      made.near = {-n.x, -n.y};
      made.exact = [&site] {
        const auto m = long_normal<RootExpression>(site);
        return Vector<RootExpression>{-m.x, -m.y};
      };
    } else {
      made.near = minus(between<Interval>(origin_, site.a), centres_[i].near);
      made.exact = [this, i, &site] { return minus(between<RootExpression>(origin_, site.a), centres_[i].exact()); };
    }
    return made;
  }

  /// The order of two directions clockwise from `start`: -1, 0, 1.
  static int compare(const LazyVector& start, const LazyVector& a, const LazyVector& b) {
    const int half_a = quarter(start, a), half_b = quarter(start, b);
    if (half_a != half_b) return half_a < half_b ? -1 : 1;
    return half_a % 2 == 0 ? 0 : sign_of_cross(a, b);
  }
  /// 0 at the start, 1 within half a turn clockwise, 2 at half a turn, 3 beyond.
  static int quarter(const LazyVector& start, const LazyVector& v) {
    const int side = sign_of_cross(start, v);
    if (side != 0) return side < 0 ? 1 : 3;
    return sign_of_dot(start, v) > 0 ? 0 : 2;
  }

  void cut_arc(std::uint32_t i, const std::vector<std::uint32_t>& near, ArcSet& made) const {
    const std::uint32_t arc = members_[i];
    const Complex& complex = places_.complex();
    const LazyVector start = towards_site(i, complex.sites[complex.edges[arcs_[arc].in].right]);
    const LazyVector stop = towards_site(i, complex.sites[complex.edges[arcs_[arc].out].left]);
    std::vector<Cover> covers;
    for (const std::uint32_t j : near)
      if (auto cover = cover_of(i, j, start, stop)) covers.push_back(std::move(*cover));
    std::sort(covers.begin(), covers.end(), [&](const Cover& a, const Cover& b) {
      if (a.at_start || b.at_start) return a.at_start != b.at_start ? a.at_start : a.by < b.by;
      const int order = compare(start, a.enter, b.enter);
      return order != 0 ? order < 0 : a.by < b.by;
    });
    const Cover* last = nullptr;  // the one that reaches furthest
    const auto is_beyond = [&](const LazyVector& v) {
      if (last == nullptr) return quarter(start, v) != 0;
      return !last->at_stop && compare(start, last->leave, v) < 0;
    };
    const auto begin = [&] { return last == nullptr ? ArcFragment::kContact : last->by; };
    for (const Cover& cover : covers) {
      if (!cover.at_start && is_beyond(cover.enter)) add(arc, begin(), cover.by, made);
      if (last == nullptr || (cover.at_stop && !last->at_stop) || (!cover.at_stop && is_beyond(cover.leave)))
        last = &cover;
    }
    if (last == nullptr || is_beyond(stop)) add(arc, begin(), ArcFragment::kContact, made);
  }

  /// Of arc i by the disc of j. No contact lies inside of what a disc covers.
  std::optional<Cover> cover_of(std::uint32_t i, std::uint32_t j, const LazyVector& start,
                                const LazyVector& stop) const {
    const Complex& complex = places_.complex();
    const CornerArc &arc = arcs_[members_[i]], &other = arcs_[members_[j]];
    Cover cover{members_[j], towards_circle(i, j, false), towards_circle(i, j, true)};
    if (touch_vertex(other.disc, complex.edges[arc.in].right)) {
      if (sign_of_cross(difference(i, j), start) < 0) return std::nullopt;
      cover.at_start = true;
    }
    if (touch_vertex(other.disc, complex.edges[arc.out].left)) {
      if (sign_of_cross(difference(i, j), stop) > 0) return std::nullopt;
      cover.at_stop = true;
    }
    if (!cover.at_start && compare(start, cover.enter, stop) >= 0) return std::nullopt;
    return cover;
  }

  bool touch_vertex(const CornerDisc& disc, std::uint32_t site) const {
    const Complex& complex = places_.complex();
    if (complex.sites[site].kind != Site::Kind::vertex) return false;
    const auto touches = [&](std::uint32_t edge) {
      return complex.edges[edge].left == site || complex.edges[edge].right == site;
    };
    if (!disc.at_node) return touches(disc.index);
    const auto first = complex.spokes.begin() + complex.first_spoke[disc.index],
               last = complex.spokes.begin() + complex.first_spoke[disc.index + 1];
    return std::any_of(first, last, [&](const Spoke& spoke) { return touches(spoke.edge); });
  }

  LazyVector difference(std::uint32_t i, std::uint32_t j) const {
    LazyVector made;
    made.near = minus(centres_[j].near, centres_[i].near);
    made.exact = [this, i, j] { return minus(centres_[j].exact(), centres_[i].exact()); };
    return made;
  }

  static void add(std::uint32_t arc, std::uint32_t begin, std::uint32_t end, ArcSet& made) {
    if (begin == ArcFragment::kContact) made.first[arc] = static_cast<std::uint32_t>(made.fragments.size());
    made.fragments.push_back({arc, begin, end, ArcFragment::kContact});
  }

  const DiscPlaces& places_;
  const std::vector<CornerArc>& arcs_;
  std::vector<std::uint32_t> members_;
  std::vector<LazyVector> centres_;
  Point origin_;
};

/// Nodes below the cut by connected parts.
UnionFind parts_below(const Complex& complex, std::uint32_t cut) {
  UnionFind parts(cut);
  for (const Edge& edge : complex.edges)
    if (edge.low < cut && edge.high < cut) parts.unite(edge.low, edge.high);
  return parts;
}

/// Which fragment goes on where one enters another disc: that which leaves the first one's disc there.
void link(ArcSet& made) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> leaving;  // (disc's node or edge, other) -> fragment
  const auto name = [&](std::uint32_t arc) {
    const CornerDisc& disc = made.arcs[arc].disc;
    return 2 * disc.index + (disc.at_node ? 1 : 0);
  };
  for (std::uint32_t f = 0; f < made.fragments.size(); ++f)
    if (made.fragments[f].begin != ArcFragment::kContact)
      leaving[{name(made.fragments[f].arc), name(made.fragments[f].begin)}] = f;
  for (ArcFragment& fragment : made.fragments) {
    if (fragment.end == ArcFragment::kContact) continue;
    const auto found = leaving.find({name(fragment.end), name(fragment.arc)});
    if (found == leaving.end()) throw std::logic_error("an arc enters a disc and none leaves it");
    fragment.next = found->second;
  }
}

}  // namespace

ArcSet corner_arcs(const DiscPlaces& places, const BoundaryOrder& order, const LevelRings& rings, std::uint32_t cut) {
  const Complex& complex = places.complex();
  ArcSet made;
  made.arc_at_end.assign(complex.edges.size(), ArcFragment::kContact);
  UnionFind parts = parts_below(complex, cut);
  std::map<std::uint32_t, std::vector<std::uint32_t>> groups;
  for (const Run& run : rings.runs) {
    if (run.whole()) continue;
    const std::uint32_t in = order.items[run.to].edge, arc = static_cast<std::uint32_t>(made.arcs.size());
    const std::uint32_t out = edge_behind(complex, places.level(), in, Connected::region);
    made.arc_at_end[in] = arc;
    made.arcs.push_back({places.disc_on(in), in, out});
    // Between components that meet at a node and touch one place there the boundary goes on: no arc.
    if (out != in && order.next(complex, order.item_of[in][1]) == order.item_of[out][0]) continue;
    groups[parts.root(complex.edges[in].low)].push_back(arc);
  }
  made.first.assign(made.arcs.size(), ArcFragment::kContact);
  made.split.assign(complex.nodes.size(), 0);
  for (const auto& [root, members] : groups) {
    const std::size_t before = made.overlaps.size();
    if (members.size() == 1) {
      made.first[members[0]] = static_cast<std::uint32_t>(made.fragments.size());
      made.fragments.push_back({members[0]});
    } else {
      ArcGroup(places, made.arcs, members).find(made);
    }
    made.split[root] = made.overlaps.size() > before;
  }
  for (std::uint32_t node = 0; node < cut; ++node) made.root.push_back(parts.root(node));
  link(made);
  return made;
}

Point towards_crossing(const DiscPlaces& places, const CornerDisc& disc, const CornerDisc& other, bool entered) {
  const Complex& complex = places.complex();
  const std::uint32_t edge =
      disc.at_node ? complex.spokes[complex.first_spoke[disc.index]].edge : disc.index;
  const Point origin = complex.sites[complex.edges[edge].left].a;
  const auto exactly = [&] {
    const auto d = minus(places.exact_centre_from(other, origin), places.exact_centre_from(disc, origin));
    const auto u = crossing(d, places.level().exact, !entered);
    return Point{exact::nearest_double(u.x), exact::nearest_double(u.y)};
  };
  if (disc.at_node || other.at_node) return exactly();
  return near_vector(
      [&](const auto& r) {
        return crossing(minus(centre_on_edge(complex, other.index, r, origin),
                              centre_on_edge(complex, disc.index, r, origin)),
                        r, !entered);
      },
      places.level(), places.level().radius);
}

}  // namespace dymsum::shape
