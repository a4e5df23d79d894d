#include "planar/edit/sum_state.h"

#include <algorithm>
#include <unordered_map>

#include "planar/boundary/boundary.h"
#include "planar/edit/edit_rings.h"
#include "planar/edit/moved_operand.h"
#include "planar/result/planar_sum.h"
#include "planar/sum/minkowski_sum.h"

namespace dymsum::planar {
namespace {

// What is kept pays from so many segments on, and up to so many; and where few of them meet in degenerate nodes.
// To make what is kept takes as long as so many sums from scratch; a step that follows saves most of one, and while
// nothing is kept a tenth of each step is put aside for another attempt.
constexpr double kMaking = 5, kSavedByUpdate = 0.8, kPutAside = 0.1;
// Edits of more than this fraction of an operand's vertices are made from scratch.
constexpr double kManyVertices = 0.2;
constexpr std::uint64_t kFewSegments = 200, kManySegments = 300000, kSegmentsPerNode = 8;

bool has_only_area(const Region& region) {
  return !region.empty() && region.polylines().empty() && region.points().empty() && region.touching_points().empty();
}

struct Sizes {
  std::size_t parts, holes, segments, points;
  std::int64_t tight_points, tight_segments;
  explicit Sizes(const PlanarSum& sum)
      : parts(sum.parts.size()),
        holes(sum.hole_count()),
        segments(sum.segments.size()),
        points(sum.points.size()),
        tight_points(static_cast<std::int64_t>(sum.tight_points.size())),
        tight_segments(static_cast<std::int64_t>(sum.tight_segments.size())) {}
};

void finish(FrameChanges& changes, const Sizes& before, const Sizes& after) {
  std::sort(changes.rings.begin(), changes.rings.end(),
            [](const RingChange& a, const RingChange& b) { return a.ring < b.ring; });
  changes.tight_points = after.tight_points - before.tight_points;
  changes.tight_segments = after.tight_segments - before.tight_segments;
  changes.topology = before.parts != after.parts || before.holes != after.holes || changes.tight_points != 0 ||
                     changes.tight_segments != 0 || before.segments != after.segments || before.points != after.points;
}

}  // namespace

SumOptions EditedSum::sum_options(bool asking) const {
  SumOptions options;
  options.semantics = options_.semantics;
  options.forced_tier = options_.forced_tier;
  if (asking) options.progress = options_.progress;
  return options;
}

Result<PlacedPair> EditedSum::placed_pair(const Step& step) {
  std::array<std::shared_ptr<const Operand>, 2> own = own_;
  for (std::uint32_t op = 0; op < 2; ++op) {
    if (own[op] != nullptr && step.changes[op] == nullptr) continue;
    const Region& region = *step.regions[op];
    // Where an edit makes rings touch, edges are cut.
    if (own[op] != nullptr && step.changes[op]->moved && !touching_[op] && region.touching_points().empty())
      if (auto moved = steps_[op].next(own[op], region, *step.changes[op]->moved)) {
        own[op] = std::move(moved);
        continue;
      }
    own[op] =
        make_operand(separate_touching(region.data(), region.touching_points()), op, op == 1 && options_.reflect_q);
    if (std::optional<Error> error = too_large(*own[op])) return *std::move(error);
  }
  PlacedPair placed;
  placed.lattice = make_lattice(own[0]->points, own[1]->points, SumInternals::min_tier_bits(options_));
  placed.p = placed_on(*placed.lattice, std::move(own[0]));
  placed.q = placed_on(*placed.lattice, std::move(own[1]));
  return placed;
}

// The operands are these from now on.
void EditedSum::stand_on(PlacedPair placed, const Step& step) {
  placed_ = std::move(placed);
  for (std::uint32_t op = 0; op < 2; ++op) {
    own_[op] = op == 0 ? placed_.p : placed_.q;
    steps_[op].use(own_[op]);
    touching_[op] = !step.regions[op]->touching_points().empty();
  }
}

bool EditedSum::can_keep(const PlacedPair& placed, const Step& step) const {
  return options_.mode != FrameMode::rebuild && has_only_area(*step.regions[0]) && has_only_area(*step.regions[1]) &&
         !placed.lattice->wide &&
         (options_.mode == FrameMode::window || !convex_boundary(*placed.lattice, *placed.p, *placed.q));
}

// Whether what is kept can go on: the numbers of what stays are the same.
bool EditedSum::comparable(const PlacedPair& placed) const {
  const Lattice &a = *placed_.lattice, &b = *placed.lattice;
  return a.unit == b.unit && a.exact_doubles == b.exact_doubles && cover_->holds(placed);
}

// Whether rounded positions and their errors are those of a sum from scratch.
bool EditedSum::same_numbers(const PlacedPair& placed) const {
  const Lattice &a = *placed_.lattice, &b = *placed.lattice;
  return a.span == b.span && a.points[0]->offset == b.points[0]->offset && a.points[1]->offset == b.points[1]->offset;
}

// Per loop and component of the other operand: whether that fills it.
std::vector<std::uint8_t> EditedSum::filled_loops(const PlacedPair& placed, std::uint32_t op) const {
  const Operand &o = op == 0 ? *placed.p : *placed.q, &other = op == 0 ? *placed.q : *placed.p;
  std::vector<std::uint8_t> filled;
  for (const Loop& loop : o.loops)
    for (const Component& c : other.components)
      filled.push_back(loop.kind == LoopKind::hole && hole_is_filled(*placed.lattice, o, loop, other, c));
  return filled;
}

std::array<WalkChanges, 2> EditedSum::changes_to(const PlacedPair& placed, const Step& step) const {
  std::array<WalkChanges, 2> walks;
  const std::array<const Operand*, 2> before{placed_.p.get(), placed_.q.get()}, after{placed.p.get(), placed.q.get()};
  for (std::uint32_t op = 0; op < 2; ++op) {
    if (step.changes[op] == nullptr) continue;
    if (steps_[op].made().get() == after[op]) walks[op] = WalkChanges(*after[op], steps_[op].moves());
    else
      walks[op] =
          WalkChanges(*before[op], *after[op], origins_of(*step.changes[op], after[op]->vertex_of_index.size()));
  }
  return walks;
}

// Loops that are filled where they were not, or not where they were, are new.
void EditedSum::renew_loops(const PlacedPair& placed, const std::array<std::vector<std::uint8_t>, 2>& filled,
                            std::array<WalkChanges, 2>& walks) const {
  const std::array<const Operand*, 2> before{placed_.p.get(), placed_.q.get()}, after{placed.p.get(), placed.q.get()};
  for (std::uint32_t op = 0; op < 2; ++op) {
    const std::size_t columns = after[1 - op]->components.size();
    const bool comparable =
        before[op]->loops.size() == after[op]->loops.size() && filled[op].size() == filled_[op].size();
    for (std::size_t l = 0; l < after[op]->loops.size(); ++l) {
      const Loop& loop = after[op]->loops[l];
      if (loop.kind != LoopKind::hole) continue;
      const auto row = filled[op].begin() + static_cast<std::ptrdiff_t>(l * columns);
      if (comparable && std::equal(row, row + static_cast<std::ptrdiff_t>(columns),
                                   filled_[op].begin() + static_cast<std::ptrdiff_t>(l * columns)))
        continue;
      if (walks[op].unchanged()) {
        VertexChanges same;
        same.moved.emplace();
        walks[op] = WalkChanges(*before[op], *after[op], origins_of(same, after[op]->vertex_of_index.size()));
      }
      walks[op].renew(loop);
    }
  }
}

// One operand whose vertices moved is followed; else the convolution is made anew.
void EditedSum::follow_convolution(const PlacedPair& placed, const std::array<WalkChanges, 2>& walks, bool same_holes) {
  const std::uint32_t op = walks[0].unchanged() ? 1 : 0;
  const OperandSteps& steps = steps_[op];
  if (same_holes && walks[1 - op].unchanged() && steps.made() == (op == 0 ? placed.p : placed.q) &&
      convolution_->can_follow())
    convolution_->follow(*placed.lattice, *placed.p, *placed.q, op, steps.moves());
  else convolution_ = std::make_unique<FollowedConvolution>(*placed.lattice, *placed.p, *placed.q);
}

void EditedSum::drop() {
  loops_.reset();
  arrangement_.reset();
  cover_.reset();
  convolution_.reset();
  cycles_.clear();
}

void EditedSum::keep(const PlacedPair& placed) {
  drop();
  convolution_ = std::make_unique<FollowedConvolution>(*placed.lattice, *placed.p, *placed.q);
  cover_ = std::make_unique<CountedCover>(placed, grid_size(convolution_->size()));
  arrangement_ = std::make_unique<EditArrangement>(placed, *convolution_, *cover_);
  loops_ = std::make_unique<EditLoops>(placed.p->components.size() == 1 && placed.q->components.size() == 1);
  for (std::uint32_t op = 0; op < 2; ++op) filled_[op] = filled_loops(placed, op);
  Collision collision(*placed.lattice, *placed.p, *placed.q, true);
  EditLoops::Changes all;
  all.all_new = true;
  loops_->update(*arrangement_, all, *cover_, collision);
  plain_ = !loops_->degenerate(*arrangement_, *cover_, collision);
}

// The rings of a sum from scratch are those of cycles from now on.
void EditedSum::hand_over() {
  const SumStats stats = std::move(sum_.stats);
  const std::vector<std::uint64_t> ids = std::move(ring_ids_);
  assemble();
  sum_.stats = stats;
  ring_ids_ = ids;
  for (std::size_t i = 0; i < cycles_.size(); ++i) loops_->cycles().at(cycles_[i]).identity = ids[i];
}

FrameChanges EditedSum::take_scratch(PlanarSum sum) {
  FrameChanges changes;
  ring_ids_ = identities_.match(sum_, ring_ids_, sum, false, changes);
  finish(changes, Sizes(sum_), Sizes(sum));
  sum_ = std::move(sum);
  cycles_.clear();
  return changes;
}

Result<FrameChanges> EditedSum::rebuild(PlacedPair placed, const Step& step) {
  work_.rebuilt = true;
  Result<PlanarSum> sum = placed_sum(placed, sum_options(true));
  if (!sum) return sum.error();
  const SumStats& stats = sum->stats;
  const bool pays = options_.mode == FrameMode::window ||
                    (stats.reduced_segments >= kFewSegments && stats.reduced_segments <= kManySegments &&
                     stats.degenerate_nodes * kSegmentsPerNode <= stats.live_segments);
  if (arrangement_ == nullptr) saved_ += kPutAside;
  const bool affordable = options_.mode == FrameMode::window || (saved_ >= kMaking && !is_large(step));
  if (pays && affordable && can_keep(placed, step)) {
    saved_ -= kMaking;
    keep(placed);
  } else {
    drop();
  }
  stand_on(std::move(placed), step);
  FrameChanges changes = take_scratch(std::move(sum).value());
  if (arrangement_ != nullptr && plain_) hand_over();
  return changes;
}

Result<FrameChanges> EditedSum::start(const Step& step) {
  Result<PlacedPair> placed = placed_pair(step);
  if (!placed) return placed.error();
  return rebuild(std::move(placed).value(), step);
}

Result<FrameChanges> EditedSum::follow(const Step& step) {
  Result<PlacedPair> made = placed_pair(step);
  if (!made) return made.error();
  PlacedPair placed = std::move(made).value();
  const bool large = options_.mode == FrameMode::automatic && is_large(step);
  if (arrangement_ == nullptr || large || !can_keep(placed, step) || !comparable(placed) ||
      placed.p->components.size() != placed_.p->components.size() ||
      placed.q->components.size() != placed_.q->components.size())
    return rebuild(std::move(placed), step);
  return update(std::move(placed), step);
}

// Whether a step changes so much that what is kept saves nothing.
bool EditedSum::is_large(const Step& step) const {
  for (std::uint32_t op = 0; op < 2; ++op) {
    if (step.changes[op] == nullptr || own_[op] == nullptr) continue;
    const std::vector<Point>& before = own_[op]->points->input;
    const double sign = own_[op]->reflected ? -1 : 1;
    std::size_t changed = 0;
    if (step.changes[op]->moved) {
      changed = step.changes[op]->moved->size();
    } else {
      std::uint32_t v = 0;
      for_each_chain(step.regions[op]->data(), [&](const std::vector<Point>& chain) {
        for (const Point p : chain) {
          const std::uint32_t was = step.changes[op]->origins[v++];
          changed += was == kNone || before[was].x != sign * p.x || before[was].y != sign * p.y;
        }
      });
      changed += v < before.size() ? before.size() - v : 0;
    }
    if (static_cast<double>(changed) > kManyVertices * static_cast<double>(before.size())) return true;
  }
  return false;
}

// The rings of the sum go back to their cycles.
void EditedSum::take_rings_back(const std::array<WalkChanges, 2>& walks) {
  std::size_t i = 0;
  const auto back = [&](SumRing& ring) {
    if (i >= cycles_.size()) return;
    EditCycle& cycle = loops_->cycles().at(cycles_[i]);
    cycle.ring = std::move(ring);
    cycle.identity = ring_ids_[i++];
  };
  for (SumPart& part : sum_.parts) {
    back(part.outer);
    for (SumRing& hole : part.holes) back(hole);
  }
  if (walks[0].renumbered() || walks[1].renumbered())
    for (auto& [id, cycle] : loops_->cycles())
      if (cycle.ring) rename_vertices(*cycle.ring, walks);
}

FrameChanges EditedSum::update(PlacedPair placed, const Step& step) {
  const bool from_scratch = cycles_.empty();  // the rings of the sum are not those of cycles
  const Sizes sizes(sum_);
  std::array<WalkChanges, 2> walks = changes_to(placed, step);
  const std::array filled{filled_loops(placed, 0), filled_loops(placed, 1)};
  const bool same_holes = filled == filled_;
  if (!same_holes) renew_loops(placed, filled, walks);
  take_rings_back(walks);
  follow_convolution(placed, walks, same_holes);
  arrangement_->remove_changed(walks, *convolution_);
  const std::vector<GridCell> uncovered = cover_->update(placed_, placed, walks);
  const bool elsewhere = !same_numbers(placed);
  arrangement_->rename(placed, *convolution_, walks, elsewhere);
  arrangement_->add_changed(walks, uncovered);
  filled_ = filled;
  stand_on(std::move(placed), step);

  saved_ += kSavedByUpdate;

  Collision collision(*placed_.lattice, *placed_.p, *placed_.q, true);
  EditLoops::Changes changes;
  changes.walks = std::move(walks);
  loops_->update(*arrangement_, changes, *cover_, collision);
  work_.degenerate = loops_->degenerate(*arrangement_, *cover_, collision);

  const EditArrangement::Work& done = arrangement_->work();
  work_.segments_removed = done.removed;
  work_.segments_added = done.added;
  work_.cells_changed = cover_->changed_cells();
  work_.cells_uncovered = uncovered.size();
  work_.pairs_tested = done.pairs;
  work_.events_changed = done.events;
  work_.loops_traced = loops_->work().traced;
  work_.loops_kept = loops_->work().kept;
  work_.collision_tests = collision.counts().tests;
  work_.exact_signs = done.exact_signs + collision.counts().signs.exact();
  FrameChanges out;
  if (!work_.degenerate && !from_scratch) {
    if (elsewhere) forget_rings();
    out = assemble();
  } else {
    PlanarSum before;
    std::vector<std::uint64_t> ids = ring_ids_;
    if (from_scratch) before = std::exchange(sum_, {});
    else ids = rings_before(before);
    if (elsewhere) forget_rings();
    // Where a position is passed twice rings are joined anew, and tight features merged: as from scratch.
    if (work_.degenerate) sum_ = placed_sum(placed_, sum_options(false)).value();
    else assemble();
    if (work_.degenerate) cycles_.clear();
    ring_ids_ = identities_.match(before, ids, sum_, false, out);
    for (std::size_t i = 0; i < cycles_.size(); ++i) loops_->cycles().at(cycles_[i]).identity = ring_ids_[i];
  }
  finish(out, sizes, Sizes(sum_));
  return out;
}

// The rings of cycles that are as they were are written again.
void EditedSum::forget_rings() {
  for (auto& [id, cycle] : loops_->cycles()) cycle.ring.reset();
}

// The rings of before that cycles have, or had.
std::vector<std::uint64_t> EditedSum::rings_before(PlanarSum& rings) const {
  std::vector<std::uint64_t> ids;
  const auto add = [&](const EditCycle& cycle) {
    if (!cycle.ring) return;
    rings.parts.push_back({*cycle.ring, {}});
    ids.push_back(cycle.identity);
  };
  for (const EditCycle& cycle : loops_->lost()) add(cycle);
  for (const auto& [id, cycle] : loops_->cycles()) add(cycle);
  return ids;
}

// The sum of the kept cycles. Rings that are not made yet are made; identities go from the rings that were lost to
// these.
FrameChanges EditedSum::assemble() {
  const auto source = std::make_shared<SumSource>(placed_.lattice, placed_.p, placed_.q);
  PlanarSum lost, made;
  std::vector<std::uint64_t> lost_ids;
  std::vector<std::uint32_t> made_cycles, all;
  for (const EditCycle& cycle : loops_->lost())
    if (cycle.ring) {
      lost.parts.push_back({*cycle.ring, {}});
      lost_ids.push_back(cycle.identity);
    }
  double error = arrangement_->soup().point_error;
  for (const auto& [id, cycle] : loops_->cycles())
    if (cycle.kept) all.push_back(id);
  std::sort(all.begin(), all.end());
  for (const std::uint32_t id : all) {
    EditCycle& cycle = loops_->cycles().at(id);
    if (!cycle.ring) {
      cycle.ring_error = 0;
      cycle.ring = ring_of_steps(*arrangement_, loops_->steps_of(*arrangement_, cycle), *source, cycle.ring_error);
      if (cycle.identity == 0) {
        made.parts.push_back({*cycle.ring, {}});
        made_cycles.push_back(id);
      }
    }
    error = std::max(error, cycle.ring_error);
  }
  FrameChanges changes;
  const std::vector<std::uint64_t> ids = identities_.match(lost, lost_ids, made, false, changes);
  for (std::size_t i = 0; i < made_cycles.size(); ++i) loops_->cycles().at(made_cycles[i]).identity = ids[i];
  std::vector<SumRing> rings;
  std::vector<std::uint8_t> outer;
  for (const std::uint32_t id : all) {
    EditCycle& cycle = loops_->cycles().at(id);
    rings.push_back(*std::exchange(cycle.ring, std::nullopt));
    cycle.ring.reset();
    outer.push_back(cycle.winding > 0);
  }
  sum_ = PlanarSum{};
  exact_source(sum_) = source;
  sum_.at_error = input_error(*placed_.lattice, error);
  std::unordered_map<const SumVertex*, std::size_t> index_at;  // rings keep their arrays
  for (std::size_t i = 0; i < rings.size(); ++i) index_at[rings[i].vertices.data()] = i;
  sum_.parts = group_rings(std::move(rings), outer, *source, sum_.at_error);
  canonicalize(sum_.parts, *source, sum_.at_error);
  cycles_.clear();
  ring_ids_.clear();
  for (const SumRing* ring : rings_of(sum_)) {
    const std::size_t i = index_at.at(ring->vertices.data());
    cycles_.push_back(all[i]);
    ring_ids_.push_back(loops_->cycles().at(all[i]).identity);
  }
  sum_.stats.tier_bits = placed_.lattice->tier_bits;
  sum_.stats.reduced_segments = convolution_->size();
  sum_.stats.live_segments = arrangement_->live_count();
  sum_.stats.crossings = arrangement_->crossing_count();
  sum_.stats.loops = loops_->cycles().size();
  return changes;
}

}  // namespace dymsum::planar
