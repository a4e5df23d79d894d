#include "shape/disc/tight_features.h"

namespace dymsum::shape {

namespace {

DiscCorner centre_of_node(const Complex& complex, std::uint32_t node) {
  DiscCorner corner;
  corner.kind = DiscCorner::Kind::centre;
  corner.disc = {true, node};
  corner.at = complex.nodes[node].centre;
  return corner;
}

struct Spokes {
  std::uint32_t rising = 0;
  std::vector<std::uint32_t> flat;
};

Spokes spokes_of(const Complex& complex, std::uint32_t node) {
  Spokes spokes;
  for (std::uint32_t i = complex.first_spoke[node]; i < complex.first_spoke[node + 1]; ++i) {
    const Spoke& spoke = complex.spokes[i];
    if (complex.edges[spoke.edge].flat) spokes.flat.push_back(spoke.edge);
    else if (spoke.up) ++spokes.rising;
  }
  return spokes;
}

/// Flat edges that meet at a node lie on one line, as the two walls between which the discs lie are opposite there.
bool goes_on(const Spokes& spokes) { return spokes.rising == 0 && spokes.flat.size() == 2; }

}  // namespace

TightFeatures tight_features(const DiscPositions& positions) {
  const Complex& complex = positions.complex();
  TightFeatures made;
  for (std::uint32_t node = positions.level().below; node < positions.level().up_to; ++node) {
    const Spokes here = spokes_of(complex, node);
    if (here.rising == 0 && here.flat.empty()) made.points.push_back(centre_of_node(complex, node));
    if (goes_on(here)) continue;
    for (std::uint32_t edge : here.flat) {
      std::uint32_t end = node;
      for (;;) {
        end = complex.edges[edge].low == end ? complex.edges[edge].high : complex.edges[edge].low;
        const Spokes there = spokes_of(complex, end);
        if (!goes_on(there)) break;
        edge = there.flat[0] == edge ? there.flat[1] : there.flat[0];
      }
      if (node < end) made.segments.push_back({centre_of_node(complex, node), centre_of_node(complex, end)});
    }
  }
  return made;
}

}  // namespace dymsum::shape
