// SumSpace in exact numbers of one width: C is Int<B>, Big, Fraction or RootValue.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <utility>

#include "exact/fraction.h"
#include "exact/int.h"
#include "spatial/convolution/fine_space.h"
#include "spatial/convolution/sum_space.h"

namespace dymsum::spatial {

/// Where a module's size counts, coordinates of 72 bits are numbers of 124, and integers of any size are fractions
/// over 1.
#ifdef __EMSCRIPTEN__
inline constexpr bool kWidthOf72 = false;
using AnyInteger = exact::Fraction;
#else
inline constexpr bool kWidthOf72 = true;
using AnyInteger = exact::Big;
#endif

template <class C>
class GridSpace final : public SumSpace {
 public:
  using Point = exact::Vector3<C>;
  using Edge = decltype(C{} + C{});
  using Normal = decltype(Edge{} * Edge{} - Edge{} * Edge{});
  using Offset = decltype(exact::dot(exact::Vector3<Normal>{}, exact::Vector3<Edge>{}));
  /// A point as (x, y, z) / w.
  template <class X, class W>
  struct Homogeneous {
    exact::Vector3<X> x;
    W w;
  };

  GridSpace(std::vector<Point> p, std::vector<Point> q, int bits, const Line (&lines)[3]);

  PlaneId add_planes(std::span<const PlaneSource> sources, int threads) override;
  int exact_side(PlaneId plane, SumPoint point) const override;
  int exact_side(PlaneId plane, const PointSource& point) const override;
  int exact_twist(const SumEdge& a, const SumEdge& b) const override;
  int exact_rise(PlaneId plane, const SumEdge& edge) const override;
  int exact_det(PlaneId a, PlaneId b, PlaneId c) const override;
  int exact_cross(PlaneId a, PlaneId b, int axis) const override;
  int exact_dot(PlaneId a, PlaneId b) const override;
  int exact_normal(PlaneId plane, int axis) const override;
  int same_plane(PlaneId a, PlaneId b) const override;
  bool same_point(const PointSource& a, const PointSource& b) const override;
  int exact_order(const PointSource& a, const PointSource& b, int axis) const override;
  int exact_det(DirectionSource u, DirectionSource v, DirectionSource w) const override;
  int exact_dot(DirectionSource u, DirectionSource v, DirectionSource w, DirectionSource x) const override;
  int exact_leading(DirectionSource w) const override;
  int exact_turn(DirectionSource r, DirectionSource u, DirectionSource v, DirectionSource w,
                 DirectionSource x) const override;
  int exact_side(const PlaneSource& plane, const Flag& flag) const override;
  int exact_normal(const PlaneSource& plane, int axis) const override;
  Approx exact_approximation(const PointSource& point) const override;
  int bits() const override { return bits_; }
  exact::BigRational exact_coordinate(const PointSource& point, int axis) const override;
  std::array<exact::BigInteger, 4> homogeneous(const PointSource& point) const override;
  std::optional<PointSource> add_position(const std::array<exact::BigRational, 3>& world) override;

 private:
  exact::Vector3<Edge> sum(SumPoint s) const { return p_int_[s.p] + q_int_[s.q]; }
  /// Up to a positive factor: signs do not depend on it. Of fractions without a common divisor, each made once.
  exact::Vector3<Edge> direction(DirectionSource w) const;
  exact::Vector3<Edge> kept_direction(DirectionSource w) const;
  exact::Vector3<Edge> along(const SumEdge& e) const;
  exact::Vector3<Normal> normal(const PlaneSource& source) const;
  void set_plane(PlaneId id, const PlaneSource& source);
  /// n . x of all points x of a plane: made where it is requested, as doubles answer most questions.
  Offset offset(PlaneId plane) const { return exact::dot(n_[plane], sum(plane_sources_[plane].at)); }
  /// The position of a point of kind edge, or planes: Homogeneous of the widths that these have.
  auto of_edge(const PointSource& point) const;
  auto of_planes(const PointSource& point) const;
  /// The position of any point, where one type has all of them.
  Homogeneous<C, C> of_any(const PointSource& point) const;
  /// f(Homogeneous) with the point in the narrowest form of its kind.
  template <class F>
  auto with_point(const PointSource& point, F f) const;

  /// The space's doubles of a position on the grid.
  template <class X>
  Vec3 near(const exact::Vector3<X>& on_grid) const;
  void balance_axes();
  /// Made when doubles have left a sign open for the first time; null where integers cost no more.
  const FineSpace* fine() const;
  /// The same of the next rung, for values at roots: multiplying polynomials costs a hundred times as much.
  const WideSpace* wide() const;
  /// ask(space), of those with intervals, counted where it answers.
  template <class Query>
  std::optional<int> by_intervals(Query query) const;
  /// ask(space) where that answers; else exactly(), counted as exact.
  template <class Query, class Exactly>
  int by_rungs(Query query, Exactly exactly) const;

  std::vector<Point> p_int_, q_int_;
  /// The positions of either operand over the largest integer that divides all differences, where that is kept: for
  /// integers of any size.
  std::vector<Point> p_short_, q_short_;
  std::vector<exact::Vector3<Normal>> n_;
  struct Position {
    Homogeneous<exact::Big, exact::Big> at;  // w > 0
    Approx approx;
  };
  std::vector<Position> positions_;
  /// Of fractions: common divisors of long numbers cost more than all else.
  mutable std::mutex directions_mutex_;
  mutable std::unordered_map<std::uint64_t, exact::Vector3<Edge>> directions_[2];
  mutable std::once_flag fine_once_;
  mutable std::unique_ptr<FineSpace> fine_;
  mutable std::once_flag wide_once_;
  mutable std::unique_ptr<WideSpace> wide_;
  int bits_;
  int shift_[3] = {};         // a step of the grid along each axis is 2^shift of the space's doubles
  int normal_shift_[3] = {};  // the same of components of normals: those of the other axes together
};

}  // namespace dymsum::spatial
