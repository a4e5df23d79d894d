// Where the exact positions of a sum's vertices come from: the contract between the engine, which knows the integer
// operands, and everything that happens after the boundary has been found.
#pragma once

#include "dymsum/planar_sum.h"
#include "exact/big.h"

namespace dymsum {

/// Exact positions of the vertices of one sum. The vertex's contacts and corner name the place; `at` is never read.
/// Requires: every vertex handed in was made by the engine that made this source. Implementations are immutable.
class ExactSource {
 public:
  struct Position {
    exact::BigRational x, y;
  };

  virtual ~ExactSource() = default;

  virtual Position position(const SumVertex& vertex) const = 0;

  /// The sign of x(a) - x(b), and of y(a) - y(b): -1, 0 or 1. The default compares positions; an engine overrides them
  /// where it can decide with fixed-width integers, because rectilinear sums ask this once or twice for every ring.
  virtual int compare_x(const SumVertex& a, const SumVertex& b) const;
  virtual int compare_y(const SumVertex& a, const SumVertex& b) const;
};

}  // namespace dymsum
