#include "spatial/events/scale_judge.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "exact/grid.h"

namespace dymsum::spatial {

using exact::BigInteger;
using exact::BigRational;

namespace {

using Kind = EventKind;
using Verdict = JudgedPoint::Verdict;

struct FacetThere {
  std::uint32_t facet;
  PositionInFacet position;
};

Vec3 unit_normal(const MovingFacets& all, std::uint32_t f) {
  const Vec3 n = normal_of(all.row(f));
  return (1 / length(n)) * n;
}

bool are_parallel_planes(const MovingFacets& all, std::uint32_t f, std::uint32_t g) {
  if (length(cross(unit_normal(all, f), unit_normal(all, g))) > 0x1p-40) return false;
  return is_zero(cross(all.plane(f).n, all.plane(g).n));
}

/// The facets through a point by the parts of them that it lies in.
struct Gathering {
  std::vector<FacetThere> facets;
  std::map<std::uint32_t, std::size_t> facet_edges, corners;  // with their numbers of facets here
  std::size_t insides = 0;
  bool parallel = false, coplanar_now = false;

  Gathering(const MovingFacets& all, const LiveFeatures& live, const MeetingEvent& event) {
    Box box;
    box.add(event.near.x);
    box.grow(2 * event.near.radius + all.span(event.near.s) * 0x1p-44);
    live.for_each(box, [&](std::uint32_t f) {
      const PositionInFacet position = position_in(all, f, event.at, event.near);
      if (position.holds) facets.push_back({f, position});
    });
    std::sort(facets.begin(), facets.end(), [](const FacetThere& a, const FacetThere& b) { return a.facet < b.facet; });
    for (const FacetThere& there : facets) count(all, there);
    for (std::size_t i = 0; i < facets.size(); ++i)
      for (std::size_t j = i + 1; j < facets.size(); ++j)
        if (are_parallel_planes(all, facets[i].facet, facets[j].facet)) {
          parallel = true;
          coplanar_now |= all.name(facets[i].facet) != all.name(facets[j].facet);
        }
  }

  Kind kind() const {
    if (coplanar_now) return Kind::coplanar_facets;
    if (!corners.empty()) return Kind::vertex_on_facet;
    return facet_edges.size() > 1 ? Kind::edge_on_edge : Kind::four_facets;
  }

  /// A corner with all its facets on another one's inside, two facet edges with all theirs, a facet edge on two facets,
  /// or four facets; no two of them parallel.
  bool is_general(const MovingFacets& all) const {
    if (parallel || corners.size() > 1) return false;
    for (const auto& [facet_edge, here] : facet_edges)
      if (here < 2 || here != all.facet_edges().around(facet_edge).size()) return false;
    if (corners.empty()) return 2 * facet_edges.size() + insides == 4;
    const auto& [corner, here] = *corners.begin();
    return facet_edges.empty() && insides == 1 && here == all.corners().around(corner).size();
  }

 private:
  void count(const MovingFacets& all, const FacetThere& there) {
    const int sides = std::popcount(there.position.on);
    if (sides == 0) {
      ++insides;
      return;
    }
    const int n = all.facets()[there.facet].corners;
    for (int k = 0; k < n; ++k) {
      const bool here = (there.position.on >> k & 1) != 0, before = (there.position.on >> ((k + n - 1) % n) & 1) != 0;
      if (sides == 1 && here) ++facet_edges[all.facet_edges().of(there.facet, k)];
      if (sides == 2 && here && before) ++corners[all.corners().of(there.facet, k)];
    }
  }
};

constexpr double kLeastFall = 0x1p-7;

/// A unit vector that provably goes from the front of all these facets to their backs; nothing where there is none. The
/// steepest one has the same fall at one, two or three of them.
std::optional<Vec3> common_direction_in(const MovingFacets& all, const std::vector<FacetThere>& facets) {
  std::vector<Vec3> n;
  for (const FacetThere& there : facets) n.push_back(unit_normal(all, there.facet));
  std::optional<Vec3> best;
  double least = kLeastFall;
  const auto try_direction = [&](Vec3 d) {
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
    try_direction(n[i]);
    for (std::size_t j = i + 1; j < most; ++j) {
      try_direction(n[i] + n[j]);
      for (std::size_t k = j + 1; k < most; ++k) try_direction(cross(n[j] - n[i], n[k] - n[i]));
    }
  }
  return best;
}

/// Whether a facet provably misses the segment from x to y.
bool misses(const MovingFacets& all, std::uint32_t f, Vec3 x, Vec3 y, double s, double room) {
  const PlaneRow& row = all.row(f);
  const Vec3 n = normal_of(row);
  const double a = dot(n, x) + row[3] * s - row[4], b = dot(n, y) + row[3] * s - row[4];
  if ((a > room && b > room) || (a < -room && b < -room)) return true;
  Box facet, direction;
  const SumFacet& of = all.facets()[f];
  for (int k = 0; k < of.corners; ++k) facet.add(all.at(of.corner[k], s));
  direction.add(x), direction.add(y);
  direction.grow(room);
  return !overlap(facet, direction);
}

/// A position in front of all facets through the point, from which nothing lies between; nothing where others are too
/// near.
std::optional<Vec3> place_in_front(const MovingFacets& all, const LiveFeatures& live,
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
    live.for_each(box, [&](std::uint32_t f) {
      if (!clear) return;
      const bool here = std::any_of(facets.begin(), facets.end(), [&](const FacetThere& t) { return t.facet == f; });
      clear = here || misses(all, f, at.x, y, at.s, room);
    });
    if (clear) return y;
  }
  return std::nullopt;
}

}  // namespace

