// A path of translations against the open sum of solid obstacles and a scaled, reflected part.
#pragma once

#include <functional>
#include <map>

#include "dymsum/solid_scale_range.h"
#include "spatial/events/meeting_point.h"
#include "spatial/events/proved_overlap.h"

namespace dymsum::spatial {

class SolidPath {
 public:
  /// P: obstacles; Q: the reflected part, which scales. Requires at least one waypoint, no two of them equal in
  /// succession; the facets have to live as long.
  SolidPath(const MovingFacets& all, const ScaledOverlap& overlap, const std::vector<RationalPoint3>& path);

  using Critical = std::map<exact::BigRational, std::vector<SolidScaleContact>>;
  /// Scales at which a facet comes to a waypoint or a facet edge of one to a leg, with what touches. `query` may throw.
  Critical critical(const std::function<void(double)>& query) const;
  /// Whether the part at this scale overlaps the obstacles nowhere on the path. Exact.
  bool free(const exact::BigRational& s) const;

 private:
  struct Leg {
    std::array<MovingPlane, 2> planes;
    std::array<PlaneRow, 2> rows;
  };
  void add(Critical& to, const ExactMeeting& at, std::uint32_t facet, std::uint32_t leg) const;
  exact::BigRational along(std::uint32_t leg, const ExactMeeting& at) const;
  std::vector<exact::BigRational> cuts(std::uint32_t leg, const exact::BigRational& s) const;
  bool overlaps(const std::array<exact::BigRational, 3>& x, const exact::BigRational& s) const;
  std::array<exact::BigRational, 3> position(std::uint32_t leg, const exact::BigRational& t) const;

  const MovingFacets& all_;
  const ScaledOverlap& overlap_;
  std::vector<std::array<exact::BigRational, 3>> way_;  // on the grid
  std::vector<Leg> legs_;
  double unit_;
};

}  // namespace dymsum::spatial
