// Whether P overlaps x - Q: whether a position x lies in the open sum.
#pragma once

#include <vector>

#include "spatial/convolution/inner_cells.h"
#include "spatial/convolution/solid_operand.h"
#include "spatial/convolution/sum_space.h"
#include "spatial/mesh/box_tree.h"

namespace dymsum::spatial {

class Collision {
 public:
  /// `inner` answers for positions deep inside, and has to live as long.
  Collision(const SumSpace& space, const SolidOperand& p, const SolidOperand& q, const InnerCells& inner);

  /// Whether P meets x - Q. For positions at which the solids do not touch without overlapping, as for all off the
  /// facets of the convolution, that is whether they overlap. Exact.
  bool meets(const Flag& x) const;

  /// Whether the interiors of P and x - Q overlap, for any x, also where the solids touch. Exact.
  bool overlaps(const Flag& x) const;

  std::uint64_t tests() const { return tests_; }
  const SolidOperand& p() const { return p_; }
  const SolidOperand& q() const { return q_; }

 private:
  struct Query;
  struct Touch;
  bool pierced(const Query& query, std::uint32_t i, std::uint32_t j) const;
  void add_touches(const Query& query, std::uint32_t i, std::uint32_t j, std::vector<Touch>& touches) const;
  void touch_vertices(const Query& query, std::uint32_t i, std::uint32_t j, const int (&sa)[3], const int (&sc)[3],
                      std::vector<Touch>& touches) const;
  void touch_edges(const Query& query, std::uint32_t i, std::uint32_t j, std::vector<Touch>& touches) const;
  void heights(const Query& query, std::uint32_t i, std::uint32_t j, int (&sa)[3], int (&sc)[3]) const;
  bool triangles_meet(const Query& query, std::uint32_t i, std::uint32_t j) const;
  bool vertex_inside(const Query& query, Way::Of of, std::uint32_t v) const;

  const SumSpace& space_;
  const SolidOperand &p_, &q_;
  BoxTree p_tree_, q_tree_;
  const InnerCells& inner_;
  mutable std::atomic<std::uint64_t> tests_{0};
};

}  // namespace dymsum::spatial
