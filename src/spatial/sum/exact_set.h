// Sets whose vertices are fractions, as operands of sums: what one operation leaves is what the next one takes,
// unrounded.
//
// Sums commute with scaling. In units of 1 / D, D the smallest odd number in whose fractions all coordinates lie up to
// powers of two, the vertices of both operands are integers on one grid; the sum in these units, divided by D, is the
// sum. Where these integers are long, every coordinate is a fraction over a denominator of its own.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "dymsum/spatial_operand.h"
#include "dymsum/spatial_sum.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {

/// A surface as sum_of_solids takes it, with exact positions.
struct ExactSet {
  MeshData set;                   ///< at the nearest doubles
  std::vector<bool> thin;         ///< faces that are thin parts; empty where none is
  std::vector<ExactPosition> at;  ///< of every vertex
};

/// The set whose vertices are doubles.
ExactSet exact_set(MeshData set, std::vector<bool> thin = {});
/// The regular part of a sum, in triangles.
ExactSet exact_set(const SpatialSum& sum);
/// The closed set that a result is: the regular part, and what is tight outside of it as thin faces. So an inner fit
/// has the positions without room to move; what is tight in a sum lies within its regular part, and is no part of its
/// own. O(n log n), and rays for what is tight.
ExactSet closed_set(const SpatialSum& sum);
/// Adds the triangles of a set without thin faces to those of another one, perhaps turned over.
void append(ExactSet& all, const ExactSet& set, bool inside_out);
/// Whether doubles hold all of its vertices.
bool in_doubles(const ExactSet& set);
/// A set without its thin faces.
ExactSet regular_part(ExactSet set);

/// An operand with these semantics: the mesh that it is or that holds a result, else the set that a result is.
class OperandSet {
 public:
  OperandSet(const SpatialOperand& operand, Semantics semantics);

  /// The mesh, or nothing where doubles do not hold the vertices, or something is tight outside of the regular part.
  const std::optional<Mesh>& mesh() const { return mesh_; }
  bool has_thin() const { return mesh_ ? mesh_->has_thin_parts() : !set_.thin.empty(); }
  ExactSet set() const { return mesh_ ? exact_set(mesh_->data(), mesh_->thin_faces()) : set_; }

 private:
  std::optional<Mesh> mesh_;
  ExactSet set_;
};

/// Its regular part, in triangles.
ExactSet regular_triangles(const OperandSet& operand);

/// The result that an operand is, or null.
inline const SpatialSum* result_of(const SpatialOperand& operand) {
  const auto* const* sum = std::get_if<const SpatialSum*>(&operand.set());
  return sum == nullptr ? nullptr : *sum;
}

/// Coordinates up to so many bits over a common denominator are integers; longer ones are fractions.
inline constexpr int kMostCommonBits = 250;

/// The sum of two of them; where doubles hold both, in the tier of doubles. Errors as minkowski_sum.
Result<SpatialSum> sum_of_exact_sets(const ExactSet& p, const ExactSet& q, const SpatialOptions& options,
                                     int most_common_bits = kMostCommonBits);

}  // namespace dymsum::spatial
