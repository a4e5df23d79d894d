// Planar sums that follow edits of their operands.
#include "dymsum/editable_sum.h"

#include <optional>

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/edit_script.h"
#include "enumeration.h"
#include "held.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

Ring ring_of(const Rows<2>& rows) {
  const auto* first = reinterpret_cast<const Point*>(rows.data);
  return {first, first + rows.size};
}

void bind_edit(nb::module_& m) {
  enumeration<EditKind>(m, "EditKind", "What is done to a region.");
  Record<Edit> edit(m, "Edit", "One edit of one operand, made by the methods of its kind.");
  edit.field("kind", &Edit::kind)
      .field("operand", &Edit::operand)
      .field("vertex", &Edit::vertex)
      .field("last", &Edit::last, "of extrude: the last vertex of the chain")
      .field("at", &Edit::at, "a position; of extrude a vector")
      .field("part", &Edit::part)
      .field("hole", &Edit::hole)
      .field("added", &Edit::added, "of add_part; of add_hole its outer ring");
  edit.def_static("move", &Edit::move, "operand"_a, "vertex"_a, "to"_a)
      .def_static("insert", &Edit::insert, "operand"_a, "after"_a, "at"_a)
      .def_static("remove", &Edit::remove, "operand"_a, "vertex"_a)
      .def_static("extrude", &Edit::extrude, "operand"_a, "first"_a, "last"_a, "by"_a)
      .def_static("invert", &Edit::invert, "operand"_a, "vertex"_a)
      .def_static(
          "add_hole",
          [](MovingOperand operand, std::uint32_t part, const Rows<2>& ring) {
            return Edit::add_hole(operand, part, ring_of(ring));
          },
          "operand"_a, "part"_a, "ring"_a, "A clockwise ring, an array of shape (n, 2).")
      .def_static("remove_hole", &Edit::remove_hole, "operand"_a, "part"_a, "hole"_a)
      .def_static("add_part", &Edit::add_part, "operand"_a, "part"_a)
      .def_static("remove_part", &Edit::remove_part, "operand"_a, "part"_a);
}

void bind_options(nb::module_& m) {
  Record<EditOptions> options(m, "EditOptions", "Options of edited sums.");
  options.def(
      "__init__",
      [](EditOptions* self, Semantics semantics, bool reflect_q, FrameMode mode, std::size_t undo_steps,
         Progress progress) {
        new (self) EditOptions{semantics, reflect_q, mode, undo_steps, {}, std::move(progress)};
      },
      "semantics"_a = Semantics::closed, "reflect_q"_a = false, "mode"_a = FrameMode::automatic,
      "undo_steps"_a = EditOptions().undo_steps, "progress"_a = nb::none());
  options.option("semantics", &EditOptions::semantics)
      .option("reflect_q", &EditOptions::reflect_q, "P (+) -Q")
      .option("mode", &EditOptions::mode)
      .option("undo_steps", &EditOptions::undo_steps, "that are kept")
      .option("progress", &EditOptions::progress);
  Record<EditWork>(m, "EditWork", "The work of one step.").listed();
}

/// An EditableSum with the watch whose Progress it keeps.
struct Editing {
  Editing(const RegionArgument& p, const RegionArgument& q, const EditOptions& o)
      : options(own_options(o)), watch(options.progress), held(create(*p, *q)) {}

  static EditOptions own_options(EditOptions options) {
    options.progress = own_progress(options.progress);
    return options;
  }
  EditableSum create(const Region& p, const Region& q) {
    EditOptions own = options;
    own.progress = watch.progress();
    return watch.take(without_gil([&] { return EditableSum::create(p, q, own); }));
  }
  template <class Work>
  auto run(Work&& work) {
    return held.alone([&](EditableSum& sum) {
      watch.begin();
      return watch.take(without_gil([&] { return work(sum); }));
    });
  }
  FrameChanges step(const ScriptStep& step) {
    FrameChanges changes = run([&](EditableSum& sum) { return make_step(sum, step); });
    if (recording) held.alone([&](EditableSum& sum) { record_step(*recording, step, sum); });
    return changes;
  }
  FrameChanges edit(const std::vector<Edit>& edits) { return step({ScriptAction::edit, edits, 0}); }
  EditRecording begin() {
    return held.alone([&](EditableSum& sum) { return begin_recording(sum, options); });
  }

  EditOptions options;
  Watch watch;
  Held<EditableSum> held;
  std::optional<EditRecording> recording;  ///< of all steps since record()
};

/// The edits of one `with sum.edit() as e`.
struct EditStep {
  nb::object sum;
  std::vector<Edit> edits;
};

