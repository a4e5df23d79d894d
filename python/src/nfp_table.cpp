// Tables of no-fit polygons.
#include "dymsum/nfp_table.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "enumeration.h"
#include "paths.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_table_input(nb::module_& m) {
  Record<TableItem> item(m, "TableItem", "An item: its name, its shape, the orientations it may take.");
  item.def(
      "__init__",
      [](TableItem* self, std::string name, const RegionArgument& shape, std::vector<Rational> degrees) {
        new (self) TableItem{std::move(name), *shape, std::move(degrees)};
      },
      "name"_a, "shape"_a, "degrees"_a);
  item.field("name", &TableItem::name)
      .field("shape", &TableItem::shape)
      .field("degrees", &TableItem::degrees, "Exact, counter-clockwise.");
  Record<TableBin> bin(m, "TableBin", "A bin: its name and its shape.");
  bin.def(
      "__init__",
      [](TableBin* self, std::string name, const RegionArgument& shape) {
        new (self) TableBin{std::move(name), *shape};
      },
      "name"_a, "shape"_a);
  bin.field("name", &TableBin::name).field("shape", &TableBin::shape);
  Record<TableInput> input(m, "TableInput", "What a table is made of.");
  input.def(
      "__init__",
      [](TableInput* self, std::vector<TableItem> items, std::vector<TableBin> bins, std::optional<double> height,
         double error, double spacing,
         double margin) { new (self) TableInput{std::move(items), std::move(bins), height, error, spacing, margin}; },
      "items"_a = nb::list(), "bins"_a = nb::list(), "strip_height"_a = nb::none(),
      "angle_error"_a = TableInput().angle_error, "spacing"_a = 0.0, "margin"_a = 0.0);
  input.field("items", &TableInput::items)
      .field("bins", &TableInput::bins)
      .field("strip_height", &TableInput::strip_height)
      .field("angle_error", &TableInput::angle_error, "Radians; quarter turns are exact.")
      .field("spacing", &TableInput::spacing, "The least distance of two items.")
      .field("margin", &TableInput::margin, "The least distance of an item from the outside of its bin or strip.");
}

void bind_table_rows(nb::module_& m) {
  Record<TableAngle>(m, "TableAngle", "An angle that rows have.")
      .field("degrees", &TableAngle::degrees, "The decimal one, in [0, 360), exactly.")
      .field("orientation", &TableAngle::orientation, "The exact one that shapes are turned by.")
      .field("error", &TableAngle::error, "They differ by at most so many radians; 0 for quarter turns.");
  Record<TableRow> row(m, "TableRow", "A row: which shapes it is about, at which angle, and which answer it has.");
  enumeration<TableRow::Kind>(row, "Kind", "What a row tells.",
                              {"item `fixed` (+) -R(angle) item `moving`, in the frame of the fixed one",
                               "bin `fixed` (-) R(angle) item `moving`", "the strip (-) R(angle) item `moving`"});
  row.def_ro_static("kNone", &TableRow::kNone, "`fixed` of strip fits.");
  row.field("kind", &TableRow::kind)
      .field("fixed", &TableRow::fixed, "Index of an item or a bin.")
      .field("moving", &TableRow::moving, "Index of an item.")
      .field("angle", &TableRow::angle, "Index in NfpTable.angles.")
      .field("answer", &TableRow::answer, "Index of the answer, which rows with the same shapes share.");
}

