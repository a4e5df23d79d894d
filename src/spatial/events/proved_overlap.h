// Whether two solids overlap at a position, in doubles with a margin: says so only where it is proved.
#pragma once

#include "spatial/convolution/reduced_facets.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/motion/posed_pair.h"
#include "spatial/moving/inner_facets.h"

namespace dymsum::spatial {

/// Whether a solid F and x - s M provably overlap or are apart, for another solid M, both where they are given.
class ProvedOverlap {
 public:
  enum class Answer : std::uint8_t { apart, overlap, unsure };
  struct Position {
    Vec3 x;
    double s = 1;
    double blur = 0;  ///< of every component of a difference of two positions
  };
  /// Takes the solids with the positions of their vertices. The operands have to live as long.
  ProvedOverlap(const SolidOperand& f, std::vector<Vec3> f_positions, const SolidOperand& m,
                std::vector<Vec3> m_positions);

  /// Whether an edge of one passes through a triangle of the other.
  Answer surfaces(const Position& at) const;
  /// Whether they overlap. Both are less than `far` wide.
  Answer at(const Position& at, double far) const;

 private:
  Answer triangles(const Position& at, std::uint32_t i, std::uint32_t j) const;
  bool contained(const Position& at, double far, bool& proved) const;

  const SolidOperand &f_, &m_;
  std::vector<Vec3> f_positions_, m_positions_;
  BoxTree f_tree_, m_tree_;
};

/// Proofs of overlap of the fixed solid and the one that scales.
class ScaledOverlap {
 public:
  using Answer = ProvedOverlap::Answer;
  /// The pair has to live as long.
  explicit ScaledOverlap(const ScalingPair& all);

  /// The answer for all positions within `radius` of x and scales within `s_radius` of s.
  Answer at(Vec3 x, double s, double radius, double s_radius) const;
  /// Whether the facet lies in the open sum at all scales from `low` to `high`. A "no" says nothing.
  bool deep_inside(const SumFacet& facet, double low, double high) const;

 private:
  struct BallPair {
    std::uint32_t f = 0, m = 0;
  };
  bool has_balls() const { return !f_balls_.balls.empty() && !m_balls_.balls.empty(); }
  double gap(BallPair pair, Vec3 x, double s) const;
  BallPair nearest_balls(Vec3 x, double s) const;

  const ScalingPair& all_;
  ProvedOverlap solids_;
  InnerBalls f_balls_, m_balls_;  // on the grid
};

}  // namespace dymsum::spatial
