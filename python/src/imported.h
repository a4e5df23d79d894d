// Functions and classes of Python's modules.
#pragma once

#include <nanobind/nanobind.h>

namespace dymsum::python {

namespace nb = nanobind;

/// A new reference, or the exception that is set.
inline nb::object checked(PyObject* owned) {
  if (!owned) throw nb::python_error();
  return nb::steal(owned);
}

/// An attribute of a module, looked up when first asked for; it stays for ever. With the GIL. It is no static object of
/// the function that asks: importing lets other threads have the GIL, and one of them would wait for that object's
/// guard without giving the GIL back.
class Imported {
 public:
  constexpr Imported(const char* module, const char* name) : module_(module), name_(name) {}
  nb::handle get() {
    if (object_ == nullptr) {
      nb::object found = nb::module_::import_(module_).attr(name_);
      if (object_ == nullptr) object_ = found.release().ptr();
    }
    return object_;
  }

 private:
  const char *module_, *name_;
  PyObject* object_ = nullptr;
};

}  // namespace dymsum::python
