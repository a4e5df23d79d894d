// Which holes are too small for the other operand throughout a range of scales.
#pragma once

#include "planar/operand/lattice.h"

namespace dymsum::planar {

/// A lattice that asks another one everything.
class DelegatingLattice : public Lattice {
 public:
  explicit DelegatingLattice(const Lattice& plain) : Lattice(plain), plain_(plain) {}
  int cross(const Edge& d, const Edge& e) const override { return plain_.cross(d, e); }
  int dot(const Edge& d, const Edge& e) const override { return plain_.dot(d, e); }
  int compare_extent(const Edge& d, const Edge& e, int axis) const override {
    return plain_.compare_extent(d, e, axis);
  }
  int side(const Segment& s, Pair v) const override { return plain_.side(s, v); }
  int along(const Segment& s, Pair v) const override { return plain_.along(s, v); }
  bool same(Pair a, Pair b) const override { return plain_.same(a, b); }
  int compare_coordinate(Pair a, Pair b, int axis) const override { return plain_.compare_coordinate(a, b, axis); }
  int side(const Segment& s, const Place& x) const override { return plain_.side(s, x); }
  int along(const Segment& s, const Place& x) const override { return plain_.along(s, x); }
  int compare_coordinate(Pair a, const Place& b, int axis) const override {
    return plain_.compare_coordinate(a, b, axis);
  }
  int compare(const Segment& on, const Cut& a, const Cut& b) const override { return plain_.compare(on, a, b); }
  int compare_coordinate(const Place& a, const Place& b, int axis) const override {
    return plain_.compare_coordinate(a, b, axis);
  }
  Homogeneous homogeneous(const Place& x) const override { return plain_.homogeneous(x); }
  Homogeneous homogeneous(Pair v) const override { return plain_.homogeneous(v); }
  std::optional<NearFrame> near_frame() const override { return plain_.near_frame(); }
  NearPosition near(const Place& x) const override { return plain_.near(x); }
  NearPosition near(Pair v) const override { return plain_.near(v); }
  const SharedIntegers& unscaled_integers() const override { return plain_.unscaled_integers(); }

 private:
  const Lattice& plain_;
};

/// For the convolution of a range of scales: a hole is filled only if it is filled at the end of the range where it is
/// largest in proportion, and then it is filled throughout. hole_is_filled() asks for extents of (hole, other operand).
class FillLattice final : public DelegatingLattice {
 public:
  FillLattice(const Lattice& plain, const Lattice& low, const Lattice& high, std::uint32_t scaled)
      : DelegatingLattice(plain), low_(low), high_(high), scaled_(scaled) {}
  int compare_extent(const Edge& hole, const Edge& other, int axis) const override {
    return (hole.op == scaled_ ? high_ : low_).compare_extent(hole, other, axis);
  }

 private:
  const Lattice &low_, &high_;
  std::uint32_t scaled_;
};

/// For the convolution of all positive scales: no hole is filled.
class UnfilledLattice final : public DelegatingLattice {
 public:
  using DelegatingLattice::DelegatingLattice;
  int compare_extent(const Edge&, const Edge&, int) const override { return 1; }
};

}  // namespace dymsum::planar
