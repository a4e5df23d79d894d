#include "dymsum/editable_sum.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <numeric>
#include <string>
#include <utility>

#include "planar/edit/region_edits.h"
#include "planar/edit/sum_state.h"
#include "planar/region/region_validate.h"

namespace dymsum {

Edit Edit::move(MovingOperand operand, std::uint32_t vertex, Point to) {
  Edit e;
  e.kind = EditKind::move, e.operand = operand, e.vertex = vertex, e.at = to;
  return e;
}
Edit Edit::insert(MovingOperand operand, std::uint32_t after, Point at) {
  Edit e;
  e.kind = EditKind::insert, e.operand = operand, e.vertex = after, e.at = at;
  return e;
}
Edit Edit::remove(MovingOperand operand, std::uint32_t vertex) {
  Edit e;
  e.kind = EditKind::remove, e.operand = operand, e.vertex = vertex;
  return e;
}
Edit Edit::extrude(MovingOperand operand, std::uint32_t first, std::uint32_t last, Point by) {
  Edit e;
  e.kind = EditKind::extrude, e.operand = operand, e.vertex = first, e.last = last, e.at = by;
  return e;
}
Edit Edit::invert(MovingOperand operand, std::uint32_t vertex) {
  Edit e;
  e.kind = EditKind::invert, e.operand = operand, e.vertex = vertex;
  return e;
}
Edit Edit::add_hole(MovingOperand operand, std::uint32_t part, Ring ring) {
  Edit e;
  e.kind = EditKind::add_hole, e.operand = operand, e.part = part, e.added.outer = std::move(ring);
  return e;
}
Edit Edit::remove_hole(MovingOperand operand, std::uint32_t part, std::uint32_t hole) {
  Edit e;
  e.kind = EditKind::remove_hole, e.operand = operand, e.part = part, e.hole = hole;
  return e;
}
Edit Edit::add_part(MovingOperand operand, Part part) {
  Edit e;
  e.kind = EditKind::add_part, e.operand = operand, e.added = std::move(part);
  return e;
}
Edit Edit::remove_part(MovingOperand operand, std::uint32_t part) {
  Edit e;
  e.kind = EditKind::remove_part, e.operand = operand, e.part = part;
  return e;
}

namespace {

using Names = std::vector<std::uint64_t>;

// An operand as it is or was, with the names of its vertices, which those before and after moves have in common.
struct NamedRegion {
  Region region;
  std::shared_ptr<const Names> names;
};
using Operands = std::array<std::shared_ptr<const NamedRegion>, 2>;

// A step from the state before it to the one after it.
struct MadeStep {
  Operands before, after;
  std::array<planar::VertexChanges, 2> changes;  // nothing of an operand that is as it was
};

// From the state after to the one before, of so many vertices.
planar::VertexChanges reversed(const planar::VertexChanges& changes, std::size_t size) {
  if (changes.moved) return changes;
  planar::VertexChanges back;
  back.origins.resize(size, planar::kNone);
  for (std::uint32_t v = 0; v < changes.origins.size(); ++v)
    if (changes.origins[v] != planar::kNone) back.origins[changes.origins[v]] = v;
  return back;
}

}  // namespace

class EditableSum::State {
 public:
  State(const Region& p, const Region& q, const EditOptions& options) : options_(options), sum_(options) {
    std::uint32_t op = 0;  // both may be one region
    for (const Region* region : {&p, &q}) {
      auto named = std::make_shared<NamedRegion>();
      named->region = planar::trusted_region(region->data(), region->touching_points());
      auto names = std::make_shared<Names>(region->vertex_count());
      std::iota(names->begin(), names->end(), next_name_);
      next_name_ += names->size();
      named->names = std::move(names);
      operands_[op++] = std::move(named);
    }
  }

  Result<FrameChanges> start() {
    return timed([&] { return sum_.start({{&region(0), &region(1)}, {}}); });
  }

  Result<FrameChanges> edit(std::span<const Edit> edits) {
    if (edits.empty()) return timed([&] { return go(operands_, {}); });  // no step: what was undone can be made again
    return timed([&]() -> Result<FrameChanges> {
      Result<MadeStep> step = make(edits);
      if (!step) return step.error();
      Result<FrameChanges> changes = go(step->after, step->changes);
      if (!changes) return changes;
      undone_.clear();
      done_.push_back(std::move(step).value());
      if (done_.size() > options_.undo_steps) done_.pop_front();
      return changes;
    });
  }

  Result<FrameChanges> undo() {
    if (done_.empty()) return Error{ErrorCode::out_of_range, "there is no step to undo", {}};
    return timed([&] {
      const MadeStep& step = done_.back();
      std::array<planar::VertexChanges, 2> back;
      for (std::size_t op = 0; op < 2; ++op)
        if (step.before[op] != step.after[op]) back[op] = reversed(step.changes[op], step.before[op]->names->size());
      Result<FrameChanges> changes = go(step.before, back);
      if (!changes) return changes;
      undone_.push_back(std::move(done_.back()));
      done_.pop_back();
      return changes;
    });
  }

  Result<FrameChanges> redo() {
    if (undone_.empty()) return Error{ErrorCode::out_of_range, "there is no step to make again", {}};
    return timed([&] {
      Result<FrameChanges> changes = go(undone_.back().after, undone_.back().changes);
      if (!changes) return changes;
      done_.push_back(std::move(undone_.back()));
      undone_.pop_back();
      return changes;
    });
  }

  std::size_t undo_count() const { return done_.size(); }
  std::size_t redo_count() const { return undone_.size(); }
  const Region& region(std::size_t op) const { return operands_[op]->region; }
  const Names& names(std::size_t op) const { return *operands_[op]->names; }
  planar::EditedSum& sum() { return sum_; }

