// Open sets moved by exact vectors, positions on their boundaries, and the signs that everything else is decided by.
// Intervals of doubles come first; where they leave a sign open, it is that of integers of any size.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "placement/open_set.h"

namespace dymsum::placement {

/// A set and where it stands.
class PlacedSet {
 public:
  PlacedSet(std::shared_ptr<const OpenSet> set, HomogeneousPoint move, std::uint32_t id);

  const OpenSet& set() const { return *set_; }
  std::uint32_t id() const { return id_; }  ///< unique; of sets that coincide the smallest one counts
  const NearPoint& near(std::uint32_t vertex) const { return near_[vertex]; }
  const std::array<double, 4>& box() const { return box_; }
  const NearPoint& move() const { return near_move_; }
  HomogeneousPoint exact(std::uint32_t vertex) const;
  Line line(std::uint32_t edge) const;

 private:
  std::shared_ptr<const OpenSet> set_;
  HomogeneousPoint move_;
  NearPoint near_move_;
  std::uint32_t id_;
  std::vector<NearPoint> near_;
  std::array<double, 4> box_{};
};

/// An edge of a placed set.
struct EdgeOf {
  const PlacedSet* set = nullptr;
  std::uint32_t edge = 0;
  const BoundaryEdge& operator*() const { return set->set().edges()[edge]; }
  const BoundaryEdge* operator->() const { return &**this; }
  const NearPoint& from() const { return set->near((*this)->from); }
  const NearPoint& to() const { return set->near((*this)->to); }
  friend bool operator==(const EdgeOf&, const EdgeOf&) = default;
};

/// A vertex of a placed set, or the crossing of edges of two of them.
struct Site {
  const PlacedSet* set = nullptr;
  std::uint32_t index = 0;           ///< of the vertex, or of the edge
  const PlacedSet* other = nullptr;  ///< of a crossing: the set with the greater id
  std::uint32_t other_index = 0;
  NearPoint near;

  /// Made the same way, and so at the same position.
  bool same_as(const Site& s) const {
    return set == s.set && index == s.index && other == s.other && other_index == s.other_index;
  }
};

Site vertex_site(const PlacedSet& set, std::uint32_t vertex);
/// Requires: edges that are not parallel, of sets with different ids.
Site crossing_site(EdgeOf f, EdgeOf g);
/// Not in lowest terms.
HomogeneousPoint exact_position(const Site& site);

/// Halfway between two positions on one edge, or a position: what is looked for in sets.
class Probe {
 public:
  Probe(const Site& a, const Site& b);
  const NearPoint& near() const { return near_; }
  const HomogeneousPoint& exact() const;

 private:
  Site a_, b_;
  NearPoint near_;
  mutable std::optional<HomogeneousPoint> exact_;
};

/// 1 where the vertex lies on the left of the line of an edge, -1 on the right, 0 on it.
int side(EdgeOf f, const PlacedSet& set, std::uint32_t vertex);
int side(EdgeOf f, const Probe& probe);
/// The order of coordinates of two positions: of x (axis 0) or y (1).
int compare(const Site& a, const Site& b, int axis);
/// The order of positions on an edge, along it.
int compare_along(EdgeOf f, const Site& a, const Site& b);
/// The sign of the cross product of the directions of two edges.
int turn(EdgeOf f, EdgeOf g);
/// Whether parallel edges run the same way.
bool same_direction(EdgeOf f, EdgeOf g);

/// The half plane of a direction: 0 from +x counter-clockwise up to -x, 1 beyond.
int half_plane(EdgeOf f);

/// Signs that intervals left open, of this thread: for tests and measurements.
std::uint64_t& exact_signs();

}  // namespace dymsum::placement
