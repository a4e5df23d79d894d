// Edges or convex vertices of an operand in a tree of discs, with the directions that their segments can have. It is
// made once: where the operand turns and scales, discs move along, and directions unless scales of x and y change
// ratio.
#pragma once

#include <cstdint>
#include <vector>

#include "planar/local/posed_regions.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

/// Directions from the angle `first` on, counter-clockwise over `width`.
struct DirectionRange {
  double first = 0, width = 0;
};
/// Whether they have a direction in common, once the first one is turned by `turn`, or nearly, within `slack`.
bool may_meet(const DirectionRange& a, double turn, const DirectionRange& b, double slack);

class FeatureDiscs {
 public:
  enum class Of : std::uint8_t {
    edges,     ///< all edges of parts with area: their direction
    vertices,  ///< convex ones: the directions that turn from the edge before to the one after
  };
  struct Node {
    Point middle;       ///< of a disc that holds the features
    double radius = 0;  ///< a little more
    DirectionRange directions;
    std::uint32_t first = 0, last = 0;  ///< items
    std::uint32_t left = 0, right = 0;  ///< nodes; 0, 0: a leaf
    bool leaf() const { return right == 0; }
  };
  /// `stretch`: what coordinates are multiplied by before directions are taken.
  FeatureDiscs(const Operand& operand, Of of, Point stretch = {1, 1});

  bool empty() const { return nodes_.empty(); }
  const Node& node(std::uint32_t k) const { return nodes_[k]; }
  /// Walk edges or walk vertices.
  std::uint32_t item(std::uint32_t k) const { return items_[k]; }
  const DirectionRange& directions(std::uint32_t item) const { return ranges_[item]; }

 private:
  std::uint32_t build(std::uint32_t first, std::uint32_t last);
  Node leaf_of(std::uint32_t item) const;
  Point at(std::uint32_t walk) const { return operand_.points->input[operand_.source[walk]]; }
  double angle_of(std::uint32_t edge) const;
  DirectionRange range_of(std::uint32_t item) const;

  const Operand& operand_;
  Of of_;
  Point stretch_;
  std::vector<std::uint32_t> items_;
  std::vector<DirectionRange> ranges_;  // by walk edge or vertex
  std::vector<Node> nodes_;
};

}  // namespace dymsum::planar
