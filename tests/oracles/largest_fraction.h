// How much of a bound errors use: never more than all, and not next to nothing.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "oracles/digits.h"

namespace dymsum::oracles {

struct LargestFraction {
  double most = 0;
  void add(const Digits& error, double bound) { most = std::max(most, static_cast<double>(abs(error)) / bound); }
  void expect_bounded(double some) const {
    EXPECT_LE(most, 1);
    EXPECT_GT(most, some);
  }
};

}  // namespace dymsum::oracles