 private:
  template <class Make>
  Result<FrameChanges> timed(const Make& make) {
    const auto start = std::chrono::steady_clock::now();
    const EditWork before = std::exchange(sum_.work(), {});
    Result<FrameChanges> changes = make();
    if (!changes) sum_.work() = before;
    else sum_.work().ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return changes;
  }

  // The data that edits of an operand begin with.
  planar::EditedData data_before(std::size_t op, std::span<const Edit> edits) const {
    planar::EditedData edited;
    edited.data = region(op).data();
    const auto moves = [op](const Edit& edit) {
      return (edit.operand == MovingOperand::p) != (op == 0) || planar::only_moves(edit);
    };
    if (std::all_of(edits.begin(), edits.end(), moves)) {
      edited.changes.moved.emplace();
    } else {
      edited.changes.origins.resize(names(op).size());
      std::iota(edited.changes.origins.begin(), edited.changes.origins.end(), 0u);
    }
    return edited;
  }

  // The operands after the edits.
  Result<MadeStep> make(std::span<const Edit> edits) {
    MadeStep step{operands_, operands_, {}};
    std::array<std::optional<planar::EditedData>, 2> edited;
    for (const Edit& edit : edits) {
      const std::size_t op = edit.operand == MovingOperand::p ? 0 : 1;
      if (!edited[op]) edited[op] = data_before(op, edits);
      if (const Result<void> made = planar::apply(edit, *edited[op]); !made) return made.error();
    }
    std::uint64_t next = next_name_;
    for (std::size_t op = 0; op < 2; ++op) {
      if (!edited[op]) continue;
      step.changes[op] = edited[op]->changes;
      Result<Region> region = planar::edited_region(this->region(op), *std::move(edited[op]));
      if (!region) return region.error();
      auto named = std::make_shared<NamedRegion>();
      named->region = std::move(region).value();
      named->names = operands_[op]->names;
      if (!step.changes[op].moved) {
        auto made = std::make_shared<Names>();
        for (const std::uint32_t v : step.changes[op].origins)
          made->push_back(v == planar::kNone ? next++ : names(op)[v]);
        named->names = std::move(made);
      }
      step.after[op] = std::move(named);
    }
    next_name_ = next;
    return step;
  }

  Result<FrameChanges> go(const Operands& to, const std::array<planar::VertexChanges, 2>& made) {
    planar::EditedSum::Step step{{&to[0]->region, &to[1]->region}, {}};
    for (std::size_t op = 0; op < 2; ++op)
      if (to[op] != operands_[op]) step.changes[op] = &made[op];
    Result<FrameChanges> changes = sum_.follow(step);
    if (changes) operands_ = to;
    return changes;
  }

  EditOptions options_;
  Operands operands_;
  std::uint64_t next_name_ = 1;
  planar::EditedSum sum_;
  std::deque<MadeStep> done_;
  std::vector<MadeStep> undone_;
};

Result<EditableSum> EditableSum::create(const Region& p, const Region& q, const EditOptions& options) {
  auto state = std::make_unique<State>(p, q, options);
  if (const Result<FrameChanges> made = state->start(); !made) return made.error();
  return EditableSum(std::move(state));
}

EditableSum::EditableSum(std::unique_ptr<State> state) : state_(std::move(state)) {}
EditableSum::EditableSum(EditableSum&&) noexcept = default;
EditableSum& EditableSum::operator=(EditableSum&&) noexcept = default;
EditableSum::~EditableSum() = default;

Result<FrameChanges> EditableSum::edit(std::span<const Edit> edits) { return state_->edit(edits); }
Result<FrameChanges> EditableSum::undo() { return state_->undo(); }
Result<FrameChanges> EditableSum::redo() { return state_->redo(); }
std::size_t EditableSum::undo_count() const { return state_->undo_count(); }
std::size_t EditableSum::redo_count() const { return state_->redo_count(); }
const Region& EditableSum::p() const { return state_->region(0); }
const Region& EditableSum::q() const { return state_->region(1); }
const std::vector<std::uint64_t>& EditableSum::vertex_names(MovingOperand operand) const {
  return state_->names(operand == MovingOperand::p ? 0 : 1);
}
const PlanarSum& EditableSum::sum() const { return state_->sum().sum(); }
std::vector<std::uint64_t> EditableSum::ring_ids() const { return state_->sum().ring_ids(); }
const EditWork& EditableSum::work() const { return state_->sum().work(); }

std::uint64_t EditableSum::hash() const {
  std::uint64_t h = 0;
  const PlanarSum& s = sum();
  const auto number = [&](std::uint64_t n) { h = planar::mixed(h, n); };
  const auto vertex = [&](const SumVertex& v) {
    const RationalPoint at = s.exact(v);
    for (const std::string& text : {at.x.to_string(), at.y.to_string()})
      for (const char c : text) number(static_cast<unsigned char>(c));
  };
  const auto ring = [&](const SumRing& r) {
    number(r.vertices.size());
    for (const SumVertex& v : r.vertices) vertex(v);
  };
  const auto segments = [&](const std::vector<SumSegment>& list) {
    number(list.size());
    for (const SumSegment& segment : list) vertex(segment.from), vertex(segment.to);
  };
  const auto points = [&](const std::vector<SumVertex>& list) {
    number(list.size());
    for (const SumVertex& v : list) vertex(v);
  };
  number(s.parts.size());
  for (const SumPart& part : s.parts) {
    ring(part.outer);
    number(part.holes.size());
    for (const SumRing& hole : part.holes) ring(hole);
  }
  segments(s.segments);
  points(s.points);
  segments(s.tight_segments);
  points(s.tight_points);
  return h;
}

}  // namespace dymsum
