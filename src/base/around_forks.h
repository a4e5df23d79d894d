// Threads of the library's own and fork(): a child has only the thread that forked. What has such a thread brings it to
// rest while the process forks, so that the child finds nothing half done and no lock held.
#pragma once

namespace dymsum::base {

/// Between watch() and forget() the three functions are called around every fork(), on the thread that forks; never at
/// the same time as either. Where there is no fork() nothing is called.
class AroundForks {
 public:
  virtual void before_fork() = 0;
  virtual void after_fork_in_parent() = 0;
  /// Its thread is not there; nobody else's is. It is forgotten: forget() is not called.
  virtual void after_fork_in_child() = 0;

 protected:
  ~AroundForks() = default;
  /// Throws std::system_error, std::bad_alloc.
  void watch();
  void forget();
};

}  // namespace dymsum::base