JudgedPoint judge(const MovingFacets& all, const LiveFeatures& live, const ScaledOverlap& overlap,
                  const MeetingEvent& event) {
  const Gathering there(all, live, event);
  JudgedPoint result{Verdict::unknown, there.kind(), {}, there.is_general(all)};
  const NearMeeting& at = event.near;
  if (const std::optional<Vec3> in = common_direction_in(all, there.facets))
    if (const std::optional<Vec3> y = place_in_front(all, live, there.facets, *in, at))
      if (overlap.at(*y, at.s, 2 * at.radius, at.s_radius) == ScaledOverlap::Answer::apart)
        result.verdict = result.is_general ? Verdict::changes : Verdict::quiet;
  if (result.verdict == Verdict::unknown)
    for (const FacetThere& f : there.facets) result.facets.push_back(f.facet);
  return result;
}

namespace {

PosedSpace space_at(const MovingFacets& all, const BigRational& s) {
  const auto scaled = [](const BigInteger& num, const BigInteger& den) {
    return ExactPose{{num, 0, 0, 0, num, 0, 0, 0, num}, den};
  };
  ExactPose moved = scaled(numerator(s), denominator(s)), fixed = scaled(1, 1);
  if (all.moving() == 0) return posed_space(all.pair(), std::move(moved), std::move(fixed));
  return posed_space(all.pair(), std::move(fixed), std::move(moved));
}

}  // namespace

bool ExactJudge::has_room(const MovingFacets& all, const BigRational& s) {
  const auto longer = std::max(msb(numerator(s)), msb(denominator(s)));
  return static_cast<int>(longer) + 1 + all.pair().p_positions.bits <= kMostGridBits;
}

ExactJudge::ExactJudge(const MovingFacets& all, const BigRational& s)
    : all_(all), space_(space_at(all, s)), collision_(*space_.space, all.pair().p, all.pair().q) {}

JudgedPoint::Verdict ExactJudge::verdict(const ExactMeeting& at, const JudgedPoint& judged) {
  std::array<BigRational, 3> world;
  for (int axis = 0; axis < 3; ++axis) {
    const int unit = space_.space->line(axis).exponent;
    world[static_cast<std::size_t>(axis)] =
        exact::ratio(exact::Big(BigInteger((at.x[static_cast<std::size_t>(axis)] * space_.scale) << std::max(unit, 0))),
                     exact::Big(BigInteger(at.w << std::max(-unit, 0))));
  }
  const std::optional<PointSource> position = space_.space->add_position(world);
  if (!position) return Verdict::unknown;
  if (collision_.overlaps({*position})) return Verdict::covered;
  const std::optional<Flag> front = in_front_of_all(*position, judged.facets);
  if (!front || collision_.meets(*front)) return Verdict::unknown;
  return judged.is_general ? Verdict::changes : Verdict::quiet;
}

/// A flag at the position whose steps lead to the front of all these facets, off all of them. Where such ways are a
/// cone with an inside, one of its rays is either the normal of a facet or runs along two of their planes, and a step
/// from there off both of these is in it.
std::optional<Flag> ExactJudge::in_front_of_all(const PointSource& position, std::span<const std::uint32_t> facets) {
  std::vector<PlaneSource> sources;
  for (const std::uint32_t f : facets) sources.push_back(all_.convolution().planes[f]);
  SumSpace& space = *space_.space;
  const PlaneId first = space.add_planes(sources);
  const auto provably_after = [&](Vec3 direction) {
    return std::any_of(sources.begin(), sources.end(), [&](const PlaneSource& source) {
      const auto k = static_cast<PlaneId>(&source - sources.data());
      return dot(space.plane(first + k).n, direction) < -0x1p-40;
    });
  };
  const auto is_in_front = [&](const Flag& flag) {
    return std::all_of(sources.begin(), sources.end(),
                       [&](const PlaneSource& source) { return space.exact_side(source, flag) > 0; });
  };
  const auto count = static_cast<PlaneId>(sources.size());
  for (PlaneId i = 0; i < count; ++i) {
    const Flag flag{position, first + i, 0, 0, 0, 1};
    if (!provably_after(space.plane(first + i).n) && is_in_front(flag)) return flag;
  }
  // The flag points against n x n_cut, then to the left of that, which is to the front of `cut`, then off the plane.
  for (PlaneId i = 0; i < count; ++i)
    for (PlaneId k = 0; k < count; ++k) {
      if (i == k || provably_after(cross(space.plane(first + k).n, space.plane(first + i).n))) continue;
      const Flag flag{position, first + i, first + k, -1, 1, 1};
      if (is_in_front(flag)) return flag;
    }
  return std::nullopt;
}

}  // namespace dymsum::spatial
