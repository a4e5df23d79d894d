// The ladder that the sign of an expression climbs until a rung determines it. Every room has some of these rungs, in
// this order and by these names; a rung that does not determine the sign says so, and never guesses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace dymsum::exact {

enum class Rung : std::uint8_t {
  doubles,       ///< doubles with a proved bound of their error, or intervals of doubles
  double_pairs,  ///< the same with some thirty digits (FineInterval)
  integers,      ///< integers of a proved width, without allocation (Int)
  big,           ///< numbers of any size (Big), and algebraic numbers over them
};

struct SignAnswer {
  int sign = 0;  ///< -1, 0, 1
  Rung rung = Rung::doubles;
};

/// How many signs each rung has determined.
class RungCounts {
 public:
  RungCounts() = default;
  constexpr RungCounts(std::uint64_t doubles, std::uint64_t double_pairs, std::uint64_t integers, std::uint64_t big)
      : decided_{doubles, double_pairs, integers, big} {}

  void count(Rung rung) { ++decided_[static_cast<std::size_t>(rung)]; }
  int add(SignAnswer answer) {
    count(answer.rung);
    return answer.sign;
  }
  std::uint64_t at(Rung rung) const { return decided_[static_cast<std::size_t>(rung)]; }
  /// Determined by rungs that round.
  std::uint64_t filtered() const { return at(Rung::doubles) + at(Rung::double_pairs); }
  /// Determined by exact numbers.
  std::uint64_t exact() const { return at(Rung::integers) + at(Rung::big); }

  RungCounts& operator+=(const RungCounts& other) {
    for (std::size_t i = 0; i < decided_.size(); ++i) decided_[i] += other.decided_[i];
    return *this;
  }
  friend bool operator==(const RungCounts&, const RungCounts&) = default;

 private:
  std::array<std::uint64_t, 4> decided_{};
};

}  // namespace dymsum::exact
