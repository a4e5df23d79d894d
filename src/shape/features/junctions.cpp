#include "shape/features/junctions.h"

#include <algorithm>

#include "base/scratch.h"

namespace dymsum::shape {
namespace {

/// Node -> first node of its junction. Flat edges lie on a line, so their chains are short and simple.
std::vector<std::uint32_t> contracted(const Complex& complex) {
  UnionFind junctions(static_cast<std::uint32_t>(complex.nodes.size()));
  for (const Edge& e : complex.edges) {
    if (!e.flat) continue;
    const auto [first, second] = std::minmax({junctions.root(e.low), junctions.root(e.high)});
    junctions.unite(second, first);
  }
  std::vector<std::uint32_t> root(complex.nodes.size());
  for (std::uint32_t n = 0; n < root.size(); ++n) root[n] = junctions.root(n);
  return root;
}

}  // namespace

std::vector<Junction> junctions_of(const Complex& complex) {
  const std::vector<std::uint32_t> root = contracted(complex);
  std::vector<std::uint32_t> position(root.size(), kNoIndex);
  std::vector<Junction> junctions;
  for (std::uint32_t n = 0; n < root.size(); ++n) {
    if (root[n] == n) {
      position[n] = std::uint32_t(junctions.size());
      junctions.emplace_back();
    }
    junctions[position[root[n]]].nodes.push_back(n);
  }
  for (std::uint32_t e = 0; e < complex.edges.size(); ++e) {
    const Edge& edge = complex.edges[e];
    if (edge.flat) continue;
    junctions[position[root[edge.low]]].out.push_back(e);
    if (edge.high != kNoIndex) junctions[position[root[edge.high]]].in.push_back(e);
  }
  return junctions;
}

}  // namespace dymsum::shape
