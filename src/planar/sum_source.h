// Exact positions of the vertices of a sum, from the provenance they carry.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "planar/exact_source.h"
#include "planar/lattice.h"
#include "planar/separate_touching.h"

namespace dymsum::planar {

/// Vertex and edge numbers of the two regions as they appear in contacts, by source vertices of the lattice.
struct Numbering {
  std::array<std::vector<std::uint32_t>, 2> vertex;
  std::array<std::vector<std::array<std::uint32_t, 2>>, 2> edge;
};

/// The source vertices and straight runs behind the numbers of an engine region.
void number_region(const EngineRegion& region, std::uint32_t op, Numbering& out);

class SumSource final : public ExactSource {
 public:
  SumSource(std::shared_ptr<const Lattice> lattice, Numbering numbering)
      : lattice_(std::move(lattice)), numbering_(std::move(numbering)) {}

  Position position(const SumVertex& vertex) const override;

 private:
  Segment segment(const Contact& contact) const;

  std::shared_ptr<const Lattice> lattice_;
  Numbering numbering_;
};

}  // namespace dymsum::planar
