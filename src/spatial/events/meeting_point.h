// The points in which moving planes meet: exact points of (x, s), and their doubles.
#pragma once

#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>

#include "spatial/events/moving_facets.h"

namespace dymsum::spatial {

/// The position x / w at the scale s / w; w > 0.
struct ExactMeeting {
  BigVector x;
  exact::BigInteger s, w;

  exact::BigRational scale() const { return exact::ratio(exact::Big(s), exact::Big(w)); }
};

using FourPlanes = std::array<const MovingPlane*, 4>;
/// The one point that four hyperplanes have in common; nothing where it is not one.
std::optional<ExactMeeting> meeting_of(const FourPlanes& planes);
/// The point at which a corner's line passes a hyperplane; nothing where it stays on one side or in it.
std::optional<ExactMeeting> meeting_of(const ScalingPair& all, SumPoint corner, const MovingPlane& plane);
/// Whether a corner stays in a hyperplane at all scales.
bool stays_in(const ScalingPair& all, SumPoint corner, const MovingPlane& plane);

/// Doubles near a point: every coordinate of x within `radius`, s within `s_radius`.
struct NearMeeting {
  Vec3 x;
  double s = 0;
  double radius = 0, s_radius = 0;
};
enum class Meets : std::uint8_t { no, near, unsure };
/// The same in doubles; `unsure` where these do not determine whether there is one point.
Meets meeting_near(const std::array<const PlaneRow*, 4>& rows, double span, NearMeeting& at);
Meets meeting_near(const ScalingPair& all, SumPoint corner, const PlaneRow& row, double span, NearMeeting& at);
NearMeeting near(const ExactMeeting& at);

/// The part of a facet in which a point of its plane lies.
struct PositionInFacet {
  bool holds = false;
  std::uint8_t on = 0;  ///< bit k: on the facet edge from corner k to k + 1
};
/// 1 where the facet provably holds a point of its plane, -1 where it provably does not, else 0.
int provably_holds(const MovingFacets& all, std::uint32_t facet, const NearMeeting& at);
/// Exact.
PositionInFacet position_in(const MovingFacets& all, std::uint32_t facet, const ExactMeeting& at,
                            const NearMeeting& near);

/// Facet edges and facets that are to meet in a point.
struct MeetingFeatures {
  std::initializer_list<std::uint32_t> facet_edges, facets;
};
/// Whether all of them hold a point of their planes: by doubles, no only where that is proved; and exactly.
bool may_hold(const MovingFacets& all, const MeetingFeatures& features, const NearMeeting& at);
bool hold(const MovingFacets& all, const MeetingFeatures& features, const ExactMeeting& at, const NearMeeting& near);

/// Two facet edges that cross at all scales, in one plane: where their crossing is at both ends of a window, in
/// doubles. Its position is a linear function of the scale: what holds at both ends of a window of the sides of a
/// hyperplane holds between them.
struct LastingCrossing {
  bool misses = false;  ///< provably beyond an end of a facet edge at all scales of the window
  bool known = false;   ///< the positions are
  std::array<Vec3, 2> at;
  std::array<double, 2> scale{};
  double blur = 0;  ///< of every coordinate

  /// Whether the crossing provably stays on one side of a hyperplane.
  bool stays_beside(const PlaneRow& row) const;
};

/// The crossing of facet edges in one plane that are not parallel, at scales from `low` to `high`.
LastingCrossing lasting_crossing_of(const MovingFacets& all, const SumEdge& one, const SumEdge& other, double low,
                                    double high);

}  // namespace dymsum::spatial
