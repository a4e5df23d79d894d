#include "shape/decompose/ring_table.h"

namespace dymsum::shape {

RationalPoint rational_point(Point p) { return {Rational::of(p.x).value(), Rational::of(p.y).value()}; }

RingTable ring_table(const Region& region) {
  RingTable table;
  std::uint32_t part_index = 0;
  const auto add = [&](const Ring& ring, bool hole) {
    const auto first = std::uint32_t(table.at.size()), n = std::uint32_t(ring.size());
    table.first.push_back(first);
    for (std::uint32_t i = 0; i < n; ++i) {
      table.at.push_back(ring[i]);
      table.next.push_back(first + (i + 1) % n);
      table.previous.push_back(first + (i + n - 1) % n);
      table.ring.push_back(std::uint32_t(table.is_hole.size()));
    }
    table.part.push_back(part_index);
    table.is_hole.push_back(hole);
  };
  for (const Part& part : region.parts()) {
    add(part.outer, false);
    for (const Ring& hole : part.holes) add(hole, true);
    ++part_index;
  }
  table.first.push_back(std::uint32_t(table.at.size()));
  return table;
}

}  // namespace dymsum::shape
