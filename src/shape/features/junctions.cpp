#include "shape/features/junctions.h"

#include <algorithm>
#include <numeric>

namespace dymsum::shape {
namespace {

/// Node -> first node of its junction. Flat edges lie on a line, so their chains are short and simple.
std::vector<std::uint32_t> contracted(const Complex& complex) {
  std::vector<std::uint32_t> root(complex.nodes.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t n) {
    while (root[n] != n) n = root[n] = root[root[n]];
    return n;
  };
  for (const Edge& e : complex.edges) {
    if (!e.flat) continue;
    const std::uint32_t a = find(e.low), b = find(e.high);
    root[std::max(a, b)] = std::min(a, b);
  }
  for (std::uint32_t n = 0; n < root.size(); ++n) root[n] = find(n);
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
