// The boundary of the slice while the angle grows: a graph of visible sub-edges, changed at events only. Near a generic
// event the change follows from the few segments that meet there; where more coincides, a whole slice on the far side
// of the event is computed and compared.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "cspace/boundary/obstacle_state.h"
#include "cspace/events/event_place.h"
#include "cspace/events/overlap_filter.h"
#include "cspace/events/quarter_turn.h"
#include "cspace/events/sub_edge.h"
#include "cspace/events/turn_events.h"
#include "planar/sum/sum_engine.h"

namespace dymsum::planar {

class ObstacleSweep {
 public:
  static constexpr std::uint32_t kNobody = 0xffffffff;

  /// A visible sub-edge: a patch while its neighbours stay the same.
  struct Node {
    WalkSegment segment;
    std::uint32_t id = 0;                            ///< of the segment
    std::uint32_t prev = kNobody, next = kNobody;    ///< along the boundary
    std::uint32_t left = 0, right = 0;               ///< the segments of prev and next
    std::uint32_t begin = kNobody, end = kNobody;    ///< angles
    std::uint32_t same = kNobody, before = kNobody;  ///< the other nodes of this segment, as a list
    std::uint32_t cell = 0;                          ///< on the right, now
    std::uint32_t born_cell = kNobody;               ///< when it began
    bool alive = true;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> cells;  ///< (angle, cell) from the second one on
  };
  struct Cell {
    std::uint32_t begin = kNobody, end = kNobody;
    bool unbounded = false;  ///< told only where the turn begins, or where nesting was looked at
  };

  ObstacleSweep(const TurningForms& forms, const TurnCatalog& catalog, std::shared_ptr<const OperandPair> base,
                bool reference);

  /// The boundary behind the beginning of the first window, before its first event.
  void start(const TurnRange& range, TurnEvents& found, const OverlapFilter& filter);
  /// Passes the events of a window. `at_end`: its end, where that is a crowded quarter turn; then none of the events is
  /// there.
  void pass(const TurnRange& range, TurnEvents found, OverlapFilter& filter, const CrowdedQuarter* at_end);
  /// The first event of a window, if it has any.
  static TurnEvent* first_event(const TurnRange& range, std::vector<TurnEvent>& events, const TurningForms& forms);
  /// Joins the end of the turn to its start.
  void close(OverlapFilter& filter);
  bool closed_turn() const { return closed_; }

  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<Cell>& cells() const { return cells_; }
  /// A free cell that goes on in another one at an angle.
  struct CellLink {
    std::uint32_t from = 0, to = 0;
  };
  const std::vector<CellLink>& cell_links() const { return cell_links_; }
  /// Cells before and behind an angle that touch each other there, in a passage that is shut.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& touching_cells() const { return touching_cells_; }
  /// Angles at which Euler numbers are told by limits of the boundary, and then twice what surfaces gain there, each
  /// with a node of theirs.
  const std::vector<std::uint32_t>& limit_angles() const { return limit_angles_; }
  const std::vector<std::pair<std::uint32_t, int>>& limit_halves() const { return limit_halves_; }
  std::uint32_t first_cell(std::uint32_t node) const { return nodes_[node].born_cell; }
  std::uint32_t shell_of(std::uint32_t node) const { return find(shell_, node); }
  std::uint32_t component_of(std::uint32_t cell) const { return find(component_, cell); }
  /// The node that goes on in this one behind the end of the turn, or itself.
  std::uint32_t continued(std::uint32_t node) const { return continued_.empty() ? node : continued_[node]; }
  std::vector<ExactAngle> angles;
  bool keeps_all_angles = false;  ///< also those at which nothing happens
  std::vector<ObstacleEvent> events;
  std::vector<TightFeature> tight;
  bool always_concurrent = false;  ///< of some window: CspaceObstacle::may_have_tight_curves
  ObstacleWork work;