void bind_answers(nb::module_& m) {
  Record<StripFit>(m, "StripFit", "x >= x_min and y_min <= y <= y_max, each correctly rounded.")
      .field("fits", &StripFit::fits, "Exactly; else the numbers are 0.")
      .field("x_min", &StripFit::x_min)
      .field("y_min", &StripFit::y_min)
      .field("y_max", &StripFit::y_max);
  Record<TableAnswer> answer(m, "TableAnswer", "The answer of rows with the same shapes.");
  enumeration<TableAnswer::Status>(answer, "Status", "What came of it.",
                                   {"with an answer", "by the library, with an error", "a limit of time was reached"});
  enumeration<TableAnswer::Rounding>(answer, "Rounding", "What rounding changed.",
                                     {"every vertex is exact", "to the nearest doubles; the topology is the exact one",
                                      "vertices that met were merged, what collapsed was dropped"});
  answer.field("status", &TableAnswer::status)
      .field("rounding", &TableAnswer::rounding)
      .field("vertices", &TableAnswer::vertices, "Of the exact polygons.")
      .field("holes", &TableAnswer::holes)
      .field("tight_segments", &TableAnswer::tight_segments)
      .field("tight_points", &TableAnswer::tight_points)
      .field("strip", &TableAnswer::strip, "Of strip fits, which have no geometry.")
      .bytes("wkb", &TableAnswer::wkb, "Well-known binary (shapely.from_wkb): the closed set with its tight features.")
      .field("error", &TableAnswer::error, "Where it was refused: not raised.");
}

NfpTable planned(const TableInput& input, const Progress& progress) {
  return run(progress, [&](const Progress& own) { return NfpTable::create(input, own); });
}

void bind_nfp_table_class(nb::module_& m) {
  nb::class_<NfpTable>(m, "NfpTable", R"doc(What a table of no-fit polygons consists of: see compute_table.

Rows in the order of their indices: by fixed item, moving item, relative angle; then bins, then the strip. Raises Error:
unsupported_operand for empty shapes, items without orientations, bins with polylines; out_of_range; cancelled. Planning
tables of very many angles takes long: it runs without the GIL and asks `progress`.

>>> from dymsum import NfpTable, TableInput, TableItem, compute_table, shapes
>>> quarters = [0, 90, 180, 270]
>>> items = [TableItem("ell", shapes.letter_l(3, 3, 1), quarters), TableItem("bar", shapes.rectangle(0, 0, 2, 1), quarters)]
>>> table = NfpTable(TableInput(items, strip_height=3))
>>> len(table.rows), table.task_count()
(24, 10)
>>> compute_table(table).answers[table.rows[-1].answer].strip
StripFit(fits=True, x_min=0.0, y_min=2.0, y_max=3.0)
)doc")
      .def(
          "__init__",
          [](NfpTable* self, const TableInput& input, const Progress& progress) {
            new (self) NfpTable(planned(input, progress));
          },
          "input"_a, "progress"_a = nb::none())
      .def_static("create", planned, "input"_a, "progress"_a = nb::none())
      .def_prop_ro("input", &NfpTable::input, nb::rv_policy::reference_internal)
      .def_prop_ro("angles", &NfpTable::angles, nb::rv_policy::reference_internal)
      .def_prop_ro("rows", &NfpTable::rows, nb::rv_policy::reference_internal, "A new list: O(rows).")
      .def("answer_count", &NfpTable::answer_count)
      .def("task_count", &NfpTable::task_count, "What shards divide: one answer, or two that mirror each other.")
      .def("__repr__",
           [](const NfpTable& self) {
             return "<NfpTable: " + std::to_string(self.input().items.size()) + " items, " +
                    std::to_string(self.rows().size()) + " rows, " + std::to_string(self.task_count()) + " tasks>";
           })
      .def("__getstate__", [](const NfpTable& self) { return nb::make_tuple(self.input()); })
      .def("__setstate__", [](NfpTable& self, nb::tuple state) {
        new (&self) NfpTable(take(NfpTable::create(nb::cast<TableInput>(state[0]))));
      });
}

