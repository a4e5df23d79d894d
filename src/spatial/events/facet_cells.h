// When the facets of a window exist. At masses of parallel faces most facets exist on one side of an angle only, and
// meet those of the other side there alone.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "dymsum/solid_rotation_events.h"
#include "exact/algebraic_root.h"
#include "spatial/convolution/reduced_facets.h"
#include "spatial/events/moving_facets.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/motion/rotation_forms.h"

namespace dymsum::spatial {

// The facets of the convolution that exist at some angle of a window, and what each of them hangs on.

/// sense (n . d) <= 0 for the normal n of a triangle of one operand and a way d of the other one.
struct SlantCondition {
  std::int8_t op = 0, sense = 1;
  std::uint32_t triangle = 0;
  DirectionSource direction;
};

struct WindowFacet {
  SumFacet facet;
  PlaneSource plane;
  std::vector<SlantCondition> unsure;  ///< hold at some angles of the window perhaps; others do at all
  Box box;                             ///< of the facet at all angles, in units

  SumEdge facet_edge(int k) const { return facet_edge_of(facet, k); }
  bool has_corner(SumPoint v) const { return spatial::has_corner(facet, v); }
};

/// The Gauss maps of two operands without thin parts: their edges' directions and normals, as unit vectors.
class GaussMaps {
 public:
  explicit GaussMaps(const RotatingPair& pair);
  /// All facets whose closed conditions hold at some angle within `half` of `midpoint`, and perhaps some more.
  std::vector<WindowFacet> facets(double midpoint, double half) const;

 private:
  struct Side {
    std::vector<Vec3> normals, edges, rays;
    std::vector<std::uint32_t> convex;  // wedges
  };
  void add_face_vertex(int op, const JetFrame& frame, double margin, std::vector<WindowFacet>& facets) const;
  void add_edge_edge(const JetFrame& frame, double margin, std::vector<WindowFacet>& facets) const;
  Vec3 turned(int op, const Mat3& m, Vec3 v) const { return op == pair_.turning ? m * v : v; }

  const RotatingPair& pair_;
  std::array<Side, 2> sides_;
};

// Roots of the forms of a window of angles, exactly.

/// A window of angles: t in (low, high] of a chart.
struct RotationRange {
  int chart = 0;
  exact::BigRational low, high;
};

/// Distinct numbers, each with the index of its first root, in order.
class RootOrder {
 public:
  /// The index of a root; a new one where no equal one is there.
  std::uint32_t add(const exact::AlgebraicRoot& root);
  const exact::AlgebraicRoot& operator[](std::uint32_t index) const { return roots_[index]; }
  const std::vector<std::uint32_t>& ascending() const { return ascending_; }
  std::size_t size() const { return roots_.size(); }
  bool is_before(std::uint32_t a, std::uint32_t b) const { return a != b && exact::compare(roots_[a], roots_[b]) < 0; }

 private:
  std::vector<exact::AlgebraicRoot> roots_;
  std::vector<std::uint32_t> ascending_;
};

/// A root of a form: the index of its angle in a window.
struct FormRoot {
  std::uint32_t angle = 0;
  bool changes_sign = true;
};

class WindowRoots {
 public:
  WindowRoots(const RotationCircle& circle, const RotationRange& range, SolidRotationWork& work);

  /// A form of turned vectors as a primitive polynomial in t: a positive multiple of it, factors 1 + |axis|^2 t^2 left
  /// out.
  exact::Polynomial polynomial(exact::Terms form) const;
  /// Its distinct roots in the window, ascending; none where it vanishes at all angles. Many forms have one polynomial.
  const std::vector<FormRoot>& of(const exact::Polynomial& p);
  /// The same, without a polynomial where doubles show that it has no root but 0. What coincides at rest has forms that
  /// vanish there, many of them twice.
  std::vector<FormRoot> of(exact::Terms form);
  RootOrder& angles() { return angles_; }

 private:
  std::vector<FormRoot> find(const exact::Polynomial& p);
  bool has_none(const exact::Terms& form) const;
  const RotationCircle& circle_;
  const RotationRange& range_;
  SolidRotationWork& work_;
  double low_ = 0, high_ = 0;  // just around the window
  RootOrder angles_;
  std::optional<std::uint32_t> zero_;                                      // the index of 0, where it is one
  std::map<std::vector<exact::BigInteger>, std::vector<FormRoot>> known_;  // by coefficients, the last one positive
  exact::RungCounts counts_;
};

/// The sign of a triangle's normal times a way, on which facets of a window hang.
struct WindowSlant {
  SlantCondition of;  ///< the first condition with these features
  int sign = 0;       ///< of its number before its first root in the window; 0 where that is zero at all angles
  std::vector<FormRoot> roots;
};

/// All slants that are open for some facet, each once, in the order of facets.
class WindowSlants {
 public:
  /// The sign of a slant in the whole window, or 0 where that is not proved.
  using ProvedSign = std::function<int(const SlantCondition&)>;
  /// `again` is called now and then and may throw.
  WindowSlants(const RotatingPair& pair, const std::vector<WindowFacet>& facets, const ProvedSign& proved_sign,
               const RotationRange& range, WindowRoots& roots, const std::function<void()>& again);
  const std::vector<WindowSlant>& all() const { return all_; }
  const WindowSlant& of(const SlantCondition& c) const { return all_[index_.at(key(c))]; }

 private:
  using Key = std::array<std::uint32_t, 4>;
  static Key key(const SlantCondition& c);
  void find_signs(const RotationRange& range, const RootOrder& angles, const std::vector<exact::Polynomial>& forms);

  std::vector<WindowSlant> all_;
  std::map<Key, std::size_t> index_;
};

/// The parameters inside a window at which it is to be divided, ascending; none where it does as a whole. Masses that
/// are parallel but for rounding have hundreds of slants that vanish at angles some 1e-16 apart, and meet there and
/// nowhere else: such a crowd has a window of its own, and that is divided into windows of few slants each.
std::vector<exact::BigRational> parts_of(const WindowSlants& slants, const RootOrder& angles,
                                         const RotationRange& range);

/// Cells of a window divided at some angles: bit k is the open interval before the k-th of them.
using RotationCells = std::uint64_t;

struct FacetCells {
  /// Rational angles at which so many slants vanish that they crowd, ascending, as indices.
  std::vector<std::uint32_t> crowded;
  /// At least the cells in which each facet exists at some angle. Of facets that exist at crowded angles alone none.
  std::vector<RotationCells> of;

  FacetCells() = default;
  FacetCells(const std::vector<WindowFacet>& facets, const WindowSlants& slants, const RootOrder& angles);
  bool is_crowded(std::uint32_t angle) const;
};

}  // namespace dymsum::spatial
