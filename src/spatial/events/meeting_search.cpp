#include "spatial/events/meeting_search.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace dymsum::spatial {

namespace {

int proved_sign(double value, double error) { return value > error ? 1 : value < -error ? -1 : 0; }

/// The side of a facet's plane on which a corner stays at all scales of a window; 0 where it changes or is not proved.
int lasting_side(const MovingFacets& all, std::uint32_t f, SumPoint c, double low, double high) {
  const PlaneRow& row = all.row(f);
  const Vec3 n = normal_of(row), x = all.fixed(c), m = all.moved(c);
  const auto size = [&](Vec3 v) { return std::abs(n.x * v.x) + std::abs(n.y * v.y) + std::abs(n.z * v.z); };
  const double a = dot(n, x) - row[4], b = dot(n, m) + row[3];
  const double error = (size(x) + std::abs(row[4]) + high * (size(m) + std::abs(row[3]))) * 0x1p-47;
  const int s = proved_sign(a + low * b, error);
  return s == proved_sign(a + high * b, error) ? s : 0;
}

using FourIndices = std::array<std::uint32_t, 4>;
struct FourHash {
  std::size_t operator()(const FourIndices& names) const {
    std::uint64_t h = 0;
    for (const std::uint32_t n : names) h = (h ^ n) * 0x9e3779b97f4a7c15ULL, h ^= h >> 29;
    return h;
  }
};

/// The search for meetings in one window of scales.
class MeetingSearch {
 public:
  MeetingSearch(const MovingFacets& all, const ScaledOverlap& overlap, double low, double high,
                const std::function<void()>& query)
      : all_(all), low_(low), high_(high), span_(all.span(high)), query_(query), list_(overlap, low, high, span_) {
    std::vector<std::uint32_t> facets, facet_edges, corners;
    std::vector<std::uint8_t> of_facet_edge(all.facet_edges().size()), of_corner(all.corners().size());
    for (std::uint32_t f = 0; f < all.facets().size(); ++f) {
      const SumFacet& facet = all.facets()[f];
      if (overlap.deep_inside(facet, low, high)) continue;
      facets.push_back(f);
      for (int k = 0; k < facet.corners; ++k)
        of_facet_edge[all.facet_edges().of(f, k)] = 1, of_corner[all.corners().of(f, k)] = 1;
    }
    for (std::uint32_t e = 0; e < of_facet_edge.size(); ++e)
      if (of_facet_edge[e] != 0 && !all.is_inner(e)) facet_edges.push_back(e);
    for (std::uint32_t c = 0; c < of_corner.size(); ++c)
      if (of_corner[c] != 0) corners.push_back(c);
    facets_ = live(std::move(facets), [&](std::uint32_t f) {
      return swept({all.facets()[f].corner.data(), static_cast<std::size_t>(all.facets()[f].corners)});
    });
    facet_edges_ = live(std::move(facet_edges), [&](std::uint32_t e) { return swept(all.facet_edges()[e]); });
    corners_ = live(std::move(corners), [&](std::uint32_t c) { return swept({&all.corners()[c], 1}); });
  }

  Meetings run() {
    corners_on_facets();
    corners_on_facet_edges();
    facet_edges_on_facet_edges();
    facet_edges_through_facets();
    facet_neighbours();
    four_facets();
    return {list_.take(), std::move(facets_), candidates_, exact_};
  }

 private:
  /// What needs not to be asked again of four hyperplanes, whatever facets and facet edges lie in them.
  enum class Common : std::uint8_t {
    open,     ///< a point outside of what is looked at, perhaps
    lasting,  ///< no one point in common
    done,     ///< the point is listed, covered, or at no scale of the window
  };

  void query_now_and_then() {
    if (++queried_ % 4096 == 0) query_();
  }
  template <class BoxOf>
  static LiveFeatures live(std::vector<std::uint32_t> features, const BoxOf& box_of) {
    std::vector<Box> boxes;
    boxes.reserve(features.size());
    for (const std::uint32_t feature : features) boxes.push_back(box_of(feature));
    return {BoxTree(std::move(boxes)), std::move(features)};
  }
  Box swept(const SumEdge& facet_edge) const { return swept(std::array{facet_edge.from, facet_edge.to}); }

  Box swept(std::span<const SumPoint> corners) const {
    Box box;
    for (const SumPoint c : corners) box.add(all_.at(c, low_)), box.add(all_.at(c, high_));
    box.grow(span_ * 0x1p-44);
    return box;
  }

