// What other discs leave of the arcs of corner discs.
#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>

#include "base/union_find.h"
#include "shape/disc/disc_arcs.h"
#include "shape/disc/lazy_vector.h"

namespace dymsum::shape {

namespace {

using exact::Interval;
using exact::RootExpression;

/// The arcs about one connected part of the complex below a level.
class ArcGroup {
 public:
  ArcGroup(const DiscPlaces& places, ArcSet& arcs, std::vector<std::uint32_t> members)
      : places_(places), arcs_(arcs), members_(std::move(members)) {
    for (const std::uint32_t arc : members_) discs_.push_back(arcs.arcs[arc].disc);
    std::sort(discs_.begin(), discs_.end());
    discs_.erase(std::unique(discs_.begin(), discs_.end()), discs_.end());
    origin_ = places.complex().sites[arcs.arcs[members_.front()].start].a;
  }

  void find() {
    const auto before = static_cast<std::uint32_t>(arcs_.fragments.size());
    if (discs_.size() > 1) find_overlaps();
    for (const std::uint32_t arc : members_) {
      if (near_.empty() || near_[local(arcs_.arcs[arc].disc)].empty()) add(arc, kNoIndex, kNoIndex);
      else cut_arc(arc);
    }
    link(before);
  }

 private:
  /// A part of an arc that another disc covers. Where that touches the vertex at which the arc starts or stops, it is
  /// known to begin or end there: else it does so within the arc, as no contact lies inside of what a disc covers.
  struct Cover {
    std::uint32_t by = 0;  ///< disc
    LazyVector enter, leave;
    bool at_start = false, at_stop = false;
  };

  std::uint32_t local(std::uint32_t disc) const {
    return static_cast<std::uint32_t>(std::lower_bound(discs_.begin(), discs_.end(), disc) - discs_.begin());
  }

  void find_overlaps() {
    for (const std::uint32_t disc : discs_) {
      centres_.push_back(centre(arcs_.discs[disc]));
      vertices_.push_back(vertices(arcs_.discs[disc]));
    }
    near_.resize(discs_.size());
    std::vector<std::uint32_t> by_x(discs_.size());
    std::iota(by_x.begin(), by_x.end(), 0);
    std::sort(by_x.begin(), by_x.end(),
              [&](std::uint32_t i, std::uint32_t j) { return centres_[i].near.x.low() < centres_[j].near.x.low(); });
    const double reach = 2 * places_.level().near.high();
    for (std::size_t k = 0; k < by_x.size(); ++k)
      for (std::size_t l = k + 1; l < by_x.size(); ++l) {
        const std::uint32_t i = by_x[k], j = by_x[l];
        if (centres_[j].near.x.low() - centres_[i].near.x.high() > reach * (1 + 0x1p-50)) break;
        if (!overlap(i, j)) continue;
        near_[i].push_back(j);
        near_[j].push_back(i);
        arcs_.overlaps.push_back({discs_[i], discs_[j]});
      }
  }

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

