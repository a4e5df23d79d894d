// What Python raises while arguments are read and what has nothing to do with them.
#pragma once

#include <nanobind/nanobind.h>

#include <exception>
#include <utility>

namespace dymsum::python {

namespace nb = nanobind;

/// An exception on its way past functions that must not throw. Those that read arguments keep here what is not to be
/// taken for an argument of another type - KeyboardInterrupt, what else a signal's handler raises, an Error - and say
/// that they have read something; who asks for the value throws it. Where nobody asks, as another argument is refused,
/// Python raises it at one of its next instructions. With the GIL.
class Interruption {
 public:
  Interruption() = default;
  Interruption(Interruption&& other) noexcept : thrown_(std::exchange(other.thrown_, nullptr)) {}
  Interruption& operator=(Interruption&& other) noexcept {
    std::swap(thrown_, other.thrown_);
    return *this;
  }
  ~Interruption();

  /// In a handler: keeps the exception that is handled, but for one of Python's that tells of the value that was read
  /// (TypeError, ValueError and the like). Whether it was kept.
  bool keep() noexcept;
  /// Asks for signals. Whether the handler of one raised something, which is kept.
  bool keep_signal() noexcept;
  bool kept() const { return thrown_ != nullptr; }
  std::exception_ptr release() { return std::exchange(thrown_, nullptr); }
  /// Throws what is kept.
  void raise() {
    if (thrown_ != nullptr) std::rethrow_exception(release());
  }

 private:
  std::exception_ptr thrown_;
};

}  // namespace dymsum::python
