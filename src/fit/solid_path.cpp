#include "fit/solid_path.h"

#include <algorithm>
#include <cmath>

#include "spatial/boundary/collision.h"
#include "spatial/motion/computed_scale.h"
#include "spatial/sum/feature_pairs.h"

namespace dymsum::spatial {

using exact::BigInteger;
using exact::BigRational;

namespace {

/// n . x = d for a rational plane, in integers.
MovingPlane still_plane(const std::array<BigRational, 3>& n, const BigRational& d) {
  BigInteger scale = denominator(d);
  for (const BigRational& c : n) scale = lcm(scale, denominator(c));
  const auto whole = [&](const BigRational& v) { return BigInteger(numerator(v) * (scale / denominator(v))); };
  MovingPlane plane;
  plane.n = {whole(n[0]), whole(n[1]), whole(n[2])}, plane.d0 = whole(d), plane.d1 = 0;
  return plane;
}

/// The hyperplane of one scale.
MovingPlane level_plane(const BigRational& s) {
  MovingPlane level;
  level.n = {0, 0, 0}, level.d0 = -numerator(s), level.d1 = denominator(s);
  return level;
}

}  // namespace

SolidPath::SolidPath(const MovingFacets& all, const ScaledOverlap& overlap, const std::vector<RationalPoint3>& path)
    : all_(all), overlap_(overlap), unit_(std::ldexp(1.0, all.pair().p_positions.exponent)) {
  const BigRational unit = exact::exact_value(unit_);
  for (const RationalPoint3& p : path)
    way_.push_back({exact::exact_value(p.x) / unit, exact::exact_value(p.y) / unit, exact::exact_value(p.z) / unit});
  for (std::size_t k = 0; k + 1 < way_.size(); ++k) {
    std::array<BigRational, 3> along;
    std::size_t most = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      along[axis] = way_[k + 1][axis] - way_[k][axis];
      if (abs(along[axis]) > abs(along[most])) most = axis;
    }
    Leg leg;
    for (std::size_t i = 0; i < 2; ++i) {
      // along x axis: upright on both.
      const std::size_t axis = (most + 1 + i) % 3, b = (axis + 1) % 3, c = (axis + 2) % 3;
      std::array<BigRational, 3> n;
      n[b] = along[c], n[c] = -along[b];
      leg.planes[i] = still_plane(n, n[0] * way_[k][0] + n[1] * way_[k][1] + n[2] * way_[k][2]);
      leg.rows[i] = row_of(leg.planes[i]);
    }
    legs_.push_back(std::move(leg));
  }
}

BigRational SolidPath::along(std::uint32_t leg, const ExactMeeting& at) const {
  BigRational up = 0, size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const BigRational way = way_[leg + 1][axis] - way_[leg][axis];
    up += way * (exact::ratio(exact::Big(at.x[axis]), exact::Big(at.w)) - way_[leg][axis]);
    size += way * way;
  }
  return up / size;
}

std::array<BigRational, 3> SolidPath::position(std::uint32_t leg, const BigRational& t) const {
  std::array<BigRational, 3> x;
  for (std::size_t axis = 0; axis < 3; ++axis) x[axis] = way_[leg][axis] + t * (way_[leg + 1][axis] - way_[leg][axis]);
  return x;
}

void SolidPath::add(Critical& to, const ExactMeeting& at, std::uint32_t facet, std::uint32_t leg) const {
  if (at.s <= 0) return;
  const SolidContact features = features_of(all_.facets()[facet], all_.pair().p, all_.pair().q);
  SolidScaleContact contact;
  contact.part = features.q, contact.obstacle = features.p, contact.leg = leg;
  if (!legs_.empty()) contact.along = exact::to_rational(along(leg, at));
  const BigRational unit = exact::exact_value(unit_);
  const auto coordinate = [&](std::size_t axis) {
    return exact::to_rational(BigRational(exact::ratio(exact::Big(at.x[axis]), exact::Big(at.w)) * unit));
  };
  contact.at = {coordinate(0), coordinate(1), coordinate(2)};
  std::vector<SolidScaleContact>& list = to[at.scale()];
  if (std::find(list.begin(), list.end(), contact) == list.end()) list.push_back(std::move(contact));
}

