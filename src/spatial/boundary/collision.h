// Whether P overlaps x - Q: whether a position x lies in the open sum.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "spatial/convolution/inner_cells.h"
#include "spatial/convolution/solid_operand.h"
#include "spatial/convolution/sum_space.h"
#include "spatial/mesh/box_tree.h"

namespace dymsum::spatial {

struct Feature;
struct FlagQuery;

class Collision {
 public:
  /// `inner` answers for positions deep inside; where it is given it has to live as long.
  Collision(const SumSpace& space, const SolidOperand& p, const SolidOperand& q, const InnerCells* inner = nullptr);

  /// Whether P meets x - Q. For positions at which the solids do not touch without overlapping, as for all off the
  /// facets of the convolution, that is whether they overlap. Exact.
  bool meets(const Flag& x) const;

  /// Whether the interiors of P and x - Q overlap, for any x, also where the solids touch; of thin parts: whether they
  /// meet the other one's interior. Exact.
  bool overlaps(const Flag& x) const;

  /// Whether they meet or touch, for any x and parts of any dimension. Exact.
  bool touches(const Flag& x) const;

  std::uint64_t tests() const { return tests_; }
  const SolidOperand& p() const { return p_; }
  const SolidOperand& q() const { return q_; }

 private:
  using Query = FlagQuery;
  struct Touch;
  /// Signs of the heights of two triangles' corners, each over the other one's plane.
  struct Heights {
    int a[3], c[3];
    bool apart() const;
  };
  bool pierced(const Query& query, std::uint32_t i, std::uint32_t j) const;
  bool pierced(const Query& query, std::uint32_t i, std::uint32_t j, const Heights& h) const;
  bool vertices_inside(const Query& query) const;
  bool provably_inside(const Query& query, DirectionSource::Of of, std::uint32_t v) const;
  void add_touches(const Query& query, std::uint32_t i, std::uint32_t j, const Heights& h,
                   std::vector<Touch>& touches) const;
  void touch_vertices(const Query& query, std::uint32_t i, std::uint32_t j, const Heights& h,
                      std::vector<Touch>& touches) const;
  void touch_edges(const Query& query, std::uint32_t i, std::uint32_t j, const Heights& h,
                   std::vector<Touch>& touches) const;
  std::optional<Feature> position(const Query& query, DirectionSource::Of of, std::uint32_t triangle,
                                  std::uint32_t vertex) const;
  bool segment_crosses(const Query& query, DirectionSource::Of of, std::uint32_t wedge, std::uint32_t triangle) const;
  bool segments_cross(const Query& query) const;
  std::vector<Touch> all_touches(const Query& query) const;
  void add_thin_touches(const Query& query, std::vector<Touch>& touches) const;
  void touch_end(const Query& query, DirectionSource::Of of, std::uint32_t vertex, std::uint32_t triangle,
                 std::vector<Touch>& touches) const;
  void touch_segment(const Query& query, DirectionSource::Of of, std::uint32_t wedge, std::uint32_t triangle,
                     std::vector<Touch>& touches) const;
  bool inside_segment(const Query& query, DirectionSource::Of of, std::uint32_t wedge, std::uint32_t vertex) const;
  bool edges_cross(const Query& query, DirectionSource e, DirectionSource g) const;
  bool thin_lines_meet(const Query& query) const;
  Heights heights(const Query& query, std::uint32_t i, std::uint32_t j) const;
  bool triangles_meet(const Query& query, std::uint32_t i, std::uint32_t j) const;
  bool vertex_inside(const Query& query, DirectionSource::Of of, std::uint32_t v) const;

  const SumSpace& space_;
  const SolidOperand &p_, &q_;
  BoxTree p_tree_, q_tree_;
  BoxTree p_segments_, q_segments_, p_points_, q_points_;  // in the order of the operands' lists
  std::array<std::vector<std::uint32_t>, 2> samples_;      // some vertices of P and of Q
  const InnerCells* inner_;
  mutable std::atomic<std::uint64_t> tests_{0};
};

}  // namespace dymsum::spatial
