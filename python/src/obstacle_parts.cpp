// What a configuration-space obstacle is made of.
#include "bind.h"
#include "calls.h"
#include "dymsum/motion.h"
#include "enumeration.h"
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
  enumeration<ObstacleEvent::Kind>(event, "Kind", "What happens at an event angle.");
  event.listed();
  Record<TightFeature>(m, "TightFeature", "Tight placements: free at one event angle, with nothing free near them.")
      .listed();
}

void bind_boundary(nb::module_& m) {
  Record<Patch> patch(m, "Patch", "A piece of ruled surface of the boundary.");
  patch.listed().def("rotating", &Patch::rotating);
  patch.attr("kNone") = Patch::kNone;
  Record<Shell>(m, "Shell", "A connected piece of the boundary.").listed();
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
  Record<ObstacleWork>(m, "ObstacleWork", "The work that was done.").listed();
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
  enumeration<Touching>(m, "Touching", "Whether robot and obstacle may touch.");
  bind_events(m);
  bind_boundary(m);
  bind_obstacle_work(m);
}

}  // namespace dymsum::python