SolidPath::Critical SolidPath::critical(const std::function<void(double)>& query) const {
  Critical found;
  const auto facets = static_cast<std::uint32_t>(all_.facets().size());
  for (std::uint32_t f = 0; f < facets; ++f) {
    if (f % 64 == 0) query(static_cast<double>(f) / facets);
    for (std::uint32_t k = 0; k < way_.size(); ++k) {
      const std::array<MovingPlane, 3> still{still_plane({1, 0, 0}, way_[k][0]), still_plane({0, 1, 0}, way_[k][1]),
                                             still_plane({0, 0, 1}, way_[k][2])};
      const auto at = meeting_of({&still[0], &still[1], &still[2], &all_.plane(f)});
      if (!at || at->s <= 0 || !position_in(all_, f, *at, near(*at)).holds) continue;
      add(found, *at, f, k < legs_.size() || k == 0 ? k : k - 1);
    }
    for (std::uint32_t k = 0; k < legs_.size(); ++k) {
      for (int i = 0; i < all_.facets()[f].corners; ++i) {
        const std::uint32_t b = all_.facet_edges().of(f, i);
        const auto along_it = all_.planes_of(b);
        NearMeeting around;
        const Meets meets =
            meeting_near({&legs_[k].rows[0], &legs_[k].rows[1], &all_.row(along_it[0]), &all_.row(along_it[1])},
                         all_.span(1), around);
        if (meets == Meets::near && (around.s < -around.s_radius || !may_hold(all_, {{b}, {}}, around))) continue;
        const auto at =
            meeting_of({&legs_[k].planes[0], &legs_[k].planes[1], &all_.plane(along_it[0]), &all_.plane(along_it[1])});
        if (!at || at->s <= 0 || !hold(all_, {{b}, {}}, *at, {})) continue;
        const BigRational t = along(k, *at);
        if (t >= 0 && t <= 1) add(found, *at, f, k);
      }
    }
  }
  return found;
}

/// The parameters at which facets cross a leg at a scale, from 0 to 1 along it, both included.
std::vector<BigRational> SolidPath::cuts(std::uint32_t leg, const BigRational& s) const {
  std::vector<BigRational> cuts{0, 1};
  const MovingPlane level = level_plane(s);
  const PlaneRow level_row = row_of(MovingPlane{{0, 0, 0}, level.d0, level.d1});
  const double near_s = exact::round_to_double(s);
  for (std::uint32_t f = 0; f < all_.facets().size(); ++f) {
    NearMeeting around;
    const Meets meets =
        meeting_near({&legs_[leg].rows[0], &legs_[leg].rows[1], &all_.row(f), &level_row}, all_.span(near_s), around);
    if (meets == Meets::near && provably_holds(all_, f, around) < 0) continue;
    const auto at = meeting_of({&legs_[leg].planes[0], &legs_[leg].planes[1], &all_.plane(f), &level});
    if (!at || !position_in(all_, f, *at, near(*at)).holds) continue;
    if (const BigRational t = along(leg, *at); t > 0 && t < 1) cuts.push_back(t);
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

bool SolidPath::overlaps(const std::array<BigRational, 3>& x, const BigRational& s) const {
  const Vec3 near_x{exact::round_to_double(x[0]), exact::round_to_double(x[1]), exact::round_to_double(x[2])};
  const double near_s = exact::round_to_double(s), far = std::abs(near_x.x) + std::abs(near_x.y) + std::abs(near_x.z);
  const ScaledOverlap::Answer answer = overlap_.at(near_x, near_s, far * 0x1p-51, near_s * 0x1p-51);
  if (answer != ScaledOverlap::Answer::unsure) return answer == ScaledOverlap::Answer::overlap;
  const PosedSpace posed = posed_space(all_.pair(), all_.poses(computed_scale(s)));
  const BigRational scale = BigRational(posed.scale) * exact::exact_value(unit_);
  const std::optional<PointSource> at = posed.space->add_position({x[0] * scale, x[1] * scale, x[2] * scale});
  if (!at) return false;
  return Collision(*posed.space, all_.pair().p, all_.pair().q).overlaps({*at, 0, 0, 0, 0, 0});
}

// Between the cuts no facet is passed, so the leg lies inside or outside the open sum as a whole.
bool SolidPath::free(const BigRational& s) const {
  for (const std::array<BigRational, 3>& x : way_)
    if (overlaps(x, s)) return false;
  for (std::uint32_t k = 0; k < legs_.size(); ++k) {
    const std::vector<BigRational> at = cuts(k, s);
    for (std::size_t i = 0; i + 1 < at.size(); ++i)
      if (overlaps(position(k, BigRational((at[i] + at[i + 1]) / 2)), s)) return false;
  }
  return true;
}

}  // namespace dymsum::spatial
