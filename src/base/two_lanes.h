// Two doubles at a time: x and y of a point, or what is asked of the first of two segments against the second one and
// of the second against the first. The same operations as on doubles, one rounding each.
#pragma once

#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace dymsum {

using Two = double __attribute__((vector_size(16)));
/// What comparing gives: -1 or 0 in each.
using TwoDecided = std::int64_t __attribute__((vector_size(16)));

inline Two both(double v) { return Two{v, v}; }
inline Two firsts(Two a, Two b) { return __builtin_shufflevector(a, b, 0, 2); }
inline Two seconds(Two a, Two b) { return __builtin_shufflevector(a, b, 1, 3); }
inline Two exchanged(Two a) { return __builtin_shufflevector(a, a, 1, 0); }
inline Two least(Two a, Two b) { return a < b ? a : b; }
inline Two most(Two a, Two b) { return a > b ? a : b; }
inline Two magnitude(Two a) { return most(a, -a); }

inline bool any(TwoDecided decided) {
#ifdef __SSE2__
  return _mm_movemask_pd(reinterpret_cast<__m128d>(decided)) != 0;
#elif defined(__wasm_simd128__)
  return wasm_v128_any_true(reinterpret_cast<v128_t>(decided));
#else
  return (decided[0] | decided[1]) != 0;
#endif
}

/// Whether it holds in both lanes; false where something is not a number.
inline bool every(TwoDecided decided) {
#ifdef __SSE2__
  return _mm_movemask_pd(reinterpret_cast<__m128d>(decided)) == 3;
#elif defined(__wasm_simd128__)
  return wasm_i64x2_all_true(reinterpret_cast<v128_t>(decided));
#else
  return (decided[0] & decided[1]) != 0;
#endif
}

}  // namespace dymsum
