#include "dymsum/editable_solid_sum.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <utility>

#include "base/poll.h"
#include "spatial/edit/mesh_edits.h"
#include "spatial/moving/sum_shape.h"

namespace dymsum {

SolidEdit SolidEdit::move(MovingOperand operand, std::uint32_t vertex, Point3 to) {
  SolidEdit e;
  e.kind = SolidEditKind::move, e.operand = operand, e.vertex = vertex, e.at = to;
  return e;
}
SolidEdit SolidEdit::extrude(MovingOperand operand, std::vector<std::uint32_t> faces, Point3 by) {
  SolidEdit e;
  e.kind = SolidEditKind::extrude, e.operand = operand, e.faces = std::move(faces), e.at = by;
  return e;
}
SolidEdit SolidEdit::invert(MovingOperand operand, std::uint32_t vertex, std::uint32_t other) {
  SolidEdit e;
  e.kind = SolidEditKind::invert, e.operand = operand, e.vertex = vertex, e.other = other;
  return e;
}
SolidEdit SolidEdit::insert_in_face(MovingOperand operand, std::uint32_t face, Point3 at) {
  SolidEdit e;
  e.kind = SolidEditKind::insert_in_face, e.operand = operand, e.face = face, e.at = at;
  return e;
}
SolidEdit SolidEdit::insert_in_edge(MovingOperand operand, std::uint32_t vertex, std::uint32_t other, Point3 at) {
  SolidEdit e = invert(operand, vertex, other);
  e.kind = SolidEditKind::insert_in_edge, e.at = at;
  return e;
}
SolidEdit SolidEdit::remove(MovingOperand operand, std::uint32_t vertex) {
  SolidEdit e;
  e.kind = SolidEditKind::remove, e.operand = operand, e.vertex = vertex;
  return e;
}
SolidEdit SolidEdit::add_shell(MovingOperand operand, MeshData shell) {
  SolidEdit e;
  e.kind = SolidEditKind::add_shell, e.operand = operand, e.added = std::move(shell);
  return e;
}
SolidEdit SolidEdit::remove_shell(MovingOperand operand, std::uint32_t face) {
  SolidEdit e;
  e.kind = SolidEditKind::remove_shell, e.operand = operand, e.face = face;
  return e;
}

namespace {

/// An operand as it is or was.
struct EditedSolid {
  Mesh mesh;
  Mesh added;  ///< what is added to the other operand: the mesh, or its reflection
  std::vector<std::uint64_t> vertex_names, face_names, face_ancestors;
};

/// Both operands, and their sum where it is kept.
struct SolidMoment {
  std::array<std::shared_ptr<const EditedSolid>, 2> operands;
  std::shared_ptr<const SpatialSum> sum;
  SolidEditWork work;
};

void count_edits(const EditedSolid& was, const EditedSolid& is, SolidEditWork& work) {
  std::vector<std::pair<std::uint64_t, std::size_t>> known;
  const auto find = [&](std::uint64_t name) -> std::optional<std::size_t> {
    const auto at = std::lower_bound(known.begin(), known.end(), std::pair{name, std::size_t{0}});
    return at != known.end() && at->first == name ? std::optional(at->second) : std::nullopt;
  };
  const auto index = [&](const std::vector<std::uint64_t>& names) {
    known.clear();
    for (std::size_t k = 0; k < names.size(); ++k) known.emplace_back(names[k], k);
    std::sort(known.begin(), known.end());
  };
  index(was.vertex_names);
  for (std::size_t v = 0; v < is.vertex_names.size(); ++v) {
    const std::optional<std::size_t> before = find(is.vertex_names[v]);
    work.vertices_edited += !before || was.mesh.vertices()[*before] != is.mesh.vertices()[v];
  }
  index(was.face_names);
  const auto names_of_face = [](const EditedSolid& solid, std::size_t f) {
    std::vector<std::uint64_t> names;
    for (const std::uint32_t v : solid.mesh.faces()[f]) names.push_back(solid.vertex_names[v]);
    return names;
  };
  for (std::size_t f = 0; f < is.face_names.size(); ++f) {
    const std::optional<std::size_t> before = find(is.face_names[f]);
    work.faces_edited += !before || names_of_face(was, *before) != names_of_face(is, f);
  }
}

}  // namespace

class EditableSolidSum::State {
 public:
  State(const Mesh& p, const Mesh& q, const SolidEditOptions& options) : options_(options) {
    std::uint32_t op = 0;
    for (const Mesh* mesh : {&p, &q}) {
      auto solid = std::make_shared<EditedSolid>();
      solid->mesh = *mesh;
      solid->added = added(*mesh, op);
      for (std::size_t v = 0; v < mesh->vertices().size(); ++v) solid->vertex_names.push_back(next_name_++);
      for (std::size_t f = 0; f < mesh->faces().size(); ++f) solid->face_names.push_back(next_name_++);
      solid->face_ancestors = solid->face_names;
      moment_.operands[op++] = std::move(solid);
    }
  }

