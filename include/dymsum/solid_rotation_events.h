// What happens to the sum of two solids of any shape while one of them rotates about a fixed axis: every angle at which
// the sum changes, exactly and in order, and the exact sum at and between them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dymsum/event.h"
#include "dymsum/frames.h"
#include "dymsum/rational.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

/// The direction of an axis through the origin, in integers of at most 2^15 in magnitude.
using TurnAxis = std::array<std::int32_t, 3>;

/// A turn by theta about an axis, counter-clockwise seen from its tip, given by t = tan(theta / 2) / |axis|, |axis|
/// being the length of the primitive axis (without common divisor): its matrix is rational. For the axes of coordinates
/// t is tan(theta / 2). Half a turn is t = infinity. A value.
class AxisTurn {
 public:
  AxisTurn() = default;  ///< theta = 0
  static AxisTurn of(Rational t) { return AxisTurn(std::move(t), false); }
  static AxisTurn half_turn() { return AxisTurn(0, true); }
  /// A rotation within 2^-40 of the angle, and exact for half turns and, about the axes of coordinates, quarter turns.
  /// Errors: bad_rotation for an angle that is not finite or an axis that is zero.
  static Result<AxisTurn> nearest(const TurnAxis& axis, double radians);

  bool is_half_turn() const { return half_turn_; }
  const Rational& t() const { return t_; }  ///< 0 for half a turn
  /// theta in (-pi, pi], within 2^-48.
  double radians(const TurnAxis& axis) const;
  friend bool operator==(const AxisTurn&, const AxisTurn&) = default;

 private:
  AxisTurn(Rational t, bool half_turn) : t_(std::move(t)), half_turn_(half_turn) {}
  Rational t_;
  bool half_turn_ = false;
};

/// An angle whose t is a root of a polynomial: c0, c1, ... are its integers without common divisor, and t (in (-1, 1] /
/// |axis| or a little more) is its only root between t_low and t_high, and a simple one; of the angle less half a turn
/// where `opposite`.
struct AlgebraicTurn {
  std::optional<AxisTurn> exact;  ///< where t is rational: the sum can be had there
  std::vector<std::string> polynomial;
  double t_low = 0, t_high = 0;
  bool opposite = false;
  friend bool operator==(const AlgebraicTurn&, const AlgebraicTurn&) = default;
};

/// Features that come together at an event.
struct SolidRotationContact {
  using Kind = EventKind;
  Kind kind = Kind::normal_on_arc;
  /// The facets that meet, each as what touches on it; of vertices and edges of sums the features that add up to them.
  std::vector<SolidContact> features;
  Point3 at;  ///< where, rounded; of normal_on_arc a corner of the face's place
};

/// An angle at which something meets on the boundary of the sum; `approx` is in (-pi, pi], within 2^-44. What is
/// visible is known where changes were requested. Where t is not rational there is no sum at the angle: before and
/// after alone are compared.
struct SolidRotationEvent : Event<AlgebraicTurn> {
  std::vector<SolidRotationContact> contacts;  ///< by kinds, then by features; 16 of them where masses meet
};

struct SolidRotationOptions {
  MovingOperand moving = MovingOperand::p;
  /// Sums before, at and after every event tell what changes: one or two exact sums an event. Without, events are the
  /// angles at which something meets on the boundary, of normal_on_arc: unless proved to lie deep inside.
  bool changes = true;
  /// How far windows of candidates reach, in radians; 0: chosen by the sizes of the operands.
  double window = 0;
  bool tight = true;
  int threads = 1;  ///< of sums; 0: as many as there are cores
};

/// The work of the last query.
struct SolidRotationWork {
  std::uint64_t windows = 0, facets = 0;  ///< facets: of the convolution, at some angle of a window, added up
  std::uint64_t candidates = 0;           ///< whose polynomials were made
  std::uint64_t roots = 0;                ///< where features that exist there meet, or doubles do not decide
  std::uint64_t covered = 0;              ///< of these, at positions that doubles prove to lie in the open sum
  std::uint64_t exact_tests = 0;          ///< distinct ones of the rest, tested exactly, at the algebraic angle
  std::uint64_t events = 0, sums = 0;
  double ms = 0;
};

/// R(theta) P (+) Q. Between two consecutive events the sum's structure is constant: faces by what touches on them, how
/// they meet, tight features. Source: Behar 2016, 8.2; docs/design/turning-solids.md.
class SolidRotationEvents {
 public:
  /// Solids without thin parts. Errors: unsupported_operand for thin parts, nothing in them, or coordinates on their
  /// common grid, less how far an operand lies from the origin where that is its width or more, that need more
  /// than 140 bits together with four times those of |axis|; bad_rotation for an axis that
  /// is zero or beyond 2^15; out_of_range for the options.
  static Result<SolidRotationEvents> create(const Mesh& p, const Mesh& q, const TurnAxis& axis,
                                            const SolidRotationOptions& options = {});
  SolidRotationEvents(SolidRotationEvents&&) noexcept;
  SolidRotationEvents& operator=(SolidRotationEvents&&) noexcept;
  ~SolidRotationEvents();

  const TurnAxis& axis() const;  ///< primitive
  /// The exact sum at a turn. Errors: unsupported_operand where coordinates need more than 8,192 bits; cancelled.
  Result<SpatialSum> at(const AxisTurn& turn, const Progress& progress = {}) const;

  /// The events from `a` counter-clockwise to `b`, both included, in order. Equal turns: those of that angle alone.
  /// Errors: cancelled; as at(). Cost: windows of candidates, and sums where changes are requested.
  Result<std::vector<SolidRotationEvent>> events(const AxisTurn& a, const AxisTurn& b,
                                                 const Progress& progress = {}) const;
  /// Those of a whole turn, from -pi (excluded) to pi.
  Result<std::vector<SolidRotationEvent>> events_of_turn(const Progress& progress = {}) const;
  /// The first visible event after `a` and not beyond `limit`, which is reached counter-clockwise.
  Result<std::optional<SolidRotationEvent>> next_event(const AxisTurn& a, const AxisTurn& limit,
                                                       const Progress& progress = {}) const;
  /// The same of events that change shells, the genus of one, or counts of tight features.
  Result<std::optional<SolidRotationEvent>> next_topology_change(const AxisTurn& a, const AxisTurn& limit,
                                                                 const Progress& progress = {}) const;
  /// A hash of the structure of a sum at a turn; constant between consecutive events. Requires: a sum that at() of the
  /// same operands returned; throws std::invalid_argument for one that names features which these have not.
  std::uint64_t combinatorial_hash(const SpatialSum& sum) const;

  const SolidRotationWork& work() const;

 private:
  class State;
  explicit SolidRotationEvents(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace dymsum
