// What moving planar sums have in common: options, work and changes.
#include "dymsum/frames.h"

#include "bind.h"
#include "calls.h"
#include "enumeration.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_moving_options(nb::module_& m) {
  enumeration<MovingOperand>(m, "MovingOperand", "Which operand moves, about the origin of its coordinates.");
  enumeration<FrameMode>(m, "FrameMode", "How frames are made; all give the same sums.");
  Record<MovingOptions> options(m, "MovingOptions", "Options of sums in motion.");
  options.def(
      "__init__",
      [](MovingOptions* self, MovingOperand moving, bool reflect_q, Semantics semantics, FrameMode mode, double window,
         std::uint64_t kept_window_bytes, int threads, Progress progress, std::uint64_t memory) {
        new (self) MovingOptions{moving, reflect_q, semantics,          mode, window, kept_window_bytes, threads,
                                 memory, {},        std::move(progress)};
      },
      "moving"_a = MovingOperand::p, "reflect_q"_a = false, "semantics"_a = Semantics::closed,
      "mode"_a = FrameMode::automatic, "window"_a = 0.0, "kept_window_bytes"_a = MovingOptions().kept_window_bytes,
      "threads"_a = 1, "progress"_a = nb::none(), "memory"_a = 0);
  options.option("moving", &MovingOptions::moving)
      .option("reflect_q", &MovingOptions::reflect_q, "P (+) -Q")
      .option("semantics", &MovingOptions::semantics)
      .option("mode", &MovingOptions::mode)
      .option("window", &MovingOptions::window, "how far windows reach ahead; 0: chosen")
      .option("kept_window_bytes", &MovingOptions::kept_window_bytes)
      .option("threads", &MovingOptions::threads)
      .option("progress", &MovingOptions::progress)
      .option("memory", &MovingOptions::memory,
              "bytes that arrays which grow faster than the operands may hold; 0: no limit");
}

void bind_frame_work(nb::module_& m) { Record<FrameWork>(m, "FrameWork", "The work of one frame.").listed(); }

void bind_frame_changes(nb::module_& m) {
  Record<RingChange> ring(m, "RingChange", "What happened to a ring from one frame to the next.");
  enumeration<RingChange::Kind>(ring, "Kind", "What happened to a ring.");
  ring.listed();
  Record<FrameChanges>(m, "FrameChanges", "What a frame changed.").listed();
}

}  // namespace

void bind_frames(nb::module_& m) {
  bind_moving_options(m);
  bind_frame_work(m);
  bind_frame_changes(m);
}

}  // namespace dymsum::python
