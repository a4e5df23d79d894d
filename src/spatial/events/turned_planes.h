// Planes of what touches in a sum while an operand turns, by names.
#pragma once

#include "spatial/events/plane_hashes.h"

namespace dymsum::spatial {

/// Two pairs of features whose planes are one at all angles have one name, as walls along the axis have. Equal names of
/// others are a coincidence of one in 2^60.
class TurnedPlanes {
 public:
  explicit TurnedPlanes(const RotatingPair& pair) : pair_(pair), frame_(pair, 0), hashes_(pair, 0) {}
  std::uint64_t name(const SolidContact& contact) const {
    return hashes_.of(normal(contact), {vertex_of(0, contact.p), vertex_of(1, contact.q)});
  }

 private:
  std::uint32_t triangle_of(int op, std::uint32_t face) const;
  std::uint32_t vertex_of(int op, const SolidFeature& f) const;
  PolynomialFrame::Vector normal(const SolidContact& contact) const;

  const RotatingPair& pair_;
  PolynomialFrame frame_;
  PlaneHashes hashes_;
};

}  // namespace dymsum::spatial
