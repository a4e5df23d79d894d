// What a Rational holds, for code that computes with it.
#pragma once

#include <memory>
#include <utility>

#include "dymsum/rational.h"
#include "exact/big.h"

namespace dymsum::exact {

/// Lowest terms, den > 0.
struct RationalParts {
  BigInteger num = 0, den = 1;
};

struct RationalAccess {
  static const RationalParts& parts(const Rational& r) {
    static const RationalParts zero;
    return r.parts_ ? *r.parts_ : zero;
  }
  /// Requires: lowest terms, den > 0.
  static Rational make(BigInteger num, BigInteger den) {
    Rational r;
    r.parts_ = std::make_shared<const RationalParts>(RationalParts{std::move(num), std::move(den)});
    return r;
  }
};

}  // namespace dymsum::exact
