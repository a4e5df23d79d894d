// The facets of the reduced convolution of two solids of any shape, kept while both rotate and scale.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "spatial/convolution/reduced_facets.h"
#include "spatial/motion/pose_angles.h"
#include "spatial/motion/posed_pair.h"
#include "spatial/moving/facet_slots.h"
#include "spatial/moving/gauss_cells.h"
#include "spatial/moving/gauss_side.h"

namespace dymsum::spatial {

/// The work of one move.
struct ConvolutionWork {
  bool rebuilt = false;               ///< the move was too long: all normals were looked at, and all pairs of arcs
  std::uint64_t normals_checked = 0;  ///< those whose certificates had ended
  std::uint64_t pairs_checked = 0;    ///< pairs of edges that an end of one's arc may have passed
  std::uint64_t exact_checks = 0;     ///< pairs of features that doubles did not decide
  std::uint64_t added = 0, removed = 0;
};

/// Left out on purpose, to show that tests notice it.
enum class SkippedCertificate : std::uint8_t {
  none,
  births,     ///< a normal finds a new vertex only where it leaves one, as by descent from facets that are there
  crossings,  ///< arcs have no part in the certificates of normals
};

class DynamicConvolution {
 public:
  /// Starts at the identity of both. Requires operands without thin parts; the pair has to live as long.
  explicit DynamicConvolution(const SolidPair& pair, SkippedCertificate skipped = SkippedCertificate::none);

  /// Moves. Exact signs are those of `exact`, the space at the same poses. The facets are those of the reduced
  /// convolution there, whatever moves were made before. Cost: the normals whose certificates have ended, and what is
  /// near them; a comparison for each normal. After a long move that of a fresh convolution.
  const ConvolutionWork& set(const PosePair& poses, SpaceOnDemand& exact);
  const ConvolutionWork& work() const { return work_; }
  /// A bound that is at least the angle by which directions move from poses to others, and the longest such step that
  /// is no fresh start.
  double motion(const PosePair& from, const PosePair& to) const;
  double longest_step() const { return 0.5 * std::min(reach_[0], reach_[1]); }

  const FacetSlots& slots() const { return slots_; }
  /// The slots in the order of reduced_convolution's facets.
  std::vector<std::uint32_t> in_order() const;

 private:
  struct Match {
    std::uint32_t feature;  // a cone, or a convex edge of Q
    std::int32_t side;      // of edges
    std::uint32_t slot;
  };
  using Matches = std::vector<Match>;
  /// The normals of one operand, among the other one's cones and arcs.
  struct Walkers {
    std::vector<double> due;       // per triangle: how far directions may have moved in all until it is looked at again
    std::vector<Matches> matches;  // per triangle, by cone
  };

  double motion_to(const PosePair& poses);
  void rebuild();
  void match_all_edges();
  void look_at(int op, std::uint32_t triangle, double step, bool first);
  bool pass(int op, std::uint32_t triangle, Vec3 n, std::uint32_t arc);
  void match_cones(int op, std::uint32_t triangle, Vec3 n, std::span<const std::uint32_t> cones);
  void keep_found(int op, std::uint32_t triangle);
  void match_edges(std::uint32_t e, std::uint32_t g);
  int edge_side(std::uint32_t e, std::uint32_t g);
  bool exactly_supported(int op, std::uint32_t triangle, std::uint32_t cone);
  Vec3 seen_from_other(int op, Vec3 v) const { return op == 0 ? row_times(v, q_to_p_) : q_to_p_ * v; }
  const SolidOperand& operand(int op) const { return op == 0 ? pair_.p : pair_.q; }

  const SolidPair& pair_;
  const SkippedCertificate skipped_;
  std::array<GaussSide, 2> sides_;
  std::array<std::optional<GaussCells>, 2> cells_;
  std::array<double, 2> drift_{};  // how far directions may have turned by scaling since the cells were made
  PosePair poses_;
  std::array<Vec3, 2> factors_{Vec3{1, 1, 1}, Vec3{1, 1, 1}};
  UnitQuaternion rotation_;  // from Q's frame to P's
  Mat3 q_to_p_, q_to_p_before_;
  bool same_shapes_ = true;  // the last move did not scale but uniformly
  bool started_ = false;
  double travelled_ = 0;
  std::array<double, 2> reach_{};
  std::array<Walkers, 2> walkers_;
  std::vector<Matches> edges_;  // per convex edge of P, by those of Q
  SpaceOnDemand* exact_ = nullptr;

  FacetSlots slots_;
  std::vector<std::uint32_t> found_;  // scratch
  ConvolutionWork work_;
};

}  // namespace dymsum::spatial
