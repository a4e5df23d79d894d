#include "planar/sum/sum_engine.h"

#include <new>
#include <stdexcept>
#include <string>

#include "base/poll.h"
#include "base/stopwatch.h"
#include "base/within_memory.h"
#include "planar/boundary/boundary.h"
#include "planar/sum/convex_boundary.h"
#include "planar/sum/reduced.h"
#include "planar/sum/winding.h"

namespace dymsum::planar {
namespace {

// Convex operands: see convex_boundary.
bool run_convex(const SumOptions& options, SumState& state, Poll& poll) {
  if (options.engine != Engine::fast || options.trace) return false;
  StageClock clock(state.stats, timed(state));
  std::optional<SumRing> ring = convex_boundary(*state.lattice, *state.p, *state.q);
  if (!ring) return false;
  state.stats.reduced_segments = state.p->loops[0].last + state.q->loops[0].last;
  state.stats.live_segments = state.stats.reduced_segments;
  state.stats.loops = 1;
  state.boundary.at_error = input_error(*state.lattice, sum_error(*state.lattice));
  state.boundary.add(*std::move(ring), true);
  clock.done("convolution");
  poll.stage("convolution");
  poll(1);
  return true;
}

void run_engine(const SumOptions& options, SumState& state, Refine refine, Poll& poll) {
  if (state.p->size() == 0 || state.q->size() == 0) return;
  if (run_convex(options, state, poll)) return;
  if (options.engine == Engine::winding) run_winding(options, state, poll);
  else run_reduced(options, state, refine, poll);
}

std::string text(std::uint64_t n) { return std::to_string(n); }

std::string sum_of_sizes(const SumState& state) {
  return "the sum of " + text(state.p->size()) + " and " + text(state.q->size()) + " vertices";
}

// The stage of an engine, and what it had found.
std::string standing(const SumState& state, std::string_view stage) {
  std::string where;
  if (!stage.empty()) where += " in the stage '" + std::string(stage) + "'";
  if (state.stats.reduced_segments > 0) where += ", " + text(state.stats.reduced_segments) + " segments";
  if (state.stats.live_segments > 0) where += ", " + text(state.stats.live_segments) + " of them to be intersected";
  if (state.stats.crossings > 0) where += ", " + text(state.stats.crossings) + " crossings";
  return where;
}

Error no_room(ErrorCode code, const SumState& state, std::string_view stage, std::string_view reason) {
  return {code, sum_of_sizes(state) + " is too large: " + std::string(reason) + standing(state, stage), {}};
}

Error over_limit(const SumState& state, std::string_view stage, const base::OverMemory& over) {
  Error error = base::over_memory(sum_of_sizes(state), over);
  error.message += ";" + standing(state, stage);
  return error;
}

Result<void> run(SumState& state, const SumOptions& options, Refine refine) {
  if (options.trace) state.trace = std::make_unique<PlanarTrace>();
  Poll poll(options.progress);
  const base::UseBudget use(base::budget_of(options.memory));
  try {
    run_engine(options, state, refine, poll);
  } catch (const Cancelled&) {
    return cancelled();
  } catch (const base::OverMemory& over) {
    if (options.memory == 0) throw;  // the limit of a larger computation
    return over_limit(state, poll.stage(), over);
  } catch (const std::bad_alloc&) {
    return no_room(ErrorCode::out_of_memory, state, poll.stage(), "out of memory");
  } catch (const std::length_error& more) {
    return no_room(ErrorCode::unsupported_operand, state, poll.stage(), more.what());
  }
  return {};
}

}  // namespace

Result<SumState> placed_state(std::shared_ptr<const Operand> p, std::shared_ptr<const Operand> q, int min_tier_bits) {
  SumState state;
  state.p = std::move(p);
  state.q = std::move(q);
  StageClock clock(state.stats, timed(state));
  for (const Operand* o : {state.p.get(), state.q.get()})
    if (std::optional<Error> error = too_large(*o)) return *std::move(error);
  state.lattice = make_lattice(state.p->points, state.q->points, min_tier_bits);
  state.p = placed_on(*state.lattice, std::move(state.p));
  state.q = placed_on(*state.lattice, std::move(state.q));
  state.stats.tier_bits = state.lattice->tier_bits;
  clock.done("operands");
  return state;
}

Result<SumState> compute_boundary(std::shared_ptr<const Operand> p, std::shared_ptr<const Operand> q,
                                  const SumOptions& options, Refine refine) {
  Result<SumState> placed = placed_state(std::move(p), std::move(q), SumInternals::min_tier_bits(options));
  if (!placed) return placed;
  SumState state = std::move(placed).value();
  if (const Result<void> done = run(state, options, refine); !done) return done.error();
  return state;
}

Result<SumState> compute_boundary(PlacedPair placed, const SumOptions& options) {
  SumState state(std::move(placed));
  if (const Result<void> done = run(state, options, Refine::where_it_pays); !done) return done.error();
  return state;
}

}  // namespace dymsum::planar
