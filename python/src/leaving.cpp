#include "leaving.h"

#include <cxxabi.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "bind.h"

namespace dymsum::python {
namespace {

constexpr auto kLongest = std::chrono::seconds(2);

/// It outlives static objects, as threads do.
struct Leaving {
  std::atomic<bool> begun = false;
  std::thread::id by;
  std::mutex mutex;
  std::condition_variable fewer;
  int inside = 0;  // calls, of all threads but the one that leaves
};
Leaving& state() {
  static Leaving& one = *new Leaving;
  return one;
}
thread_local int t_depth = 0;  // calls of this thread

void count(int by) {
  Leaving& s = state();
  const std::lock_guard held(s.mutex);
  s.inside += by;
  t_depth += by;
  if (s.begun) s.fewer.notify_all();
}

[[noreturn]] void sleep_for_ever() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

/// Called without the GIL.
[[noreturn]] void sleep_until_the_end() {
  count(-t_depth);
  sleep_for_ever();
}

void leave() {
  Leaving& s = state();
  const int own = t_depth;
  s.by = std::this_thread::get_id();
  s.begun = true;
  {
    const nb::gil_scoped_release free;
    std::unique_lock held(s.mutex);
    s.fewer.wait_for(held, kLongest, [&] { return s.inside <= own; });
  }
  // What other threads hold when they are stopped is never given back.
  if (nb::cast<int>(nb::module_::import_("threading").attr("active_count")()) > 1) nb::set_leak_warnings(false);
}

/// No thread but this one is in a child that was forked.
void forked() {
  Leaving& s = state();
  new (&s.mutex) std::mutex;
  new (&s.fewer) std::condition_variable;
  s.inside = t_depth;
}

}  // namespace

bool leaving() { return state().begun && state().by != std::this_thread::get_id(); }

Inside::Inside() {
  if (leaving()) {
    PyEval_SaveThread();
    sleep_until_the_end();
  }
  count(1);
}

Inside::~Inside() { count(-1); }

// No frame between here and Python's has anything to destroy.
PyObject* call_python(PyObject* callable, PyObject* const* arguments, std::size_t count) {
#ifdef __GLIBCXX__
  try {
    return PyObject_Vectorcall(callable, arguments, count, nullptr);
  } catch (const abi::__forced_unwind&) {  // Python before 3.14 ends threads so
    sleep_for_ever();
  }
#else
  return PyObject_Vectorcall(callable, arguments, count, nullptr);
#endif
}

void sleep_where_stopped(const std::exception_ptr& thrown) {
  if (!thrown) sleep_for_ever();
}

WithoutGil::WithoutGil() : state_(PyEval_SaveThread()) {}

WithoutGil::~WithoutGil() {
  if (leaving()) sleep_until_the_end();
  PyEval_RestoreThread(state_);
}

void bind_leaving(nb::module_& m) {
  m.def("_leave", &leave);
  m.def("_forked", &forked);
  nb::module_::import_("atexit").attr("register")(m.attr("_leave"));
  const nb::module_ os = nb::module_::import_("os");
  if (nb::hasattr(os, "register_at_fork")) os.attr("register_at_fork")(nb::arg("after_in_child") = m.attr("_forked"));
}

}  // namespace dymsum::python
