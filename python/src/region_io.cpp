// Files of planar regions.
#include "dymsum/region_io.h"

#include "arguments.h"
#include "bind.h"
#include "enumeration.h"
#include "file_content.h"
#include "paths.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_region_readers(nb::module_& m) {
  enumeration<RegionFormat>(m, "RegionFormat", "A format of planar files.");
  enumeration<ThirdCoordinates>(m, "ThirdCoordinates", "What becomes of third coordinates and measures in files.");
  enumeration<CurveBound>(m, "CurveBound", "On which side of the curves that bound a region chords lie.");
  Record<CurveOptions>(m, "CurveOptions", "How curves of files become chords.")
      .constructible()
      .option("error", &CurveOptions::error, "in the file's units; None: a thousandth of a radius or a curve's size")
      .option("bound", &CurveOptions::bound);
  Record<ReadOptions>(m, "ReadOptions", "What readers make of third coordinates and of curves.")
      .constructible()
      .option("third", &ReadOptions::third)
      .option("curves", &ReadOptions::curves);
  Record<NamedShape>(m, "NamedShape", "One named shape of a file.")
      .field("name", &NamedShape::name)
      .field("data", &NamedShape::data, "RegionData, not yet validated")
      .field("unit", &NamedShape::unit, "of its coordinates, where the file says it")
      .field("curves", &NamedShape::curves, "that became chords");
  m.def(
      "region_format", [](const PathArgument& path) { return take(region_format(path.text)); }, "path"_a,
      "The format that a path's extension names. Raises Error: unsupported_format.");
  m.def(
      "names_region", [](const PathArgument& path) { return names_region(path.text); }, "path"_a,
      "Whether the path's extension is that of a format of regions.");
  m.def(
      "file_of_shape", [](const PathArgument& path) { return file_of_shape(path.text); }, "path"_a,
      "The file in a path that may name a shape of it after a \"#\".");
  m.def(
      "begins_like_dxf", [](const std::string& text) { return begins_like_dxf(text); }, "text"_a,
      "Whether a text begins as .dxf files do; other formats never do.");
  m.def(
      "read_shapes",
      [](const PathArgument& path, const ReadOptions& options) { return take(read_shapes(path.text, options)); },
      "path"_a, "options"_a = ReadOptions(),
      "All shapes of a file (.poly, .wkt, .geojson, .svg, .dxf, nesting .json, .gpkg), or the one of \"f.json#name\", "
      "of \"f.gpkg#layer\" or of \"f.gpkg#layer/row\". Raises Error with file and line.");
  m.def(
      "parse_shapes",
      [](const FileContent& text, RegionFormat format, const std::string& name, const ReadOptions& options) {
        return take(parse_shapes(text.bytes, format, name, options));
      },
      "text"_a, "format"_a, "name_for_errors"_a = "text", "options"_a = ReadOptions(),
      R"doc(The shapes of a text, of gpkg of bytes. Raises Error with `name_for_errors` and line.

>>> from dymsum import Region, RegionFormat, parse_shapes
>>> shapes = parse_shapes("POLYGON((0 0, 4 0, 0 3, 0 0))\nPOLYGON((0 0, 1 0, 0 1, 0 0))", RegionFormat.wkt)
>>> [Region(shape.data).area() for shape in shapes]
[6.0, 0.5]
)doc");
  m.def(
      "read_shape",
      [](const PathArgument& path, const ReadOptions& options) { return take(read_shape(path.text, options)); },
      "path"_a, "options"_a = ReadOptions(),
      "The file's only or selected shape. Raises Error: malformed where there are several.");
  m.def(
      "read_region_data",
      [](const PathArgument& path, const ReadOptions& options) { return take(read_region_data(path.text, options)); },
      "path"_a, "options"_a = ReadOptions(),
      "The file's only or selected shape, not yet validated. Raises Error: malformed where there are several.");
}

void bind_joined_chains(nb::module_& m) {
  Record<JoinReport>(m, "JoinReport", "What joining lines changed.")
      .field("joints", &JoinReport::joints)
      .field("largest_gap", &JoinReport::largest_gap)
      .field("rings", &JoinReport::rings)
      .def("changed", &JoinReport::changed)
      .def("to_string", &JoinReport::to_string);
  Record<JoinedChains>(m, "JoinedChains", "Lines joined to rings and chains.")
      .field("data", &JoinedChains::data)
      .field("report", &JoinedChains::report);
  m.def(
      "joined_chains",
      [](const RegionDataArgument& data, double tolerance) { return take(joined_chains(*data, tolerance)); }, "data"_a,
      "tolerance"_a,
      "Polylines joined where their ends meet or are no further apart than the tolerance; closed ones become rings. "
      "Raises Error: out_of_range, malformed.");
}

void bind_region_writers(nb::module_& m) {
  m.def(
      "format_region",
      [](const RegionArgument& region, RegionFormat format) {
        return content_of(format_region(*region, format), format);
      },
      "region"_a, "format"_a, R"doc(The region as text, in gpkg as bytes; coordinates read back as the same doubles.

>>> from dymsum import RegionFormat, format_region
>>> format_region([(0, 0), (0.1, 0), (0, 3)], RegionFormat.wkt)
'POLYGON ((0 0,0.1 0,0 3,0 0))\n'
)doc");
  m.def(
      "write_file", [](const PathArgument& path, const FileContent& text) { take(write_file(path.text, text.bytes)); },
      "path"_a, "text"_a, "Replaces a file as a whole. Raises Error: cannot_write.");
  m.def(
      "check_writable", [](const PathArgument& path) { take(check_writable(path.text)); }, "path"_a,
      "Raises the Error cannot_write that write_file would, as far as can be told without writing.");
  m.def(
      "written_path", [](const PathArgument& path) { return written_path(path.text); }, "path"_a,
      "The file that writing to the path replaces: links are followed.");
  m.def(
      "draw_region", [](const RegionArgument& region) { return draw_region(*region); }, "region"_a,
      "A picture as SVG text.");
}

}  // namespace

void bind_region_io(nb::module_& m) {
  bind_region_readers(m);
  bind_joined_chains(m);
  bind_region_writers(m);
}

}  // namespace dymsum::python
