// What files hold: text, or bytes of a format that is none.
#pragma once

#include <nanobind/nanobind.h>

#include <string>
#include <utility>

#include "dymsum/region_io.h"

namespace dymsum::python {

struct FileContent {
  std::string bytes;
  bool text = true;
};

inline FileContent content_of(std::string bytes, RegionFormat format) {
  return {std::move(bytes), format != RegionFormat::gpkg};
}

}  // namespace dymsum::python

namespace nanobind::detail {

template <>
struct type_caster<dymsum::python::FileContent> {
  NB_TYPE_CASTER(dymsum::python::FileContent, const_name("str | bytes"))
  bool from_python(handle src, uint32_t, cleanup_list*) {
    value.text = PyUnicode_Check(src.ptr());
    if (!value.text && !PyBytes_Check(src.ptr())) return false;
    Py_ssize_t size = value.text ? 0 : PyBytes_GET_SIZE(src.ptr());
    const char* const data = value.text ? PyUnicode_AsUTF8AndSize(src.ptr(), &size) : PyBytes_AS_STRING(src.ptr());
    if (data == nullptr) PyErr_Clear();  // half of a pair of surrogates
    else value.bytes.assign(data, static_cast<std::size_t>(size));
    return data != nullptr;
  }
  static handle from_cpp(const dymsum::python::FileContent& of, rv_policy, cleanup_list*) noexcept {
    const auto size = static_cast<Py_ssize_t>(of.bytes.size());
    return of.text ? PyUnicode_FromStringAndSize(of.bytes.data(), size)
                   : PyBytes_FromStringAndSize(of.bytes.data(), size);
  }
};

}  // namespace nanobind::detail