  /// Lists a point that doubles leave open: `exact` gives it where it is one, and lies in all that is to meet there.
  template <class Exact>
  void decide(Meets meets, const NearMeeting& around, Exact exact) {
    if (meets == Meets::no) return;
    if (meets == Meets::near && (list_.is_beside_window(around) || list_.is_covered(around))) return;
    ++exact_;
    std::optional<ExactMeeting> at = exact();
    if (!at || at->s <= 0) return;
    if (meets != Meets::near && list_.is_covered(near(*at))) return;
    list_.add(*std::move(at));
  }

  /// The same of the one point of four hyperplanes: in masses of parallel and coplanar facets many fours of them lie in
  /// the same ones, which are decided once.
  Common four_planes(const FourIndices& planes, const MeetingFeatures& features) {
    const auto of_all = [&](auto get) {
      return std::array{get(planes[0]), get(planes[1]), get(planes[2]), get(planes[3])};
    };
    FourIndices names = of_all([&](std::uint32_t k) { return all_.name(k); });
    std::sort(names.begin(), names.end());
    if (std::adjacent_find(names.begin(), names.end()) != names.end()) return Common::lasting;
    if (const auto known = known_.find(names); known != known_.end()) return known->second;
    const auto learn = [&](Common what) { return known_.emplace(names, what).first->second; };
    ++candidates_;
    NearMeeting at;
    const Meets meets = meeting_near(of_all([&](std::uint32_t k) { return &all_.row(k); }), span_, at);
    if (meets == Meets::near) {
      if (list_.is_beside_window(at) || !may_hold(all_, features, at)) return Common::open;
      if (list_.is_covered(at)) return learn(Common::done);
    }
    ++exact_;
    std::optional<ExactMeeting> point = meeting_of(of_all([&](std::uint32_t k) { return &all_.plane(k); }));
    if (!point) return learn(Common::lasting);
    if (point->s <= 0) return learn(Common::done);
    const NearMeeting around = near(*point);
    if (!list_.is_in_window(around) || (meets != Meets::near && list_.is_covered(around))) return learn(Common::done);
    if (!hold(all_, features, *point, around)) return Common::open;
    list_.add(*std::move(point));
    return learn(Common::done);
  }

  void corners_on_facets() {
    for (std::uint32_t k = 0; k < corners_.size(); ++k) {
      const SumPoint c = all_.corners()[corners_[k]];
      facets_.for_each(corners_.box(k), [&](std::uint32_t f) {
        query_now_and_then();
        if (has_corner(all_.facets()[f], c)) return;
        if (lasting_side(all_, f, c, low_, high_) != 0) return;
        ++candidates_;
        NearMeeting at;
        const Meets meets = meeting_near(all_, c, all_.row(f), span_, at);
        if (meets == Meets::near && provably_holds(all_, f, at) < 0) return;
        decide(meets, at, [&]() -> std::optional<ExactMeeting> {
          std::optional<ExactMeeting> point = meeting_of(all_, c, all_.plane(f));
          if (point && (point->s <= 0 || !position_in(all_, f, *point, near(*point)).holds)) return std::nullopt;
          return point;
        });
      });
    }
  }

  // In general position a corner misses every facet edge. Where it stays in one of two planes along a facet edge, or
  // comes into both at once, the facets beside it may not determine when it comes onto it: they may all be in one plane
  // with its way.
  void corners_on_facet_edges() {
    for (std::uint32_t k = 0; k < corners_.size(); ++k) {
      const SumPoint c = all_.corners()[corners_[k]];
      facet_edges_.for_each(corners_.box(k), [&](std::uint32_t b) {
        const SumEdge& facet_edge = all_.facet_edges()[b];
        query_now_and_then();
        if (facet_edge.from == c || facet_edge.to == c) return;
        NearMeeting at[2];
        Meets meets[2];
        for (std::size_t i = 0; i < 2; ++i) {
          meets[i] = meeting_near(all_, c, all_.row(all_.planes_of(b)[i]), span_, at[i]);
          if (meets[i] == Meets::no || (meets[i] == Meets::near && list_.is_beside_window(at[i]))) return;
        }
        if (meets[0] == Meets::near && meets[1] == Meets::near &&
            std::abs(at[0].s - at[1].s) > 2 * (at[0].s_radius + at[1].s_radius))
          return;
        ++candidates_;
        const auto try_point = [&](const std::optional<ExactMeeting>& point) {
          if (!point || point->s <= 0 || !hold(all_, {{b}, {}}, *point, {})) return;
          decide(Meets::unsure, {}, [&] { return point; });
        };
        for (const std::uint32_t plane : all_.planes_of(b))
          if (!stays_in(all_, c, all_.plane(plane))) return try_point(meeting_of(all_, c, all_.plane(plane)));
        // Along the facet edge's own line: it meets the ends.
        for (const SumPoint end : {facet_edge.from, facet_edge.to}) {
          const BigVector direction = minus(all_.exact_moved(c), all_.exact_moved(end));
          for (std::size_t axis = 0; axis < 3; ++axis) {
            if (direction[axis] == 0) continue;
            MovingPlane wall{{0, 0, 0}, all_.exact_fixed(end)[axis], all_.exact_moved(end)[axis]};
            wall.n[axis] = 1;
            try_point(meeting_of(all_, c, wall));
            break;
          }
        }
      });
    }
  }