 private:
  struct LocalVertex {
    int other = -1;
    bool chain = false;
  };
  struct Local {
    WalkSegment segment;
    std::uint32_t id = 0;
    bool opens = false, closes = false;  ///< it starts, or ends, here
    int count = 0;                       ///< vertices behind the event, in order
    std::array<LocalVertex, 2> vertices{};
    std::uint32_t in = kNobody, out = kNobody;  ///< visible nodes that come here and that leave
    int pieces() const { return count + 1; }
  };
  struct Cluster {
    int size = 0;
    std::array<Local, 3> local;
    std::array<std::array<int, 3>, 3> cross{};  ///< signs of direction x direction
    std::vector<std::uint32_t> vanish;          ///< nodes that shrink to the event
    Point at;                                   ///< in the forms' doubles
    double at_error = 0;
    bool any() const;
    int find(std::uint32_t id) const;
  };
  struct Path {
    std::uint32_t in = kNobody, out = kNobody;
    std::vector<int> segments;  ///< of the cluster
  };
  /// Visible sub-edges that follow each other along the common line of two aligned edges, and where they start and end
  /// on it.
  struct AlignedRun {
    std::uint32_t first = kNobody, last = kNobody;
    double from = 0, to = 0, error = 0;
    bool on_first = false, on_second = false;  ///< the segments behind the event that carry it
  };
  /// A stretch behind an event and before the next one, to look at the slice there.
  struct Behind {
    const TurnRange* range = nullptr;
    TurnEvent *from = nullptr, *to = nullptr;  ///< without them the ends of the range
    Orientation sample(const TurningForms& forms) const;
  };
  using Group = std::vector<TurnEvent*>;

