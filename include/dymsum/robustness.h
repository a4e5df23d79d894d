// By how much shapes may differ from what is given before an answer about them changes, and what a fit's clearance is
// made of.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dymsum/penetration_depth.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/result.h"
#include "dymsum/uncertain.h"

namespace dymsum {

/// The largest r for which an answer stays yes when both regions change by up to r: when each lies within the disc sum,
/// and holds the erosion, of the given one and a disc of radius r. So every point of either may move by r.
struct Robustness {
  bool holds = false;  ///< the answer for the regions as they are; r is 0 where it is no
  Rational squared;    ///< r^2, exact
  double radius = 0;   ///< r, the nearest double; infinite where one of the regions is empty
  /// What decides: Q moved by `move`, which is 2 r long, touches P by these contacts. Where the regions overlap, the
  /// shortest moves that separate them. Where a part sticks out of its container, none.
  std::vector<PlanarWay> ways;
};

/// Whether P and Q, moved by `at`, do not overlap; touching is allowed. Exact. Errors: as PlanarDepth::create.
Result<Robustness> robustness_of_free(const Region& p, const Region& q, const RationalPoint& at);
/// Whether the part, moved by `at`, lies in the container. Contacts name edges and vertices of the container as `p`.
/// Exact. Errors: as erode; unsupported_operand for polylines and points of the part.
Result<Robustness> robustness_of_fit(const Region& container, const Region& part, const RationalPoint& at);

/// The position at which a part fits with the most clearance.
struct RobustFit {
  bool fits = false;  ///< somewhere
  RationalPoint at;   ///< a position of the largest robustness, or one as good as it to within at_most
  Rational squared;   ///< of the robustness there
  double radius = 0;
  double at_most = 0;  ///< no position has more: `radius` where that is proved (`exact`)
  bool exact = true;   ///< as PlanarExcess::exact
};
/// The largest r for which every part, changed by up to r, fits somewhere into every container that is. Cost: the
/// erosion, and the furthest position from the edges of it. Errors: as erode and check_offset.
Result<RobustFit> most_robust_fit(const Region& container, const Region& part);

/// A row of the table of a fit: how far an edge of the container is from the part, and what of it tolerances take.
struct FitStackRow {
  PlanarFeature container, part;  ///< the nearest features: an edge of the container, an edge or vertex of the part
  Rational squared;               ///< the exact square of their distance
  double nominal = 0;             ///< their distance
  double least = 0, most = 0;     ///< with all tolerances at their ends; negative: they overlap
  double of_container = 0;        ///< most - least is of_container + of_part: the widths of both tolerances
  double of_part = 0;
  friend bool operator==(const FitStackRow&, const FitStackRow&) = default;
};
struct FitStack {
  bool fits = false;              ///< the nominal part in the nominal container
  std::vector<FitStackRow> rows;  ///< one for each edge of the container, by ascending `least`
};
/// The clearances of a part, moved by `at`, in a container, edge by edge: nominal + lower of the container's edge -
/// upper of the part's edge, and the other way round. A tolerance is one for all, or one for each vertex: that of the
/// edge that starts there; a vertex of the part has the larger upper and the smaller lower one of its two edges.
/// `least` is a bound: of bands (Uncertain::of_band), and of edges that each stay within their own tolerance where the
/// container's lower ones are not positive and the part's upper ones not negative, no variant has less. `most` adds up
/// likewise, but where corners are cut back a variant may have more. Rows are empty where the part does not fit.
/// Errors: out_of_range for other numbers of tolerances, or lower > upper; as robustness_of_fit.
Result<FitStack> fit_stack(const Region& container, std::span<const Tolerance> container_tolerances, const Region& part,
                           std::span<const Tolerance> part_tolerances, const RationalPoint& at);

}  // namespace dymsum
