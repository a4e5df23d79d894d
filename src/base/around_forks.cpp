#include "base/around_forks.h"

#include <algorithm>
#include <mutex>
#include <system_error>
#include <vector>

#if (defined(__unix__) || defined(__APPLE__)) && !defined(__EMSCRIPTEN__)
#include <pthread.h>
#define DYMSUM_HAS_FORK 1
#endif

namespace dymsum::base {
namespace {

/// It outlives static objects. The mutex is held from before a fork until after it.
struct Watched {
  std::mutex mutex;
  std::vector<AroundForks*> all;
};
Watched& watched() {
  static Watched& one = *new Watched;
  return one;
}

#ifdef DYMSUM_HAS_FORK

void before() {
  watched().mutex.lock();
  for (AroundForks* one : watched().all) one->before_fork();
}

void in_parent() {
  for (AroundForks* one : watched().all) one->after_fork_in_parent();
  watched().mutex.unlock();
}

void in_child() {
  for (AroundForks* one : watched().all) one->after_fork_in_child();
  watched().all.clear();
  watched().mutex.unlock();
}

void query_to_be_called() {
  static const int refused = pthread_atfork(before, in_parent, in_child);
  if (refused != 0) throw std::system_error(refused, std::generic_category());
}

#else

void query_to_be_called() {}

#endif

}  // namespace

void AroundForks::watch() {
  query_to_be_called();
  const std::lock_guard lock(watched().mutex);
  watched().all.push_back(this);
}

void AroundForks::forget() {
  const std::lock_guard lock(watched().mutex);
  std::erase(watched().all, this);
}

}  // namespace dymsum::base
