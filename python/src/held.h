// Objects that move: one call at a time, although the GIL is free while it runs.
#pragma once

#include <nanobind/nanobind.h>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <utility>

#include "leaving.h"

namespace dymsum::python {

/// A T that is changed without the GIL, with the Python objects it was made of. A second thread that calls meanwhile is
/// refused with RuntimeError.
template <class T>
class Held {
 public:
  explicit Held(T value) : value_(std::make_unique<T>(std::move(value))) {}
  ~Held() {
    // In the child of a fork, where the thread that changes it is not: what it left half done is left.
    if (busy_.test_and_set()) static_cast<void>(value_.release());
    const WithoutGil free;  // its own threads may be asking for the GIL
    value_.reset();
  }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

  /// work(T&), as the only one.
  template <class Work>
  decltype(auto) alone(Work&& work) {
    const Claim claim(busy_);
    return work(*value_);
  }

 private:
  struct Claim {
    explicit Claim(std::atomic_flag& flag) : busy(flag) {
      if (busy.test_and_set()) throw std::runtime_error("another thread is using this object");
    }
    ~Claim() { busy.clear(); }
    std::atomic_flag& busy;
  };
  std::unique_ptr<T> value_;
  std::atomic_flag busy_;
};

}  // namespace dymsum::python
