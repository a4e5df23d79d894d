// What becomes of other threads when the interpreter ends. Python stops each where it next requests the GIL, and as C++
// on the way out of that ends the process, no thread may ask any more.
#pragma once

#include <nanobind/nanobind.h>

#include <cstddef>
#include <exception>

namespace dymsum::python {

/// Whether the interpreter ends and this thread is not the one that ends it.
bool leaving();

/// Between these a thread is inside the library: the end of the interpreter tells it to stop and waits for it, two
/// seconds at most. With the GIL; one that is to enter when the interpreter ends sleeps until the process does.
class Inside {
 public:
  Inside();
  ~Inside();
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;
};

/// What the callable returns, null with an exception set. Where Python stops the thread in the middle, as the
/// interpreter has ended, the thread sleeps instead: nothing behind it may run any more.
PyObject* call_python(PyObject* callable, PyObject* const* arguments, std::size_t count);

/// What a translator of exceptions gets where Python stops a thread in the middle of anything else that a call asks of
/// it: no exception at all. As nanobind has caught what cannot be caught, and goes on without the GIL, the thread
/// sleeps.
void sleep_where_stopped(const std::exception_ptr& thrown);

/// Lets go of the GIL, from inside, and takes it again; where the interpreter ends, it sleeps instead.
class WithoutGil {
 public:
  WithoutGil();
  ~WithoutGil();
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

 private:
  Inside inside_;
  PyThreadState* state_;
};

}  // namespace dymsum::python
