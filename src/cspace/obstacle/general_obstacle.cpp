#include "cspace/obstacle/general_obstacle.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <thread>

#include "base/parallel.h"
#include "base/poll.h"
#include "cspace/events/walk_indices.h"
#include "cspace/obstacle/event_windows.h"
#include "cspace/obstacle/obstacle_export.h"
#include "cspace/obstacle/obstacle_sweep.h"

namespace dymsum::planar {
namespace {

void count(const PreparedWindow& p, ObstacleWork& work) {
  ++work.windows;
  work.segments += p.window->segments.size();
  work.candidate_pairs += p.found.pairs;
  work.candidate_triples += p.found.triples;
  work.potential_events += p.found.events.size();
}

/// Queries whether to go on, on the thread that made it, and stops on the others too.
class RotationPoll {
 public:
  explicit RotationPoll(const Progress& progress) : progress_(progress) {}
  void at(double fraction) { fraction_ = fraction; }
  void operator()() {
    if (std::this_thread::get_id() == caller_ && progress_ && !progress_("angles", fraction_)) stop_ = true;
    if (stop_.load(std::memory_order_relaxed)) throw Cancelled{};
  }

 private:
  const Progress& progress_;
  const std::thread::id caller_ = std::this_thread::get_id();
  double fraction_ = 0;
  std::atomic<bool> stop_{false};
};

// Ranges are prepared side by side, some at a time, and passed one after the other. Throws Cancelled.
void pass_turn(const EventWindows& windows, ObstacleSweep& sweep, RotationPoll& poll,
               const std::function<void()>& again) {
  constexpr int kAtATime = 16;
  std::vector<std::vector<PreparedWindow>> some(kAtATime);
  bool started = false, halved = false;
  for (int first = 0; first < windows.count(); first += kAtATime) {
    poll.at(static_cast<double>(first) / windows.count());
    again();
    const int last = std::min(windows.count(), first + kAtATime);
    base::parallel_parts(static_cast<std::size_t>(last - first), 0, [&](std::size_t k) {
      const bool at_once = halved && k > 0;
      some[k] = windows.prepare(first + static_cast<int>(k),
                                at_once ? EventWindows::Halved::always : EventWindows::Halved::where_crowded, again);
    });
    // Where all of some ranges had to be halved the next ones will have to be as well; their first one is asked.
    halved = std::all_of(some.begin(), some.begin() + (last - first),
                         [](const std::vector<PreparedWindow>& parts) { return parts.size() > 1; });
    for (int k = 0; k < last - first; ++k)
      for (PreparedWindow& p : some[static_cast<std::size_t>(k)]) {
        count(p, sweep.work());
        if (!started) sweep.start(p.range, p.found, *p.filter);
        started = true;
        sweep.pass(p.range, std::move(p.found), *p.filter, p.at_end);
      }
    if (last == windows.count()) sweep.close(*some[static_cast<std::size_t>(last - first - 1)].back().filter);
  }
}

std::uint64_t surfaces(const TurningForms& forms, const RotationCatalog& catalog) {
  std::uint64_t n = 0;
  for (std::uint32_t side = 0; side < 2; ++side)
    for (std::uint32_t e = 0; e < forms.size(side); ++e)
      for (std::uint32_t v = 0; v < forms.size(1 - side); ++v) n += catalog.may_exist({side, e, v});
  return n;
}

}  // namespace

Result<void> general_obstacle(planar::ObstacleState& state, const ObstacleOptions& options) {
  const bool touching = !state.robot.touching_points().empty() || !state.obstacle.touching_points().empty();
  const std::shared_ptr<const OperandPair> base = touching ? numbered_by_walk(*state.base) : state.base;
  const TurningForms forms(*base);
  const RotationCatalog catalog(forms);
  if (static_cast<double>(forms.size(0)) * forms.size(1) > 0x1p27)
    return Error{ErrorCode::unsupported_operand, "more than 2^27 pairs of vertices", {}};
  RotationPoll poll(options.progress);
  const std::function<void()> again = [&] { poll(); };
  ObstacleSweep sweep(forms, catalog, base, options.reference, again);
  // It names contacts as regions do, and knows no pieces without area.
  if (!touching && !options.reference) {
    PlanarLocalOptions near_events;  // boxes lie anywhere: nothing of the last one is near the next one
    near_events.engine = LocalEngine::hierarchy;
    if (Result<PlanarLocalSum> near = PlanarLocalSum::create(state.obstacle, state.robot, near_events))
      sweep.use(*std::move(near));
  }
  try {
    pass_turn(EventWindows(forms, catalog, options.reference), sweep, poll, again);
  } catch (const Cancelled&) {
    return cancelled();
  }
  const SweptBoundary& found = sweep.found();
  export_obstacle(found, forms, state);
  state.always_concurrent = found.always_concurrent;
  state.work = found.work;
  state.work.surfaces = surfaces(forms, catalog);
  for (const ObstacleEvent& e : found.events) {
    state.work.alignments += e.kind == ObstacleEvent::Kind::alignment;
    state.work.vertex_events += e.kind == ObstacleEvent::Kind::vertex_on_segment;
    state.work.triple_events += e.kind == ObstacleEvent::Kind::three_segments;
    state.work.tight_events += e.kind == ObstacleEvent::Kind::tight;
  }
  state.work.visible_events = found.events.size();
  return {};
}

}  // namespace dymsum::planar
