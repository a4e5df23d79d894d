// Whether a layout is right: parts that overlap, that are nearer than a required spacing, that stick out of the
// container; whoever made it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dymsum/orientation.h"
#include "dymsum/planar_sum.h"
#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum {

/// A part of a layout: a shape, turned about the origin of its coordinates, then moved.
struct LayoutPart {
  std::string name;
  std::uint32_t shape = 0;  ///< index into Layout::shapes
  Orientation orientation;
  RationalPoint at;
};

struct Layout {
  std::vector<Region> shapes;
  std::vector<LayoutPart> parts;
  std::optional<Region> container;  ///< none: parts may be anywhere
  std::vector<std::string> notes;   ///< what was repaired where it was read, a line for each shape
};

struct LayoutFault {
  enum class Kind : std::uint8_t {
    overlap,   ///< two parts have interior points in common; `distance` is their penetration depth
    too_near,  ///< two parts are nearer than the spacing, or one is nearer to the outside than the margin; the distance
    outside,   ///< a part is not in the container; `distance` is the shortest move into it
  };
  static constexpr std::uint32_t kContainer = 0xffffffff;
  Kind kind = Kind::overlap;
  std::uint32_t part = 0;            ///< index into Layout::parts
  std::uint32_t other = kContainer;  ///< the other one, with the smaller index, or kContainer
  /// False of overlaps beyond LayoutCheckOptions::measured, none of which is deeper than one that is, but for 2^-30 of
  /// it: `squared`, `distance` and `move` are 0, and count nothing.
  bool measured = true;
  Rational squared;     ///< the exact square of `distance`
  double distance = 0;  ///< the nearest double; infinite where a part fits nowhere (`squared` is 0 and counts nothing)
  double at_most = 0;   ///< `distance` is no more than this; the same double where it is measured
  RationalPoint move;   ///< a shortest move of `part` to a touch; that into the container; zero where there is none
  Point at;             ///< near the fault: what overlaps or sticks out is there, or a corner of the part's box
};

struct LayoutCheckOptions {
  double spacing = 0, margin = 0;  ///< the required distances of parts, and of parts and the outside
  std::size_t measured = 100;      ///< of how many overlaps, the deepest ones, the depth is determined
  Progress progress;
};

struct LayoutCheck {
  std::vector<LayoutFault> faults;  ///< by kind, then what is measured, then the worst first, then by parts
  std::uint64_t pairs = 0;          ///< whose boxes are near enough to be looked at
  double density = 0;               ///< area of all parts over that of the container; 0 without one; rounded
  bool valid() const { return faults.empty(); }
};

/// Exact: touching is allowed, and whether parts overlap or keep a distance is decided by integers, for the
/// orientations and positions as they are given. Parts without area overlap nothing. Errors: bad_index for a part with
/// a shape that is not there; out_of_range for distances that are negative or above 2^400; those of nfp; cancelled. O(n
/// log n) for boxes that rarely meet, and for each pair that does the pieces of both boundaries that are near each
/// other; a sum for some more overlaps than are to be measured, as bounds from 32 directions tell which may be deepest.
Result<LayoutCheck> check_layout(const Layout& layout, const LayoutCheckOptions& options = {});

struct LayoutReadOptions {
  /// Of drawings, what the container is: empty: elements of the class `bin` (SVG), else the largest ring; `largest`;
  /// `none`; else the layer that it alone is drawn on (DXF), or the id of its element (SVG).
  std::string container;
  /// JSON: shapes are repaired as by repair(), which orients rings that run the wrong way. Drawings have no
  /// orientation.
  bool repair = false;
};

/// The layouts of a file. JSON: what jagua-rs and sparrow write, an instance with its solution, and what layout_to_json
/// does (docs/guide/checking.md); one for a strip, one for each bin that is used. Rotations are degrees, at face value:
/// multiples of 90 exactly, others by Orientation::nearest. Drawings, .dxf and .svg: every shape is a part that stands
/// where it is drawn. DXF: a closed ring with the rings inside it, which are its holes. SVG: an element, or a group
/// with elements of the class `hole`, as SVGnest writes them; a layout for each bin. Errors: cannot_open; malformed,
/// also for lines in drawings that are not closed, and those of regions with the item's name.
Result<std::vector<Layout>> read_layouts(const std::string& path, const LayoutReadOptions& options = {});
/// A layout as JSON that read_layouts gives back exactly: an instance and its solution as jagua-rs and sparrow write
/// them, with shapes by their indices, orientations by `tan_half` besides the degrees, and positions as numbers where
/// these are doubles, else as fractions in texts; a container is the one bin. Notes are left out.
std::string layout_to_json(const Layout& layout);

enum class LayoutFormat : std::uint8_t { json, svg, dxf };
Result<std::vector<Layout>> parse_layouts(std::string_view text, std::string_view name_for_errors,
                                          const LayoutReadOptions& options = {},
                                          LayoutFormat format = LayoutFormat::json);

}  // namespace dymsum
