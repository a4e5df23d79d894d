// The cycles of the frames of a rotating sum: which of them bound it, and which continues which.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/frames.h"
#include "planar/frame/frame_rings.h"
#include "planar/frame/rotating_frame.h"
#include "planar/frame/rotating_overlap.h"
#include "planar/motion/exact_frame.h"

namespace dymsum::planar {

class RotatingLoops {
 public:
  struct Loop : LoopStatus {
    std::uint32_t first = 0, last = 0;  ///< steps [first, last)
  };

  /// `swapped`: P is the moving operand, operand 1 of the forms.
  RotatingLoops(const TurningForms& forms, bool connected, bool swapped)
      : forms_(forms), connected_(connected), swapped_(swapped), overlap_(forms) {}

  /// Takes the cycles of a frame over. What the frame before knew is used if both lie in one window; `identities` gives
  /// fresh names.
  void update(const RotatingFrame& frame, ExactFrame& exact, RingIdentities& identities, FrameWork& work,
              FrameChanges& changes);
  /// Nothing is known any more of the frame before.
  void forget() {
    loops_.clear();
    steps_.clear();
    known_ = false;
  }
  /// Before the first frame of a new window: the frame before in the numbers of its segments.
  void renumber(const RotatingWindow& from, const RotatingWindow& to);

  const std::vector<Loop>& loops() const { return loops_; }
  std::vector<Loop>& loops() { return loops_; }
  bool known() const { return known_; }
  std::size_t bytes() const { return base::bytes_of(steps_, old_steps_, loops_, old_); }

 private:
  /// What identifies a sub-edge in a window.
  struct Known {
    std::uint32_t segment = 0, from = 0, to = 0;
    std::uint32_t loop = 0;
    std::uint32_t next = kNone;  ///< another one on the same segment
  };
  class Stretch;
  const Known* match(const RotatingFrame::Step& s) const;
  bool inherit(const RotatingFrame& frame, Loop& loop, FrameWork& work);
  bool witnessed(const RotatingFrame& frame, Loop& loop);
  static bool undisturbed(const Stretch& all, const RotatingWindow& window, const RotatingFrame::Step& s);
  bool covered(const RotatingFrame& frame, Loop& loop, ExactFrame& exact, FrameWork& work);
  bool covers(const CrossingEdges& edges, const RotatingFrame& frame, const RotatingFrame::Located& z) const;
  void follow(const RotatingFrame& frame, RingIdentities& identities, FrameChanges& changes);
  Segment source_segment(std::uint32_t segment, const RotatingWindow& window) const;

  const TurningForms& forms_;
  bool connected_, swapped_;
  RotatingOverlap overlap_;
  bool known_ = false;
  double last_delta_ = 0;  // of the frame before, in the window
  std::vector<Loop> loops_, old_;
  std::vector<Known> steps_, old_steps_;
  std::vector<std::uint32_t> head_;  // segment -> old steps
  std::vector<std::uint8_t> told_;
  RecentEdges<16> lately_;  // of any loop
  RingClaims claims_;
};

}  // namespace dymsum::planar
