#include "errors.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include <optional>
#include <string>

#include "leaving.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

template <class T>
nb::object or_none(const std::optional<T>& value) {
  return value ? nb::cast(*value) : nb::none();
}

nb::object evidence_object(const Evidence& e) {
  return nb::module_::import_("dymsum._errors")
      .attr("Evidence")(e.file, or_none(e.line), or_none(e.part), or_none(e.ring), or_none(e.vertex),
                        or_none(e.other_part), or_none(e.other_ring), or_none(e.other_vertex), or_none(e.face),
                        or_none(e.other_face), or_none(e.x), or_none(e.y), or_none(e.z));
}

template <class T>
void read(nb::handle from, const char* name, std::optional<T>& to) {
  const nb::object value = from.attr(name);
  if (!value.is_none()) to = nb::cast<T>(value);
}

Evidence evidence_of(nb::handle object) {
  Evidence e;
  e.file = nb::cast<std::string>(object.attr("file"));
  read(object, "line", e.line);
  read(object, "part", e.part);
  read(object, "ring", e.ring);
  read(object, "vertex", e.vertex);
  read(object, "other_part", e.other_part);
  read(object, "other_ring", e.other_ring);
  read(object, "other_vertex", e.other_vertex);
  read(object, "face", e.face);
  read(object, "other_face", e.other_face);
  read(object, "x", e.x);
  read(object, "y", e.y);
  read(object, "z", e.z);
  return e;
}

void bind_codes(nb::module_& m) {
  nb::enum_<ErrorCode> codes(m, "ErrorCode", "What went wrong: the code of an Error.");
  for (int k = 0; k <= static_cast<int>(ErrorCode::out_of_memory); ++k) {
    const auto code = static_cast<ErrorCode>(k);
    codes.value(std::string(name(code)).c_str(), code);
  }
  m.def("name", nb::overload_cast<ErrorCode>(&name), "code"_a, "The name of a code as it is written in code.");
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
