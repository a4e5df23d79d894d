// A vertex of a sum.
#pragma once

#include <compare>
#include <cstdint>

namespace dymsum::spatial {

/// A vertex of P plus a vertex of Q, as indices of the polytopes.
struct VertexPair {
  std::uint32_t p = 0, q = 0;
  friend auto operator<=>(const VertexPair&, const VertexPair&) = default;
};
constexpr VertexPair kNoPair{~std::uint32_t{0}, ~std::uint32_t{0}};

}  // namespace dymsum::spatial
