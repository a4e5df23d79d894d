// How long stages query whether to go on.
#pragma once

#include <cstddef>
#include <string_view>

#include "dymsum/progress.h"
#include "dymsum/result.h"

namespace dymsum {

/// Thrown where the caller's progress callback requests a stop; the public function makes ErrorCode::cancelled of it.
struct Cancelled {};

/// What a public function returns that was stopped.
inline Error cancelled() { return {ErrorCode::cancelled, "stopped on request", {}}; }

/// Tells the progress callback the stage and its fraction; does not return when that says to stop.
class Poll {
 public:
  explicit Poll(const Progress& progress) : progress_(progress) {}
  void stage(std::string_view name) {
    stage_ = name;
    (*this)(0);
  }
  std::string_view stage() const { return stage_; }
  void operator()(double fraction) const {
    if (progress_ && !progress_(stage_, fraction)) throw Cancelled{};
  }
  /// Polls once in 4096 rounds of a loop.
  void at(std::size_t round, std::size_t rounds) const {
    if (round % 4096 == 4095) (*this)(static_cast<double>(round) / static_cast<double>(rounds));
  }

  /// Polls where a round is a collision test.
  void at_test(std::size_t round, std::size_t rounds) const {
    if (round % 16 == 15) (*this)(static_cast<double>(round) / static_cast<double>(rounds));
  }

 private:
  const Progress& progress_;
  std::string_view stage_;
};

}  // namespace dymsum
