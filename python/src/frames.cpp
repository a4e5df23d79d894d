// What moving planar sums have in common: options, work and changes.
#include "dymsum/frames.h"

#include "bind.h"
#include "calls.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_moving_options(nb::module_& m) {
  nb::enum_<MovingOperand>(m, "MovingOperand", "Which operand moves, about the origin of its coordinates.")
      .value("p", MovingOperand::p)
      .value("q", MovingOperand::q);
  nb::enum_<FrameMode>(m, "FrameMode", "How frames are made; all give the same sums.")
      .value("automatic", FrameMode::automatic)
      .value("window", FrameMode::window)
      .value("rebuild", FrameMode::rebuild);
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

void bind_frame_work(nb::module_& m) {
  Record<FrameWork>(m, "FrameWork", "The work of one frame.")
      .field("rebuilt", &FrameWork::rebuilt)
      .field("new_window", &FrameWork::new_window)
      .field("degenerate", &FrameWork::degenerate)
      .field("pieces", &FrameWork::pieces)
      .field("candidates", &FrameWork::candidates)
      .field("pieces_repaired", &FrameWork::pieces_repaired)
      .field("lists_changed", &FrameWork::lists_changed)
      .field("crossings_changed", &FrameWork::crossings_changed)
      .field("loops_traced", &FrameWork::loops_traced)
      .field("loops_kept", &FrameWork::loops_kept)
      .field("witnessed", &FrameWork::witnessed)
      .field("witnesses_lost", &FrameWork::witnesses_lost)
      .field("collision_tests", &FrameWork::collision_tests)
      .field("exact_signs", &FrameWork::exact_signs)
      .field("window_low", &FrameWork::window_low)
      .field("window_high", &FrameWork::window_high)
      .field("ms", &FrameWork::ms)
      .field("peak_bytes", &FrameWork::peak_bytes);
}

void bind_frame_changes(nb::module_& m) {
  Record<RingChange> ring(m, "RingChange", "What happened to a ring from one frame to the next.");
  nb::enum_<RingChange::Kind>(ring, "Kind", "What happened to a ring.")
      .value("appeared", RingChange::Kind::appeared)
      .value("disappeared", RingChange::Kind::disappeared)
      .value("reshaped", RingChange::Kind::reshaped)
      .value("moved", RingChange::Kind::moved);
  ring.field("kind", &RingChange::kind)
      .field("ring", &RingChange::ring, "identity")
      .field("vertices_appeared", &RingChange::vertices_appeared)
      .field("vertices_disappeared", &RingChange::vertices_disappeared);
  Record<FrameChanges>(m, "FrameChanges", "What a frame changed.")
      .field("rings", &FrameChanges::rings)
      .field("tight_points", &FrameChanges::tight_points)
      .field("tight_segments", &FrameChanges::tight_segments)
      .field("topology", &FrameChanges::topology);
}

}  // namespace

void bind_frames(nb::module_& m) {
  bind_moving_options(m);
  bind_frame_work(m);
  bind_frame_changes(m);
}

}  // namespace dymsum::python
