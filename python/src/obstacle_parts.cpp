// What a configuration-space obstacle is made of.
#include "bind.h"
#include "calls.h"
#include "dymsum/motion.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_events(nb::module_& m) {
  Record<EventAngle>(m, "EventAngle", "An angle at which the combinatorics of the slice change; in (-pi, pi].")
      .field("theta", &EventAngle::theta)
      .field("low", &EventAngle::low, "the exact angle lies between low and high")
      .field("high", &EventAngle::high)
      .field("exact", &EventAngle::exact, "where the tangent of the half angle is rational");
  Record<ObstacleEvent> event(m, "ObstacleEvent", "What happens at an event angle.");
  nb::enum_<ObstacleEvent::Kind>(event, "Kind", "What happens at an event angle.")
      .value("alignment", ObstacleEvent::Kind::alignment)
      .value("vertex_on_segment", ObstacleEvent::Kind::vertex_on_segment)
      .value("three_segments", ObstacleEvent::Kind::three_segments)
      .value("tight", ObstacleEvent::Kind::tight);
  event.field("kind", &ObstacleEvent::kind).field("angle", &ObstacleEvent::angle).field("at", &ObstacleEvent::at);
  Record<TightFeature>(m, "TightFeature", "Tight placements: free at one event angle, with nothing free near them.")
      .field("angle", &TightFeature::angle)
      .field("from_", &TightFeature::from)
      .field("to", &TightFeature::to)
      .field("error", &TightFeature::error);
}

void bind_boundary(nb::module_& m) {
  Record<Patch> patch(m, "Patch", "A piece of ruled surface of the boundary.");
  patch.field("contact", &Patch::contact)
      .field("left", &Patch::left)
      .field("right", &Patch::right)
      .field("left_corner", &Patch::left_corner)
      .field("right_corner", &Patch::right_corner)
      .field("begin", &Patch::begin, "index in angles(), or kNone")
      .field("end", &Patch::end, "index in angles(), or kNone")
      .field("shell", &Patch::shell)
      .def("rotating", &Patch::rotating);
  patch.attr("kNone") = Patch::kNone;
  Record<Shell>(m, "Shell", "A connected piece of the boundary.")
      .field("outer", &Shell::outer)
      .field("patches", &Shell::patches)
      .field("euler", &Shell::euler)
      .field("free_component", &Shell::free_component);
  Record<FreeCell>(m, "FreeCell", "A piece of free space between two event angles.")
      .field("begin", &FreeCell::begin)
      .field("end", &FreeCell::end)
      .field("unbounded", &FreeCell::unbounded)
      .field("component", &FreeCell::component);
  Record<TurnMark>(m, "TurnMark", "An angle at which the robot, turning in place, meets the obstacle.")
      .field("angle", &TurnMark::angle)
      .field("free", &TurnMark::free)
      .field("free_after", &TurnMark::free_after);
}

void bind_obstacle_work(nb::module_& m) {
  Record<ObstacleWork>(m, "ObstacleWork", "The work that was done.")
      .field("windows", &ObstacleWork::windows)
      .field("segments", &ObstacleWork::segments)
      .field("candidate_pairs", &ObstacleWork::candidate_pairs)
      .field("candidate_triples", &ObstacleWork::candidate_triples)
      .field("surfaces", &ObstacleWork::surfaces)
      .field("potential_events", &ObstacleWork::potential_events)
      .field("visible_events", &ObstacleWork::visible_events)
      .field("alignments", &ObstacleWork::alignments)
      .field("vertex_events", &ObstacleWork::vertex_events)
      .field("triple_events", &ObstacleWork::triple_events)
      .field("tight_events", &ObstacleWork::tight_events)
      .field("local_updates", &ObstacleWork::local_updates)
      .field("slices", &ObstacleWork::slices)
      .field("exact_signs", &ObstacleWork::exact_signs)
      .field("collision_tests", &ObstacleWork::collision_tests)
      .field("ms", &ObstacleWork::ms);
  Record<ObstacleOptions> options(m, "ObstacleOptions", "Options of obstacles.");
  options.def(
      "__init__",
      [](ObstacleOptions* self, bool reference, Progress progress, std::uint64_t memory) {
        new (self) ObstacleOptions{reference, std::move(progress), memory};
      },
      "reference"_a = false, "progress"_a = nb::none(), "memory"_a = 0);
  options.option("reference", &ObstacleOptions::reference)
      .option("progress", &ObstacleOptions::progress)
      .option("memory", &ObstacleOptions::memory,
              "bytes that arrays which grow faster than the operands may hold; 0: no limit");
}

}  // namespace

void bind_obstacle_parts(nb::module_& m) {
  nb::enum_<Touching>(m, "Touching", "Whether robot and obstacle may touch.")
      .value("allowed", Touching::allowed)
      .value("forbidden", Touching::forbidden);
  bind_events(m);
  bind_boundary(m);
  bind_obstacle_work(m);
}

}  // namespace dymsum::python
