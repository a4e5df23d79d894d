#include "arguments.h"

#include "imported.h"
#include "leaving.h"
#include "values.h"

namespace dymsum::python {
namespace {

constinit Imported g_kind{"dymsum._convert", "kind"}, g_region{"dymsum._convert", "region"},
    g_mesh{"dymsum._convert", "mesh"}, g_region_data{"dymsum._convert", "region_data"},
    g_mesh_data{"dymsum._convert", "mesh_data"}, g_doubles{"dymsum._convert", "doubles"},
    g_masked{"numpy.ma", "MaskedArray"};

nb::handle converter(std::string_view name) {
  if (name == "region_data") return g_region_data.get();
  if (name == "mesh_data") return g_mesh_data.get();
  return name == "kind" ? g_kind.get() : name == "region" ? g_region.get() : g_mesh.get();
}

/// function(object), from inside.
nb::object called(nb::handle function, nb::handle object) {
  const Inside call;
  PyObject* const argument = object.ptr();
  nb::object made = nb::steal(call_python(function.ptr(), &argument, 1));
  if (!made) throw nb::python_error();
  return made;
}

}  // namespace

bool is_like(nb::handle object, std::string_view kind) {
  return nb::cast<std::string_view>(called(converter("kind"), object)) == kind;
}

nb::object converted(nb::handle object, const char* maker) { return called(converter(maker), object); }

nb::object contiguous(nb::handle object) { return called(g_doubles.get(), object); }

bool tells_of_numbers(const nb::python_error& error) {
  return error.matches(PyExc_TypeError) || error.matches(PyExc_ValueError) || is_error(error.value());
}

bool is_masked(nb::handle object) { return nb::isinstance(object, g_masked.get()); }

}  // namespace dymsum::python

namespace nanobind::detail {

bool type_caster<dymsum::python::ScaleArgument>::from_python(handle src, uint32_t, cleanup_list*) {
  if (isinstance<dymsum::Scale>(src)) {
    value.given = *inst_ptr<dymsum::Scale>(src);
    return true;
  }
  if (PyFloat_Check(src.ptr())) {
    value.given = dymsum::Scale::of(PyFloat_AS_DOUBLE(src.ptr()));
    return true;
  }
  dymsum::Result<dymsum::Rational> number = dymsum::Rational();
  if (!dymsum::python::read_rational(src, number)) return false;
  value.given = number ? dymsum::Scale::of(*number) : number.error();
  return true;
}

}  // namespace nanobind::detail
