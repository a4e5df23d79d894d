// The facets of the reduced convolution of two solids of any shape, kept while both rotate and scale.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "spatial/convolution/reduced_facets.h"
#include "spatial/convolution/solid_operand.h"
#include "spatial/convolution/sum_space.h"
#include "spatial/mesh/vec3.h"
#include "spatial/motion/posed_pair.h"

namespace dymsum::spatial {

// The facets of a sum that moves, in slots that they keep as long as they exist.

/// Slots of facets that ended are used again from the next move on.
class FacetSlots {
 public:
  std::size_t count() const { return facets_.size(); }
  std::size_t facets() const { return facets_.size() - free_.size() - removed_.size(); }
  bool exists(std::uint32_t slot) const { return exists_[slot] != 0; }
  const SumFacet& operator[](std::uint32_t slot) const { return facets_[slot]; }
  /// The slots of the last move's new facets, and of those that ended.
  const std::vector<std::uint32_t>& added() const { return added_; }
  const std::vector<std::uint32_t>& removed() const { return removed_; }

  void begin_move() {
    free_.insert(free_.end(), removed_.begin(), removed_.end());
    added_.clear(), removed_.clear();
  }
  std::uint32_t add(const SumFacet& facet) {
    std::uint32_t slot = 0;
    if (free_.empty()) {
      slot = static_cast<std::uint32_t>(facets_.size());
      facets_.push_back(facet), exists_.push_back(1);
    } else {
      slot = free_.back();
      free_.pop_back();
      facets_[slot] = facet, exists_[slot] = 1;
    }
    added_.push_back(slot);
    return slot;
  }
  void remove(std::uint32_t slot) {
    exists_[slot] = 0;
    removed_.push_back(slot);
  }

 private:
  std::vector<SumFacet> facets_;
  std::vector<std::uint8_t> exists_;
  std::vector<std::uint32_t> free_, added_, removed_;
};

// The Gauss map of one operand in its own frame: normals, arcs of convex edges, and what cones of vertices support, as
// unit vectors in doubles.

/// Every component of the unit vectors is within this of the exact one.
inline constexpr double kUnitError = 0x1p-48;
/// The product of two of them, one turned by matrix_of of another 2^-46: beyond this its sign is the exact one.
inline constexpr double kSignError = 0x1p-43;

/// The normals between those of an edge's faces lie in a ball of `radius` about `centre`, which are chords: distances
/// between unit vectors, which no turn by some angle changes by more than that.
struct GaussArc {
  Vec3 centre;
  double radius = 0;
};

class GaussSide {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;

  /// Unscaled. Requires an operand without thin parts, which has to live as long.
  GaussSide(const SolidOperand& solid, const GridPositions& positions);
  /// Scales along the axes of its frame.
  void scale(Vec3 factors);

  const SolidOperand& solid;
  std::vector<Vec3> normals;             ///< of triangles
  std::vector<std::uint32_t> convex;     ///< the wedges of convex edges
  std::vector<std::uint32_t> convex_of;  ///< per wedge: its index among these, or kNone
  std::vector<Vec3> edges;               ///< of these: the direction
  std::vector<GaussArc> arcs;
  std::vector<Vec3> rays;  ///< as solid.rays

  const Wedge& wedge(std::uint32_t convex_edge) const { return solid.wedges[convex[convex_edge]]; }
  /// Calls f for the convex edges of a triangle, at most three.
  template <class F>
  void for_each_edge(std::uint32_t triangle, F f) const {
    for (std::uint32_t k = 0; k < 3; ++k)
      if (const std::uint32_t e = convex_of[solid.wedge_of[3 * triangle + k]]; e != kNone) f(e);
  }

 private:
  void set_arcs();
  std::vector<Vec3> own_normals_, own_edges_, own_rays_;  // unscaled, each component within 2^-50 of its size
};

// The sphere of directions in cells, with what of a Gauss map comes near each: the faces of a cube in equal squares.

class GaussCells {
 public:
  explicit GaussCells(const GaussSide& side);

  /// Arcs of four convex edges as the cells were made, in floats: directions of the edges, and the balls around arcs.
  /// Where there are fewer, the radius of what is left over is below zero and far from everything.
  struct FourArcs {
    float x[4], y[4], z[4], centre_x[4], centre_y[4], centre_z[4], radius[4];
    std::uint32_t index[4];
  };
  struct Cell {
    std::span<const FourArcs> arcs;
    std::span<const std::uint32_t> cones;
  };
  /// Arcs nearer to n than reach(), a distance, as the cells were made, and cones nearer than a quarter of that.
  Cell at(Vec3 n) const;
  double reach() const { return reach_; }
  /// Distances from floats are within this of the exact ones.
  static constexpr double kFloatError = 0x1p-20;

 private:
  struct Square {
    std::uint32_t face, u, v, size;  // its lowest cell, and cells along a side
  };
  struct Lists {
    std::vector<std::vector<std::uint32_t>> arcs, cones;  // per cell
  };
  void split(const GaussSide& side, const Square& square, std::span<const std::uint32_t> cones,
             std::span<const std::uint32_t> arcs, Lists& lists) const;
  std::size_t cell(std::uint32_t face, std::uint32_t u, std::uint32_t v) const {
    return (static_cast<std::size_t>(face) * across_ + v) * across_ + u;
  }

  double reach_ = 0;
  std::uint32_t across_ = 1;                           // cells along a side of the cube, a power of two
  std::vector<std::uint32_t> first_arc_, first_cone_;  // per cell; one more at the end
  std::vector<FourArcs> arcs_;
  std::vector<std::uint32_t> cones_;
};

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