  Result<SolidEditWork> start() {
    return timed([&] { return computed(moment_); });
  }

  Result<SolidEditWork> edit(std::span<const SolidEdit> edits) {
    if (edits.empty()) return timed([&] { return computed(moment_); });  // no step: what was undone can be made again
    return timed([&]() -> Result<SolidMoment> {
      std::uint64_t next = next_name_;
      Result<SolidMoment> edited = make(edits, next);
      if (!edited) return edited;
      Result<SolidMoment> moment = computed(*std::move(edited));
      if (!moment) return moment;
      next_name_ = next;
      undone_.clear();
      done_.push_back(moment_);
      if (done_.size() > options_.undo_steps) done_.pop_front();
      return moment;
    });
  }

  Result<SolidEditWork> undo() {
    if (done_.empty()) return Error{ErrorCode::out_of_range, "there is no step to undo", {}};
    return timed([&]() -> Result<SolidMoment> {
      Result<SolidMoment> moment = computed(done_.back());
      if (!moment) return moment;
      undone_.push_back(moment_);
      done_.pop_back();
      return moment;
    });
  }

  Result<SolidEditWork> redo() {
    if (undone_.empty()) return Error{ErrorCode::out_of_range, "there is no step to make again", {}};
    return timed([&]() -> Result<SolidMoment> {
      Result<SolidMoment> moment = computed(undone_.back());
      if (!moment) return moment;
      done_.push_back(moment_);
      undone_.pop_back();
      return moment;
    });
  }

  std::size_t undo_count() const { return done_.size(); }
  std::size_t redo_count() const { return undone_.size(); }
  const EditedSolid& solid(MovingOperand operand) const {
    return *moment_.operands[operand == MovingOperand::p ? 0 : 1];
  }
  const SpatialSum& sum() const { return *moment_.sum; }
  const SolidEditWork& work() const { return moment_.work; }

 private:
  Mesh added(const Mesh& mesh, std::size_t op) const { return op == 1 && options_.reflect_q ? negated(mesh) : mesh; }

  /// make() gives the next moment, or an error and nothing has changed.
  template <class Make>
  Result<SolidEditWork> timed(const Make& make) {
    const auto start = std::chrono::steady_clock::now();
    Result<SolidMoment> moment = make();
    if (!moment) return moment.error();
    const SolidMoment before = std::exchange(moment_, *std::move(moment));
    if (before.sum)
      for (std::size_t op = 0; op < 2; ++op)
        if (before.operands[op] != moment_.operands[op])
          count_edits(*before.operands[op], *moment_.operands[op], moment_.work);
    let_go_of_sums();
    moment_.work.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return moment_.work;
  }

  /// The moment with its sum.
  Result<SolidMoment> computed(SolidMoment moment) const {
    moment.work = {};
    moment.work.kept = moment.sum != nullptr;
    if (moment.sum) return moment;
    SpatialOptions options;
    options.semantics = options_.semantics, options.tight = options_.tight, options.threads = options_.threads;
    options.progress = options_.progress;
    Result<SpatialSum> sum = minkowski_sum(moment.operands[0]->added, moment.operands[1]->added, options);
    if (!sum) return sum.error();
    const SpatialStats& stats = sum->stats;
    moment.work.facets = stats.face_vertex + stats.edge_edge;
    moment.work.contacts = stats.contacts, moment.work.exact_signs = stats.exact_signs;
    moment.sum = std::make_shared<SpatialSum>(*std::move(sum));
    return moment;
  }

  /// The operands after the edits, without their sum.
  Result<SolidMoment> make(std::span<const SolidEdit> edits, std::uint64_t& next) const {
    SolidMoment moment{moment_.operands, nullptr, {}};
    std::array<std::optional<spatial::NamedMeshData>, 2> edited;
    for (const SolidEdit& edit : edits) {
      const std::size_t op = edit.operand == MovingOperand::p ? 0 : 1;
      const EditedSolid& was = *moment_.operands[op];
      if (!edited[op]) edited[op] = {was.mesh.data(), was.vertex_names, was.face_names, was.face_ancestors, next};
      edited[op]->next_name = next;
      if (const Result<void> made = spatial::apply(edit, *edited[op]); !made) return made.error();
      next = edited[op]->next_name;
    }
    for (std::size_t op = 0; op < 2; ++op) {
      if (!edited[op]) continue;
      Result<Mesh> mesh = Mesh::create(std::move(edited[op]->data));
      if (!mesh) return mesh.error();
      auto solid = std::make_shared<EditedSolid>();
      solid->mesh = *std::move(mesh);
      solid->added = added(solid->mesh, op);
      solid->vertex_names = std::move(edited[op]->vertex_names);
      solid->face_names = std::move(edited[op]->face_names);
      solid->face_ancestors = std::move(edited[op]->face_ancestors);
      moment.operands[op] = std::move(solid);
    }
    return moment;
  }