  void facet_edges_on_facet_edges() {
    for (std::uint32_t k = 0; k < facet_edges_.size(); ++k) {
      const std::uint32_t e = facet_edges_[k];
      facet_edges_.for_each(facet_edges_.box(k), [&](std::uint32_t g) {
        if (g <= e) return;
        query_now_and_then();
        if (share_end(all_.facet_edges()[e], all_.facet_edges()[g]) || all_.direction(e) == all_.direction(g)) return;
        const auto u = all_.planes_of(e), v = all_.planes_of(g);
        if (four_planes({u[0], u[1], v[0], v[1]}, {{e, g}, {}}) == Common::lasting) lasting_crossing(e, g);
      });
    }
  }

  /// Whether a plane is one of those that are known to hold a facet edge at all scales.
  bool bounds_plane(std::uint32_t facet_edge, std::uint32_t plane) const {
    const std::uint32_t name = all_.name(plane);
    const auto is_it = [&](std::uint32_t other) { return all_.name(other) == name; };
    const auto along = all_.planes_of(facet_edge);
    const auto facets = all_.facet_edges().around(facet_edge);
    return is_it(along[0]) || is_it(along[1]) || std::any_of(facets.begin(), facets.end(), is_it);
  }

  /// Two facet edges that cross at all scales, in one plane: where their crossing passes something else.
  void lasting_crossing(std::uint32_t e, std::uint32_t g) {
    const LastingCrossing crossing =
        lasting_crossing_of(all_, all_.facet_edges()[e], all_.facet_edges()[g], low_, high_);
    if (crossing.misses) return;
    const auto u = all_.planes_of(e), v = all_.planes_of(g);
    // Whether the crossing does not stay in the plane at all scales.
    const auto try_plane = [&](std::uint32_t plane, const MeetingFeatures& features) {
      if (bounds_plane(e, plane) || bounds_plane(g, plane)) return false;
      if (crossing.stays_beside(all_.row(plane))) return true;
      for (std::size_t left_out = 0; left_out < 4; ++left_out) {
        FourIndices four{u[0], u[1], v[0], v[1]};
        four[left_out] = plane;
        if (four_planes(four, features) != Common::lasting) return true;
      }
      return false;
    };
    const Box a = swept(all_.facet_edges()[e]), b = swept(all_.facet_edges()[g]);
    const Box both{{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y), std::max(a.low.z, b.low.z)},
                   {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y), std::min(a.high.z, b.high.z)}};
    facets_.for_each(both, [&](std::uint32_t f) { try_plane(f, {{e, g}, {f}}); });
    facet_edges_.for_each(both, [&](std::uint32_t t) {
      if (t == e || t == g) return;
      for (const std::uint32_t plane : all_.planes_of(t))
        if (try_plane(plane, {{e, g, t}, {}})) break;
    });
  }

  void facet_edges_through_facets() {
    std::vector<std::uint32_t> through;
    for (std::uint32_t k = 0; k < facet_edges_.size(); ++k) {
      const std::uint32_t e = facet_edges_[k];
      const SumEdge& facet_edge = all_.facet_edges()[e];
      through.clear();
      facets_.for_each(facet_edges_.box(k), [&](std::uint32_t f) {
        query_now_and_then();
        if (has_corner(all_.facets()[f], facet_edge.from) || has_corner(all_.facets()[f], facet_edge.to)) return;
        if (bounds_plane(e, f)) return;
        const int a = lasting_side(all_, f, facet_edge.from, low_, high_);
        if (a != 0 && a == lasting_side(all_, f, facet_edge.to, low_, high_)) return;
        through.push_back(f);
      });
      std::sort(through.begin(), through.end());
      const auto u = all_.planes_of(e);
      for (std::size_t i = 0; i < through.size(); ++i)
        for (std::size_t j = i + 1; j < through.size(); ++j) {
          const std::uint32_t f = through[i], g = through[j];
          query_now_and_then();
          if (all_.name(f) != all_.name(g)) four_planes({u[0], u[1], f, g}, {{e}, {f, g}});
        }
    }
  }

  /// Whether two facets may meet in more than a facet edge or a corner that they share.
  bool may_cross(std::uint32_t f, std::uint32_t g) const {
    const SumFacet &a = all_.facets()[f], &b = all_.facets()[g];
    if (all_.name(f) == all_.name(g)) return false;
    int shared = 0;
    const auto passes = [&](const SumFacet& facet, const SumFacet& other, std::uint32_t plane) {
      int below = 0, above = 0, open = 0;
      for (int k = 0; k < facet.corners; ++k) {
        if (has_corner(other, facet.corner[k])) continue;
        const int s = lasting_side(all_, plane, facet.corner[k], low_, high_);
        ++(s > 0 ? above : s < 0 ? below : open);
      }
      return open > 0 || (below > 0 && above > 0);
    };
    for (int k = 0; k < a.corners; ++k) shared += has_corner(b, a.corner[k]);
    return shared < 2 && passes(a, b, g) && passes(b, a, f);
  }

  void facet_neighbours() {
    neighbours_.assign(facets_.size(), {});
    for (std::uint32_t k = 0; k < facets_.size(); ++k) {
      facets_.for_each_position(facets_.box(k), [&](std::uint32_t j) {
        query_now_and_then();
        if (j > k && may_cross(facets_[k], facets_[j])) neighbours_[k].push_back(j);
      });
      std::sort(neighbours_[k].begin(), neighbours_[k].end());
    }
  }

  void four_facets() {
    std::vector<std::uint32_t> near_both;
    const auto of_three = [&](std::uint32_t f, std::uint32_t g, std::uint32_t h) {
      const SumFacet &a = all_.facets()[facets_[f]], &b = all_.facets()[facets_[g]], &c = all_.facets()[facets_[h]];
      return std::any_of(a.corner.begin(), a.corner.begin() + a.corners,
                         [&](SumPoint at) { return has_corner(b, at) && has_corner(c, at); });
    };
    for (std::uint32_t f = 0; f < facets_.size(); ++f)
      for (const std::uint32_t g : neighbours_[f]) {
        near_both.clear();
        std::set_intersection(neighbours_[f].begin(), neighbours_[f].end(), neighbours_[g].begin(),
                              neighbours_[g].end(), std::back_inserter(near_both));
        for (const std::uint32_t h : near_both) {
          if (of_three(f, g, h)) continue;
          for (const std::uint32_t i : near_both) {
            if (i <= h || !std::binary_search(neighbours_[h].begin(), neighbours_[h].end(), i)) continue;
            query_now_and_then();
            const FourIndices four{facets_[f], facets_[g], facets_[h], facets_[i]};
            four_planes(four, {{}, {four[0], four[1], four[2], four[3]}});
          }
        }
      }
  }

  const MovingFacets& all_;
  double low_, high_, span_;
  const std::function<void()>& query_;
  LiveFeatures facets_, facet_edges_, corners_;
  std::vector<std::vector<std::uint32_t>> neighbours_;  // of live facets, by position, with larger ones, sorted
  MeetingList list_;
  std::unordered_map<FourIndices, Common, FourHash> known_;  // by names of planes; not those that are open
  std::uint64_t candidates_ = 0, exact_ = 0, queried_ = 0;
};

}  // namespace

std::vector<double> window_ends(const MovingFacets& all, double low, double high) {
  double size = 0, direction = 0;
  for (const SumFacet& facet : all.facets()) {
    Box box;
    Vec3 moved;
    for (int k = 0; k < facet.corners; ++k) {
      box.add(all.at(facet.corner[k], high));
      moved = moved + 1.0 / facet.corners * all.moved(facet.corner[k]);
    }
    size += box.size() / 3, direction += length(moved);
  }
  const double steps = size > 0 ? std::clamp(std::ceil((high - low) * direction / size), 1.0, 4096.0) : 1;
  std::vector<double> ends;
  for (int k = 0; k < static_cast<int>(steps); ++k) ends.push_back(low + (high - low) * k / steps);
  ends.push_back(high);
  return ends;
}

Meetings find_meetings(const MovingFacets& all, const ScaledOverlap& overlap, double low, double high,
                       const std::function<void()>& query) {
  return MeetingSearch(all, overlap, low, high, query).run();
}

}  // namespace dymsum::spatial
