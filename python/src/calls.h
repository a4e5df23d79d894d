// Calls that take long: without the GIL, with progress and interrupts.
#pragma once

#include <nanobind/nanobind.h>

#include <memory>
#include <utility>

#include "dymsum/progress.h"
#include "errors.h"
#include "leaving.h"

namespace dymsum::python {

/// A Python callable as the library's Progress. It may be copied and destroyed without the GIL. None: an empty one.
Progress progress_of(nb::object callable);
/// The callable again, or None.
nb::object callable_of(const Progress& progress);
/// The same Progress with a reference to the callable of its own. With the GIL.
inline Progress own_progress(const Progress& of) { return progress_of(callable_of(of)); }
/// Does the work of tp_traverse for an object that has `copies` copies of a Progress: visits the callable where nobody
/// else has one, for the reference to it is one and shared by all copies.
int visit_callable(const Progress& progress, long copies, visitproc visit, void* arg);

/// Slots of a class with a member `progress`, so that the garbage collector sees the callable.
template <class T>
struct ProgressSlots {
  static int traverse(PyObject* self, visitproc visit, void* arg) {
    Py_VISIT(Py_TYPE(self));
    return nb::inst_ready(self) ? visit_callable(nb::inst_ptr<T>(self)->progress, 1, visit, arg) : 0;
  }
  static int clear(PyObject* self) {
    if (nb::inst_ready(self)) nb::inst_ptr<T>(self)->progress = {};
    return 0;
  }
  static inline const PyType_Slot slots[] = {{Py_tp_traverse, reinterpret_cast<void*>(&traverse)},
                                             {Py_tp_clear, reinterpret_cast<void*>(&clear)},
                                             {0, nullptr}};
};

/// What one call hands to the library as Progress: it asks Python for signals (KeyboardInterrupt) on the thread that
/// called, and the user's callable, both at most fifty times a second but for the first time. An exception of either
/// stops the call and is raised by take(). Objects whose state keeps the Progress keep their Watch.
class Watch {
 public:
  explicit Watch(const Progress& user);
  ~Watch();
  Watch(Watch&&) noexcept;
  Watch& operator=(Watch&&) noexcept;

  /// A call begins, on this thread.
  void begin();
  Progress progress() const;
  /// The user's progress is queried no more.
  void forget();
  /// Raises what stopped the call, if anything did. With the GIL.
  void raise() const;
  template <class T>
  T take(Result<T>&& result) const {
    raise();
    return python::take(std::move(result));
  }

 private:
  struct State;
  std::shared_ptr<State> state_;
};

/// Slots of a class with `options`, which have a progress, and a `watch` of it: the garbage collector sees the
/// callable.
template <class Self>
struct WatchedSlots {
  static int traverse(PyObject* self, visitproc visit, void* arg) {
    Py_VISIT(Py_TYPE(self));
    return nb::inst_ready(self) ? visit_callable(nb::inst_ptr<Self>(self)->options.progress, 2, visit, arg) : 0;
  }
  static int clear(PyObject* self) {
    if (!nb::inst_ready(self)) return 0;
    nb::inst_ptr<Self>(self)->options.progress = {};
    nb::inst_ptr<Self>(self)->watch.forget();
    return 0;
  }
  static inline const PyType_Slot slots[] = {{Py_tp_traverse, reinterpret_cast<void*>(&traverse)},
                                             {Py_tp_clear, reinterpret_cast<void*>(&clear)},
                                             {0, nullptr}};
};

/// work() without the GIL.
template <class Work>
auto without_gil(Work&& work) {
  const WithoutGil free;
  return work();
}

/// The value of work(progress), a Result, without the GIL.
template <class Work>
auto run(const Progress& user, Work&& work) {
  Watch watch(user);
  auto result = without_gil([&] { return work(watch.progress()); });
  return watch.take(std::move(result));
}

/// The same with the progress of `options`: work(options).
template <class Options, class Work>
auto run_with(const Options& options, Work&& work) {
  return run(options.progress, [&](Progress progress) {
    Options own = options;
    own.progress = std::move(progress);
    return work(own);
  });
}

}  // namespace dymsum::python

namespace nanobind::detail {

template <>
struct type_caster<dymsum::Progress> {
  NB_TYPE_CASTER(dymsum::Progress, const_name("collections.abc.Callable[[str, float], bool | None] | None"))
  bool from_python(handle src, uint32_t, cleanup_list*) noexcept {
    if (!src.is_none() && !PyCallable_Check(src.ptr())) return false;
    value = dymsum::python::progress_of(borrow(src));
    return true;
  }
  static handle from_cpp(const dymsum::Progress& progress, rv_policy, cleanup_list*) noexcept {
    return dymsum::python::callable_of(progress).release();
  }
};

}  // namespace nanobind::detail
