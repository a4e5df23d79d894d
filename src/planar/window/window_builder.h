// Makes windows of scales, stage by stage: the convolution of a range of scales, the grid, and which operand moves
// in the window; for scales of one ratio too.
#pragma once

#include <array>
#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <vector>

#include "base/scratch.h"
#include "exact/big.h"
#include "planar/mask/interior_mask.h"
#include "planar/window/scaling_pairs.h"
#include "planar/window/scaling_window.h"

namespace dymsum::planar {

// The stages of building a window of scales, in their order.

/// Cells of the plane of sums that lie in the open sum at every scale of a window (interior_mask.h for a moving
/// operand): their closures, grown by 8 kReach cells, lie in int P + Q or P + int Q. `cells` along the longer side.
/// Without `use` no cell is covered and only the grid is made.
CoveredCells swept_cells(const OperandPair& base, const WindowFrame& frame, int cells, bool use);

// Cutting: segments of a window lose what lies in covered cells throughout.

/// The ends a and b of a piece, each coordinate at both ends of the window, in the window's frame.
struct PieceEnds {
  Two ax, ay, bx, by;
  double dx, dy;  ///< the unscaled edge vector
  double error;   ///< of the side of a point of another piece
};

/// Gives a window's segments their pieces. `swept`: the frame of the mask. Returns the ends of the pieces.
Array<PieceEnds> cut_pieces(Window& window, const WindowFrame& swept, const CoveredCells& mask, Scratch* memory);

// The scales at which a position on a piece's line lies inside the piece, as far as doubles know them.

/// Narrows a candidate's brackets to the scales at which the position t, known up to `error`, lies inside a piece.
/// False where there are none provably. `unsure`: at its head or tail throughout the window, as far as doubles decide.
bool narrow_to_piece(const Window& window, std::uint32_t piece, const Linear& t, double error, Candidate& c,
                     std::array<bool, 2>& unsure);

// Pair finding: which pieces of a window may meet, and when they cross.

class CoverMemory;
class EdgeSearch;

/// How crossings inside the sum are found, to be left out.
struct CoverSearch {
  EdgeSearch* edges = nullptr;    ///< none: they are not
  CoverMemory* memory = nullptr;  ///< of windows before, if there is one
};

/// Fills in a window's candidates, and what touches at every scale. Returns for every touch its pair of vertices;
/// nothing where more boxes of pieces meet than the settings allow, or where it is stopped. `search` leaves out
/// crossings that two edges prove covered while they exist.
std::optional<std::vector<WalkPair>> find_candidates(Window& window, const WindowFrame& swept, const CoveredCells& mask,
                                                     const Array<PieceEnds>& ends, const WindowSettings& settings,
                                                     const CoverSearch& search);

// What touches at every scale: ends of segments that stay on the lines of others, and the nodes they make.

/// Finds the touches of a window while its pairs are tested.
class TouchFinder {
 public:
  explicit TouchFinder(Window& window) : window_(window) {}

  /// Whether a pair of vertices lies on the line of a segment at every scale. A side is linear in s: zero at s = 1 and
  /// s = 2 is zero always.
  bool always_on(std::uint32_t segment, Pair v);

  /// Whether an end of one piece of a pair stays on the line of the other; then they touch there or not at all, and are
  /// no candidate.
  bool touch_always(const Candidate& c, std::array<bool, 2> at_a, std::array<bool, 2> at_b);
  /// Two parallel segments on one line at every scale: each end inside the other one touches it.
  void touch_parallel(std::uint32_t i, std::uint32_t j);
  /// The pair of every touch of the window, in order.
  const std::vector<WalkPair>& pairs() const { return pairs_; }

