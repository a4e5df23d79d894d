// Files of planar regions and pictures. Readers return plain data that is not yet validated, so that a caller can
// choose between Region::create (refuse) and repair (change and report).
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dymsum/planar_sum.h"
#include "dymsum/read_options.h"
#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum {

/// poly: the thesis's format (number of chains; per chain `n out|in`, n points, their order on an index line or more; #
/// comments; glued numbers such as `-6.64248.788605` are split). wkt: any geometry. geojson: geometry, feature or
/// collection, with curves. svg: path, polygon, polyline, rect, line, circle, ellipse, use. json: a nesting instance
/// with `items`. dxf: polylines with bulges, lines, arcs, circles, ellipses, splines, points, blocks. gpkg: GeoPackage,
/// a database of layers, whose rows are shapes; its bytes are no text. Curves become chords (CurveOptions).
enum class RegionFormat { poly, wkt, geojson, svg, json, dxf, gpkg };

/// The format a path's extension names. Error unsupported_format: none, or gpkg where the library was compiled without
/// SQLite (WebAssembly).
Result<RegionFormat> region_format(std::string_view path);
/// Whether a text begins as .dxf files do: with a section, or with a comment that is not a number, on the line after
/// its code. Other formats never do.
bool begins_like_dxf(std::string_view text);
/// The file in a path that may name a shape of it after a "#": all of the path where there is a file of that name; else
/// what stands before the last "#" in front of which there is a file; where there is none, before the last "#".
std::string file_of_shape(const std::string& path);
/// Whether read_shapes reads files of that name, by the extension, perhaps in front of a "#": those formats and maps.
bool names_region(const std::string& path);

/// One named shape of a file. Most files hold one; nesting instances and GeoJSON collections may hold several.
struct NamedShape {
  std::string name;
  RegionData data;
  std::string unit = {};   ///< of its coordinates where the file says it: "mm", "cm", "m", "in", "ft" or another name
  std::size_t curves = 0;  ///< that became chords
};

/// All shapes of a file, or the one of "f.json#name"; "-" is standard input. Maps (.yaml, .map) are one shape, see
/// docs/guide/files.md. Of a .gpkg all rows of all layers, named "layer/1"; "f.gpkg#layer" is all of a layer as one
/// shape. Errors: cannot_open, unsupported_format, malformed, truncated, not_finite, each with file and line, of .gpkg
/// with layer and row.
Result<std::vector<NamedShape>> read_shapes(const std::string& path, const ReadOptions& options = {});
Result<std::vector<NamedShape>> parse_shapes(std::string_view text, RegionFormat format,
                                             std::string_view name_for_errors, const ReadOptions& options = {});

/// The file's only or selected shape. Error malformed when the file holds several and none is selected.
Result<NamedShape> read_shape(const std::string& path, const ReadOptions& options = {});
/// The same, its lists alone.
Result<RegionData> read_region_data(const std::string& path, const ReadOptions& options = {});

struct JoinReport {
  std::size_t joints = 0;  ///< pairs of ends that were apart, and are joined by a segment now
  double largest_gap = 0;  ///< the longest of these segments
  std::size_t rings = 0;   ///< closed chains that bound parts and holes now
  bool changed() const { return joints + rings > 0; }
  std::string to_string() const;
};
struct JoinedChains {
  RegionData data;
  JoinReport report;
};
/// Polylines joined to chains where their ends meet or are no further apart than `tolerance`, by a segment from one end
/// to the other: no vertex moves. Closed chains become rings, nested even-odd into parts; chains that stay open are
/// polylines; parts and points stay. Ends that are equal are joined first. Errors: out_of_range for a tolerance below 0
/// or not finite; malformed where an end is within the tolerance of several others, with the position. O(n log n).
Result<JoinedChains> joined_chains(RegionData data, double tolerance);

/// The region in a format, coordinates with the fewest digits that read back to the same doubles; gpkg, in bytes, holds
/// these doubles themselves. Requires: a format that region_format knows; of gpkg, less than 10^9 bytes.
std::string format_region(const Region& region, RegionFormat format);

/// The same for a sum and its rounded region, with the tight features, every vertex of theirs correctly rounded.
/// GeoJSON: a collection of two features, named `sum` and `tight`. The others: tight features that are not pieces of
/// the set anyway follow as further geometries of one collection (.wkt), as `open` and `points` chains after a comment
/// (.poly), or in `polylines` and `points` of the shape (.json); read back, they are the same closed set.
std::string format_sum(const PlanarSum& sum, const Region& rounded, RegionFormat format);

/// Writes text to a path ("-" is standard output) through a temporary file beside it, so that an existing file is
/// replaced only by a complete one. Symbolic links stay and what they name is written, also where that is not there
/// yet. A path that ends in .gz is compressed. Errors: cannot_write; unsupported_format for .gz without zlib
/// (WebAssembly).
Result<void> write_file(const std::string& path, std::string_view text);
/// Whether write_file can do it, as far as can be determined without writing: error cannot_write for a directory, a
/// folder that does not exist, a file that may not be changed.
Result<void> check_writable(const std::string& path);
/// The file that write_file replaces: the path itself, or where symbolic links lead from it in the end.
std::string written_path(const std::string& path);

/// What a picture calls operands and result.
struct SumNames {
  std::string p = "P", q = "Q", sum = "P ⊕ Q";
};

/// Pictures (SVG text). `draw_sum` shows P, Q and the sum with tight features; `draw_trace` the stages side by side.
/// The sum is drawn as `rounded`, and the picture is read as that region; without it that is the region of
/// snap_rounded().
std::string draw_region(const Region& region);
std::string draw_sum(const Region& p, const Region& q, const PlanarSum& sum, const SumNames& names = {});
std::string draw_sum(const Region& p, const Region& q, const PlanarSum& sum, const Region& rounded,
                     const SumNames& names = {});
/// A set alone, and parts of it in which solids only touch (SolidSlice::touching).
std::string draw_section(const PlanarSum& sum, const std::vector<SumPart>& touching = {});
std::string draw_trace(const Region& p, const Region& q, const PlanarSum& sum);

/// The sum as JSON text: rings with rounded and exact coordinates and the provenance of every edge and vertex.
std::string sum_to_json(const PlanarSum& sum);

}  // namespace dymsum
