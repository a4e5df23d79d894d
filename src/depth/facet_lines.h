// What of a facet may be the nearest free position: its lines and where they cross, as the position that is queried
// sees them.
#pragma once

#include <vector>

#include "depth/depth_operands.h"
#include "depth/exact_frame.h"

namespace dymsum::depth {

/// Facets seen from a position, in scaled doubles.
struct FacetView {
  const DepthOperands& o;
  spatial::Vec3 from;  ///< the position
  double slack;        ///< more than positions on facets are off, in any direction
  std::vector<CoveredBall> balls = {};

  std::size_t corners(std::uint32_t f) const { return o.facets[f].corners; }
  spatial::Vec3 corner(std::uint32_t f, std::size_t k) const {
    return o.corner(o.facets[f].corner[k % o.facets[f].corners]) - from;
  }
  /// Whether a ball covers what of a segment is nearer than `within`; its ends as seen from the position, and off by so
  /// much.
  bool cover(spatial::Vec3 a, spatial::Vec3 b, double off, double within) const;
  /// The same of a box where it stands.
  bool cover(const spatial::Box& box, double within) const;
  /// The position of a facet that is nearest.
  spatial::Vec3 nearest(std::uint32_t f) const;
};

/// A line in a facet's plane, which holds a facet edge of it or of another facet in its plane, or meets a facet in
/// another plane.
struct FacetLine {
  enum class Kind : std::uint8_t { own, level, across } kind = Kind::own;
  std::uint32_t facet = 0;
  int facet_edge = 0;          ///< of own and level ones
  spatial::Vec3 foot, along;   ///< the foot of the position, a unit vector
  double first = 0, last = 0;  ///< the interval, as multiples of `along`
  double off = 0;              ///< how far it may be off
  spatial::Vec3 at(double s) const { return foot + s * along; }
  double distance() const;  ///< of the interval, at least
};

/// A position that may be free: the foot on a line, or where two lines cross.
struct FacetCandidate {
  double lower = 0;  ///< a bound of its distance
  spatial::Vec3 at;  ///< within `off` of it, where that is not too large to say anything
  double off = 0;
  int a = 0, b = -1;  ///< lines; none twice: the foot on one
  int corner = -1;    ///< of the facet itself, else -1
};

/// Those of a facet within some distance, the nearest first. Of what several facets make, each is listed with one of
/// them at least. A superset: what is listed need not lie on the facet.
class FacetCandidates {
 public:
  FacetCandidates(const FacetView& view, const ExactFrame& frame, std::uint32_t facet, double within);

  const std::vector<FacetCandidate>& all() const { return candidates_; }
  /// Nothing for what is no position.
  std::optional<ExactPosition> exact(const FacetCandidate& c) const;

 private:
  void add_facet_edges();
  void add_neighbours();
  void add_level(std::uint32_t g);
  void add_across(std::uint32_t g);
  bool may_cross(const spatial::Box& part, std::uint32_t g) const;
  void add_line(const FacetLine& line);
  void add_feet();
  void add_crossings();
  void cross_lines(int i, int j);
  bool clip(std::uint32_t f, FacetLine& line) const;
  ExactPlane support(const FacetLine& line) const;

  const FacetView& view_;
  const ExactFrame& frame_;
  std::uint32_t f_;
  double within_;
  spatial::Vec3 normal_;
  std::vector<FacetLine> lines_;
  std::vector<FacetCandidate> candidates_;
};

// Whether two positions lie in one cell that the facets cut: then both are free, or neither is.

/// Two positions in the plane of a facet, exactly, and within the slack where the position sees a and b: whether no
/// facet begins or ends on the way between them. Contact is constant along such a way, so one tells of the other. A
/// "no" says nothing. O(log n + k) for k facets near the way.
bool same_cell(const FacetView& view, const ExactFrame& frame, std::uint32_t facet, spatial::Vec3 a, spatial::Vec3 b);

/// Whether facets lie in one plane. Exact.
bool in_one_plane(const FacetView& view, const ExactFrame& frame, std::uint32_t f, std::uint32_t g);

}  // namespace dymsum::depth