  // obstacle_sweep.cpp
  void pass_pending(const std::function<Orientation()>& behind, OverlapFilter& filter);
  void pass_group(const Group& group, const TurnRange& range, const std::function<Orientation()>& behind,
                  OverlapFilter& filter);
  void join_faces(const Orientation& at);
  std::uint32_t cell_at(const SumRing& ring) const;
  WalkSegment walk_segment(const Contact& c) const;
  std::vector<WalkSegment> segments_of(const SumRing& ring) const;
  bool matters(const Group& run, const OverlapFilter& filter) const;
  void change(const Group& group, const TurnRange& range, const std::function<Orientation()>& behind,
              OverlapFilter& filter);
  std::vector<std::uint32_t> segments_of(const TurnEvent& event, bool& unsure) const;
  std::uint32_t angle(const TurnRange& range, TurnEvent& event);
  void slice(const TurnRange& range, const Group& group, const std::function<Orientation()>& behind);
  void take_slice(SumState state);
  WalkSegment segment_of(std::uint32_t id) const;
  SubEdge sub_edge(std::uint32_t n) const {
    return {nodes_[n].segment, segment_of(nodes_[n].left), segment_of(nodes_[n].right)};
  }
  const SignsAt& signs_now() const;
  void note(Heading h, ObstacleEvent::Kind kind, Point at);
  Point position(Heading h, Point at) const;
  // event_clusters.cpp
  std::vector<Group> clusters(const Group& group) const;
  // line_stretch.cpp
  std::vector<std::pair<std::uint32_t, std::uint32_t>> continued_stretches(
      const std::vector<std::uint32_t>& ended, const std::vector<std::uint32_t>& fresh) const;
  bool continues(std::uint32_t n, std::uint32_t m, Heading h) const;
  bool on_one_line(const WalkSegment& s, const WalkSegment& t, Heading h) const;
  bool collinear(const WalkSegment& s, const WalkSegment& t, Heading h) const;
  /// Lines that collinear() may call one have offsets from the origin that differ by less than this share of the span,
  /// a tenth of it.
  static constexpr double kLineNear = 0x1p-34;
  double line_offset(std::uint32_t n, Heading h) const;
  // shut_passages.cpp
  using Lines = std::vector<std::pair<double, std::uint32_t>>;  ///< nodes by the offsets of their lines
  Lines lines_of(const std::vector<std::uint32_t>& nodes) const;
  std::vector<std::uint32_t> opposite_walls(std::uint32_t n, const Lines& side, Heading h) const;
  bool shut_now(const std::vector<std::uint32_t>& nodes, const Lines& side) const;
  std::array<double, 3> stretch_now(std::uint32_t on, std::uint32_t n, Heading h) const;
  // tight_events.cpp
  /// A place of events of the group that may be free, and segments whose lines go through it.
  struct Candidate {
    ExactPlace place;
    Point near;  ///< in the forms' doubles
    std::vector<std::uint32_t> through;
    bool visible = false;  ///< sub-edges before or behind the angle come to it
    bool goes_through(std::uint32_t segment) const {
      return std::find(through.begin(), through.end(), segment) != through.end();
    }
  };
  /// A sub-edge before or behind the angle: where it begins and ends at the angle, as d . (x - start) of its segment,
  /// in doubles.
  struct NodeNow {
    std::uint32_t node = 0;
    double from = 0, to = 0, error = 0;  ///< of the difference to `along_near` of a place
  };
  void examine(const TurnRange& range, const OverlapFilter& filter, const std::vector<AlwaysConcurrent>& curves_behind);
  void note_tight(const Candidate& from, const Candidate& to);
  std::vector<Candidate> candidates(const SignsAt& signs, const OverlapFilter& filter) const;
  std::vector<Candidate> candidates_of_open_slice(const SignsAt& signs,
                                                  std::vector<std::array<std::uint32_t, 2>>& between) const;
  std::vector<std::uint32_t> through_end(const TurnEvent& event, Pair v) const;
  bool same_place(const SignsAt& signs, const Candidate& y, const Candidate& z) const;
  std::vector<Candidate> each_once(const SignsAt& signs, std::vector<Candidate> all) const;
  std::vector<std::array<std::uint32_t, 2>> opposite_stretches(const SignsAt& signs,
                                                               const std::vector<Candidate>& places) const;
  std::vector<NodeNow> nodes_now(const SignsAt& signs, bool before) const;
  int order_of_end(const SignsAt& signs, const NodeNow& n, const Candidate& z, bool at_end) const;
  bool on_line(const SignsAt& signs, const NodeNow& n, const Candidate& z) const;
  bool reaches(const SignsAt& signs, const NodeNow& n, const Candidate& z) const;
  bool reached_all_along(const SignsAt& signs, const std::vector<NodeNow>& nodes, const Candidate& y,
                         const Candidate& z) const;
  std::optional<Point> look_at_limits(const SignsAt& signs);
  // tight_curves.cpp
  std::vector<AlwaysConcurrent> tight_curves(const Orientation& at, const OverlapFilter& filter) const;
  std::optional<Candidate> meeting_of(const SignsAt& signs, const AlwaysConcurrent& three) const;
  std::vector<Candidate> places_of(const SignsAt& signs, const std::vector<AlwaysConcurrent>& curves) const;
  // obstacle_nodes.cpp
  std::uint32_t id(const WalkSegment& s) const;
  std::uint32_t add_node(const WalkSegment& s, std::uint32_t cell);
  void end_node(std::uint32_t n);
  void link(std::uint32_t from, std::uint32_t to);
  void refresh(std::vector<std::uint32_t> touched);
  void relabel(const std::vector<std::uint32_t>& touched, const std::vector<std::uint32_t>& lost,
               const std::vector<std::pair<std::uint32_t, std::uint32_t>>& more);
  std::uint32_t new_cell(bool unbounded);
  static std::uint32_t find(const std::vector<std::uint32_t>& parents, std::uint32_t i);
  void join(std::vector<std::uint32_t>& parents, std::uint32_t a, std::uint32_t b);
  // local_update.cpp
  bool local_update(TurnEvent& event, const TurnRange& range, const std::function<Orientation()>& behind,
                    OverlapFilter& filter);
  bool gather(Cluster& cluster, Heading h) const;
  enum class Fill : std::uint8_t {
    nothing,  ///< the segments do not meet there
    unsure,   ///< doubles do not tell, or more coincides
    done,
  };
  static Fill within(Located t);
  Fill fill_triple(Cluster& cluster, const TurnEvent& event, Heading h) const;
  Fill fill_vertex(Cluster& cluster, const TurnEvent& event, Heading h) const;
  bool find_signs(Cluster& cluster, Heading h) const;
  bool find_nodes(Cluster& cluster, Heading h) const;
  bool start_alive(const Cluster& c, int segment, int piece) const;
  bool end_alive(const Cluster& c, int segment, int piece) const;
  std::optional<std::vector<Path>> paths(const Cluster& cluster, std::vector<std::vector<int>>& births) const;
  bool apply(const Cluster& cluster, const std::vector<Path>& paths, const std::vector<std::vector<int>>& births);
  bool born(const Cluster& cluster, const std::vector<int>& cycle, const std::function<Orientation()>& behind);
  // alignment_update.cpp
  bool alignment_update(TurnEvent& event, const TurnRange& range);
  bool carry(TurnEvent& event, const TurnRange& range, const std::vector<AlignedRun>& runs,
             const std::array<WalkSegment, 4>& s);
  // overlap_update.cpp
  bool overlap_update(TurnEvent& event, const TurnRange& range);
  struct Stretch {
    std::vector<std::uint32_t> nodes;  ///< along the common line, with those that shrink to a point between them
    double from = 0, to = 0, error = 0;
  };
  std::vector<Stretch> stretches(const WalkSegment& a, const WalkSegment& b, Heading h) const;
  void replace(const std::vector<std::uint32_t>& old, const std::vector<WalkSegment>& segments,
               std::map<std::uint32_t, std::uint32_t>& starts, std::map<std::uint32_t, std::uint32_t>& ends,
               std::vector<std::uint32_t>& touched);
  void relink(const std::map<std::uint32_t, std::uint32_t>& starts, const std::map<std::uint32_t, std::uint32_t>& ends,
              std::vector<std::uint32_t>& touched);

