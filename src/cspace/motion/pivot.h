// The robot at one position, turning: the exact angles of its contacts, and between which of them it overlaps the
// obstacle.
#pragma once

#include <vector>

#include "cspace/motion/motion_sweep.h"
#include "cspace/motion/slice_map.h"
#include "dymsum/motion.h"
#include "planar/motion/orientation.h"
#include "planar/motion/turning_forms.h"

namespace dymsum::planar {

/// An angle at which a vertex meets a closed edge.
struct PivotEvent {
  ExactAngle angle;
  Contact contact;
};

/// The gap between two neighbouring events, counter-clockwise; their indices.
struct PivotGap {
  std::uint32_t begin = 0, end = 0;
  bool overlap = false;
};

/// What a way from one angle to another meets first.
struct PivotStop {
  ExactAngle angle;
  std::optional<Contact> contact;
};

class Pivot {
 public:
  /// Requires: operands that CspaceObstacle::create takes, which live as long as this.
  Pivot(const Region& robot, const Region& obstacle);

  /// The robot stands at this position from now on. O(1).
  void stand(const Position& at);
  /// Whether the interiors meet at an orientation. Exact: doubles, or a slice.
  bool overlaps(const Orientation& theta);
  /// All events, each angle once, in the order of the angles in (-pi, pi]. Between two of them the answer is one and
  /// the same. O(nm) filtered pairs and exact roots for those that are in reach.
  std::vector<PivotEvent> events() const;
  /// Those on the closed way counter-clockwise between two orientations, and perhaps more; fewer exact roots.
  std::vector<PivotEvent> events(const Orientation& from, const Orientation& to) const;
  /// The events of the closed way, in its order.
  std::vector<PivotEvent> on_way(const Orientation& from, const Orientation& to, TurnDirection turn) const;
  std::vector<PivotGap> gaps(const std::vector<PivotEvent>& events);
  /// The first stop on the way between two orientations; nothing for a free way. Equal ones: no way at all.
  std::optional<PivotStop> stop(const Orientation& from, const Orientation& to, TurnDirection turn, Touching touch);
  /// An orientation strictly between theta and both `to` and the first event after theta. Requires: to is not theta.
  Orientation beside(const Orientation& theta, const ExactAngle& to, TurnDirection turn) const;

 private:
  struct Form {  // a + b cos + g sin
    exact::BigRational a, b, g;
  };
  struct Candidate {
    std::uint32_t robot = 0, obstacle = 0;
    bool edge_of_obstacle = true;
  };
  Form side_form(const Candidate& c) const;
  Form along_form(const Candidate& c, exact::BigRational& length) const;
  bool in_reach(const Candidate& c) const;
  bool persists(const Candidate& c) const;
  void add_events(const Candidate& c, std::vector<PivotEvent>& to) const;
  bool possible(const Candidate& c, Heading midpoint, double half) const;
  static Contact contact_of(const Candidate& c);
  static void sort_out(std::vector<PivotEvent>& events);
  std::optional<Contact> held() const;
  template <class Visit>
  void each_candidate(Visit visit) const;

  const Region& robot_;
  const Region& obstacle_;
  Pose pose_;
  Position at_;
  Point near_;
  double error_ = 0;
};

}  // namespace dymsum::planar
