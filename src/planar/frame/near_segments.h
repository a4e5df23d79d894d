// The segments of the convolution near a box, found in trees of discs, or among those that were near the last one; and
// the sides of that box.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/memory_budget.h"
#include "planar/frame/posed_regions.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

/// Directions from the angle `first` on, counter-clockwise over `width`.
struct DirectionRange {
  double first = 0, width = 0;
};
/// Whether they have a direction in common, once the first one is turned by `turn`, or nearly, within `slack`.
bool may_meet(const DirectionRange& a, double turn, const DirectionRange& b, double slack);

/// Edges or convex vertices of an operand in a tree of discs, with the directions that their segments can have. It is
/// made once: where the operand rotates and scales, discs move along, and directions unless scales of x and y change
/// ratio.
class FeatureDiscs {
 public:
  enum class Of : std::uint8_t {
    edges,     ///< all edges of parts with area: their direction
    vertices,  ///< convex ones: the directions that turn from the edge before to the one after
  };
  struct Node {
    Point centre;       ///< of a disc that holds the features
    double radius = 0;  ///< a little more
    DirectionRange directions;
    std::uint32_t first = 0, last = 0;  ///< items
    std::uint32_t left = 0, right = 0;  ///< nodes; 0, 0: a leaf
    bool leaf() const { return right == 0; }
  };
  /// `factors`: what coordinates are multiplied by before directions are taken.
  FeatureDiscs(const Operand& operand, Of of, Point factors = {1, 1});

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
  Point factors_;
  std::vector<std::uint32_t> items_;
  std::vector<DirectionRange> ranges_;  // by walk edge or vertex
  std::vector<Node> nodes_;
};

/// A box in scaled doubles.
struct ScaledBox {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

class NearSegments {
 public:
  /// The search serves poses with these scales; others of the same ratio do, too.
  NearSegments(const Operand& p, const Operand& q, const std::array<Point, 2>& factors);

  /// A superset of the segments of the reduced convolution that meet the box: edges and convex vertices whose
  /// directions meet, or nearly, as doubles decide.
  base::CountedArray<WalkSegment> find(const PosedRegions& posed, const ScaledBox& box);
  /// The same among the pairs that were near the last box, kept with a margin; these are found anew where operands and
  /// box have moved further than that since.
  base::CountedArray<WalkSegment> update(const PosedRegions& posed, const PosePair& poses, const ScaledBox& box);
  /// All of them, whatever the box.
  base::CountedArray<WalkSegment> all(const PosedRegions& posed) const;

  bool rebuilt() const { return rebuilt_; }  ///< by the last call
  std::uint64_t pairs() const { return pairs_; }

 private:
  struct Wanted {
    ScaledBox box;
    double turn = 0;  ///< directions may differ by so much
  };
  base::CountedArray<WalkSegment> search(const PosedRegions& posed, const Wanted& wanted);
  void search_side(const PosedRegions& posed, const Wanted& wanted, std::uint32_t side,
                   base::CountedArray<WalkSegment>& found);
  bool is_near(const PosedRegions& posed, const WalkSegment& s, const Wanted& wanted) const;
  bool still_holds(const PosedRegions& posed, const PosePair& poses, const ScaledBox& box);

  std::array<const Operand*, 2> operands_;
  std::array<FeatureDiscs, 2> edges_, vertices_;
  bool rebuilt_ = false;
  std::uint64_t pairs_ = 0;

  struct Kept {
    base::CountedArray<WalkSegment> segments;
    PosePair poses;
    ScaledBox box;  ///< with its margin
    double turn = 0;
    int scale = 0;
    std::uint64_t calls = 0;  ///< since it was made, and how far operands have moved
    double moved = 0;
  };
  std::optional<Kept> kept_;
};

/// A line x = value or y = value. Beyond all sums it cuts nothing.
struct LocalWall {
  int axis = 0;
  double value = 0;   ///< in input coordinates
  double scaled = 0;  ///< rounded
  bool beyond = false;
  BigPosition exact;      ///< its coordinate, for both axes
  base::DoublePair pair;  ///< the same
};

/// The sides of the box that a sum is cut to, and of a larger one, in which everything near it is known.
class LocalWalls {
 public:
  LocalWalls(const PosedRegions& posed, const PlanarBox& box, const PlanarBox& reach);

  const std::array<LocalWall, 8>& all() const { return walls_; }  ///< low x, high x, low y, high y; the larger box's
  /// The larger box, in scaled doubles.
  ScaledBox reach() const { return {walls_[4].scaled, walls_[6].scaled, walls_[5].scaled, walls_[7].scaled}; }

 private:
  std::array<LocalWall, 8> walls_;
};

/// A box about the box: a 32nd larger, or by more than doubles err in what is found with them.
PlanarBox larger_box(const PlanarBox& box, double extent);

}  // namespace dymsum::planar
