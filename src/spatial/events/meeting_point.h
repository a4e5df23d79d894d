// Where moving planes meet: exact points of (x, s), and their doubles.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "spatial/events/moving_facets.h"

namespace dymsum::spatial {

/// The position x / w at the scale s / w; w > 0.
struct ExactMeeting {
  BigVector x;
  exact::BigInteger s, w;

  exact::BigRational scale() const { return exact::ratio(exact::Big(s), exact::Big(w)); }
};

/// The one point that four hyperplanes have in common; nothing where it is not one.
std::optional<ExactMeeting> meeting_of(const std::array<const MovingPlane*, 4>& planes);
/// Where a corner's line passes a hyperplane; nothing where it stays on one side or in it.
std::optional<ExactMeeting> meeting_of(const MovingFacets& all, SumPoint corner, const MovingPlane& plane);
/// Whether a corner stays in a hyperplane at all scales.
bool stays_in(const MovingFacets& all, SumPoint corner, const MovingPlane& plane);

/// Doubles near a point: every coordinate of x within `radius`, s within `s_radius`.
struct NearMeeting {
  Vec3 x;
  double s = 0;
  double radius = 0, s_radius = 0;
};
enum class Meets : std::uint8_t { no, near, unsure };
/// The same in doubles; `unsure` where these do not tell whether there is one point.
Meets meeting_near(const std::array<const PlaneRow*, 4>& rows, double span, NearMeeting& at);
Meets meeting_near(const MovingFacets& all, SumPoint corner, const PlaneRow& row, double span, NearMeeting& at);
NearMeeting near(const ExactMeeting& at);

/// Where a point of a facet's plane lies in it.
struct PlaceInFacet {
  bool holds = false;
  std::uint8_t on = 0;  ///< bit k: on the border from corner k to k + 1
};
/// Whether the facet's plane may hold the point, and the facet, by doubles: no only where that is sure.
bool may_hold(const MovingFacets& all, std::uint32_t facet, const NearMeeting& at);
bool may_hold(const MovingFacets& all, const MovingBorder& border, const NearMeeting& at);
/// 1 where the facet surely holds a point of its plane, -1 where it surely does not, else 0.
int surely_holds(const MovingFacets& all, std::uint32_t facet, const NearMeeting& at);
/// Exact.
PlaceInFacet place_in(const MovingFacets& all, std::uint32_t facet, const ExactMeeting& at, const NearMeeting& near);
bool lies_on(const MovingFacets& all, const MovingBorder& border, const ExactMeeting& at);

}  // namespace dymsum::spatial