void bind_step(nb::module_& m) {
  nb::class_<EditStep> step(m, "EditStep", "Edits that are made as one step when the `with` block ends.");
  step.def("__enter__", [](nb::handle_t<EditStep> self) { return nb::borrow(self); })
      .def(
          "__exit__",
          [](EditStep& self, nb::handle kind, nb::handle, nb::handle) {
            if (kind.is_none()) self.sum.attr("edit")(self.edits);
          },
          "kind"_a.none(), "value"_a.none(), "trace"_a.none())
      .def(
          "add", [](EditStep& self, const Edit& edit) { self.edits.push_back(edit); }, "edit"_a)
      .def(
          "move",
          [](EditStep& self, MovingOperand operand, std::uint32_t vertex, Point to) {
            self.edits.push_back(Edit::move(operand, vertex, to));
          },
          "operand"_a, "vertex"_a, "to"_a)
      .def(
          "insert",
          [](EditStep& self, MovingOperand operand, std::uint32_t after, Point at) {
            self.edits.push_back(Edit::insert(operand, after, at));
          },
          "operand"_a, "after"_a, "at"_a)
      .def(
          "remove",
          [](EditStep& self, MovingOperand operand, std::uint32_t vertex) {
            self.edits.push_back(Edit::remove(operand, vertex));
          },
          "operand"_a, "vertex"_a);
}

void bind_sum(nb::module_& m) {
  nb::class_<Editing> type(m, "EditableSum", R"doc(P (+) Q, which follows edits of P and of Q, exactly.

>>> from dymsum import EditableSum, MovingOperand, minkowski_sum, shapes
>>> sum = EditableSum(shapes.star(5, 1, 2), shapes.rectangle(0, 0, 1, 1))
>>> with sum.edit() as e:
...     e.move(MovingOperand.p, 0, (2.5, 0))
>>> sum.sum() == minkowski_sum(sum.p(), sum.q()), sum.undo_count()
(True, 1)
)doc",
                           nb::type_slots(WatchedSlots<Editing>::slots));
  type.def(
          "__init__",
          [](Editing* self, const RegionArgument& p, const RegionArgument& q, const EditOptions& options) {
            new (self) Editing(p, q, options);
          },
          "p"_a, "q"_a, "options"_a = EditOptions())
      .def_static(
          "create",
          [](const RegionArgument& p, const RegionArgument& q, const EditOptions& options) {
            return new Editing(p, q, options);
          },
          nb::rv_policy::take_ownership, "p"_a, "q"_a, "options"_a = EditOptions(), "Raises Error: as minkowski_sum.")
      .def(
          "edit",
          [](nb::handle_t<Editing> self) {
            return EditStep{nb::borrow(self), {}};
          },
          "A step to be filled: with sum.edit() as e.")
      .def(
          "edit", [](Editing& self, const Edit& edit) { return self.edit({edit}); }, "edit"_a)
      .def(
          "edit", [](Editing& self, const std::vector<Edit>& edits) { return self.edit(edits); }, "edits"_a,
          "Makes all edits as one step. Raises Error: out_of_range, those of Region.create, cancelled; nothing changes "
          "then.")
      .def("undo",
           [](Editing& self) {
             return self.step({ScriptAction::undo, {}, 0});
           })
      .def("redo",
           [](Editing& self) {
             return self.step({ScriptAction::redo, {}, 0});
           })
      .def(
          "record", [](Editing& self) { self.recording = self.begin(); },
          "From here on steps are recorded. Raises ValueError where there are steps to undo or to redo.")
      .def(
          "recording",
          [](Editing& self) {
            if (!self.recording) throw nb::value_error("recording: record() was not called");
            return *self.recording;
          },
          "What was recorded so far.")
      .def("undo_count",
           [](Editing& self) { return self.held.alone([](EditableSum& sum) { return sum.undo_count(); }); })
      .def("redo_count",
           [](Editing& self) { return self.held.alone([](EditableSum& sum) { return sum.redo_count(); }); })
      .def("p", [](Editing& self) { return self.held.alone([](EditableSum& sum) { return Region(sum.p()); }); })
      .def("q", [](Editing& self) { return self.held.alone([](EditableSum& sum) { return Region(sum.q()); }); })
      .def(
          "vertex_names",
          [](Editing& self, MovingOperand operand) {
            return self.held.alone([&](EditableSum& sum) { return sum.vertex_names(operand); });
          },
          "operand"_a, "Names of the vertices of an operand, by index; they last through edits.")
      .def(
          "sum",
          [](Editing& self) {
            return self.held.alone([&](EditableSum& sum) {
              return remembered(PlanarSum(sum.sum()), "edited_sum", Region(sum.p()), Region(sum.q()), self.options);
            });
          },
          "A copy of the exact sum.")
      .def("ring_ids", [](Editing& self) { return self.held.alone([](EditableSum& sum) { return sum.ring_ids(); }); })
      .def("work", [](Editing& self) { return self.held.alone([](EditableSum& sum) { return sum.work(); }); })
      .def("hash", [](Editing& self) { return self.held.alone([](EditableSum& sum) { return sum.hash(); }); })
      .def_prop_ro("options", [](const Editing& self) { return Editing::own_options(self.options); })
      .def("__reduce__", [](nb::handle_t<Editing> self) {
        auto* object = nb::inst_ptr<Editing>(self);
        return object->held.alone([&](EditableSum& sum) {
          return nb::make_tuple(self.type(), nb::make_tuple(Region(sum.p()), Region(sum.q()), object->options));
        });
      });
}

