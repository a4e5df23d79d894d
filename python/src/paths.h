// Paths of files: text, or what stands for one (pathlib.Path and all that has __fspath__).
#pragma once

#include <nanobind/nanobind.h>

#include <string>

#include "imported.h"

namespace dymsum::python {

struct PathArgument {
  std::string text;
};

}  // namespace dymsum::python

namespace nanobind::detail {

template <>
struct type_caster<dymsum::python::PathArgument> {
  NB_TYPE_CASTER(dymsum::python::PathArgument, const_name("str | os.PathLike[str]"))
  bool from_python(handle src, uint32_t, cleanup_list*) {
    using dymsum::python::checked;
    if (!PyUnicode_Check(src.ptr()) && !hasattr(src, "__fspath__")) return false;
    const object path = checked(PyOS_FSPath(src.ptr()));
    const object bytes = PyBytes_Check(path.ptr()) ? path : checked(PyUnicode_EncodeFSDefault(path.ptr()));
    value.text.assign(PyBytes_AS_STRING(bytes.ptr()), static_cast<std::size_t>(PyBytes_GET_SIZE(bytes.ptr())));
    return true;
  }
};

}  // namespace nanobind::detail
