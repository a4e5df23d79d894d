#include "calls.h"

#include <atomic>
#include <chrono>
#include <optional>
#include <string_view>

namespace dymsum::python {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kBetweenQuestions = std::chrono::milliseconds(20);

/// Owns a callable; the last copy may go away on any thread.
struct Callable {
  explicit Callable(nb::object what) : object(std::move(what)) {}
  ~Callable() {
    if (leaving()) {
      object.release();  // nobody may request the GIL any more
      return;
    }
    const nb::gil_scoped_acquire held;
    object.reset();
  }
  Callable(const Callable&) = delete;
  Callable& operator=(const Callable&) = delete;
  nb::object object;
};

struct PythonProgress {
  std::shared_ptr<Callable> callable;
  /// With the GIL. What the callable returns means stop where it is False; None goes on.
  bool ask(std::string_view stage, double fraction) const {
    const nb::str name(stage.data(), stage.size());
    const nb::float_ value(fraction);
    PyObject* const arguments[] = {name.ptr(), value.ptr()};
    const nb::object answer = nb::steal(call_python(callable->object.ptr(), arguments, 2));
    if (!answer) throw nb::python_error();
    return answer.is_none() || nb::cast<bool>(nb::bool_(answer));
  }
  bool operator()(std::string_view stage, double fraction) const {
    const nb::gil_scoped_acquire held;
    return ask(stage, fraction);
  }
};

}  // namespace

Progress progress_of(nb::object callable) {
  if (callable.is_none()) return {};
  return PythonProgress{std::make_shared<Callable>(std::move(callable))};
}

nb::object callable_of(const Progress& progress) {
  const auto* python = progress.target<PythonProgress>();
  return python ? nb::object(python->callable->object) : nb::none();
}

int visit_callable(const Progress& progress, long copies, visitproc visit, void* arg) {
  const auto* python = progress.target<PythonProgress>();
  if (python && python->callable.use_count() == copies) Py_VISIT(python->callable->object.ptr());
  return 0;
}

struct Watch::State {
  Progress user;
  std::atomic<Clock::rep> next = 0;  // nothing is asked before
  std::atomic<bool> stopped = false;
  std::optional<nb::python_error> exception;  // with the GIL

  bool ask(std::string_view stage, double fraction) {
    const Clock::rep now = Clock::now().time_since_epoch().count();
    if (stopped || leaving()) return false;
    Clock::rep due = next;
    if (now < due || !next.compare_exchange_strong(due, now + Clock::duration(kBetweenQuestions).count())) return true;
    const nb::gil_scoped_acquire held;
    try {
      if (PyErr_CheckSignals() != 0) throw nb::python_error();
      if (const auto* python = user.target<PythonProgress>(); python && !python->ask(stage, fraction)) stopped = true;
    } catch (nb::python_error& error) {
      if (!exception) exception.emplace(std::move(error));
      stopped = true;
    }
    return !stopped;
  }
};

Watch::Watch(const Progress& user) : state_(std::make_shared<State>()) {
  state_->user = user;
  begin();
}
Watch::~Watch() = default;
Watch::Watch(Watch&&) noexcept = default;
Watch& Watch::operator=(Watch&&) noexcept = default;

void Watch::begin() {
  state_->stopped = false;
  state_->exception.reset();
  // The user is asked at once, signals after a while: most calls are done by then.
  state_->next = state_->user ? 0 : (Clock::now() + kBetweenQuestions).time_since_epoch().count();
}

Progress Watch::progress() const {
  return [state = state_](std::string_view stage, double fraction) { return state->ask(stage, fraction); };
}

void Watch::forget() { state_->user = {}; }

void Watch::raise() const {
  if (!state_->exception) return;
  nb::python_error error = std::move(*state_->exception);
  state_->exception.reset();
  throw error;
}

}  // namespace dymsum::python
