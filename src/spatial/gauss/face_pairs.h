// Faces of P and Q that truly face the same way.
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "spatial/gauss/signs.h"

namespace dymsum::spatial {

constexpr std::uint32_t kNoFace = ~std::uint32_t{0};

struct FacePair {
  std::uint32_t p, q;
  friend auto operator<=>(const FacePair&, const FacePair&) = default;
};

/// The pairs, also by either face, and the cells in which the arcs of half-edges of such faces begin
/// (overlay_parallel.cpp).
struct FacePairs {
  std::vector<FacePair> all, parted;  ///< those now, and those of the move before
  std::array<std::vector<std::uint32_t>, 2> parallel, start;

  FacePairs(const Polytope& p, const Polytope& q);

  /// That faces of `all` are parallel; that they are not.
  void join();
  void part();
  /// The cell that the arc of each half-edge of face f of operand op, which is parallel to face g of the other one,
  /// begins in. Going round f, the arcs turn one way, and so do the cells. Calls changed(half-edge) for those that it
  /// changes.
  template <class Changed>
  void start_arcs(const Signs& signs, int op, std::uint32_t f, std::uint32_t g, const Changed& changed);

 private:
  int side_beyond(const Signs& signs, int op, HalfEdge mine, HalfEdge other) const;
};

template <class Changed>
void FacePairs::start_arcs(const Signs& signs, int op, std::uint32_t f, std::uint32_t g, const Changed& changed) {
  const Polytope &mine = signs.poly(op), &other = signs.poly(1 - op);
  HalfEdge at = other.first[g];  // leaves the cell at hand
  HalfEdge h = mine.first[f];
  std::uint32_t turned = 0;
  do {
    // The next one while it rises; at first, from a vertex that may be on the far side, until one is reached that does.
    const auto rises = [&](HalfEdge edge) { return side_beyond(signs, op, h, edge) > 0; };
    if (h == mine.first[f])
      while (!rises(at)) at = other.next[at];
    while (rises(at)) {
      at = other.next[at];
      if (++turned > 4 * (other.edge_count() + 1))
        throw std::logic_error("Overlay: a face without an outermost vertex");
    }
    std::uint32_t& begin = start[op][h];
    if (begin != other.origin[at]) {
      begin = other.origin[at];
      changed(h);
    }
    h = mine.next[h];
  } while (h != mine.first[f]);
}

}  // namespace dymsum::spatial
