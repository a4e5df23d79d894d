// Edges that pass through two facets, and fours of facets, as far as jets tell that they may have a point in common.
#pragma once

#include <functional>
#include <vector>

#include "spatial/events/facet_cells.h"
#include "spatial/events/rotation_candidates.h"

namespace dymsum::spatial {

/// In the angles of a frame: those of a window, or one. Frame is JetFrame or FineFrame.
template <class Frame>
class CrossingSearch {
 public:
  /// Only facets that exist in a common cell, by `cells`, are looked at together. Boxes are those of `boxes`, at the
  /// same angles at least. `again` is called now and then and may throw.
  CrossingSearch(const RotationWindow& window, const Frame& frame, const JetFrame& boxes, std::vector<TurnCells> cells,
                 const std::function<void()>& again);

  /// Calls take(meeting) for all candidates: edges_and_facets in the order of edges and facets, then four_facets in
  /// that of facets; until it says false.
  void run(const std::function<bool(const Meeting&)>& take);

 private:
  using Jets = RotationSigns<Frame>;
  using SidedPlane = typename Jets::SidedPlane;
  using Place = typename Jets::Place;
  struct NearFacet {
    SidedPlane plane;
    std::array<typename Jets::Vector, 4> inward;  ///< of borders
    Box box;
  };

  void poll() {
    if (++since_ % 512 == 0) again_();
  }
  TurnCells cells_around(std::uint32_t edge) const;
  void pass(std::uint32_t edge, std::vector<std::uint32_t>& met);
  bool may_pass(const SumEdge& e, std::uint32_t facet) const;
  bool may_turn_into(std::uint32_t facet, SumPoint corner, SumPoint to) const;
  bool pairs_along(std::uint32_t edge, const std::vector<std::uint32_t>& met);
  void join_neighbours();
  bool has_end(std::uint32_t facet, const SumEdge& e) const;
  bool meet_in_border(std::uint32_t f, std::uint32_t g) const;
  bool crossing(std::uint32_t f, std::uint32_t g) const;
  bool surely_outside(std::uint32_t facet, const Place& at) const;
  bool fours_of(std::uint32_t f, std::uint32_t g);
  bool may_meet(const std::array<std::uint32_t, 4>& four, const Place& at) const;

  const RotationWindow& w_;
  const std::function<void()>& again_;
  const std::function<bool(const Meeting&)>* take_ = nullptr;
  const JetFrame& boxes_;
  Jets jets_;
  std::vector<TurnCells> cells_;
  std::vector<NearFacet> near_;
  std::vector<std::uint32_t> live_;
  BoxTree tree_;                                        // of live facets
  std::vector<std::vector<std::uint32_t>> neighbours_;  // per facet, those that may cross it
  std::size_t since_ = 0;
};

}  // namespace dymsum::spatial
