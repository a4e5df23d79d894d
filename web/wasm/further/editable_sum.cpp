// EditableSum: sums that follow edits, which come as the lines of a script.
#include "dymsum/editable_sum.h"

#include "arrays.h"
#include "dymsum/edit_script.h"
#include "options.h"
#include "plain.h"
#include "planar_shape.h"

namespace dymsum::web {
namespace {

std::shared_ptr<EditableSum> created(const Region& p, const Region& q, const val& options) {
  EditOptions how;
  how.semantics = semantics_in(member(options, "semantics"));
  how.reflect_q = member_or(options, "reflectQ", false);
  how.mode = enumerator(member(options, "mode"), FrameMode::automatic);
  how.undo_steps = static_cast<std::size_t>(member_or(options, "undoSteps", static_cast<double>(how.undo_steps)));
  how.progress = progress_in(member(options, "progress"));
  return shared(got(EditableSum::create(p, q, how)));
}

/// All edits of the lines as one step.
val edit_by(EditableSum& sum, const std::string& lines) {
  std::vector<Edit> edits;
  for (const ScriptStep& step : got(parse_script(lines))) {
    if (step.action != ScriptAction::edit) throw Thrown{{ErrorCode::malformed, "a step holds edits alone", {}}};
    edits.insert(edits.end(), step.edits.begin(), step.edits.end());
  }
  return plain(got(sum.edit(edits)));
}
val undo_in(EditableSum& sum) { return plain(got(sum.undo())); }
val redo_in(EditableSum& sum) { return plain(got(sum.redo())); }
double undo_count_of(const EditableSum& sum) { return static_cast<double>(sum.undo_count()); }
double redo_count_of(const EditableSum& sum) { return static_cast<double>(sum.redo_count()); }

std::shared_ptr<Region> region_of(const EditableSum& sum, const val& operand) {
  return shared(enumerator(operand, MovingOperand::p) == MovingOperand::p ? sum.p() : sum.q());
}
val array_of_ids(const std::vector<std::uint64_t>& ids) {
  return array_of(std::vector<double>(ids.begin(), ids.end()));
}
val vertex_names_of(const EditableSum& sum, const val& operand) {
  return array_of_ids(sum.vertex_names(enumerator(operand, MovingOperand::p)));
}
val ring_ids_of(const EditableSum& sum) { return array_of_ids(sum.ring_ids()); }
val shape_of_edited(const EditableSum& sum) { return sum_shape(sum.sum()); }
std::shared_ptr<PlanarSum> sum_of_edited(const EditableSum& sum) { return shared(sum.sum()); }
val work_of_edit(const EditableSum& sum) { return plain(sum.work()); }
std::string hash_of_edited(const EditableSum& sum) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text(16, '0');
  std::uint64_t hash = sum.hash();
  for (std::size_t k = 16; k-- > 0; hash >>= 4) text[k] = kDigits[hash & 15];
  return text;
}

EMSCRIPTEN_BINDINGS(editable_sum) {
  handle<EditableSum>("EditableSum")
      .class_function("create", guarded<&created>)
      .function("edit", guarded<&edit_by>)
      .function("undo", guarded<&undo_in>)
      .function("redo", guarded<&redo_in>)
      .function("undoCount", guarded<&undo_count_of>)
      .function("redoCount", guarded<&redo_count_of>)
      .function("region", guarded<&region_of>)
      .function("vertexNames", guarded<&vertex_names_of>)
      .function("ringIds", guarded<&ring_ids_of>)
      .function("shape", guarded<&shape_of_edited>)
      .function("sum", guarded<&sum_of_edited>)
      .function("work", guarded<&work_of_edit>)
      .function("hash", guarded<&hash_of_edited>);
}

}  // namespace
}  // namespace dymsum::web
