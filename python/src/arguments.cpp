#include "arguments.h"

#include "leaving.h"
#include "values.h"

namespace dymsum::python {
namespace {

/// A function of a module; it stays for ever.
nb::handle function_of(const char* module, const char* name) {
  return nb::object(nb::module_::import_(module).attr(name)).release();
}

nb::handle converter(std::string_view name) {
  static const nb::handle kKind = function_of("dymsum._convert", "kind");
  static const nb::handle kRegion = function_of("dymsum._convert", "region");
  static const nb::handle kMesh = function_of("dymsum._convert", "mesh");
  static const nb::handle kRegionData = function_of("dymsum._convert", "region_data");
  static const nb::handle kMeshData = function_of("dymsum._convert", "mesh_data");
  if (name == "region_data") return kRegionData;
  if (name == "mesh_data") return kMeshData;
  return name == "kind" ? kKind : name == "region" ? kRegion : kMesh;
}

}  // namespace

bool is_like(nb::handle object, std::string_view kind) noexcept {
  const Inside call;
  try {
    return nb::cast<std::string_view>(converter("kind")(object)) == kind;
  } catch (std::exception&) {
    return false;
  }
}

nb::object converted(nb::handle object, const char* maker) {
  const Inside call;
  return converter(maker)(object);
}

nb::object contiguous(nb::handle object) {
  static const nb::handle kFunction = function_of("dymsum._convert", "doubles");
  const Inside call;
  return kFunction(object);
}

bool is_masked(nb::handle object) {
  static const nb::handle kMasked = function_of("numpy.ma", "MaskedArray");
  return nb::isinstance(object, kMasked);
}

}  // namespace dymsum::python

namespace nanobind::detail {

bool type_caster<dymsum::python::ScaleArgument>::from_python(handle src, uint32_t, cleanup_list*) noexcept {
  if (isinstance<dymsum::Scale>(src)) {
    value.given = *inst_ptr<dymsum::Scale>(src);
    return true;
  }
  if (PyFloat_Check(src.ptr())) {
    value.given = dymsum::Scale::of(PyFloat_AS_DOUBLE(src.ptr()));
    return true;
  }
  dymsum::Rational number;
  if (!dymsum::python::read_rational(src, number)) return false;
  value.given = dymsum::Scale::of(number);
  return true;
}

}  // namespace nanobind::detail
