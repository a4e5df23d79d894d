// The signed distance of a configuration to the boundary of an obstacle: its patches and its tight placements.
#pragma once

#include "cspace/queries/nearest_patch.h"
#include "cspace/queries/slice_distance.h"
#include "dymsum/obstacle_queries.h"

namespace dymsum::cspace {

/// `from.theta` in [-pi, pi], within 2^-50 of Orientation::nearest(asked).
struct ClearanceQuestion {
  Configuration from;
  double queried = 0;
  double weight = 0;
  Touching touching = Touching::allowed;
  bool overlaps = false;        ///< exactly
  bool provably_apart = false;  ///< neither overlaps nor touches, as patches decide
};

class ClearanceSearch {
 public:
  ClearanceSearch(const CspaceObstacle& obstacle, const PatchForms& forms, const PatchTree& tree)
      : obstacle_(obstacle), forms_(forms), tree_(tree) {}

  struct Answer {
    Clearance clearance;
    std::uint64_t bounds = 0;
  };
  Answer run(const ClearanceQuestion& q) const {
    return std::isinf(q.weight) ? translation(q) : no_farther_than_translation(q, any(q));
  }

 private:
  Answer any(const ClearanceQuestion& q) const;
  Answer translation(const ClearanceQuestion& q) const;
  /// The answer where doubles know little of what is near at other angles.
  Answer no_farther_than_translation(const ClearanceQuestion& q, Answer answer) const;
  Answer by_slice(const ClearanceQuestion& q) const;
  Answer touching(const ClearanceQuestion& q, const NearestPatch& found, bool on_edge) const;
  /// The nearest patch at any angle, or at the question's own; lengths in the coordinates of the obstacle, positions
  /// absolute.
  NearestPatch nearest(const ClearanceQuestion& q, bool whole_edges) const;
  NearestPatch nearest_at(const ClearanceQuestion& q) const;
  NearestPatch on_boundary(const ClearanceQuestion& q, const NearestPatch& found) const;
  template <class Search>
  NearestPatch in_coordinates(const ClearanceQuestion& q, bool whole_edges, Search search) const;
  SliceDistance slice_of(const ClearanceQuestion& q) const;
  bool near_event(double theta) const;

  const CspaceObstacle& obstacle_;
  const PatchForms& forms_;
  const PatchTree& tree_;
};

}  // namespace dymsum::cspace
