// The points of one plane: those of the table and those found in the plane, by coordinates within it.
#pragma once

#include <cmath>
#include <vector>

#include "spatial/arrangement/point_table.h"

namespace dymsum::spatial {

class PlanePoints {
 public:
  PlanePoints(const SumSpace& space, const PointTable& table) : space_(space), table_(table) {}

  void begin(PlaneId plane) {
    const Vec3 n = space_.plane(plane).n;
    const double size[3] = {std::abs(n.x), std::abs(n.y), std::abs(n.z)};
    plane_ = plane;
    axis_ = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
    facing_ = (axis_ == 0 ? n.x : axis_ == 1 ? n.y : n.z) > 0 ? 1 : -1;
    found.clear(), found_approx_.clear();
  }
  const SumSpace& space() const { return space_; }
  const PointTable& table() const { return table_; }
  PlaneId plane() const { return plane_; }
  /// Points with ids from here on were found in this plane.
  PointId known() const { return static_cast<PointId>(table_.size()); }

  PointId add(const PointSource& source) { return add(source, space_.approximate(source)); }
  PointId add(const PointSource& source, const Approx& near) {
    found.push_back(source);
    found_approx_.push_back(near);
    return known() + static_cast<PointId>(found.size() - 1);
  }
  const PointSource& source(PointId id) const { return id < known() ? table_.source(id) : found[id - known()]; }
  const Approx& approx(PointId id) const { return id < known() ? table_.approx(id) : found_approx_[id - known()]; }

  /// Coordinates in the plane, counter-clockwise seen against its normal.
  double x(const Approx& a) const { return axis_ == 0 ? a.at.y : axis_ == 1 ? a.at.z : a.at.x; }
  double y(const Approx& a) const { return facing_ * (axis_ == 0 ? a.at.z : axis_ == 1 ? a.at.x : a.at.y); }
  /// The sign of b's coordinate less a's: axis 0 is x, 1 is y.
  int order(PointId a, PointId b, int axis) const {
    if (a == b) return 0;
    const Approx &u = approx(a), &v = approx(b);
    const double gap = axis == 0 ? x(v) - x(u) : y(v) - y(u);
    if (std::abs(gap) > (u.radius + v.radius) * (1 + 0x1p-40) + space_.span() * 0x1p-51) return gap > 0 ? 1 : -1;
    return axis == 0 ? space_.exact_order(source(a), source(b), (axis_ + 1) % 3)
                     : facing_ * space_.exact_order(source(a), source(b), (axis_ + 2) % 3);
  }
  /// Whether doubles show that two positions differ.
  bool apart(const Approx& a, const Approx& b) const {
    const double near = (a.radius + b.radius) * (1 + 0x1p-40) + space_.span() * 0x1p-51;
    const Vec3 gap = b.at - a.at;
    return std::abs(gap.x) > near || std::abs(gap.y) > near || std::abs(gap.z) > near;
  }
  /// The axis along which two different points differ, and by more where doubles decide.
  int long_axis(PointId a, PointId b) const {
    const Approx &u = approx(a), &v = approx(b);
    const int axis = std::abs(x(v) - x(u)) >= std::abs(y(v) - y(u)) ? 0 : 1;
    return order(a, b, axis) != 0 ? axis : 1 - axis;
  }
  /// 1 where the point is to the left of the direction n x n_cut on the line of `cut`, -1 to the right.
  int left_of(PlaneId cut, PointId point) const { return -space_.side(cut, source(point), approx(point)); }
  /// Whether doubles show that a point does not lie on the line of `cut`.
  bool off_line(PlaneId cut, PointId point) const {
    const Plane& p = space_.plane(cut);
    const Approx& at = approx(point);
    return std::abs(dot(p.n, at.at) - p.d) > p.slack + p.norm1 * at.radius;
  }

  std::vector<PointSource> found;

 private:
  const SumSpace& space_;
  const PointTable& table_;
  PlaneId plane_ = 0;
  int axis_ = 2, facing_ = 1;
  std::vector<Approx> found_approx_;
};

}  // namespace dymsum::spatial
