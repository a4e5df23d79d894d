#include "shape/disc/arc_group.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "shape/disc/group_discs.h"

namespace dymsum::shape {

namespace {

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

void cut_group(const DiscPositions& positions, ArcSet& arcs, const std::vector<std::uint32_t>& members) {
  ArcGroup(positions, arcs, members).find();
}

}  // namespace dymsum::shape
