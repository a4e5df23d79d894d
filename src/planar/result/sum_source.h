// Exact positions of the vertices of a sum, from the provenance they carry.
#pragma once

#include <array>
#include <memory>

#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"
#include "planar/position/exact_source.h"

namespace dymsum::planar {

class SumSource final : public ExactSource {
 public:
  SumSource(std::shared_ptr<const Lattice> lattice, std::shared_ptr<const Operand> p, std::shared_ptr<const Operand> q)
      : lattice_(std::move(lattice)), operands_{std::move(p), std::move(q)} {}

  Position position(const SumVertex& vertex) const override;
  Homogeneous homogeneous(const SumVertex& vertex) const override;
  std::optional<NearFrame> near_frame() const override { return lattice_->near_frame(); }
  NearPosition near(const SumVertex& vertex) const override;
  std::optional<Point> rounded_once(const SumVertex& vertex) const override;
  int compare_x(const SumVertex& a, const SumVertex& b) const override;
  int compare_y(const SumVertex& a, const SumVertex& b) const override;

  /// Whether a position lies on the closed segment that a contact names.
  bool on_contact(const Contact& contact, const Position& at) const;
  /// A contact that carries a position on a ring edge whose first and last contacts are given. Requires: `at` lies on
  /// that edge.
  Contact contact_at(const Contact& first, const Contact& last, const Position& at) const;

 private:
  Segment segment(const Contact& contact) const;
  bool on_segment(const Segment& s, const Position& at) const;
  Pair corner(const SumVertex& v) const;
  SegmentPosition crossing(const SumVertex& v) const;
  int compare(const SumVertex& a, const SumVertex& b, int axis) const;

  std::shared_ptr<const Lattice> lattice_;
  std::array<std::shared_ptr<const Operand>, 2> operands_;
};

}  // namespace dymsum::planar
