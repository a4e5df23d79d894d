// Planar sums that stay exact while their operands are edited: vertices move, come and go, chains are extruded, holes
// and parts are added and removed, in either operand. A step updates what it touches; the result equals a fresh sum,
// always.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "dymsum/frames.h"
#include "dymsum/planar_sum.h"
#include "dymsum/progress.h"
#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum {

/// What is done to a region. Vertices have the indices of Region, after the edits before this one.
enum class EditKind : std::uint8_t {
  move,         ///< a vertex to another position
  insert,       ///< a vertex into the edge that starts at another one
  remove,       ///< a vertex; its neighbours are joined
  extrude,      ///< a chain of edges by a vector: its ends stay, and two edges lead from them to the moved chain
  invert,       ///< a vertex to the other side of the line through its neighbours, at the nearest doubles
  add_hole,     ///< a ring to a part
  remove_hole,  ///< a ring of a part
  add_part,
  remove_part,
};

/// One edit of one operand. Made by the functions below; the fields that its kind does not name mean nothing.
struct Edit {
  EditKind kind = EditKind::move;
  MovingOperand operand = MovingOperand::p;
  std::uint32_t vertex = 0;  ///< of move, remove, invert; before the new one of insert; the first of a chain
  std::uint32_t last = 0;    ///< of extrude: the last vertex of the chain, in the direction of its ring
  Point at;                  ///< of move and insert: a position; of extrude: a vector
  std::uint32_t part = 0;    ///< of holes and parts
  std::uint32_t hole = 0;    ///< of remove_hole: counted from 0
  Part added;                ///< of add_part; of add_hole its outer ring, clockwise

  static Edit move(MovingOperand operand, std::uint32_t vertex, Point to);
  static Edit insert(MovingOperand operand, std::uint32_t after, Point at);
  static Edit remove(MovingOperand operand, std::uint32_t vertex);
  static Edit extrude(MovingOperand operand, std::uint32_t first, std::uint32_t last, Point by);
  static Edit invert(MovingOperand operand, std::uint32_t vertex);
  static Edit add_hole(MovingOperand operand, std::uint32_t part, Ring ring);
  static Edit remove_hole(MovingOperand operand, std::uint32_t part, std::uint32_t hole);
  static Edit add_part(MovingOperand operand, Part part);
  static Edit remove_part(MovingOperand operand, std::uint32_t part);
  friend bool operator==(const Edit&, const Edit&) = default;
};

struct EditOptions {
  Semantics semantics = Semantics::closed;
  bool reflect_q = false;  ///< P (+) -Q; edits and provenance refer to Q
  /// automatic: steps are updates where what is kept pays, and fresh sums elsewhere; window: always updates where there
  /// can be any; rebuild: always fresh sums. Choices depend on counted work only. The sums are identical.
  FrameMode mode = FrameMode::automatic;
  std::size_t undo_steps = 1000;  ///< that are kept, with the regions before each
  ForcedTier forced_tier;
  Progress progress;  ///< called in steps that are made from scratch, see progress.h
};

/// The work of one step.
struct EditWork {
  bool rebuilt = false;     ///< from scratch, all that is kept included
  bool degenerate = false;  ///< something touches that shows: the result is from scratch, what is kept is not
  std::uint64_t segments_removed = 0, segments_added = 0;  ///< live ones
  std::uint64_t cells_changed = 0;                         ///< of the operands' rasters
  std::uint64_t cells_uncovered = 0;                       ///< of the sum
  std::uint64_t pairs_tested = 0;                          ///< of segments
  std::uint64_t events_changed = 0;  ///< crossings and touches that came or went, each counted at both segments
  std::uint64_t loops_traced = 0;    ///< cycles walked
  std::uint64_t loops_kept = 0;      ///< cycles carried over without a walk
  std::uint64_t collision_tests = 0;
  std::uint64_t exact_signs = 0;
  double ms = 0;  ///< wall time of the step
};

class EditableSum {
 public:
  /// P (+) Q, to be edited. General regions; steps of operands with polylines, points or rings that touch are made from
  /// scratch. Errors: as minkowski_sum.
  static Result<EditableSum> create(const Region& p, const Region& q, const EditOptions& options = {});

  EditableSum(EditableSum&&) noexcept;
  EditableSum& operator=(EditableSum&&) noexcept;
  ~EditableSum();

  /// Makes all edits, one after the other, as one step; none are no step. On an error nothing changes: out_of_range for
  /// a vertex, part or hole that there is not, or the last vertex of a ring; those of Region::create, with its evidence
  /// in the indices of the region that the edits would make; cancelled. Cost: O(n + m) for n and m vertices, and what
  /// the segments of the edges that change meet. Reports what became of the rings.
  Result<FrameChanges> edit(std::span<const Edit> edits);
  Result<FrameChanges> edit(const Edit& one) { return edit(std::span<const Edit>(&one, 1)); }
  /// Back to the state before the last step that was not undone, and forward again. Error out_of_range where there is
  /// none.
  Result<FrameChanges> undo();
  Result<FrameChanges> redo();
  std::size_t undo_count() const;
  std::size_t redo_count() const;

  /// The operands as they are.
  const Region& p() const;
  const Region& q() const;
  /// Names of the vertices of an operand, by index: a vertex keeps its name while it moves and while others come and
  /// go, a new one has a name that no other one had, and undo brings back the names. An edge is named by the vertex
  /// that starts it.
  const std::vector<std::uint64_t>& vertex_names(MovingOperand operand) const;

  /// The exact sum; valid until the next step. Copies stay valid for ever. After an update stats hold the sizes and the
  /// tier only; the rest is in work().
  const PlanarSum& sum() const;
  /// Identities of the rings of sum(), part by part, outer ring first.
  std::vector<std::uint64_t> ring_ids() const;
  const EditWork& work() const;
  /// A hash of the sum: its rings and tight features by exact positions. Equal sums have equal hashes.
  std::uint64_t hash() const;

 private:
  class State;
  explicit EditableSum(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace dymsum
