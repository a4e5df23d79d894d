// GMP as the witness: conversions between exact::Int and mpz_class that touch only the raw storage, and the integers on
// which fixed widths go wrong.
#pragma once

#include <gmpxx.h>

#include <cmath>
#include <cstdint>
#include <iostream>
#include <random>
#include <vector>

#include "exact/int.h"

namespace dymsum::exact {

// The two directions work on plain limbs, so that a test over many widths compiles them once.
inline mpz_class import_limbs(const std::uint64_t* limbs, int count) {
  mpz_class r;
  mpz_import(r.get_mpz_t(), count, -1, sizeof(std::uint64_t), 0, 0, limbs);
  if (static_cast<std::int64_t>(limbs[count - 1]) < 0) r -= mpz_class(1) << (64 * count);
  return r;
}

inline void export_limbs(const mpz_class& v, std::uint64_t* limbs, int count) {
  const mpz_class wrapped = v < 0 ? mpz_class(v + (mpz_class(1) << (64 * count))) : v;
  mpz_export(limbs, nullptr, -1, sizeof(std::uint64_t), 0, 0, wrapped.get_mpz_t());
}

template <int B>
mpz_class to_mpz(const Int<B>& v) {
  const auto limbs = to_limbs(v.raw());
  return import_limbs(limbs.w.data(), limb_count(B));
}

/// Requires |v| <= 2^B.
template <int B>
Int<B> from_mpz(const mpz_class& v) {
  Limbs<limb_count(B)> limbs;
  export_limbs(v, limbs.w.data(), limb_count(B));
  if constexpr (B <= 62) {
    return Int<B>::from_raw(static_cast<std::int64_t>(limbs.w[0]));
  } else if constexpr (B <= 126) {
    return Int<B>::from_raw(static_cast<i128>((static_cast<u128>(limbs.w[1]) << 64) | limbs.w[0]));
  } else {
    return Int<B>::from_raw(limbs);
  }
}

/// The generator of a test; its seed goes into the output, so that a failure can be replayed.
inline std::mt19937_64 seeded(std::uint64_t seed) {
  std::cout << "seed " << seed << '\n';
  return std::mt19937_64(seed);
}

/// An integer with |v| <= 2^bits: any bit length up to it, with long runs of equal bits now and then.
inline mpz_class random_integer(std::mt19937_64& random, int bits) {
  const int length = static_cast<int>(random() % (bits + 1));
  mpz_class v = 0;
  const unsigned style = random() % 4;
  for (int have = 0; have < length; have += 32) {
    std::uint32_t chunk = static_cast<std::uint32_t>(random());
    if (style == 0) chunk = random() % 2 ? 0xffffffffu : 0;
    v = (v << 32) + chunk;
  }
  v &= (mpz_class(1) << length) - 1;
  if (style == 1) v |= mpz_class(1) << length >> 1;
  return random() % 2 ? v : mpz_class(-v);
}

/// Corners of the width and of its limbs, then `more` random integers.
inline std::vector<mpz_class> hard_integers(std::mt19937_64& random, int bits, int more) {
  const mpz_class top = mpz_class(1) << bits;
  std::vector<mpz_class> values = {0, top, -top, 1, -1, top - 1, 1 - top, top / 2, -top / 2};
  for (int edge = 31; edge <= bits; edge += edge % 2 ? 1 : 31) {
    const mpz_class power = mpz_class(1) << edge;
    values.insert(values.end(), {power, -power, power - 1, 1 - power});
    if (edge < bits) values.insert(values.end(), {power + 1, -power - 1});
  }
  for (int i = 0; i < more; ++i) values.push_back(random_integer(random, bits));
  return values;
}

/// v, exactly.
inline mpq_class exact_mpq(double v) { return mpq_class(v); }

}  // namespace dymsum::exact
