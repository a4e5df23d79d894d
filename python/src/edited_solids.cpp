// Sums of solids that follow edits of their operands.
#include <optional>

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/editable_solid_sum.h"
#include "dymsum/solid_edit_script.h"
#include "enumeration.h"
#include "held.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_solid_edit(nb::module_& m) {
  enumeration<SolidEditKind>(m, "SolidEditKind", "What is done to a mesh.");
  Record<SolidEdit> edit(m, "SolidEdit", "One edit of one operand, made by the methods of its kind.");
  edit.field("kind", &SolidEdit::kind)
      .field("operand", &SolidEdit::operand)
      .field("vertex", &SolidEdit::vertex)
      .field("other", &SolidEdit::other, "the other end of an edge")
      .field("face", &SolidEdit::face)
      .field("faces", &SolidEdit::faces, "of extrude")
      .field("at", &SolidEdit::at, "a position; of extrude a vector")
      .field("added", &SolidEdit::added, "of add_shell");
  edit.def_static("move", &SolidEdit::move, "operand"_a, "vertex"_a, "to"_a)
      .def_static("extrude", &SolidEdit::extrude, "operand"_a, "faces"_a, "by"_a)
      .def_static("invert", &SolidEdit::invert, "operand"_a, "vertex"_a, "other"_a)
      .def_static("insert_in_face", &SolidEdit::insert_in_face, "operand"_a, "face"_a, "at"_a)
      .def_static("insert_in_edge", &SolidEdit::insert_in_edge, "operand"_a, "vertex"_a, "other"_a, "at"_a)
      .def_static("remove", &SolidEdit::remove, "operand"_a, "vertex"_a)
      .def_static(
          "add_shell",
          [](MovingOperand operand, const MeshDataArgument& shell) { return SolidEdit::add_shell(operand, *shell); },
          "operand"_a, "shell"_a)
      .def_static("remove_shell", &SolidEdit::remove_shell, "operand"_a, "face"_a);
}

void bind_solid_edit_options(nb::module_& m) {
  Record<SolidEditOptions> options(m, "SolidEditOptions", "Options of edited sums of solids.");
  options.def(
      "__init__",
      [](SolidEditOptions* self, Semantics semantics, bool reflect_q, bool tight, int threads, std::size_t undo_steps,
         std::size_t kept_sums, Progress progress) {
        new (self) SolidEditOptions{semantics, reflect_q, tight, threads, undo_steps, kept_sums, std::move(progress)};
      },
      "semantics"_a = Semantics::closed, "reflect_q"_a = false, "tight"_a = true, "threads"_a = 1,
      "undo_steps"_a = SolidEditOptions().undo_steps, "kept_sums"_a = SolidEditOptions().kept_sums,
      "progress"_a = nb::none());
  options.option("semantics", &SolidEditOptions::semantics)
      .option("reflect_q", &SolidEditOptions::reflect_q, "P (+) -Q")
      .option("tight", &SolidEditOptions::tight, "look for tight features")
      .option("threads", &SolidEditOptions::threads, "0: as many as there are cores")
      .option("undo_steps", &SolidEditOptions::undo_steps, "that are kept")
      .option("kept_sums", &SolidEditOptions::kept_sums, "sums of the nearest steps in either direction")
      .option("progress", &SolidEditOptions::progress);
  Record<SolidEditWork>(m, "SolidEditWork", "The work of one step.").listed();
}

/// An EditableSolidSum with the watch whose Progress it keeps.
struct EditingSolids {
  EditingSolids(const MeshArgument& p, const MeshArgument& q, const SolidEditOptions& o)
      : options(own_options(o)), watch(options.progress), held(create(*p, *q)) {}

  static SolidEditOptions own_options(SolidEditOptions options) {
    options.progress = own_progress(options.progress);
    return options;
  }
  EditableSolidSum create(const Mesh& p, const Mesh& q) {
    SolidEditOptions own = options;
    own.progress = watch.progress();
    return watch.take(without_gil([&] { return EditableSolidSum::create(p, q, own); }));
  }
  SolidEditWork step(const SolidScriptStep& step) {
    return held.alone([&](EditableSolidSum& sum) {
      watch.begin();
      const SolidEditWork work = watch.take(without_gil([&] { return make_step(sum, step); }));
      if (recording) record_step(*recording, step, sum);
      return work;
    });
  }
  SolidEditWork edit(const std::vector<SolidEdit>& edits) { return step({ScriptAction::edit, edits, 0}); }
  SolidEditRecording begin() {
    return held.alone([&](EditableSolidSum& sum) { return begin_recording(sum, options); });
  }