void bind_script(nb::module_& m) {
  enumeration<ScriptAction>(m, "ScriptAction", "What a step of a script does.");
  Record<ScriptStep>(m, "ScriptStep", "A step of a script.")
      .constructible()
      .field("action", &ScriptStep::action)
      .field("edits", &ScriptStep::edits)
      .field("line", &ScriptStep::line, "on which it begins, from 1; 0 where it was not read");
  m.def(
      "parse_script", [](const std::string& text, const std::string& name) { return take(parse_script(text, name)); },
      "text"_a, "name_for_errors"_a = "", "The steps of a script. Raises Error: malformed, with the line.");
  m.def(
      "format_script", [](const std::vector<ScriptStep>& steps) { return format_script(steps); }, "steps"_a,
      "A script of these steps; nothing is rounded.");
}

void bind_recording(nb::module_& m) {
  Record<EditRecording>(m, "EditRecording", "All that it takes to make a session again, and its hashes.")
      .constructible()
      .field("p", &EditRecording::p, "before the first step")
      .field("q", &EditRecording::q)
      .field("semantics", &EditRecording::semantics)
      .field("reflect_q", &EditRecording::reflect_q)
      .field("mode", &EditRecording::mode)
      .field("undo_steps", &EditRecording::undo_steps)
      .field("steps", &EditRecording::steps)
      .field("hashes", &EditRecording::hashes, "of the sum before the first step, and after each");
  Record<EditReplay>(m, "EditReplay", "What came of making a session again.")
      .field("steps", &EditReplay::steps, "that were made")
      .field("differs", &EditReplay::differs, "the first step after which the sum is another one, or None")
      .field("refused", &EditReplay::refused, "where that step is refused, why");
  m.def(
      "format_recording", [](const EditRecording& recording) { return format_recording(recording); }, "recording"_a,
      "The recording as text; nothing is rounded.");
  m.def(
      "parse_recording",
      [](const std::string& text, const std::string& name) { return take(parse_recording(text, name)); }, "text"_a,
      "name_for_errors"_a = "", "Raises Error: truncated, malformed, those of Region.create.");
  m.def(
      "read_recording", [](const PathArgument& path) { return take(read_recording(path.text)); }, "path"_a,
      "The recording of a file, also a compressed one.");
  m.def(
      "replay",
      [](const EditRecording& recording, const Progress& progress) {
        return run(progress, [&](const Progress& own) { return replay(recording, own); });
      },
      "recording"_a, "progress"_a = nb::none(), "Makes a session again and compares hash after hash.");
}

void bind_steps(nb::module_& m) {
  m.def(
      "make_step", [](Editing& sum, const ScriptStep& step) { return sum.step(step); }, "sum"_a, "step"_a,
      "One step of a sum: edit, undo or redo.");
  m.def(
      "begin_recording", [](Editing& sum) { return sum.begin(); }, "sum"_a,
      "A recording that begins with the state of a sum; EditableSum.record() does it for you.");
  m.def(
      "record_step",
      [](EditRecording& recording, const ScriptStep& step, Editing& sum) {
        sum.held.alone([&](EditableSum& held) { record_step(recording, step, held); });
      },
      "recording"_a, "step"_a, "sum"_a, "Adds a step that the sum has made.");
}

}  // namespace

void bind_edited_sum(nb::module_& m) {
  bind_edit(m);
  bind_script(m);
  bind_options(m);
  bind_step(m);
  bind_recording(m);
  bind_sum(m);
  bind_steps(m);
}

}  // namespace dymsum::python
