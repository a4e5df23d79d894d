// How much time has passed.
#pragma once

#include <chrono>

namespace dymsum {

class Stopwatch {
 public:
  /// In milliseconds, since it was made or the last lap().
  double ms() const { return in_ms(Clock::now() - begin_); }
  /// The same, and begins anew.
  double lap() {
    const Clock::time_point now = Clock::now();
    const double ms = in_ms(now - begin_);
    begin_ = now;
    return ms;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double in_ms(Clock::duration d) { return std::chrono::duration<double, std::milli>(d).count(); }
  Clock::time_point begin_ = Clock::now();
};

}  // namespace dymsum
