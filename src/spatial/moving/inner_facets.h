// The facets of a convolution in motion that lie deep inside the open sum, each proved by a ball of P plus one of Q,
// that is looked for from the pair that proved it at the frame before.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "spatial/convolution/reduced_facets.h"
#include "spatial/convolution/solid_operand.h"
#include "spatial/mesh/vec3.h"
#include "spatial/motion/posed_pair.h"

namespace dymsum::spatial {

// Balls inside an operand. A ball of P plus a ball of Q is a ball of the open sum, wherever both operands stand.

struct InnerBalls {
  static constexpr std::size_t kNeighbours = 6;
  struct Ball {
    Vec3 centre;
    double radius = 0;
  };
  std::vector<Ball> balls;                                         ///< each inside the solid, proved in doubles
  std::vector<std::array<std::uint32_t, kNeighbours>> neighbours;  ///< of every ball others near it, or itself
};

/// Balls that touch the surface from inside, at the centres of some of its triangles, the largest first and none with
/// its centre in the inner half of another one. O(n) for every triangle tried, 200 at most.
InnerBalls inner_balls(const SolidOperand& solid);

class InnerFacets {
 public:
  explicit InnerFacets(const SolidPair& pair);

  /// Moves to the poses of a space, which has to live until the next call.
  void move(const PosedSpace& at, const PosePair& poses);
  /// A facet in a slot is a new one.
  void forget(std::uint32_t slot) {
    if (slot >= pairs_.size()) pairs_.resize(slot + 1, kUnknown);
    pairs_[slot] = kUnknown;
  }
  /// Whether a facet is proved to lie in the open sum. A "no" says nothing. O(steps from pair to pair).
  bool hold(std::uint32_t slot, const SumFacet& facet);
  std::uint64_t kept() const { return kept_; }      ///< since move(): proved by the pair at hand
  std::uint64_t tested() const { return tested_; }  ///< those for which others were tried

 private:
  struct BallPair {
    std::uint32_t p, q;
  };
  static constexpr BallPair kUnknown{0xffffffff, 0xffffffff};
  double gap(BallPair pair, Vec3 x) const {
    const InnerBalls::Ball &a = posed_[0][pair.p], &b = posed_[1][pair.q];
    return length(x - a.centre - b.centre) - a.radius - b.radius;
  }
  bool covers(BallPair pair, const SumFacet& facet) const;
  void make_some();
  BallPair search(Vec3 x);
  BallPair descend(BallPair from, Vec3 x) const;

  std::array<InnerBalls, 2> own_;
  std::array<std::vector<InnerBalls::Ball>, 2> posed_;  // in units of the space
  std::vector<BallPair> pairs_;                         // per slot
  BallPair last_ = kUnknown;                            // of the facet queried before
  struct SomePairs {
    std::vector<double> x, y, z, radius;
    std::vector<BallPair> pair;
  } some_;  // sums of some balls of either operand: where a search begins
  std::vector<double> powers_;
  const SumSpace* space_ = nullptr;
  double margin_ = 0;
  std::uint64_t kept_ = 0, tested_ = 0;
};

}  // namespace dymsum::spatial
