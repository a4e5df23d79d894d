// What stands in the cells of the tables of convex sums.
#pragma once

#include <string>

#include "convex/measure.h"
#include "page.h"

namespace dymsum::bench {

inline std::string text(std::uint64_t n) { return std::to_string(n); }
inline std::string us(double v) { return v > 0 ? fixed(v, v < 10 ? 2 : v < 100 ? 1 : 0) : "-"; }
inline std::string ratio(double a, double b) { return bench::ratio(a, b, 1); }
inline std::string pair_of(const MotionRow& r) { return r.p + " + " + r.q; }
inline std::string compared(const MotionRow& r) { return text(r.compared) + ", " + text(r.different); }

}  // namespace dymsum::bench
