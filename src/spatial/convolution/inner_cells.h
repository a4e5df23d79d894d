// Parts of the open sum that are known before anything is computed: boxes inside P plus boxes inside Q.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "spatial/convolution/reduced_facets.h"
#include "spatial/convolution/stage_watch.h"
#include "spatial/mesh/box_tree.h"

namespace dymsum::spatial {

/// Whether the upward ray from a point passes through a triangle: 1 yes, 0 no, -1 not known, as for points on it. The
/// answer holds for exact coordinates of which those of the point and of a corner are off by `margin` together at most;
/// that is 2^-44 of all coordinates or more.
int passes_upward(Vec3 from, Vec3 a, Vec3 b, Vec3 c, double margin);

/// A lattice of boxes over each operand, of one shape: those that lie inside. An open box of P plus an open box of Q is
/// an open box, twice as wide, of the open sum; the union of these holds most of what is deep inside. All by doubles
/// with a margin: what it holds is a proof, the rest says nothing.
class InnerCells {
 public:
  /// Makes about `across` boxes over the sum in each direction; below 2 there are none. O(k + r s) for k boxes near the
  /// surfaces and r and s rows of boxes inside.
  InnerCells(const SumSpace& space, const SolidOperand& p, const SolidOperand& q, int across, StageWatch& watch);

  /// Whether all positions in a closed box lie in the open sum.
  bool hold(const Box& box) const;
  /// Whether all of a facet does.
  bool hold(const SumFacet& facet) const;
  bool empty() const { return bits_.empty(); }

 private:
  using Position = std::array<int, 3>;
  struct Lattice {
    Vec3 low;
    Position size{};
    std::vector<std::uint8_t> state;  // 0 not looked at, 1 inside, 2 not inside or not known, 3 near the surface
    std::size_t at(int x, int y, int z) const {
      return (static_cast<std::size_t>(x) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(y)) *
                 static_cast<std::size_t>(size[2]) +
             static_cast<std::size_t>(z);
    }
  };
  struct Row {
    int x, y, first, last;  // boxes inside, from first to last along z
  };

  /// Coordinates with the direction of rows last.
  Vec3 turned(Vec3 v) const { return axis_ == 2 ? v : axis_ == 1 ? Vec3{v.z, v.x, v.y} : Vec3{v.y, v.z, v.x}; }
  Lattice inside(const SolidOperand& solid, const std::vector<Vec3>& at, StageWatch& watch) const;
  void mark(Lattice& lattice, Vec3 a, Vec3 b, Vec3 c) const;
  void fill(Lattice& lattice, const SolidOperand& solid, const std::vector<Vec3>& at, Position from) const;
  std::vector<Row> rows(const Lattice& lattice) const;
  void add_rows(int x, const std::vector<Row>& p, const std::vector<Row>& q);
  void set(int x, int y, int first, int last);
  bool holds_piece(Vec3 a, Vec3 b, Vec3 c) const;

  const SumSpace& space_;
  int axis_ = 2;  // along which rows run
  Vec3 step_, low_;
  double margin_ = 0;
  Position size_{};
  std::size_t words_ = 0;
  std::vector<std::uint64_t> bits_;  // of sums of boxes, rows along z
};

}  // namespace dymsum::spatial
