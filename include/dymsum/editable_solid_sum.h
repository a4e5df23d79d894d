// Sums of solids that follow edits of their operands: vertices move, come and go, faces are extruded, edges swapped,
// bodies added and removed, in either operand. The result equals a fresh sum, always.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "dymsum/frames.h"
#include "dymsum/mesh.h"
#include "dymsum/progress.h"
#include "dymsum/result.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

/// What is done to a mesh. Vertices and faces have the indices of Mesh, after the edits before this one.
enum class SolidEditKind : std::uint8_t {
  move,            ///< a vertex to another position; the faces around it have to stay plane
  extrude,         ///< a connected set of faces by a vector; walls join their boundary to where it was
  invert,          ///< an edge of two triangles: the other diagonal of these takes its part
  insert_in_face,  ///< a vertex; triangles lead from it to the face's edges
  insert_in_edge,  ///< a vertex into an edge; a face becomes triangles unless the vertex is in its plane
  remove,          ///< a vertex; what was around it is filled
  add_shell,       ///< a closed surface: a body, or a cavity
  remove_shell,    ///< a surface, with its vertices
};

/// One edit of one operand. Made by the functions below; the fields that its kind does not name mean nothing.
struct SolidEdit {
  SolidEditKind kind = SolidEditKind::move;
  MovingOperand operand = MovingOperand::p;
  std::uint32_t vertex = 0;          ///< of move and remove; of invert and insert_in_edge one end of the edge
  std::uint32_t other = 0;           ///< the edge's other end
  std::uint32_t face = 0;            ///< of insert_in_face; of remove_shell one of its faces
  std::vector<std::uint32_t> faces;  ///< of extrude
  Point3 at;                         ///< a position; of extrude a vector
  MeshData added;                    ///< of add_shell

  static SolidEdit move(MovingOperand operand, std::uint32_t vertex, Point3 to);
  static SolidEdit extrude(MovingOperand operand, std::vector<std::uint32_t> faces, Point3 by);
  static SolidEdit invert(MovingOperand operand, std::uint32_t vertex, std::uint32_t other);
  static SolidEdit insert_in_face(MovingOperand operand, std::uint32_t face, Point3 at);
  static SolidEdit insert_in_edge(MovingOperand operand, std::uint32_t vertex, std::uint32_t other, Point3 at);
  static SolidEdit remove(MovingOperand operand, std::uint32_t vertex);
  static SolidEdit add_shell(MovingOperand operand, MeshData shell);
  static SolidEdit remove_shell(MovingOperand operand, std::uint32_t face);
  friend bool operator==(const SolidEdit&, const SolidEdit&) = default;
};

struct SolidEditOptions {
  Semantics semantics = Semantics::closed;
  bool reflect_q = false;         ///< P (+) -Q; edits and provenance refer to Q
  bool tight = true;              ///< look for tight features
  int threads = 1;                ///< 0: as many as there are cores; the result does not depend on it
  std::size_t undo_steps = 1000;  ///< that are kept, with the meshes before each
  std::size_t kept_sums = 8;  ///< sums of the nearest steps in either direction that undo and redo give back at once
  Progress progress;
};

/// The work of one step.
struct SolidEditWork {
  bool kept = false;                  ///< the sum of an earlier step was still there: nothing was computed
  std::uint64_t vertices_edited = 0;  ///< that are new or have other positions, of both operands
  std::uint64_t faces_edited = 0;     ///< that are new or have other vertices
  std::uint64_t facets = 0;           ///< of the reduced convolution
  std::uint64_t contacts = 0, exact_signs = 0;
  double ms = 0;  ///< wall time of the step
};

/// Every step validates the whole edited mesh and makes the sum anew; the other operand, the states before and the
/// sums near to them are kept, so that undo and redo cost nothing as a rule. Right in every case, and never faster than
/// minkowski_sum: slots that a change leaves alone are not there yet (docs/design/edited-solids.md).
class EditableSolidSum {
 public:
  /// P (+) Q, to be edited. Errors: as minkowski_sum; unsupported_operand for parts without volume; out_of_range for
  /// threads below 0.
  static Result<EditableSolidSum> create(const Mesh& p, const Mesh& q, const SolidEditOptions& options = {});

  EditableSolidSum(EditableSolidSum&&) noexcept;
  EditableSolidSum& operator=(EditableSolidSum&&) noexcept;
  ~EditableSolidSum();

  /// Makes all edits, one after the other, as one step; none are no step. On an error nothing changes: out_of_range for
  /// what there is not, faces that are not connected, an edge of invert with a face that is no triangle, a vertex
  /// around which nothing can be filled; those of Mesh::create, with its evidence in the indices of the mesh that the
  /// edits would make; those of minkowski_sum.
  Result<SolidEditWork> edit(std::span<const SolidEdit> edits);
  Result<SolidEditWork> edit(const SolidEdit& one) { return edit(std::span<const SolidEdit>(&one, 1)); }
  /// Back to the state before the last step that was not undone, and forward again. Error out_of_range where there is
  /// none.
  Result<SolidEditWork> undo();
  Result<SolidEditWork> redo();
  std::size_t undo_count() const;
  std::size_t redo_count() const;

  /// The operands as they are. Edits leave the order of vertices and faces that stay; new ones come last.
  const Mesh& p() const;
  const Mesh& q() const;
  /// Names of the vertices of an operand, by index: a vertex keeps its name while it moves and while others come and
  /// go, a new one has a name that no other one had, and undo brings back the names.
  const std::vector<std::uint64_t>& vertex_names(MovingOperand operand) const;
  /// The same of faces: one that is moved, or has other vertices, keeps its name; those that it is split into have new
  /// ones.
  const std::vector<std::uint64_t>& face_names(MovingOperand operand) const;
  /// The names of the faces, before all edits or in an added shell, that these come of: their own, where they were not
  /// made by an edit; of a wall that of the extruded face; of what fills a gap that of a face that was there.
  const std::vector<std::uint64_t>& face_ancestors(MovingOperand operand) const;

  /// The exact sum; valid until the next step. Copies stay valid for ever.
  const SpatialSum& sum() const;
  const SolidEditWork& work() const;
  /// A hash of the sum: its vertices by exact positions, faces and what is tight. Equal sums have equal hashes. O(n) in
  /// exact numbers.
  std::uint64_t hash() const;

 private:
  class State;
  explicit EditableSolidSum(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace dymsum