void bind_table_options(nb::module_& m) {
  Record<TableOptions> options(m, "TableOptions", "Options of compute_table.");
  options.def(
      "__init__",
      [](TableOptions* self, int threads, std::uint32_t shard, std::uint32_t shards, double pair_seconds,
         double all_seconds, PathArgument store, bool compute, Progress progress) {
        new (self) TableOptions{
            threads, shard, shards, pair_seconds, all_seconds, std::move(store.text), compute, std::move(progress)};
      },
      "threads"_a = 0, "shard"_a = 1, "shards"_a = 1, "pair_seconds"_a = TableOptions().pair_seconds,
      "all_seconds"_a = TableOptions().all_seconds, "store"_a = "", "compute"_a = true, "progress"_a = nb::none());
  options.option("threads", &TableOptions::threads, "0: as many as there are cores.")
      .option("shard", &TableOptions::shard, "Compute the tasks of one shard alone, from 1 on.")
      .option("shards", &TableOptions::shards)
      .option("pair_seconds", &TableOptions::pair_seconds, "A limit for a task.")
      .option("all_seconds", &TableOptions::all_seconds, "A limit for all tasks.")
      .path("store", &TableOptions::store, "A folder that answers are taken from and added to; \"\": none.")
      .option("compute", &TableOptions::compute, "Else only what the store has is taken.")
      .option("progress", &TableOptions::progress);
  Record<RefusedFile>(m, "RefusedFile", "A file of the store of which not everything could be believed.")
      .field("file", &RefusedFile::file)
      .field("why", &RefusedFile::why);
  Record<TableWork>(m, "TableWork", "What compute_table did.")
      .field("tasks", &TableWork::tasks, "Of this shard.")
      .field("computed", &TableWork::computed, "Of these, by this call.")
      .field("timed_out", &TableWork::timed_out, "Of these, given up; the others were in the store.")
      .field("store_files", &TableWork::store_files)
      .field("refused_files", &TableWork::refused_files);
  Record<TableResult>(m, "TableResult", "Answers of a table, and what was done for them.")
      .field("answers", &TableResult::answers, "None where another shard has it, or nobody. A new list: O(answers).")
      .field("work", &TableResult::work)
      .field("table", &TableResult::table, "A hash of the rows and shapes of the table that the answers belong to.");
}

/// work() without the GIL, as text or as bytes.
template <class Text, class Work>
Text text_of(Work&& work) {
  const std::string text = without_gil(work);
  return Text(text.data(), text.size());
}

void bind_table_texts(nb::module_& m) {
  m.def(
      "compute_table",
      [](const NfpTable& table, const TableOptions& options) {
        return run_with(options, [&](const TableOptions& own) { return compute_table(table, own); });
      },
      "table"_a, "options"_a = TableOptions(),
      "The answers of a table, in parallel and without the GIL. What was finished when it is interrupted is in the "
      "store. Raises Error: out_of_range; cannot_open, cannot_write for the store; cancelled.");
  m.def(
      "table_rows",
      [](const NfpTable& table, const TableResult& result, bool inline_geometry) {
        return text_of<nb::str>([&] { return table_rows(table, result, inline_geometry); });
      },
      "table"_a, "result"_a, "inline_geometry"_a,
      "Rows as JSON lines, with their geometry in hexadecimal digits or with its place in table_geometry. Raises "
      "ValueError where an answer is missing, and for answers of another table.");
  m.def(
      "table_geometry",
      [](const NfpTable& table, const TableResult& result) {
        return text_of<nb::bytes>([&] { return table_geometry(table, result); });
      },
      "table"_a, "result"_a,
      "The well-known binary of all rows, one after the other. Raises ValueError as table_rows.");
  m.def(
      "table_manifest",
      [](const NfpTable& table, const TableResult& result, const std::string& rows, const nb::bytes& geometry) {
        const std::string_view bytes(geometry.c_str(), geometry.size());
        return text_of<nb::str>([&] { return table_manifest(table, result, rows, bytes); });
      },
      "table"_a, "result"_a, "rows"_a, "geometry"_a,
      "The table as one JSON object, with counts, and sizes and SHA-256 of both texts. Raises ValueError as "
      "table_rows.");
}

}  // namespace

void bind_nfp_table(nb::module_& m) {
  bind_table_input(m);
  bind_table_rows(m);
  bind_answers(m);
  bind_nfp_table_class(m);
  bind_table_options(m);
  bind_table_texts(m);
}

}  // namespace dymsum::python