  SolidEditOptions options;
  Watch watch;
  Held<EditableSolidSum> held;
  std::optional<SolidEditRecording> recording;  ///< of all steps since record()
};

template <class Read>
auto reading(Read read) {
  return [read](EditingSolids& self) { return self.held.alone([&](EditableSolidSum& sum) { return read(sum); }); };
}
template <class Read>
auto reading_names(Read read) {
  return [read](EditingSolids& self, MovingOperand operand) {
    return self.held.alone([&](EditableSolidSum& sum) { return read(sum, operand); });
  };
}

void bind_solid_states(nb::class_<EditingSolids>& type) {
  using Names = std::vector<std::uint64_t>;
  type.def("undo_count", reading([](EditableSolidSum& sum) { return sum.undo_count(); }))
      .def("redo_count", reading([](EditableSolidSum& sum) { return sum.redo_count(); }))
      .def("p", reading([](EditableSolidSum& sum) { return Mesh(sum.p()); }))
      .def("q", reading([](EditableSolidSum& sum) { return Mesh(sum.q()); }))
      .def("vertex_names",
           reading_names([](EditableSolidSum& s, MovingOperand op) { return Names(s.vertex_names(op)); }), "operand"_a,
           "Names of the vertices of an operand, by index; they last through edits.")
      .def("face_names", reading_names([](EditableSolidSum& s, MovingOperand op) { return Names(s.face_names(op)); }),
           "operand"_a, "The same of faces.")
      .def("face_ancestors",
           reading_names([](EditableSolidSum& s, MovingOperand op) { return Names(s.face_ancestors(op)); }),
           "operand"_a, "The names of the faces that these come of.")
      .def(
          "sum",
          [](EditingSolids& self) {
            return self.held.alone([&](EditableSolidSum& sum) {
              return remembered(SpatialSum(sum.sum()), "edited_solid_sum", Mesh(sum.p()), Mesh(sum.q()), self.options);
            });
          },
          "A copy of the exact sum.")
      .def("work", reading([](EditableSolidSum& sum) { return sum.work(); }))
      .def("hash", reading([](EditableSolidSum& sum) { return sum.hash(); }))
      .def_prop_ro("options", [](const EditingSolids& self) { return EditingSolids::own_options(self.options); })
      .def("__reduce__", [](nb::handle_t<EditingSolids> self) {
        auto* object = nb::inst_ptr<EditingSolids>(self);
        return object->held.alone([&](EditableSolidSum& sum) {
          return nb::make_tuple(self.type(), nb::make_tuple(Mesh(sum.p()), Mesh(sum.q()), object->options));
        });
      });
}

nb::class_<EditingSolids> bind_solid_edit_sum(nb::module_& m) {
  nb::class_<EditingSolids> type(m, "EditableSolidSum", R"doc(P (+) Q of solids, which follows edits of P and of Q.

>>> from dymsum import EditableSolidSum, MovingOperand, SolidEdit, minkowski_sum, solids
>>> sum = EditableSolidSum(solids.box(0, 0, 0, 1, 1, 1), solids.box(0, 0, 0, 2, 2, 2))
>>> work = sum.edit(SolidEdit.extrude(MovingOperand.p, [0], (0, 0, -1)))
>>> sum.sum() == minkowski_sum(sum.p(), sum.q()), sum.undo_count()
(True, 1)
)doc",
                                 nb::type_slots(WatchedSlots<EditingSolids>::slots));
  type.def(
          "__init__",
          [](EditingSolids* self, const MeshArgument& p, const MeshArgument& q, const SolidEditOptions& options) {
            new (self) EditingSolids(p, q, options);
          },
          "p"_a, "q"_a, "options"_a = SolidEditOptions())
      .def_static(
          "create",
          [](const MeshArgument& p, const MeshArgument& q, const SolidEditOptions& options) {
            return new EditingSolids(p, q, options);
          },
          nb::rv_policy::take_ownership, "p"_a, "q"_a, "options"_a = SolidEditOptions(),
          "Raises Error: as minkowski_sum; unsupported_operand, out_of_range.")
      .def(
          "edit", [](EditingSolids& self, const SolidEdit& edit) { return self.edit({edit}); }, "edit"_a)
      .def("edit", &EditingSolids::edit, "edits"_a,
           "Makes all edits as one step. Raises Error: out_of_range, those of Mesh.create and minkowski_sum; nothing "
           "changes then.")
      .def("undo",
           [](EditingSolids& self) {
             return self.step({ScriptAction::undo, {}, 0});
           })
      .def("redo",
           [](EditingSolids& self) {
             return self.step({ScriptAction::redo, {}, 0});
           })
      .def(
          "record", [](EditingSolids& self) { self.recording = self.begin(); },
          "From here on steps are recorded. Raises ValueError where there are steps to undo or to redo.")
      .def(
          "recording",
          [](EditingSolids& self) {
            if (!self.recording) throw nb::value_error("recording: record() was not called");
            return *self.recording;
          },
          "What was recorded so far.");
  return type;
}

