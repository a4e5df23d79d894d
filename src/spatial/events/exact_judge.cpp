#include "spatial/events/exact_judge.h"

#include <algorithm>
#include <utility>

#include "exact/grid.h"
#include "spatial/convolution/sum_space.h"

namespace dymsum::spatial {

using exact::BigInteger;
using exact::BigRational;

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
  return static_cast<int>(longer) + 1 + all.pair().p_places.bits <= kMostGridBits;
}

ExactJudge::ExactJudge(const MovingFacets& all, const BigRational& s)
    : all_(all), space_(space_at(all, s)), collision_(*space_.space, all.pair().p, all.pair().q) {}

JudgedPoint::Verdict ExactJudge::verdict(const ExactMeeting& at, const JudgedPoint& judged) {
  using Verdict = JudgedPoint::Verdict;
  std::array<BigRational, 3> world;
  for (int axis = 0; axis < 3; ++axis) {
    const int unit = space_.space->line(axis).exponent;
    world[static_cast<std::size_t>(axis)] =
        exact::ratio(exact::Big(BigInteger((at.x[static_cast<std::size_t>(axis)] * space_.scale) << std::max(unit, 0))),
                     exact::Big(BigInteger(at.w << std::max(-unit, 0))));
  }
  const std::optional<PointSource> place = space_.space->add_place(world);
  if (!place) return Verdict::unknown;
  if (collision_.overlaps({*place})) return Verdict::covered;
  const std::optional<Flag> front = in_front_of_all(*place, judged.facets);
  if (!front || collision_.meets(*front)) return Verdict::unknown;
  return judged.is_general ? Verdict::changes : Verdict::quiet;
}

/// A flag at the place whose steps lead to the front of all these facets, off all of them. Where such ways are a cone
/// with an inside, one of its rays is either the normal of a facet or runs along two of their planes, and a step from
/// there off both of these is in it.
std::optional<Flag> ExactJudge::in_front_of_all(const PointSource& place, std::span<const std::uint32_t> facets) {
  std::vector<PlaneSource> sources;
  for (const std::uint32_t f : facets) sources.push_back(all_.convolution().planes[f]);
  SumSpace& space = *space_.space;
  const PlaneId first = space.add_planes(sources);
  const auto surely_behind = [&](Vec3 way) {
    return std::any_of(sources.begin(), sources.end(), [&](const PlaneSource& source) {
      const auto k = static_cast<PlaneId>(&source - sources.data());
      return dot(space.plane(first + k).n, way) < -0x1p-40;
    });
  };
  const auto is_in_front = [&](const Flag& flag) {
    return std::all_of(sources.begin(), sources.end(),
                       [&](const PlaneSource& source) { return space.exact_side(source, flag) > 0; });
  };
  const auto count = static_cast<PlaneId>(sources.size());
  for (PlaneId i = 0; i < count; ++i) {
    const Flag flag{place, first + i, 0, 0, 0, 1};
    if (!surely_behind(space.plane(first + i).n) && is_in_front(flag)) return flag;
  }
  // Against n x n_cut, then to the left of that, which is to the front of `cut`, then off the plane.
  for (PlaneId i = 0; i < count; ++i)
    for (PlaneId k = 0; k < count; ++k) {
      if (i == k || surely_behind(cross(space.plane(first + k).n, space.plane(first + i).n))) continue;
      const Flag flag{place, first + i, first + k, -1, 1, 1};
      if (is_in_front(flag)) return flag;
    }
  return std::nullopt;
}

}  // namespace dymsum::spatial
