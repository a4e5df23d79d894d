// Walks counter-clockwise through a range of angles, window by window: the angles at which something meets on the
// boundary, in order, and what changes there.
#pragma once

#include <span>

#include "spatial/events/root_contacts.h"
#include "spatial/events/turned_planes.h"
#include "spatial/moving/sum_shape.h"

namespace dymsum::spatial {

class RotationWalk {
 public:
  RotationWalk(const RotatingPair& pair, const GaussMaps& maps, const PairOfBalls& balls,
               const SolidRotationOptions& options, SolidRotationWork& work, const Progress& progress);

  /// Calls take(event) until it says false. The events from a to b, both included unless `behind` (then those at a are
  /// not), in order. A whole turn from a back to it where `whole`. Throws Cancelled, and std::invalid_argument where
  /// sums need more than 8,192 bits.
  void run(const ChartPlace& a, const ChartPlace& b, bool behind, bool whole,
           const std::function<bool(SolidRotationEvent&)>& take);

 private:
  struct Angle {
    exact::AlgebraicRoot root;
    bool wanted = false;  ///< others are known by their roots alone, to choose places between
    std::vector<SolidRotationContact> contacts;
  };
  /// Which angles of a window are asked for: from `low` (open where `behind`) to `high`, where they are.
  struct Wanted {
    std::optional<exact::BigRational> low, high;
    bool behind = false;
    bool holds(const exact::AlgebraicRoot& root) const;
  };
  std::vector<Angle> angles_in(const RotationRange& range, const Wanted& wanted);
  std::vector<Angle> angles_in_parts(const RotationRange& range, std::vector<exact::BigRational> ends,
                                     const Wanted& wanted);
  std::vector<SolidRotationContact> contacts_at(const RotationWindow& window, const exact::AlgebraicRoot& root,
                                                std::span<const Meeting> meetings, bool crowded);
  /// A place's t in a chart; nothing for infinity.
  std::optional<exact::BigRational> seen_in(int chart, const ChartPlace& place) const;
  std::optional<SolidRotationEvent> event_at(const RotationRange& range, std::vector<Angle>& angles, std::size_t i);
  SolidRotationEvent event_of(int chart, Angle& angle) const;
  void look(const RotationRange& range, const std::vector<Angle>& angles, std::size_t i, SolidRotationEvent& event);
  SumShape shape(const ChartPlace& at);
  void ask();

  const RotatingPair& pair_;
  const GaussMaps& maps_;
  const PairOfBalls& balls_;
  const SolidRotationOptions& options_;
  SolidRotationWork& work_;
  const Progress& progress_;
  SpatialOptions stages_;
  double step_ = 0, share_ = 0;
  std::optional<SumShape> before_;
};

/// The exact sum at a place of the circle.
SpatialSum turned_sum(const RotatingPair& pair, const ChartPlace& at, const SpatialOptions& options);

}  // namespace dymsum::spatial
