#include "interruption.h"

#include "errors.h"
#include "imported.h"

namespace dymsum::python {
namespace {

constinit Imported g_error{"dymsum._errors", "Error"};

bool tells_of_value(const nb::python_error& error) {
  for (PyObject* type : {PyExc_TypeError, PyExc_ValueError, PyExc_ArithmeticError, PyExc_LookupError,
                         PyExc_AttributeError, PyExc_BufferError}) {
    if (error.matches(type)) return true;
  }
  return error.matches(g_error.get());
}

void raise_soon(const nb::python_error& error) noexcept {
  PyThreadState_SetAsyncExc(PyThread_get_thread_ident(), error.type().ptr());
}

}  // namespace

bool Interruption::keep() noexcept {
  try {
    throw;
  } catch (const nb::python_error& error) {
    try {
      if (tells_of_value(error)) return false;
    } catch (const nb::python_error&) {  // of an import that is interrupted itself
    }
    thrown_ = std::current_exception();
  } catch (const ErrorRaised&) {
    thrown_ = std::current_exception();
  } catch (const std::exception&) {
    return false;
  }
  return true;
}

bool Interruption::keep_signal() noexcept {
  if (PyErr_CheckSignals() == 0) return false;
  thrown_ = std::make_exception_ptr(nb::python_error());
  return true;
}

Interruption::~Interruption() {
  if (thrown_ == nullptr) return;
  try {
    std::rethrow_exception(std::exchange(thrown_, nullptr));
  } catch (const nb::python_error& error) {
    raise_soon(error);
  } catch (const std::exception&) {
  }
}

}  // namespace dymsum::python