  const TurningForms& forms_;
  const TurnCatalog& catalog_;
  std::shared_ptr<const OperandPair> base_;
  bool reference_;
  bool connected_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> first_;  ///< per segment id
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> shell_, component_;          ///< union-find
  std::vector<std::uint32_t> begin_nodes_;                ///< at the start of the turn
  std::vector<std::array<std::uint32_t, 2>> begin_keys_;  ///< their neighbours then
  std::vector<std::uint32_t> continued_;
  std::array<std::vector<std::uint32_t>, 2> walk_vertex_, walk_edge_;  ///< by number in the region
  std::vector<CellLink> cell_links_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> touching_cells_;
  std::uint32_t born_ = 0;                ///< loops without a predecessor, in the group
  std::uint32_t now_ = kNobody;           ///< the angle of the group, once something changed there
  double theta_now_ = 0;                  ///< near the angle of the group
  mutable std::optional<SignsAt> signs_;  ///< at the angle of the group, once asked for
  bool trying_ = false;                   ///< local updates tell whether they can do it, and change nothing
  bool changed_ = false;                  ///< a sub-edge began or ended there
  std::vector<std::uint32_t> ended_;      ///< sub-edges that ended there
  bool sliced_ = false;                   ///< a whole slice told what changed
  std::vector<std::pair<std::uint32_t, std::uint32_t>>
      relinked_;  ///< nodes with another one behind them now, and the former one
  std::vector<std::uint32_t> limit_angles_;
  std::vector<std::pair<std::uint32_t, int>> limit_halves_;
  std::vector<TurnEvent*>
      doubtful_;         ///< events of the group that may be places of tight contacts, or of nothing at all
  bool turned_ = false;  ///< the last window is passed
  bool closed_ = false;
  std::vector<AlwaysConcurrent> always_;  ///< of the window
  std::vector<AlwaysConcurrent> curves_;  ///< of these, the tight ones, behind the last group; sorted
  std::vector<AlwaysConcurrent> begin_curves_;
  std::vector<TurnEvent> pending_;           ///< at the very end of the last window
  const CrowdedQuarter* crowded_ = nullptr;  ///< there they stand for many, so that a whole slice is due
  TurnRange pending_range_;
  Orientation begin_;  ///< where the turn was begun
};

}  // namespace dymsum::planar
