#include "spatial/events/event_judge.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>

namespace dymsum::spatial {

namespace {

using Kind = EventKind;
using Verdict = JudgedPoint::Verdict;

struct FacetThere {
  std::uint32_t facet;
  PlaceInFacet place;
};

Vec3 unit_normal(const MovingFacets& all, std::uint32_t f) {
  const PlaneRow& row = all.row(f);
  const Vec3 n{row[0], row[1], row[2]};
  return (1 / length(n)) * n;
}

bool are_parallel_planes(const MovingFacets& all, std::uint32_t f, std::uint32_t g) {
  if (length(cross(unit_normal(all, f), unit_normal(all, g))) > 0x1p-40) return false;
  const BigVector &a = all.plane(f).n, &b = all.plane(g).n;
  return a[1] * b[2] == a[2] * b[1] && a[2] * b[0] == a[0] * b[2] && a[0] * b[1] == a[1] * b[0];
}
/// Of parallel planes: whether they are one at all scales.
bool is_same_hyperplane(const MovingFacets& all, std::uint32_t f, std::uint32_t g) {
  const SumPoint c = all.facets()[f].corner[0];
  return stays_in(all, c, all.plane(g));
}

/// The facets through a point by the parts of them that it lies in.
struct Gathering {
  std::vector<FacetThere> facets;
  std::map<std::uint32_t, std::size_t> borders, corners;  // with their numbers of facets here
  std::size_t insides = 0;
  bool parallel = false, coplanar_now = false;

  Gathering(const MovingFacets& all, const EventSearch& search, const MeetingEvent& event) {
    Box box;
    box.add(event.near.x);
    box.grow(2 * event.near.radius + all.span(event.near.s) * 0x1p-44);
    search.for_each_facet(box, [&](std::uint32_t f) {
      const PlaceInFacet place = place_in(all, f, event.at, event.near);
      if (place.holds) facets.push_back({f, place});
    });
    std::sort(facets.begin(), facets.end(), [](const FacetThere& a, const FacetThere& b) { return a.facet < b.facet; });
    for (const FacetThere& there : facets) count(all, there);
    for (std::size_t i = 0; i < facets.size(); ++i)
      for (std::size_t j = i + 1; j < facets.size(); ++j)
        if (are_parallel_planes(all, facets[i].facet, facets[j].facet)) {
          parallel = true;
          coplanar_now |= !is_same_hyperplane(all, facets[i].facet, facets[j].facet);
        }
  }

  Kind kind() const {
    if (coplanar_now) return Kind::coplanar_facets;
    if (!corners.empty()) return Kind::vertex_on_facet;
    return borders.size() > 1 ? Kind::edge_on_edge : Kind::four_facets;
  }

  /// A corner with all its facets on another one's inside, two borders with all theirs, a border on two facets, or four
  /// facets; no two of them parallel.
  bool is_general(const MovingFacets& all) const {
    if (parallel || corners.size() > 1) return false;
    for (const auto& [border, here] : borders)
      if (here < 2 || here != all.facets_of(all.borders()[border]).size()) return false;
    if (corners.empty()) return 2 * borders.size() + insides == 4;
    const auto& [corner, here] = *corners.begin();
    return borders.empty() && insides == 1 && here == all.facets_of(all.corners()[corner]).size();
  }

