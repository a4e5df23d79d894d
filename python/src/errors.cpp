#include "errors.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include <optional>
#include <string>

#include "dymsum/fields.h"
#include "enumeration.h"
#include "leaving.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

nb::object object_of(const std::string& text) { return nb::cast(text); }
template <class T>
nb::object object_of(const std::optional<T>& value) {
  return value ? nb::cast(*value) : nb::none();
}

nb::object evidence_object(const Evidence& evidence) {
  nb::dict fields;
  names::for_each_field(evidence, [&](std::string_view name, const auto& value) {
    fields[nb::str(name.data(), name.size())] = object_of(value);
  });
  return nb::module_::import_("dymsum._errors").attr("Evidence")(**fields);
}

void read(nb::handle from, std::string& to) { to = nb::cast<std::string>(from); }
template <class T>
void read(nb::handle from, std::optional<T>& to) {
  if (!from.is_none()) to = nb::cast<T>(from);
}

Evidence evidence_of(nb::handle object) {
  Evidence evidence;
  names::for_each_field(
      evidence, [&](std::string_view name, auto& value) { read(object.attr(std::string(name).c_str()), value); });
  return evidence;
}

void bind_codes(nb::module_& m) {
  enumeration<ErrorCode>(m, "ErrorCode", "What went wrong: the code of an Error.");
  m.def(
      "name", [](ErrorCode code) { return name(code); }, "code"_a, "The name of a code as it is written in code.");
}

}  // namespace

nb::object error_object(const Error& error) {
  return nb::module_::import_("dymsum._errors")
      .attr("Error")(error.code, error.message, evidence_object(error.evidence));
}

void name_item(const nb::python_error& raised, std::size_t item) {
  const nb::handle error = raised.value();
  if (is_error(error) && error.attr("item").is_none()) nb::setattr(error, "item", nb::int_(item));
}

bool is_error(nb::handle object) {
  return nb::isinstance(object, nb::module_::import_("dymsum._errors").attr("Error"));
}

Error error_of(nb::handle object) {
  return {nb::cast<ErrorCode>(object.attr("code")), nb::cast<std::string>(object.attr("message")),
          evidence_of(object.attr("evidence"))};
}

void bind_errors(nb::module_& m) {
  bind_codes(m);
  m.def("_error_text", [](nb::handle error) { return error_of(error).to_string(); });
  nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    sleep_where_stopped(thrown);
    try {
      std::rethrow_exception(thrown);
    } catch (const ErrorRaised& raised) {
      const nb::object error = error_object(raised.error);
      if (raised.item) error.attr("item") = *raised.item;
      PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error.ptr())), error.ptr());
    }
  });
}

}  // namespace dymsum::python