 private:
  void add_touch(std::uint32_t piece, WalkPair v, const Linear& t, double error);
  Window& window_;
  std::shared_ptr<const Lattice> doubled_;  // at scale 2
  std::vector<WalkPair> pairs_;
};

/// Touches grouped by their pair of vertices; segments through one node meet there only, so they are no candidates.
void make_nodes(Window& window, const std::vector<WalkPair>& touch_pairs);
/// Pieces pass and end in nodes that two edges prove covered throughout `swept` as if nothing touched: what begins or
/// ends in the open sum is false.
void drop_covered_nodes(Window& window, const WindowFrame& swept);

// Segments that lie along each other, the same way, at every scale: where several cover a position, one goes on and the
// others stop there.

using PiecePairs = Array<std::array<std::uint32_t, 2>>;

/// Settles the pairs of pieces that lie along each other; what stays open stays in `close`. What stops counting still
/// has to be known where something touches at one scale.
void share_lines(Window& window, TouchFinder& touches, PiecePairs& close);

/// All that a window for frames is made of, so that any thread can.
struct WindowPlan {
  std::uint64_t family = 0;
  std::shared_ptr<const OperandPair> base;
  double low = 0, high = 0;
  std::shared_ptr<const ReducedConvolution> convolution;
  std::shared_ptr<CoverMemory> memory;  ///< used by one window at a time
  WindowSettings settings;
};

class WindowBuilder {
 public:
  /// `family`: of the windows for frames.
  explicit WindowBuilder(std::shared_ptr<const OperandPair> base, std::uint64_t family = 0)
      : base_(std::move(base)), family_(family) {}

  /// A window for the events in [low, high]; without `covers` also of crossings inside the sum. `again` is called now
  /// and then and may throw.
  std::unique_ptr<Window> between(const exact::BigRational& low, const exact::BigRational& high, bool covers = false,
                                  const std::function<void()>& again = {});
  /// A plan for frames in (low, high), near `at` at first; abandoned when more than `most_pairs` boxes meet. Plans of
  /// one convolution share a memory.
  WindowPlan plan(double low, double high, double at, std::uint64_t most_pairs);
  /// The width, as a logarithm, beyond which masks lose more than longer windows gain.
  double widest(double s) const;

  /// The reduced convolution of all scales in [low, high], perhaps of more.
  const ReducedConvolution& convolution_for(double low, double high);
  /// The one the last window was made from: its ids are the window's.
  std::shared_ptr<const ReducedConvolution> convolution() const { return convolution_; }
  /// The settings of a window for scales in [low, high]: all but the grid. At `at` the smaller operand moves.
  WindowSettings settings_for(const exact::BigRational& low, const exact::BigRational& high, double at) const;
  double shrink = 1;         ///< tests only, see WindowSettings
  bool edges_prove = true;  ///< see WindowSettings

 private:
  WindowSettings with_grid(WindowSettings settings) const;
  std::array<double, 2> sizes(double s) const;

  std::shared_ptr<const OperandPair> base_;
  std::uint64_t family_ = 0;
  std::shared_ptr<CoverMemory> memory_;  ///< of windows for frames, made from convolution_
  std::shared_ptr<const ReducedConvolution> convolution_;
  double fill_low_ = 0, fill_high_ = 0;  ///< scales for which the convolution's filled holes are right
};

/// What scales of one ratio have in common: diag(x, y) with the larger one 1. Of uniform scales both are. diag(s, r s)
/// times an operand is s times the operand stretched by diag(1, r), so that windows of uniform scales serve them.
struct Factors {
  ScaleValue x, y;
  bool uniform() const { return x == y; }
  friend bool operator==(const Factors&, const Factors&) = default;
};
/// The factors of diag(x, y).
Factors factors_of(const ScaleValue& x, const ScaleValue& y);

struct RatioSweep {
  std::uint64_t family;  ///< of its windows; 0 is that of uniform scales
  Factors factors;
  std::shared_ptr<const OperandPair> base;  ///< the stretched one
  WindowBuilder windows;
};

/// The sweeps of the last few ratios.
class RatioSweeps {
 public:
  /// That of a ratio, if it is known.
  RatioSweep* find(const Factors& factors);
  /// Makes one. Nothing where windows cannot serve: for ratios beyond 2^OperandPair::kFactorBits.
  RatioSweep* make(const OperandPair& base, const Factors& factors);

 private:
  std::list<RatioSweep> sweeps_;  // the most recently used first
  std::uint64_t made_ = 0;
};

}  // namespace dymsum::planar
