// The cycles of an edited arrangement: which of them bound the sum, and what proves that the others do not.
// docs/design/edited-sum.md, "Cycles".
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "planar/boundary/collision.h"
#include "planar/edit/edit_arrangement.h"
#include "planar/edit/new_overlap.h"

namespace dymsum::planar {

/// What proves a position covered: edges that cross there, or a covered cell around it; else nothing that is kept.
struct CoverProof {
  std::optional<CrossingEdges> edges;
  std::optional<GridCell> cell;
};

/// A cycle of the successor map.
struct EditCycle {
  int winding = 0;
  bool kept = false;                 ///< it bounds the sum
  EventName sample;                  ///< where a sub-edge of it starts
  CoverProof cover;                  ///< of one that is not kept
  std::vector<std::uint64_t> nodes;  ///< that it comes to, by their keys
  std::uint64_t identity = 0;        ///< of its ring, 0: not yet given
  std::optional<SumRing> ring;       ///< of a kept one
  std::vector<LiveSubEdge> steps;    ///< of one that is new, until its ring is written
  double ring_error = 0;             ///< of its positions, in units of the lattice
};

/// A position that may be a tight feature: a node, or a sub-edge that is covered from both sides.
struct TightSuspect {
  EventName at;
  bool crack = false;
  bool covered = false;
  CoverProof cover;
};

class EditLoops {
 public:
  /// `connected`: the sum has one outer boundary.
  explicit EditLoops(bool connected) : connected_(connected) {}

  /// What an edit left, in the names after it; of new arrangements nothing.
  struct Changes {
    std::array<WalkChanges, 2> walks;
    bool all_new = false;
  };
  /// Follows the arrangement: finds cycles that are new, and decides those that the edit may have changed.
  void update(EditArrangement& arrangement, const Changes& changes, const CountedCover& cover, Collision& collision);

  const std::map<std::uint32_t, EditCycle>& cycles() const { return cycles_; }
  std::map<std::uint32_t, EditCycle>& cycles() { return cycles_; }
  /// Cycles that bounded the sum before the last update, with their rings.
  const std::vector<EditCycle>& lost() const { return lost_; }

  /// Whether a tight feature shows, or the boundary comes to a position twice: rings have to be joined anew there.
  bool degenerate(EditArrangement& arrangement, const CountedCover& cover, Collision& collision);

  bool has_nodes() const { return !nodes_.empty(); }
  /// The sub-edges of a cycle; those of a new one are handed out once.
  std::vector<LiveSubEdge> steps_of(EditArrangement& arrangement, EditCycle& cycle) const;

  struct Work {
    std::uint64_t traced = 0, kept = 0, witnessed = 0, tests = 0;
  };
  const Work& work() const { return work_; }

 private:
  void rename(const std::array<WalkChanges, 2>& walks);
  void break_cycles(EditArrangement& arrangement);
  void update_nodes(EditArrangement& arrangement);
  void recheck(EditArrangement& arrangement, const NewOverlap& anew, const CountedCover& cover, Collision& collision);
  void uncover_outer(EditArrangement& arrangement, const NewOverlap& anew, Collision& collision);
  void lose(EditCycle& cycle);
  void trace(EditArrangement& arrangement);
  void walk(EditArrangement& arrangement, LiveSubEdge start);
  void close(EditArrangement& arrangement, std::uint32_t id, std::vector<LiveSubEdge>& path,
             const std::vector<std::uint32_t>& marks);
  void decide(EditArrangement& arrangement, const NewOverlap* anew, const CountedCover& cover, Collision& collision);
  bool covered_anew(const SegmentPosition& x, const NewOverlap& anew, Collision& collision);
  bool still_covered(const CoverProof& proof, const CountedCover& cover) const;
  bool alive(std::uint32_t mark) const { return mark >= EditArrangement::kFirstCycle && cycles_.count(mark) != 0; }

  struct Undecided {
    std::uint32_t cycle;
    EventName was_kept;  ///< where a sub-edge starts that bounded the sum before
    std::vector<CrossingEdges> witnesses;
  };

  bool connected_;
  std::map<std::uint32_t, EditCycle> cycles_, broken_;
  std::vector<EditCycle> lost_;
  std::vector<Undecided> undecided_;
  std::unordered_map<std::uint64_t, std::vector<TightSuspect>> nodes_;
  std::uint32_t next_mark_ = EditArrangement::kFirstCycle, first_mark_ = EditArrangement::kFirstCycle;
  Work work_;
};

}  // namespace dymsum::planar