  /// Sums of steps further away than so many are made again when they are needed.
  void let_go_of_sums() {
    const std::size_t kept = options_.kept_sums;
    if (done_.size() > kept) done_[done_.size() - 1 - kept].sum = nullptr;
    if (undone_.size() > kept) undone_[undone_.size() - 1 - kept].sum = nullptr;
  }

  SolidEditOptions options_;
  std::uint64_t next_name_ = 1;
  SolidMoment moment_;
  std::deque<SolidMoment> done_;
  std::vector<SolidMoment> undone_;
};

Result<EditableSolidSum> EditableSolidSum::create(const Mesh& p, const Mesh& q, const SolidEditOptions& options) {
  if (options.threads < 0)
    return Error{ErrorCode::out_of_range, "threads must be at least 0, not " + std::to_string(options.threads), {}};
  if (p.has_thin_parts() || q.has_thin_parts())
    return Error{ErrorCode::unsupported_operand, "an edited solid may have no parts without volume", {}};
  auto state = std::make_unique<State>(p, q, options);
  if (const Result<SolidEditWork> made = state->start(); !made) return made.error();
  return EditableSolidSum(std::move(state));
}

EditableSolidSum::EditableSolidSum(std::unique_ptr<State> state) : state_(std::move(state)) {}
EditableSolidSum::EditableSolidSum(EditableSolidSum&&) noexcept = default;
EditableSolidSum& EditableSolidSum::operator=(EditableSolidSum&&) noexcept = default;
EditableSolidSum::~EditableSolidSum() = default;

Result<SolidEditWork> EditableSolidSum::edit(std::span<const SolidEdit> edits) { return state_->edit(edits); }
Result<SolidEditWork> EditableSolidSum::undo() { return state_->undo(); }
Result<SolidEditWork> EditableSolidSum::redo() { return state_->redo(); }
std::size_t EditableSolidSum::undo_count() const { return state_->undo_count(); }
std::size_t EditableSolidSum::redo_count() const { return state_->redo_count(); }
const Mesh& EditableSolidSum::p() const { return state_->solid(MovingOperand::p).mesh; }
const Mesh& EditableSolidSum::q() const { return state_->solid(MovingOperand::q).mesh; }
const std::vector<std::uint64_t>& EditableSolidSum::vertex_names(MovingOperand operand) const {
  return state_->solid(operand).vertex_names;
}
const std::vector<std::uint64_t>& EditableSolidSum::face_names(MovingOperand operand) const {
  return state_->solid(operand).face_names;
}
const std::vector<std::uint64_t>& EditableSolidSum::face_ancestors(MovingOperand operand) const {
  return state_->solid(operand).face_ancestors;
}
const SpatialSum& EditableSolidSum::sum() const { return state_->sum(); }
const SolidEditWork& EditableSolidSum::work() const { return state_->work(); }

std::uint64_t EditableSolidSum::hash() const {
  const SpatialSum& s = sum();
  std::uint64_t h = 0;
  const auto number = [&](std::uint64_t n) { h = spatial::mixed(h, n); };
  const auto loops = [&](const std::vector<std::vector<std::uint32_t>>& list) {
    number(list.size());
    for (const std::vector<std::uint32_t>& loop : list) {
      number(loop.size());
      for (const std::uint32_t v : loop) number(v);
    }
  };
  number(s.vertices.size());
  for (std::size_t v = 0; v < s.vertices.size(); ++v) {
    const RationalPoint3 at = s.exact(v);
    for (const Rational* c : {&at.x, &at.y, &at.z})
      for (const char letter : c->to_string()) number(static_cast<unsigned char>(letter));
  }
  number(s.faces.size());
  for (const SpatialFace& face : s.faces) loops(face.loops);
  number(s.tight_faces.size());
  for (const auto& face : s.tight_faces) loops(face);
  number(s.tight_segments.size());
  for (const auto& [from, to] : s.tight_segments) number(from), number(to);
  number(s.tight_points.size());
  for (const std::uint32_t v : s.tight_points) number(v);
  return h;
}

}  // namespace dymsum
