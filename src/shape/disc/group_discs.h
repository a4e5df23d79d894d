// The corner discs of one connected part of the complex below a level: how they lie to each other.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "shape/disc/disc_arcs.h"
#include "shape/disc/lazy_vector.h"

namespace dymsum::shape {

/// Discs by their place in `indices`. Directions are from a disc's centre.
class GroupDiscs {
 public:
  /// Requires: indices ascend, and are of arcs.discs; all these outlive this.
  GroupDiscs(const DiscPositions& positions, const ArcSet& arcs, std::vector<std::uint32_t> indices, Point origin);

  /// Whether two discs overlap (1), touch from outside (0) or are apart.
  int meeting(std::uint32_t i, std::uint32_t j) const;
  /// Calls meet(i, j, meeting) for all that overlap or touch. O(n log n) and a sign for discs whose x ranges overlap.
  template <class Meet>
  void for_each_meeting(const Meet& meet) const {
    const std::vector<std::uint32_t> by_x = sorted_by_x();
    for (std::size_t k = 0; k < by_x.size(); ++k)
      for (std::size_t l = k + 1; l < by_x.size() && may_reach(by_x[k], by_x[l]); ++l)
        if (const int sign = meeting(by_x[k], by_x[l]); sign >= 0) meet(by_x[k], by_x[l], sign);
  }

  std::uint32_t local(std::uint32_t disc) const;
  std::uint32_t disc(std::uint32_t i) const { return indices_[i]; }
  std::size_t size() const { return indices_.size(); }

  /// Whether disc j touches this vertex.
  bool touches(std::uint32_t j, const std::optional<Point>& vertex) const;
  LazyVector centre(std::uint32_t i) const { return centres_[i]; }
  /// The vector to the centre of j.
  LazyVector difference(std::uint32_t i, std::uint32_t j) const;
  /// The vector to where the circle of j is crossed, clockwise of its centre or counter-clockwise.
  LazyVector towards_circle(std::uint32_t i, std::uint32_t j, bool clockwise) const;
  /// The vector to where disc i touches a site, at `vertex` if that is none of an edge.
  LazyVector towards_contact(std::uint32_t i, std::uint32_t site, const std::optional<Point>& vertex) const;

 private:
  LazyVector centre_of(const CornerDisc& disc) const;
  std::vector<Point> vertices_of(const CornerDisc& disc) const;
  std::vector<std::uint32_t> sorted_by_x() const;
  bool may_reach(std::uint32_t i, std::uint32_t j) const;

  const DiscPositions& positions_;
  std::vector<std::uint32_t> indices_;
  Point origin_;
  std::vector<LazyVector> centres_;
  std::vector<std::vector<Point>> vertices_;  ///< that they touch
};

}  // namespace dymsum::shape