  /// Those that a disc touches.
  std::vector<Point> vertices(const CornerDisc& disc) const {
    const Complex& complex = places_.complex();
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
  bool touches(std::uint32_t j, const std::optional<Point>& vertex) const {
    return vertex && std::find(vertices_[j].begin(), vertices_[j].end(), *vertex) != vertices_[j].end();
  }

  bool overlap(std::uint32_t i, std::uint32_t j) const {
    const auto reach = [](const auto& a, const auto& b, const auto& r) {
      const auto d = minus(a, b);
      return r * r - dot(d, d) / (decltype(r * r)(4));
    };
    if (const auto sign = sign_of(reach(centres_[i].near, centres_[j].near, places_.level().near))) return *sign > 0;
    return exact::sign_of(reach(centres_[i].exact(), centres_[j].exact(), places_.level().exact)) > 0;
  }

  LazyVector difference(std::uint32_t i, std::uint32_t j) const {
    LazyVector made;
    made.near = minus(centres_[j].near, centres_[i].near);
    made.exact = [this, i, j] { return minus(centres_[j].exact(), centres_[i].exact()); };
    return made;
  }

  LazyVector towards_circle(std::uint32_t i, std::uint32_t j, bool clockwise) const {
    LazyVector made;
    made.near = crossing(minus(centres_[j].near, centres_[i].near), places_.level().near, clockwise);
    made.exact = [this, i, j, clockwise] {
      return crossing(minus(centres_[j].exact(), centres_[i].exact()), places_.level().exact, clockwise);
    };
    return made;
  }

  LazyVector towards_contact(std::uint32_t i, std::uint32_t site, const std::optional<Point>& vertex) const {
    const Site& s = places_.complex().sites[site];
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

  /// Whether a direction lies in the arc, at neither end of it: where the first sign is open, the second may tell.
  static bool is_within(const LazyVector& start, const LazyVector& v, const LazyVector& stop) {
    const auto first = sign_of(cross(start.near, v.near)), second = sign_of(cross(v.near, stop.near));
    if ((first && *first >= 0) || (second && *second >= 0)) return false;
    return sign_of_cross(start, v) < 0 && sign_of_cross(v, stop) < 0;
  }

  void cut_arc(std::uint32_t index) {
    const CornerArc& arc = arcs_.arcs[index];
    const std::uint32_t i = local(arc.disc);
    const LazyVector start = towards_contact(i, arc.start, arc.start_vertex);
    const LazyVector stop = towards_contact(i, arc.stop, arc.stop_vertex);
    std::vector<Cover> covers;
    for (const std::uint32_t j : near_[i])
      if (auto cover = cover_of(arc, i, j, start, stop)) covers.push_back(std::move(*cover));
    // Where other discs enter at one place any of them comes first: link() knows.
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

  /// Of an arc of disc i by disc j.
  std::optional<Cover> cover_of(const CornerArc& arc, std::uint32_t i, std::uint32_t j, const LazyVector& start,
                                const LazyVector& stop) const {
    Cover cover{discs_[j], towards_circle(i, j, false), towards_circle(i, j, true)};
    if (touches(j, arc.start_vertex)) {
      if (sign_of_cross(difference(i, j), start) < 0) return std::nullopt;
      cover.at_start = true;
    }
    if (touches(j, arc.stop_vertex)) {
      if (sign_of_cross(difference(i, j), stop) > 0) return std::nullopt;
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

  /// Which fragment goes on where one enters another disc: that which leaves the first one's disc there. Where more
  /// than two circles meet at the place, it may be one of another disc that begins there.
  void link(std::uint32_t before) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> leaving;  // (disc, the one it leaves) -> fragment
    const auto count = static_cast<std::uint32_t>(arcs_.fragments.size());
    for (std::uint32_t f = before; f < count; ++f)
      if (arcs_.fragments[f].begin != kNoIndex) leaving[{disc_of(arcs_.fragments[f]), arcs_.fragments[f].begin}] = f;
    std::vector<std::uint32_t> open;
    for (std::uint32_t f = before; f < count; ++f) {
      ArcFragment& fragment = arcs_.fragments[f];
      if (fragment.end == kNoIndex) continue;
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

  LazyVector place(std::uint32_t fragment, bool at_end) const {
    const ArcFragment& f = arcs_.fragments[fragment];
    const std::uint32_t i = local(disc_of(f)), j = local(at_end ? f.end : f.begin);
    const LazyVector arm = towards_circle(i, j, !at_end);
    LazyVector made;
    made.near = plus(centres_[i].near, arm.near);
    made.exact = [this, i, arm] { return plus(centres_[i].exact(), arm.exact()); };
    return made;
  }

  template <class Left>
  typename Left::iterator beginning_at_end_of(std::uint32_t fragment, Left& left) const {
    const LazyVector end = place(fragment, true);
    std::vector<typename Left::iterator> near;
    for (auto it = left.begin(); it != left.end(); ++it) {
      const auto d = minus(place(it->second, false).near, end.near);
      if (sign_of(d.x).value_or(0) == 0 && sign_of(d.y).value_or(0) == 0) near.push_back(it);
    }
    // The only one near by is the one that there has to be.
    while (near.size() > 1) {
      const auto d = minus(place(near.back()->second, false).exact(), end.exact());
      if (exact::sign_of(d.x) == 0 && exact::sign_of(d.y) == 0) return near.back();
      near.pop_back();
    }
    if (near.empty()) throw std::logic_error("an arc enters a disc and none leaves it");
    return near.front();
  }

  const DiscPlaces& places_;
  ArcSet& arcs_;
  std::vector<std::uint32_t> members_;            ///< arcs
  std::vector<std::uint32_t> discs_;              ///< of the arcs, ascending
  std::vector<LazyVector> centres_;               ///< of them
  std::vector<std::vector<Point>> vertices_;      ///< that they touch
  std::vector<std::vector<std::uint32_t>> near_;  ///< disc -> discs that overlap it, both by their place in discs_
  Point origin_;
};

/// Nodes below the cut by connected parts.
UnionFind parts_below(const Complex& complex, std::uint32_t cut) {
  UnionFind parts(cut);
  for (const Edge& edge : complex.edges)
    if (edge.low < cut && edge.high < cut) parts.unite(edge.low, edge.high);
  return parts;
}

}  // namespace

void cut_arcs(const DiscPlaces& places, std::uint32_t cut, ArcSet& arcs) {
  const Complex& complex = places.complex();
  UnionFind parts = parts_below(complex, cut);
  for (std::uint32_t node = 0; node < cut; ++node) arcs.part.push_back(parts.root(node));
  arcs.is_split.assign(cut, 0);
  std::map<std::uint32_t, std::vector<std::uint32_t>> groups;
  for (std::uint32_t arc = 0; arc < arcs.arcs.size(); ++arc)
    groups[parts.root(complex.edges[arcs.arcs[arc].edge].low)].push_back(arc);
  arcs.first.assign(arcs.arcs.size(), kNoIndex);
  for (auto& [root, members] : groups) {
    const std::size_t before = arcs.overlaps.size();
    ArcGroup(places, arcs, std::move(members)).find();
    arcs.is_split[root] = arcs.overlaps.size() > before;
  }
}

Point towards_crossing(const DiscPlaces& places, const CornerDisc& disc, const CornerDisc& other, bool entered) {
  const Complex& complex = places.complex();
  const std::uint32_t edge = disc.at_node ? complex.spokes[complex.first_spoke[disc.index]].edge : disc.index;
  const Point origin = complex.sites[complex.edges[edge].left].a;
  const auto exactly = [&] {
    const auto d = minus(places.exact_centre_from(other, origin), places.exact_centre_from(disc, origin));
    const auto u = crossing(d, places.level().exact, !entered);
    return Point{exact::nearest_double(u.x), exact::nearest_double(u.y)};
  };
  if (disc.at_node || other.at_node) return exactly();
  return near_vector(
      [&](const auto& r) {
        return crossing(
            minus(centre_on_edge(complex, other.index, r, origin), centre_on_edge(complex, disc.index, r, origin)), r,
            !entered);
      },
      places.level(), places.level().radius);
}

}  // namespace dymsum::shape
