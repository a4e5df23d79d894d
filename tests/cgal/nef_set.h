// Sets bounded by planes as CGAL's Nef polyhedra, exact: every vertex, edge, facet and volume is marked as part of the
// set or not. A witness for sums of solids that shares no code with them.
#pragma once

#include <array>
#include <memory>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/rational.h"

namespace dymsum::nef {

using Place = std::array<Rational, 3>;
using Side = std::array<Place, 2>;  ///< the smaller end first

/// What a set and its complement have in common with the closure of the other one, as CGAL simplifies it: no vertex
/// inside a straight edge, no edge inside a facet, unless marks or what touches there differ.
struct Cells {
  std::set<Place> vertices;
  std::set<Side> edges;
  std::multiset<std::vector<Side>> facets;  ///< each by the edges of all of its loops, sorted
  friend bool operator==(const Cells&, const Cells&) = default;
};

/// The cell in which a position lies.
struct Location {
  bool marked = false;
  int dimension = 3;
};

class NefSet {
 public:
  NefSet();  ///< empty
  /// The closed hull of positions that do not lie in one plane.
  static NefSet hull(std::span<const Place> places);
  /// The closed solid that a mesh bounds, of any shape: an odd number of the pyramids over faces from one position.
  static NefSet solid(const MeshData& mesh);

  NefSet interior() const;
  NefSet closure() const;
  NefSet complement() const;
  NefSet regularized() const;  ///< the closure of the interior
  NefSet without(const NefSet& other) const;
  NefSet common_with(const NefSet& other) const;
  friend NefSet united(const std::vector<NefSet>& sets);
  friend bool operator==(const NefSet& a, const NefSet& b);

  /// The vertices of convex closed sets whose union the closure is: CGAL::convex_decomposition_3.
  std::vector<std::vector<Place>> convex_pieces() const;
  /// CGAL::minkowski_sum_3.
  friend NefSet cgal_sum(const NefSet& a, const NefSet& b);

  bool empty() const;
  Location locate(const Place& at) const;
  Cells cells() const;
  /// Of a bounded set. Exact.
  Rational volume() const;

 private:
  struct Polyhedron;
  explicit NefSet(Polyhedron polyhedron);
  std::shared_ptr<const Polyhedron> polyhedron_;
};

}  // namespace dymsum::nef
