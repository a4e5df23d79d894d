// What is kept of a sum from edit to edit, and how a step follows its operands.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "dymsum/editable_sum.h"
#include "planar/edit/counted_cover.h"
#include "planar/edit/edit_arrangement.h"
#include "planar/edit/edit_loops.h"
#include "planar/edit/moved_operand.h"
#include "planar/frame/frame_rings.h"

namespace dymsum::planar {

/// The sum of two operands that change, with all that makes the next step cheap.
class EditedSum {
 public:
  explicit EditedSum(const EditOptions& options) : options_(options) {}

  /// The operands of a step: regions, and what became of their vertices.
  struct Step {
    std::array<const Region*, 2> regions;
    std::array<const VertexChanges*, 2> changes{};  ///< null: this operand is as it was
  };
  /// From scratch. Errors: as minkowski_sum; then nothing changed.
  Result<FrameChanges> start(const Step& step);
  /// Follows an edit. Errors: the same.
  Result<FrameChanges> follow(const Step& step);

  const PlanarSum& sum() const { return sum_; }
  const std::vector<std::uint64_t>& ring_ids() const { return ring_ids_; }
  EditWork& work() { return work_; }

 private:
  Result<PlacedPair> placed_pair(const Step& step);
  bool can_keep(const PlacedPair& placed, const Step& step) const;
  bool is_large(const Step& step) const;
  bool comparable(const PlacedPair& placed) const;
  bool same_numbers(const PlacedPair& placed) const;
  std::array<WalkChanges, 2> changes_to(const PlacedPair& placed, const Step& step) const;
  void renew_loops(const PlacedPair& placed, const std::array<std::vector<std::uint8_t>, 2>& filled,
                   std::array<WalkChanges, 2>& walks) const;
  std::vector<std::uint8_t> filled_loops(const PlacedPair& placed, std::uint32_t op) const;
  Result<FrameChanges> rebuild(PlacedPair placed, const Step& step);
  void stand_on(PlacedPair placed, const Step& step);
  void follow_convolution(const PlacedPair& placed, const std::array<WalkChanges, 2>& walks, bool same_holes);
  void keep(const PlacedPair& placed);
  void hand_over();
  void drop();
  FrameChanges update(PlacedPair placed, const Step& step);
  FrameChanges take_scratch(PlanarSum sum);
  FrameChanges assemble();
  void forget_rings();
  void take_rings_back(const std::array<WalkChanges, 2>& walks);
  std::vector<std::uint64_t> rings_before(PlanarSum& rings) const;
  SumOptions sum_options(bool asking) const;

  EditOptions options_;
  PlacedPair placed_;
  std::array<std::shared_ptr<const Operand>, 2> own_;  // as they are by themselves
  std::array<OperandSteps, 2> steps_;
  std::array<bool, 2> touching_{};  // their rings
  std::unique_ptr<FollowedConvolution> convolution_;
  std::unique_ptr<CountedCover> cover_;
  std::unique_ptr<EditArrangement> arrangement_;
  std::unique_ptr<EditLoops> loops_;
  std::array<std::vector<std::uint8_t>, 2> filled_;
  PlanarSum sum_;
  std::vector<std::uint64_t> ring_ids_;
  std::vector<std::uint32_t> cycles_;  // of the rings of sum_, while these are from updates
  bool plain_ = false;                 // nothing degenerate shows in what was made to be kept
  RingIdentities identities_;
  double saved_ = 5;  // in sums from scratch: enough to make once what is kept
  EditWork work_;
};

}  // namespace dymsum::planar