void bind_solid_script(nb::module_& m) {
  Record<SolidScriptStep>(m, "SolidScriptStep", "A step of a script of solids.")
      .constructible()
      .field("action", &SolidScriptStep::action)
      .field("edits", &SolidScriptStep::edits)
      .field("line", &SolidScriptStep::line, "on which it begins, from 1; 0 where it was not read");
  m.def(
      "parse_solid_script",
      [](const std::string& text, const std::string& name) { return take(parse_solid_script(text, name)); }, "text"_a,
      "name_for_errors"_a = "", "The steps of a script. Raises Error: malformed, with the line.");
  m.def(
      "format_solid_script", [](const std::vector<SolidScriptStep>& steps) { return format_solid_script(steps); },
      "steps"_a, "A script of these steps; nothing is rounded.");
}

void bind_solid_recording(nb::module_& m) {
  Record<SolidEditRecording>(m, "SolidEditRecording", "All that it takes to make a session again, and its hashes.")
      .constructible()
      .field("p", &SolidEditRecording::p, "before the first step")
      .field("q", &SolidEditRecording::q)
      .field("semantics", &SolidEditRecording::semantics)
      .field("reflect_q", &SolidEditRecording::reflect_q)
      .field("tight", &SolidEditRecording::tight)
      .field("undo_steps", &SolidEditRecording::undo_steps)
      .field("steps", &SolidEditRecording::steps)
      .field("hashes", &SolidEditRecording::hashes, "of the sum before the first step, and after each");
  m.def(
      "format_recording", [](const SolidEditRecording& recording) { return format_recording(recording); },
      "recording"_a);
  m.def(
      "parse_solid_recording",
      [](const std::string& text, const std::string& name) { return take(parse_solid_recording(text, name)); },
      "text"_a, "name_for_errors"_a = "", "Raises Error: truncated, malformed, those of Mesh.create.");
  m.def(
      "read_solid_recording", [](const PathArgument& path) { return take(read_solid_recording(path.text)); }, "path"_a,
      "The recording of a file, also a compressed one.");
  m.def(
      "replay",
      [](const SolidEditRecording& recording, const Progress& progress) {
        return run(progress, [&](const Progress& own) { return replay(recording, own); });
      },
      "recording"_a, "progress"_a = nb::none());
}

void bind_solid_steps(nb::module_& m) {
  m.def(
      "make_step", [](EditingSolids& sum, const SolidScriptStep& step) { return sum.step(step); }, "sum"_a, "step"_a);
  m.def(
      "begin_recording", [](EditingSolids& sum) { return sum.begin(); }, "sum"_a);
  m.def(
      "record_step",
      [](SolidEditRecording& recording, const SolidScriptStep& step, EditingSolids& sum) {
        sum.held.alone([&](EditableSolidSum& held) { record_step(recording, step, held); });
      },
      "recording"_a, "step"_a, "sum"_a);
}

}  // namespace

void bind_edited_solids(nb::module_& m) {
  bind_solid_edit(m);
  bind_solid_edit_options(m);
  bind_solid_script(m);
  bind_solid_recording(m);
  nb::class_<EditingSolids> type = bind_solid_edit_sum(m);
  bind_solid_states(type);
  bind_solid_steps(m);
}

}  // namespace dymsum::python