 private:
  void count(const MovingFacets& all, const FacetThere& there) {
    const int sides = std::popcount(there.place.on);
    if (sides == 0) {
      ++insides;
      return;
    }
    const int n = all.facets()[there.facet].corners;
    for (int k = 0; k < n; ++k) {
      const bool here = (there.place.on >> k & 1) != 0, before = (there.place.on >> ((k + n - 1) % n) & 1) != 0;
      if (sides == 1 && here) ++borders[all.border_of(there.facet, k)];
      if (sides == 2 && here && before) ++corners[all.corner_of(there.facet, k)];
    }
  }
};

constexpr double kLeastFall = 0x1p-7;

/// A unit vector that surely goes from the front of all these facets to their backs; nothing where there is none. The
/// steepest one has the same fall at one, two or three of them.
std::optional<Vec3> common_way_in(const MovingFacets& all, const std::vector<FacetThere>& facets) {
  std::vector<Vec3> n;
  for (const FacetThere& there : facets) n.push_back(unit_normal(all, there.facet));
  std::optional<Vec3> best;
  double least = kLeastFall;
  const auto try_way = [&](Vec3 d) {
    const double size = length(d);
    if (size < 0x1p-30) return;
    for (const double s : {-1 / size, 1 / size}) {
      double fall = 1;
      for (const Vec3& m : n) fall = std::min(fall, -s * dot(m, d));
      if (fall > least) least = fall, best = s * d;
    }
  };
  const std::size_t most = std::min<std::size_t>(n.size(), 24);
  for (std::size_t i = 0; i < most; ++i) {
    try_way(n[i]);
    for (std::size_t j = i + 1; j < most; ++j) {
      try_way(n[i] + n[j]);
      for (std::size_t k = j + 1; k < most; ++k) try_way(cross(n[j] - n[i], n[k] - n[i]));
    }
  }
  return best;
}

/// Whether a facet surely misses the segment from x to y.
bool misses(const MovingFacets& all, std::uint32_t f, Vec3 x, Vec3 y, double s, double room) {
  const PlaneRow& row = all.row(f);
  const Vec3 n{row[0], row[1], row[2]};
  const double a = dot(n, x) + row[3] * s - row[4], b = dot(n, y) + row[3] * s - row[4];
  if ((a > room && b > room) || (a < -room && b < -room)) return true;
  Box facet, way;
  const SumFacet& of = all.facets()[f];
  for (int k = 0; k < of.corners; ++k) facet.add(all.at(of.corner[k], s));
  way.add(x), way.add(y);
  way.grow(room);
  return !overlap(facet, way);
}

/// A place in front of all facets through the point, from which nothing lies between; nothing where others are too
/// near.
std::optional<Vec3> place_in_front(const MovingFacets& all, const EventSearch& search,
                                   const std::vector<FacetThere>& facets, Vec3 in, const NearMeeting& at) {
  const double span = all.span(at.s), room = span * 0x1p-40 + 16 * (at.radius + at.s_radius * span);
  for (const int power : {8, 11, 14, 17, 20, 23}) {
    const double step = std::ldexp(span, -power);
    if (step * kLeastFall < 4 * room) return std::nullopt;
    const Vec3 y = at.x - step * in;
    Box box;
    box.add(at.x), box.add(y);
    box.grow(room);
    bool clear = true;
    search.for_each_facet(box, [&](std::uint32_t f) {
      if (!clear) return;
      const bool here = std::any_of(facets.begin(), facets.end(), [&](const FacetThere& t) { return t.facet == f; });
      clear = here || misses(all, f, at.x, y, at.s, room);
    });
    if (clear) return y;
  }
  return std::nullopt;
}

}  // namespace

JudgedPoint judge(const MovingFacets& all, const EventSearch& search, const ScaledOverlap& overlap,
                  const MeetingEvent& event) {
  const Gathering there(all, search, event);
  JudgedPoint result{Verdict::unknown, there.kind(), {}, there.is_general(all)};
  const NearMeeting& at = event.near;
  if (const std::optional<Vec3> in = common_way_in(all, there.facets))
    if (const std::optional<Vec3> y = place_in_front(all, search, there.facets, *in, at))
      if (overlap.at(*y, at.s, 2 * at.radius, at.s_radius) == ScaledOverlap::Answer::apart)
        result.verdict = result.is_general ? Verdict::changes : Verdict::quiet;
  if (result.verdict == Verdict::unknown)
    for (const FacetThere& f : there.facets) result.facets.push_back(f.facet);
  return result;
}

}  // namespace dymsum::spatial
