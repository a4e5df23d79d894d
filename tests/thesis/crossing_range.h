// The range of scales at which two segments cross, in doubles that know when they do not know.
#pragma once

#include <algorithm>
#include <cmath>

#include "planar/motion/operand_pair.h"

namespace dymsum::planar {

/// An intersection of half-lines a + b s > 0 with 0 < s: empty, unsure, or low < s < high, whose finite ends are roots
/// up to roundings. `unsure` wins wherever a and b, known up to ea and eb, could tell another story.
// A root -a / b errs relatively by at most (x + y) / (1 - y), x = ea / |a|, y = eb / |b|, upwards and by x + y
// downwards. With the slack s = 2 (x + y) + kRoot <= kMostSlack that is 1.1 s / 2: true ends are apart, in the order of
// the computed ones, where those are a factor of 1 + 4 s apart.
class CrossingRange {
 public:
  double low = 0, high = INFINITY;
  bool empty = false, unsure = false;

  void meet(double a, double b, double ea, double eb) {
    if (empty || unsure) return;
    const int sa = a > ea ? 1 : a < -ea ? -1 : 0, sb = b > eb ? 1 : b < -eb ? -1 : 0;
    if (sa == 0 || sb == 0) {
      unsure = true;
    } else if (sa < 0 && sb < 0) {
      empty = true;
    } else if (sa != sb) {
      const double root = -a / b;
      double& end = sb > 0 ? low : high;
      // Which of two close roots is the tighter one does not matter; whether the range is empty does.
      end = sb > 0 ? std::max(low, root) : std::min(high, root);
      slack_ = std::max(slack_, 2 * (ea / std::abs(a) + eb / std::abs(b)) + kRoot);
    }
    if (slack_ > kMostSlack) unsure = true;
    else if (low > high * (1 + kApart * slack_)) empty = true;
  }
  void settle() {
    if (!empty && !(low < high * (1 - kApart * slack_))) unsure = true;
  }

 private:
  static constexpr double kMostSlack = 0.125, kApart = 4;
  double slack_ = 0;
};

/// Of either coefficient of a side, times |edge|_1 and its operand's extent: coordinates 2 and their difference, the
/// edge vector, the product and the difference.
inline constexpr double kSideCoefficient = exact::rounding_bound(6, 8);

}  // namespace dymsum::planar
