#include "record.h"

#include <cstdint>
#include <set>

namespace dymsum::python {
namespace {

const RecordField* find(const std::vector<RecordField>& fields, std::string_view name) {
  for (const RecordField& field : fields) {
    if (field.name == name) return &field;
  }
  return nullptr;
}

void set_field(const RecordField& field, void* record, nb::handle value) {
  try {
    field.set(record, value);
  } catch (const nb::cast_error&) {
    throw nb::type_error(("no value for " + field.name + ": " + nb::cast<std::string>(nb::repr(value))).c_str());
  }
}

/// Long lists, and bytes, are determined by their length.
std::string short_repr(nb::handle value) {
  constexpr std::size_t kMost = 6;
  if (nb::isinstance<nb::list>(value) && nb::len(value) > kMost) {
    return "[... " + std::to_string(nb::len(value)) + " items]";
  }
  if (nb::isinstance<nb::bytes>(value)) return "b'... " + std::to_string(nb::len(value)) + " bytes'";
  return nb::cast<std::string>(nb::repr(value));
}

}  // namespace

void fill_record(const std::vector<RecordField>& fields, void* record, nb::args args, nb::kwargs kwargs) {
  if (args.size() > fields.size()) throw nb::type_error("too many arguments");
  for (std::size_t k = 0; k < args.size(); ++k) set_field(fields[k], record, args[k]);
  for (const auto& [key, value] : kwargs) {
    const auto name = nb::cast<std::string>(key);
    const RecordField* field = find(fields, name);
    if (!field) throw nb::type_error(("no field is named " + name).c_str());
    if (static_cast<std::size_t>(field - fields.data()) < args.size()) {
      throw nb::type_error(("two values for " + name).c_str());
    }
    set_field(*field, record, value);
  }
}

nb::tuple record_state(const std::vector<RecordField>& fields, nb::handle record) {
  nb::list state;
  for (const RecordField& field : fields) {
    // A callable is no part of a value, and mostly cannot be pickled.
    state.append(field.name == "progress" ? nb::none() : nb::object(record.attr(field.name.c_str())));
  }
  return nb::tuple(state);
}

void restore_record(const std::vector<RecordField>& fields, void* record, nb::tuple state) {
  if (state.size() != fields.size()) throw nb::value_error("pickled by another version of dymsum");
  for (std::size_t k = 0; k < fields.size(); ++k) set_field(fields[k], record, state[k]);
}

void copy_record(const std::vector<RecordField>& fields, nb::handle record, nb::handle made, void* to,
                 const nb::object& memo) {
  const nb::object deepcopy = memo.is_none() ? nb::object() : nb::module_::import_("copy").attr("deepcopy");
  // Before the fields, one of which may lead back to the record.
  if (deepcopy) memo[nb::int_(reinterpret_cast<std::uintptr_t>(record.ptr()))] = made;
  for (const RecordField& field : fields) {
    const nb::object value = record.attr(field.name.c_str());
    set_field(field, to, deepcopy ? deepcopy(value, memo) : value);
  }
}

std::string record_repr(const std::vector<RecordField>& fields, nb::handle record) {
  std::string text = nb::cast<std::string>(record.type().attr("__qualname__")) + "(";
  const char* between = "";
  for (const RecordField& field : fields) {
    text += between + field.name + "=" + short_repr(record.attr(field.name.c_str()));
    between = ", ";
  }
  return text + ")";
}

std::string attribute_name(std::string_view member) {
  return std::string(member) + (member == "from" || member == "in" ? "_" : "");
}

std::string_view interned(std::string_view text) {
  static std::set<std::string, std::less<>>& texts = *new std::set<std::string, std::less<>>;
  return *texts.emplace(text).first;
}

}  // namespace dymsum::python
