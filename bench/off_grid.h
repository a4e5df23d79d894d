// The table "Off the grid" of a benchmark: what the coordinates of the same shapes cost.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "coordinate_kinds.h"

namespace dymsum::bench {

/// An answer to shapes of one kind, compared as the suite compares its own.
struct Compared {
  std::string verdict;  ///< "equal", or what differs
  bool wrong = false;
  double rival_ms = 0;  ///< of the opponent, on the same shapes; 0: not asked
};

/// What is measured of an input whose shapes are of one kind.
struct OffGridWork {
  std::function<std::size_t()> run;   ///< timed; the size of the result in the plan's units
  std::function<Compared()> compare;  ///< once, not timed
};

struct OffGridCase {
  std::string name;
  /// An error where rounding spoils a shape, or the library refuses it.
  std::function<Result<OffGridWork>(Coordinates)> prepare;
};

/// Of two shapes; `rounded` makes them of a kind, `work` (shapes to OffGridWork) is what is measured.
template <class Shape, class Work>
OffGridCase off_grid_case(std::string name, const Shape& p, const Shape& q, Work work,
                          Result<Shape> (*rounded)(const Shape&, Kind) = with_coordinates) {
  return {std::move(name), [=](Coordinates kind) -> Result<OffGridWork> {
            const Result<Shape> a = rounded(p, kind), b = rounded(q, kind);
            if (!a) return a.error();
            if (!b) return b.error();
            return OffGridWork(work(*a, *b));
          }};
}

struct OffGridPlan {
  std::string suite;     ///< as `./run bench` has it
  std::string title;     ///< what is measured, in a sentence
  std::string unit;      ///< of the results, one of them: "vertex"
  std::string opponent;  ///< empty: none
  std::string compared;  ///< with what answers are compared, in a sentence
};

/// Measures all kinds of a case by turns, prints a row for each, and puts the table in the place of the suite's section
/// of off-the-grid.md in that folder ("": nowhere). Times are processor time, the median of the turns; ratios are
/// medians of those within a turn. An input that cannot be measured has a row that says why. False where an answer is
/// wrong.
bool off_grid_table(const OffGridPlan& plan, const std::vector<OffGridCase>& cases, const std::string& folder);

}  // namespace dymsum::bench
