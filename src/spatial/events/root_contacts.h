// What happens at one exact angle: which of the features that may meet there do, and whether the place is covered.
#pragma once

#include <memory>
#include <optional>

#include "spatial/boundary/collision.h"
#include "spatial/events/rotation_candidates.h"
#include "spatial/events/sure_overlap.h"
#include "spatial/moving/inner_balls.h"

namespace dymsum::spatial {

/// Balls inside both operands: what a ball of P plus one of Q holds lies in the open sum.
struct PairOfBalls {
  explicit PairOfBalls(const RotatingPair& pair);
  std::array<std::vector<InnerBalls::Ball>, 2> balls;  ///< in the pair's units
};

/// One angle, the root of a meeting of a window.
class RootContacts {
 public:
  RootContacts(const RotatingPair& pair, const PairOfBalls& balls, const RotationWindow& window,
               const exact::AlgebraicRoot& root, SolidRotationWork& work);

  /// What a meeting tells of the sum's boundary: nothing where a feature does not exist at this angle, where they do
  /// not meet as far as they reach, or where the position lies in the open sum. Exact, but of normal_on_arc: these are
  /// left out only where balls prove the face plus the edge to lie in the open sum.
  std::optional<SolidRotationContact> contact(const Meeting& meeting) { return contact(meeting, true); }
  /// Calls take(contact) for all edge_and_facets and four_facets of this angle, until it says false. `again` as
  /// CrossingSearch. For crowded angles: most facets of a window do not exist there, or do not meet.
  void crossings(const std::function<bool(SolidRotationContact)>& take, const std::function<void()>& again);
  double radians() const { return radians_; }

 private:
  using Jets = RotationSigns<JetFrame>;
  using Exact = RotationSigns<PolynomialFrame>;
  /// The sign of form(RotationSigns) here: jets, in doubles and in pairs of them, then in fixed point, else exact.
  template <class F>
  int sign(F form) const;
  bool exists(std::uint32_t facet) const;
  bool exists_at(SumPoint v) const;
  bool exists_at(const SumEdge& e) const;
  template <class F>
  bool in_facet(std::uint32_t facet, F place, int w) const;
  template <class F>
  bool on_edge(const SumEdge& e, F place, int w) const;
  bool slant_holds(const SlantCondition& c) const;

  /// Where not `known` it is asked as well whether the form of the meeting vanishes here.
  std::optional<SolidRotationContact> contact(const Meeting& meeting, bool known);
  std::optional<SolidRotationContact> normal_on_arc(const Meeting& meeting);
  std::optional<SolidRotationContact> vertex_on_facet(const Meeting& meeting);
  std::optional<SolidRotationContact> edge_on_edge(const Meeting& meeting);
  std::optional<SolidRotationContact> edge_and_facets(const Meeting& meeting, bool known);
  std::optional<SolidRotationContact> four_facets(const Meeting& meeting, bool known);

  /// A place in doubles; not `sure` where they do not tell.
  struct NearPlace {
    Vec3 at;
    double radius = 0;
    bool sure = false;
  };
  NearPlace near(const Jets::Place& place) const;
  bool surely_covered(const NearPlace& place);
  /// Of a meeting at a place, and as the space of the angle names it.
  template <class F>
  std::optional<SolidRotationContact> free_contact(const Meeting& meeting, NearPlace place, F source);
  /// Whether a place lies in the open sum, exactly. Many meetings share one: each is tested once.
  bool is_covered(const NearPlace& near, const PointSource& place);
  std::vector<SolidContact> features(const Meeting& meeting) const;
  bool in_balls(const std::vector<Vec3>& places, double radius);
  bool surely_overlaps(Vec3 at, double radius);
  const SumSpace& space();
  SolidContact features(std::uint32_t facet) const;

  const RotatingPair& pair_;
  const PairOfBalls& balls_;
  const RotationWindow& w_;
  SolidRotationWork& work_;
  const exact::AlgebraicRoot& root_;
  exact::RootPoint point_;
  std::optional<exact::BigRational> t_;  // where it is rational, and short
  double radians_ = 0, reach_ = 0;
  JetFrame jets_frame_;
  FineFrame fine_frame_;
  mutable std::optional<WideFrame> wide_frame_;  // made when it is asked for
  PolynomialFrame exact_frame_;
  Jets jets_;
  RotationSigns<FineFrame> fine_;
  Exact exact_;
  std::array<std::vector<InnerBalls::Ball>, 2> turned_;
  std::optional<SureOverlap> overlap_;
  std::unique_ptr<SumSpace> space_;
  std::optional<Collision> collision_;
  struct TestedPlace {
    NearPlace near;
    PointSource place;
    bool covered = false;
  };
  std::vector<TestedPlace> tested_;
  mutable std::vector<std::int8_t> known_;  // per facet: exists, 0 not asked
};

}  // namespace dymsum::spatial
