// Functions and classes of Python's modules.
#pragma once

#include <nanobind/nanobind.h>

namespace dymsum::python {

/// An attribute of a module, looked up when first asked for; it stays for ever. With the GIL. It is no static object of
/// the function that asks: importing lets other threads have the GIL, and one of them would wait for that object's
/// guard without giving the GIL back.
class Imported {
 public:
  constexpr Imported(const char* module, const char* name) : module_(module), name_(name) {}
  nanobind::handle get() {
    if (object_ == nullptr) {
      nanobind::object found = nanobind::module_::import_(module_).attr(name_);
      if (object_ == nullptr) object_ = found.release().ptr();
    }
    return object_;
  }

 private:
  const char *module_, *name_;
  PyObject* object_ = nullptr;
};

}  // namespace dymsum::python
