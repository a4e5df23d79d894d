// A table as texts. Nothing of how it came about is in them.
#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "dymsum/names.h"
#include "io/source.h"
#include "nesting/table_plan.h"

namespace dymsum {
namespace nesting {
namespace {

using Json = nlohmann::ordered_json;

std::string hex_of(std::string_view bytes) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text(2 * bytes.size(), '0');
  char* at = text.data();
  for (const char c : bytes) {
    *at++ = kDigits[static_cast<unsigned char>(c) >> 4];
    *at++ = kDigits[static_cast<unsigned char>(c) & 15];
  }
  return text;
}

std::string hex_of(const base::Digest& digest) {
  return hex_of({reinterpret_cast<const char*>(digest.data()), digest.size()});
}

/// A text in JSON: bytes that are no text are replaced.
std::string quoted(const std::string& text) { return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string number_text(double value) {
  std::string text;
  io::append_number(text, value);
  return text;
}

std::string tangent_of(const Orientation& o) { return o.is_half_turn() ? "inf" : o.tan_half().to_string(); }

void require_same(const NfpTable& table, const TableResult& result) {
  if (result.table != table.state().mark || result.answers.size() != table.answer_count())
    throw std::invalid_argument("the answers are those of another table");
}

const TableAnswer& answer_of(const TableResult& result, const TableRow& row) {
  const std::optional<TableAnswer>& answer = result.answers.at(row.answer);
  if (!answer) throw std::invalid_argument("a row of the table has no answer: not all shards are there");
  return *answer;
}

/// Writes rows one by one; by hand, because there may be millions.
class RowWriter {
 public:
  RowWriter(const NfpTable::State& table, bool inline_geometry) : inline_(inline_geometry) {
    for (const TableItem& item : table.input.items) items_.push_back(quoted(item.name));
    for (const TableBin& bin : table.input.bins) bins_.push_back(quoted(bin.name));
    for (const TableAngle& angle : table.angles)
      angles_.push_back(R"(,"degrees":)" + number_text(angle.degrees.to_double()) + R"(,"tan_half":")" +
                        tangent_of(angle.orientation) + '"');
  }

  void write(std::string& out, const TableRow& row, const TableAnswer& answer) {
    out += R"({"kind":")";
    out += name(row.kind);
    if (row.kind == TableRow::Kind::nfp) out += R"(","fixed":)" + items_[row.fixed];
    else if (row.kind == TableRow::Kind::bin_fit) out += R"(","bin":)" + bins_[row.fixed];
    else out += '"';
    out += R"(,"moving":)" + items_[row.moving] + angles_[row.angle] + R"(,"status":")" +
           std::string(name(answer.status)) + '"';
    if (answer.error) write_error(out, *answer.error);
    if (answer.status == TableAnswer::Status::done) {
      if (answer.strip) write_strip(out, answer);
      else write_set(out, answer);
    }
    out += "}\n";
    offset_ += answer.wkb.size();
  }

 private:
  void write_error(std::string& out, const Error& error) const {
    out += R"(,"error":{"code":")" + std::string(name(error.code)) + R"(","message":)" + quoted(error.message) + '}';
  }

  void write_rounding(std::string& out, const TableAnswer& answer) const {
    out += R"(,"rounding":")";
    out += name(answer.rounding);
    out += '"';
  }

  void write_strip(std::string& out, const TableAnswer& answer) const {
    const StripFit& fit = *answer.strip;
    out += R"(,"fits":)";
    out += fit.fits ? "true" : "false";
    if (!fit.fits) return;
    write_rounding(out, answer);
    out += R"(,"x_min":)" + number_text(fit.x_min) + R"(,"y_min":)" + number_text(fit.y_min) + R"(,"y_max":)" +
           number_text(fit.y_max);
  }

  void write_set(std::string& out, const TableAnswer& answer) const {
    write_rounding(out, answer);
    out += R"(,"vertices":)" + std::to_string(answer.vertices) + R"(,"holes":)" + std::to_string(answer.holes) +
           R"(,"tight":{"segments":)" + std::to_string(answer.tight_segments) + R"(,"points":)" +
           std::to_string(answer.tight_points) + '}';
    if (inline_) out += R"(,"wkb":")" + hex_of(answer.wkb) + '"';
    else out += R"(,"offset":)" + std::to_string(offset_) + R"(,"bytes":)" + std::to_string(answer.wkb.size());
  }

  bool inline_;
  std::vector<std::string> items_, bins_, angles_;
  std::uint64_t offset_ = 0;
};

Json degrees_json(const std::vector<Rational>& degrees) {
  Json list = Json::array();
  for (const Rational& d : degrees) list.push_back(d.to_double());
  return list;
}

Json text_json(std::string_view text) { return {{"bytes", text.size()}, {"sha256", hex_of(base::sha256(text))}}; }

Json counts_json(const NfpTable::State& table, const TableResult& result) {
  constexpr const auto& kNames = names_of<TableAnswer::Status>();
  std::array<std::uint64_t, kNames.size()> counts{};
  for (const TableRow& row : table.rows) ++counts[static_cast<std::size_t>(answer_of(result, row).status)];
  Json json{{"all", table.rows.size()}};
  for (std::size_t k = 0; k < counts.size(); ++k) json[std::string(kNames[k])] = counts[k];
  return json;
}

}  // namespace
}  // namespace nesting

std::string table_rows(const NfpTable& table, const TableResult& result, bool inline_geometry) {
  nesting::require_same(table, result);
  nesting::RowWriter writer(table.state(), inline_geometry);
  std::string out;
  for (const TableRow& row : table.rows()) writer.write(out, row, nesting::answer_of(result, row));
  return out;
}

std::string table_geometry(const NfpTable& table, const TableResult& result) {
  nesting::require_same(table, result);
  std::string out;
  for (const TableRow& row : table.rows()) out += nesting::answer_of(result, row).wkb;
  return out;
}

std::string table_manifest(const NfpTable& table, const TableResult& result, std::string_view rows,
                           std::string_view geometry) {
  using nesting::Json;
  nesting::require_same(table, result);
  const NfpTable::State& state = table.state();
  Json items = Json::array(), bins = Json::array(), angles = Json::array();
  for (std::size_t i = 0; i < state.input.items.size(); ++i)
    items.push_back({{"name", state.input.items[i].name},
                     {"sha256", nesting::hex_of(state.item_digests[i])},
                     {"degrees", nesting::degrees_json(state.input.items[i].degrees)}});
  for (std::size_t i = 0; i < state.input.bins.size(); ++i)
    bins.push_back({{"name", state.input.bins[i].name}, {"sha256", nesting::hex_of(state.bin_digests[i])}});
  for (const TableAngle& angle : state.angles)
    angles.push_back({{"degrees", angle.degrees.to_double()},
                      {"tan_half", nesting::tangent_of(angle.orientation)},
                      {"error", angle.error}});
  const Json manifest = {{"format", "dymsum nfp table"},
                         {"format_version", 1},
                         {"items", std::move(items)},
                         {"bins", std::move(bins)},
                         {"spacing", state.input.spacing},
                         {"margin", state.input.margin},
                         {"strip_height", state.input.strip_height ? Json(*state.input.strip_height) : Json(nullptr)},
                         {"angles", std::move(angles)},
                         {"rows", nesting::counts_json(state, result)},
                         {"row_text", nesting::text_json(rows)},
                         {"geometry", nesting::text_json(geometry)}};
  return manifest.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dymsum
