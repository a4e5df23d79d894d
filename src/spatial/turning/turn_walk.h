// Walks counter-clockwise through a range of angles, window by window: the angles at which something meets on the
// boundary, in order, and what changes there.
#pragma once

#include <span>

#include "spatial/moving/sum_shape.h"
#include "spatial/turning/root_contacts.h"
#include "spatial/turning/turned_planes.h"

namespace dymsum::spatial {

class TurnWalk {
 public:
  TurnWalk(const TurningPair& pair, const GaussMaps& maps, const PairOfBalls& balls, const TurningSolidOptions& options,
           TurningSolidWork& work, const Progress& progress);

  /// Calls take(event) until it says false. The events from a to b, both included unless `behind` (then those at a are
  /// not), in order. A whole turn from a back to it where `whole`. Throws Cancelled, and std::invalid_argument where
  /// sums need more than 8,192 bits.
  void run(const ChartPlace& a, const ChartPlace& b, bool behind, bool whole,
           const std::function<bool(SolidTurnEvent&)>& take);

 private:
  struct Angle {
    exact::AlgebraicRoot root;
    bool wanted = false;  ///< others are known by their roots alone, to choose places between
    std::vector<SolidTurnContact> contacts;
  };
  /// Which angles of a window are asked for: from `low` (open where `behind`) to `high`, where they are.
  struct Wanted {
    std::optional<exact::BigRational> low, high;
    bool behind = false;
    bool holds(const exact::AlgebraicRoot& root) const;
  };
  std::vector<Angle> angles_in(const TurnRangeOfT& range, const Wanted& wanted);
  std::vector<Angle> angles_in_parts(const TurnRangeOfT& range, std::vector<exact::BigRational> ends,
                                     const Wanted& wanted);
  std::vector<SolidTurnContact> contacts_at(const SolidTurnWindow& window, const exact::AlgebraicRoot& root,
                                            std::span<const Meeting> meetings, bool crowded);
  /// A place's t in a chart; nothing for infinity.
  std::optional<exact::BigRational> seen_in(int chart, const ChartPlace& place) const;
  std::optional<SolidTurnEvent> event_at(const TurnRangeOfT& range, std::vector<Angle>& angles, std::size_t i);
  SolidTurnEvent event_of(int chart, Angle& angle) const;
  void look(const TurnRangeOfT& range, const std::vector<Angle>& angles, std::size_t i, SolidTurnEvent& event);
  SumShape shape(const ChartPlace& at);
  void ask();

  const TurningPair& pair_;
  const GaussMaps& maps_;
  const PairOfBalls& balls_;
  const TurningSolidOptions& options_;
  TurningSolidWork& work_;
  const Progress& progress_;
  SpatialOptions stages_;
  double step_ = 0, share_ = 0;
  std::optional<SumShape> before_;
};

/// The exact sum at a place of the circle.
SpatialSum turned_sum(const TurningPair& pair, const ChartPlace& at, const SpatialOptions& options);

}  // namespace dymsum::spatial
