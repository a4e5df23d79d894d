// GeoPackages: what is read of databases made by SQL, what is written, and what is refused.
#include "io/region/gpkg.h"

#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <random>

#include "dymsum/planar_sum.h"
#include "dymsum/shapes.h"
#include "io/bytes.h"
#include "io/reading.h"
#include "io/region/database.h"
#include "io/region/read_shapes.h"
#include "io/region/write_wkb.h"
#include "oracles/coordinate_kinds.h"

namespace dymsum::io_test::gpkg {
namespace {

constexpr RegionFormat kGpkg = RegionFormat::gpkg;

std::string hex(std::string_view bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const char c : bytes) {
    text += kDigits[static_cast<unsigned char>(c) >> 4];
    text += kDigits[static_cast<unsigned char>(c) & 15];
  }
  return text;
}

/// A geometry's header without a box, with these flags, before WKB.
std::string blob(const std::string& wkb, unsigned flags = 1) {
  std::string bytes("GP\0", 3);
  bytes += static_cast<char>(flags);
  return bytes + std::string(4, '\0') + wkb;
}
std::string wkb_of(const RegionData& data) {
  std::string bytes;
  io::append_wkb(bytes, data);
  return bytes;
}
RegionData triangle(double x) { return {{{{{x, 0}, {x + 1, 0}, {x, 1}}, {}}}, {}, {}}; }

const std::string kTables =
    "CREATE TABLE gpkg_contents (table_name TEXT, data_type TEXT);"
    "CREATE TABLE gpkg_geometry_columns (table_name TEXT, column_name TEXT);";

/// Between such quotation marks.
std::string doubled(const std::string& name, char mark) {
  std::string quoted(1, mark);
  for (const char c : name) quoted.append(c == mark ? 2 : 1, c);
  return quoted + mark;
}

std::string registered(const std::string& name, const std::string& column = "geom") {
  return "INSERT INTO gpkg_contents VALUES (" + doubled(name, '\'') + ", 'features');" +
         "INSERT INTO gpkg_geometry_columns VALUES (" + doubled(name, '\'') + ", " + doubled(column, '\'') + ");";
}
std::string layer(const std::string& name) {
  return registered(name) + "CREATE TABLE \"" + name + "\" (fid INTEGER PRIMARY KEY, name TEXT, geom BLOB);";
}
std::string row(const std::string& table, int fid, const std::string& bytes) {
  return "INSERT INTO \"" + table + "\" (fid, geom) VALUES (" + std::to_string(fid) + ", x'" + hex(bytes) + "');";
}
std::string row(const std::string& table, int fid, const RegionData& data) {
  return row(table, fid, blob(wkb_of(data)));
}

std::string database(const std::string& statements) {
  io::Database made;
  made.run(statements.c_str());
  return made.bytes();
}

/// Two layers, one of which has several rows.
std::string towns_and_a_road() {
  return database(kTables + layer("towns") + row("towns", 3, triangle(0)) + row("towns", 7, triangle(5)) +
                  layer("roads") + row("roads", 1, RegionData{{}, {{{0, 0}, {1, 1}}}, {}}) +
                  "INSERT INTO gpkg_contents VALUES ('picture', 'tiles')");
}

void save(const std::string& path, std::string_view bytes) { std::ofstream(path, std::ios::binary) << bytes; }

void refused(const std::string& bytes, ErrorCode code, std::string_view words) {
  expect_refused(bytes, kGpkg, code, 0, words);
}
void refused_row(const std::string& bytes, ErrorCode code, std::string_view words) {
  refused(database(kTables + layer("towns") + row("towns", 3, triangle(0)) + row("towns", 4, bytes)), code,
          "layer 'towns', row 4: " + std::string(words));
}

TEST(Gpkg, rows_of_all_layers_are_shapes) {
  const auto shapes = read_all(towns_and_a_road(), kGpkg);
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_EQ(shapes[0].name, "roads/1");
  EXPECT_EQ(shapes[0].data, (RegionData{{}, {{{0, 0}, {1, 1}}}, {}}));
  EXPECT_EQ(shapes[1].name, "towns/3");
  EXPECT_EQ(shapes[1].data, triangle(0));
  EXPECT_EQ(shapes[2].name, "towns/7");
  EXPECT_EQ(shapes[2].data, triangle(5));
}

TEST(Gpkg, a_layer_or_a_row_is_selected) {
  const Folder folder("gpkg");
  const std::string path = folder / "map.gpkg";
  save(path, towns_and_a_road());
  EXPECT_EQ(read_region_data(path + "#towns/7").value(), triangle(5));
  EXPECT_EQ(read_region_data(path + "#roads").value().polylines.size(), 1u);
  const NamedShape towns = read_shape(path + "#towns").value();
  EXPECT_EQ(towns.name, "towns");
  RegionData both = triangle(0);
  both.parts.push_back(triangle(5).parts[0]);
  EXPECT_EQ(towns.data, both);
  EXPECT_EQ(read_shape(path + "#1").value().name, "towns/3") << "by its index";
  const auto says = [&](const std::string& selected, std::string_view words) {
    const auto read = read_shape(path + selected);
    ASSERT_FALSE(read.ok()) << selected;
    EXPECT_EQ(read.error().code, ErrorCode::malformed);
    EXPECT_EQ(read.error().evidence.file, path);
    EXPECT_NE(read.error().message.find(words), std::string::npos) << read.error().to_string();
  };
  says("", "holds 3 shapes: select one as in " + path + "#roads/1, or all of a layer as in " + path +
               "#roads; its layers, with their rows: roads (1), towns (2)");
  says("#rivers", "no layer 'rivers': there are roads, towns");
  says("#", "no layer '': there are roads, towns");
  says("#towns/4", "the layer 'towns' has no row '4'");
  says("#towns/07", "has no row '07'");
  says("#3", "no shape '3' among 3");
}

TEST(Gpkg, of_many_layers_the_first_are_listed) {
  const Folder folder("gpkg");
  const std::string path = folder / "map.gpkg";
  std::string statements = kTables;
  for (int k = 100; k < 123; ++k)
    statements += layer("l" + std::to_string(k) + "\n") + row("l" + std::to_string(k) + "\n", 1, triangle(k));
  save(path, database(statements));
  const auto ends = [](const std::string& message, std::string_view words) {
    EXPECT_TRUE(message.ends_with(words)) << message;
  };
  ends(read_shape(path).error().message, ", l119? (1) and 3 more");
  ends(read_shape(path + "#none").error().message,
       "there are l100?, " + std::string("l101?, l102?, l103?, l104?, l105?, l106?, l107?, l108?, l109?, l110?, l111?, "
                                         "l112?, l113?, l114?, l115?, l116?, l117?, l118?, l119? and 3 more"));
}

TEST(Gpkg, what_is_not_selected_is_not_read) {
  const Folder folder("gpkg");
  const std::string path = folder / "map.gpkg";
  save(path, database(kTables + layer("bad") + row("bad", 1, "none") + layer("good") + row("good", 1, triangle(0)) +
                      row("good", 2, "none")));
  EXPECT_EQ(read_region_data(path + "#good/1").value(), triangle(0));
  EXPECT_FALSE(read_region_data(path + "#good").ok());
  EXPECT_FALSE(read_shapes(path).ok());
}

TEST(Gpkg, a_layer_without_its_table_hides_no_other) {
  const Folder folder("gpkg");
  const std::string path = folder / "map.gpkg";
  save(path, database(kTables + registered("gone") + layer("towns") + row("towns", 3, triangle(0))));
  EXPECT_EQ(read_region_data(path).value(), triangle(0));
  EXPECT_EQ(read_region_data(path + "#towns").value(), triangle(0));
  for (const char* selected : {"#gone", "#gone/1"})
    EXPECT_NE(read_shape(path + selected).error().message.find("'gone' names a table that is not there"),
              std::string::npos);
  EXPECT_NE(read_shape(path + "#rivers").error().message.find("gone (whose table is not there), towns"),
            std::string::npos);
}

TEST(Gpkg, tables_without_row_numbers_are_counted) {
  const auto shapes =
      read_all(database(kTables + registered("towns") +
                        "CREATE TABLE towns (code TEXT PRIMARY KEY, fid INTEGER, geom BLOB) WITHOUT ROWID;" +
                        "INSERT INTO towns VALUES ('x', 7, NULL);" + "INSERT INTO towns VALUES ('y', 5, x'" +
                        hex(blob(wkb_of(triangle(5)))) + "');"),
               kGpkg);
  ASSERT_EQ(shapes.size(), 2u);
  EXPECT_EQ(shapes[0].name, "towns/1");
  EXPECT_EQ(shapes[1].name, "towns/2");
  EXPECT_EQ(shapes[1].data, triangle(5));
}

TEST(Gpkg, marks_in_the_names_of_layers_select_none) {
  const Folder folder("gpkg");
  const std::string path = folder / "map#1.gpkg";
  save(path, database(kTables + layer("no #1") + row("no #1", 3, triangle(0)) + layer("#") + row("#", 1, triangle(5)) +
                      layer("#/#") + row("#/#", 2, triangle(7))));
  EXPECT_EQ(read_region_data(path + "#no #1").value(), triangle(0));
  EXPECT_EQ(read_region_data(path + "#no #1/3").value(), triangle(0));
  EXPECT_EQ(read_region_data(path + "##").value(), triangle(5));
  EXPECT_EQ(read_region_data(path + "##/1").value(), triangle(5));
  EXPECT_EQ(read_region_data(path + "##/#").value(), triangle(7));
  EXPECT_EQ(read_region_data(path + "##/#/2").value(), triangle(7));
}

TEST(Gpkg, names_of_tables_are_never_statements) {
  for (const std::string name : {"two words", "semi;colon", "quo\"te", "SELECT", "x\" UNION SELECT 1, x'00' --", "a/b",
                                 "\xC3\xB6sterreich", "[brackets]", "%s"}) {
    const std::string quoted = doubled(name, '"');
    const std::string bytes =
        database(kTables + registered(name, name) + "CREATE TABLE " + quoted + " (fid INTEGER PRIMARY KEY, " + quoted +
                 " BLOB); INSERT INTO " + quoted + " VALUES (5, x'" + hex(blob(wkb_of(triangle(0)))) + "')");
    const auto shapes = read_all(bytes, kGpkg);
    ASSERT_EQ(shapes.size(), 1u) << name;
    EXPECT_EQ(shapes[0].name, name + "/5");
    EXPECT_EQ(shapes[0].data, triangle(0));
    const Folder folder("gpkg");
    save(folder / "a.gpkg", bytes);
    EXPECT_EQ(read_region_data((folder / "a.gpkg#") + name + "/5").value(), triangle(0)) << name;
    EXPECT_EQ(read_region_data((folder / "a.gpkg#") + name).value(), triangle(0)) << name;
  }
}

TEST(Gpkg, a_column_that_is_not_there_is_no_text) {
  refused(database(kTables + registered("towns", "shape") + "CREATE TABLE towns (fid INTEGER PRIMARY KEY, geom BLOB);" +
                   row("towns", 1, triangle(0))),
          ErrorCode::malformed, "no such column");
}

TEST(Gpkg, every_kind_of_header) {
  const std::string box(64, '\x7f');
  const std::size_t sizes[] = {0, 32, 48, 48, 64};
  for (unsigned kind = 0; kind < 5; ++kind)
    for (const unsigned order : {0U, 1U}) {
      const std::string bytes = blob(box.substr(0, sizes[kind]) + wkb_of(triangle(kind)), order | kind << 1);
      EXPECT_EQ(read_one(database(kTables + layer("a") + row("a", 1, bytes)), kGpkg), triangle(kind));
      if (kind > 0)
        refused_row(blob(box.substr(0, sizes[kind] - 1), order | kind << 1), ErrorCode::truncated,
                    "the geometry ends before its box does");
    }
  const std::string empty = wkb_of({});
  EXPECT_EQ(read_one(database(kTables + layer("a") + row("a", 1, blob(empty, 17))), kGpkg), RegionData{});
}

TEST(Gpkg, wrong_geometries_are_named_by_layer_and_row) {
  const std::string good = blob(wkb_of(triangle(0)));
  refused_row("", ErrorCode::truncated, "the geometry has 0 bytes, and its header 8");
  refused_row(good.substr(0, 7), ErrorCode::truncated, "the geometry has 7 bytes");
  refused_row("PG" + good.substr(2), ErrorCode::malformed, "the geometry does not begin with GP");
  std::string other = good;
  other[2] = '\xff';
  refused_row(other, ErrorCode::malformed, "the geometry has the version 255 of its format");
  refused_row(blob(wkb_of(triangle(0)), 0x21), ErrorCode::malformed, "the geometry is of an extension");
  for (const unsigned kind : {5U, 6U, 7U})
    refused_row(blob(wkb_of(triangle(0)), 1 | kind << 1), ErrorCode::malformed,
                "the box of the geometry is of the kind " + std::to_string(kind));
  refused_row(good.substr(0, 8), ErrorCode::truncated, "the geometry ends before its byte order");
  refused_row(good.substr(0, good.size() - 1), ErrorCode::truncated, "the geometry announces 4 points");
  refused_row(blob(std::string("\x01\xe9\x03\0\0", 5)), ErrorCode::malformed, "coordinates with Z are not planar");
  refused_row(blob(std::string("\x01\x10\0\0\0", 5)), ErrorCode::malformed, "a TIN is no point, line or polygon");
  refused(database(kTables + layer("towns") + "INSERT INTO towns VALUES (9, '', 'POINT (1 1)')"), ErrorCode::malformed,
          "layer 'towns', row 9: the geometry is no blob");
}

TEST(Gpkg, third_coordinates_are_left_out_where_that_is_asked_for) {
  std::string wkb("\x01\xe9\x03\0\0", 5);
  for (const double v : {1.0, 2.0, 3.0}) io::append_bytes(wkb, v);
  const std::string bytes = database(kTables + layer("a") + row("a", 1, blob(wkb)));
  const auto shapes = parse_shapes(bytes, kGpkg, "a", {ThirdCoordinates::dropped, {}});
  ASSERT_TRUE(shapes.ok()) << shapes.error().to_string();
  EXPECT_EQ(shapes->at(0).data, (RegionData{{}, {}, {{1, 2}}}));
}

TEST(Gpkg, a_row_without_geometry_is_empty) {
  EXPECT_EQ(read_one(database(kTables + layer("a") + "INSERT INTO a (fid) VALUES (1)"), kGpkg), RegionData{});
  EXPECT_EQ(read_all(database(kTables + layer("a")), kGpkg).size(), 0u);
}

TEST(Gpkg, arcs_become_chords) {
  std::string wkb("\x01\x08\0\0\0\x03\0\0\0", 9);
  for (const double v : {1.0, 0.0, 0.0, 1.0, -1.0, 0.0}) io::append_bytes(wkb, v);
  const auto shapes = read_all(database(kTables + layer("a") + row("a", 1, blob(wkb))), kGpkg);
  ASSERT_EQ(shapes.size(), 1u);
  EXPECT_EQ(shapes[0].data, read_one("CIRCULARSTRING (1 0, 0 1, -1 0)", RegionFormat::wkt));
  EXPECT_EQ(shapes[0].curves, 1u);
}

// Databases that are none, damaged or hostile.

TEST(Gpkg, what_is_no_geopackage_is_refused) {
  refused("", ErrorCode::truncated, "is an SQLite database, and this is none");
  refused("POLYGON ((0 0, 1 0, 0 1, 0 0))", ErrorCode::malformed, "is an SQLite database, and this is none");
  refused(std::string("SQLite format 3\0rest", 20), ErrorCode::truncated, "ends in the header");
  refused(database("CREATE TABLE a (b)"), ErrorCode::malformed, "is no GeoPackage with layers");
  refused(database(kTables), ErrorCode::malformed, "the file has no layer of geometries");
  refused(database(kTables + registered("gone")), ErrorCode::malformed,
          "the layer 'gone' names a table that is not there");
  refused(database(kTables + registered("sqlite_master", "sql")), ErrorCode::malformed, "is not there");
  refused(database(kTables + registered("pragma_function_list", "name")), ErrorCode::malformed, "is not there");
  refused(database("CREATE TABLE gpkg_contents (a); CREATE TABLE gpkg_geometry_columns (b)"), ErrorCode::malformed,
          "the database cannot be read: no such column");
}

TEST(Gpkg, views_are_layers_and_their_rows_are_counted) {
  const auto shapes = read_all(
      database(kTables + layer("towns") + row("towns", 3, triangle(0)) + row("towns", 9, triangle(5)) +
               registered("some") + "CREATE VIEW some AS SELECT upper(name) AS n, geom FROM towns WHERE fid > 5"),
      kGpkg);
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_EQ(shapes[0].name, "some/1");
  EXPECT_EQ(shapes[0].data, triangle(5));
}

TEST(Gpkg, what_views_may_do_is_limited) {
  const std::string towns = kTables + layer("towns") + row("towns", 1, triangle(0));
  const auto view = [&](const std::string& select, std::string_view words) {
    refused(database(towns + registered("v") + "CREATE VIEW v AS " + select), ErrorCode::malformed, words);
  };
  view("WITH RECURSIVE r(geom) AS (SELECT x'00' UNION ALL SELECT geom FROM r) SELECT geom FROM r", "is recursive");
  view("SELECT zeroblob(1000000000) AS geom", "a view calls the function zeroblob");
  view("SELECT randomblob(8) AS geom", "a view calls the function randomblob");
  view("SELECT load_extension('x') AS geom", "unsafe use of load_extension()");
  view("SELECT replace(geom, 'a', 'b') AS geom FROM towns", "a view calls the function replace");
  view("SELECT unknown(geom) AS geom FROM towns", "no such function: unknown");
  view("SELECT sql AS geom FROM sqlite_master", "the geometry is no blob");
  view("SELECT geom FROM v2", "no such table: main.v2");
  view("SELECT geom FROM v", "circularly defined");
  // 60^6 rows
  std::string many = towns + "CREATE TABLE n (a);";
  for (int k = 0; k < 60; ++k) many += "INSERT INTO n VALUES (1);";
  const auto crossed = [&](const std::string& select, std::string_view words) {
    refused(database(many + registered("v") + "CREATE VIEW v AS " + select), ErrorCode::malformed, words);
  };
  crossed(
      "SELECT NULL AS geom FROM n, n AS b, n AS c, n AS d, n AS e, n AS f WHERE n.a + b.a + c.a + d.a + e.a + f.a = 7",
      "takes more steps to read");
  crossed("SELECT geom FROM towns, n, n AS b, n AS c, n AS d, n AS e", "larger than the file");
  std::string large = kTables + "CREATE TABLE towns (fid INTEGER PRIMARY KEY, geom BLOB);" +
                      row("towns", 1, blob(std::string(1'000'000, '\1')));
  for (int k = 0; k < 60; ++k)
    large += (k == 0 ? "CREATE TABLE n (a);" : "") + std::string("INSERT INTO n VALUES (1);");
  refused(
      database(
          large + registered("v") +
          "CREATE VIEW v AS SELECT geom || n.rowid || b.rowid AS geom FROM towns, n, n AS b ORDER BY 1 LIMIT 100000"),
      ErrorCode::malformed, "takes more memory to read");
}

TEST(Gpkg, triggers_and_checks_of_strangers_do_nothing) {
  EXPECT_EQ(read_one(database(kTables + layer("a") + row("a", 1, triangle(0)) +
                              "CREATE TABLE log (x CHECK (length(x) > 3));"
                              "CREATE TRIGGER t AFTER UPDATE ON a BEGIN INSERT INTO log VALUES (1); END;"
                              "CREATE VIRTUAL TABLE rtree_a USING rtree(id, minx, maxx, miny, maxy);"),
                     kGpkg),
            triangle(0));
}

TEST(Gpkg, cut_files_are_truncated) {
  const std::string whole = towns_and_a_road();
  for (std::size_t size = 0; size < whole.size(); size += size < 200 ? 1 : 997)
    EXPECT_FALSE(parse_shapes(whole.substr(0, size), kGpkg, "cut").ok()) << size;
  refused(whole.substr(0, whole.size() - 1), ErrorCode::truncated,
          "its header announces " + std::to_string(whole.size()));
}

TEST(Gpkg, damaged_files_are_refused_or_read) {
  const std::string whole = towns_and_a_road();
  std::size_t read = 0, refusals = 0;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    std::mt19937_64 random(seed);
    std::string bytes = whole;
    // Most of it are zeros: where something is, or the heads of pages.
    for (int changes = 1 + int(random() % 4); changes > 0; --changes) {
      std::size_t at = random() % bytes.size();
      if (random() % 2 == 0) at = at / 4096 * 4096 + random() % 16;
      else
        while (bytes[at] == 0) at = random() % bytes.size();
      bytes[at] = static_cast<char>(random());
    }
    const auto shapes = parse_shapes(bytes, kGpkg, "damaged");
    if (shapes) {
      ++read;
      continue;
    }
    ++refusals;
    const Error& error = shapes.error();
    EXPECT_EQ(error.evidence.file, "damaged") << seed;
    EXPECT_TRUE(error.code == ErrorCode::malformed || error.code == ErrorCode::truncated ||
                error.code == ErrorCode::not_finite)
        << seed << " " << error.to_string();
  }
  EXPECT_GT(read, 100u);
  EXPECT_GT(refusals, 100u);
}

TEST(Gpkg, a_file_that_another_program_is_writing_is_refused) {
  const Folder folder("gpkg");
  const std::string path = folder / "a.gpkg";
  std::string bytes = database(kTables + layer("a") + row("a", 1, triangle(0)));
  bytes[18] = bytes[19] = 2;  // with a journal of what is to be written, as QGIS leaves files
  save(path, bytes);
  EXPECT_EQ(read_region_data(path).value(), triangle(0));
  save(path + "-wal", "");
  EXPECT_EQ(read_region_data(path).value(), triangle(0));
  for (const std::string more : {"-wal", "-journal"}) {
    save(path + more, "changes");
    const auto read = read_region_data(path);
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.error().code, ErrorCode::cannot_open);
    EXPECT_NE(read.error().message.find(path + more + " holds changes"), std::string::npos);
    std::filesystem::remove(path + more);
  }
}

// Written.

TEST(Gpkg, regions_read_back_bit_for_bit_as_from_wkt) {
  std::mt19937_64 random(3);
  for (const CoordinateKind kind : kCoordinateKinds)
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      RegionData data = (seed % 2 == 0 ? shapes::grate(3, 2, 0.5, 5) : shapes::random_polygon(40, 2, seed)).data();
      const auto moved = [&](std::vector<Point>& points) {
        for (Point& p : points) {
          const Point3 at = of_kind(Point3{p.x, p.y, 0}, kind, random);
          p = {at.x, at.y};
        }
      };
      for (Part& part : data.parts) {
        moved(part.outer);
        for (Ring& hole : part.holes) moved(hole);
      }
      if (seed % 3 == 0) data.polylines.push_back({{1.5, -2}, {1e-300, 4e300}});
      if (seed % 4 == 0) data.points.push_back({-0x1p-1074, 0.1});
      const RegionData from_wkt = read_one(io::format_region_data(data, RegionFormat::wkt), RegionFormat::wkt);
      const std::string bytes = io::format_region_data(data, kGpkg);
      const RegionData back = read_one(bytes, kGpkg);
      ASSERT_EQ(back, from_wkt) << name_of(kind) << ", seed " << seed;
      ASSERT_EQ(io::format_region_data(data, kGpkg), bytes) << "the same region, the same bytes";
      ASSERT_EQ(io::format_region_data(back, kGpkg), io::format_region_data(from_wkt, kGpkg));
    }
}

TEST(Gpkg, nothing_and_the_smallest_things_read_back) {
  for (const RegionData& data : {RegionData{}, RegionData{{}, {}, {{1, 2}}}, RegionData{{}, {}, {{1, 2}, {-3, 4}}},
                                 RegionData{{}, {{{0, 0}, {1, 0}}}, {}}, triangle(0)})
    EXPECT_EQ(read_one(io::format_region_data(data, kGpkg), kGpkg), data);
}

TEST(Gpkg, what_is_written_is_a_geopackage) {
  const Region region = shapes::grate(3, 2, 0.5, 5);
  const std::string bytes = format_region(region, kGpkg);
  EXPECT_EQ(bytes.substr(68, 4), "GPKG");
  EXPECT_EQ(io::from_bytes<std::uint32_t>(bytes, 60, std::endian::big), 10200u);
  io::Database database(bytes);
  io::Query systems(database, "SELECT srs_id FROM gpkg_spatial_ref_sys ORDER BY srs_id");
  for (const int id : {-1, 0, 4326}) {
    ASSERT_TRUE(systems.next());
    EXPECT_EQ(systems.integer(0), id);
  }
  EXPECT_FALSE(systems.next());
  io::Query contents(database,
                     "SELECT c.data_type, c.srs_id, g.geometry_type_name, g.z, g.m, c.last_change, c.min_x, c.min_y, "
                     "c.max_x, c.max_y FROM gpkg_contents AS c JOIN gpkg_geometry_columns AS g ON g.table_name = "
                     "c.table_name AND g.srs_id = c.srs_id WHERE c.table_name = 'region' AND g.column_name = 'geom'");
  ASSERT_TRUE(contents.next());
  EXPECT_EQ(contents.text(0), "features");
  EXPECT_EQ(contents.integer(1), -1);
  EXPECT_EQ(contents.text(2), "POLYGON");
  EXPECT_EQ(contents.integer(3) + contents.integer(4), 0);
  EXPECT_EQ(contents.text(5), "1970-01-01T00:00:00.000Z");
  const std::array<double, 4> box = bounds(region);
  EXPECT_EQ(contents.number(6), box[0]);
  EXPECT_EQ(contents.number(7), box[1]);
  EXPECT_EQ(contents.number(8), box[2]);
  EXPECT_EQ(contents.number(9), box[3]);
  EXPECT_FALSE(contents.next());
  io::Query rows(database, "SELECT fid, geom FROM region");
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.integer(0), 1);
  const std::string geometry(rows.blob(1));
  EXPECT_EQ(geometry.substr(0, 8), std::string("GP\0\3\xff\xff\xff\xff", 8))
      << "with a box of the plane, little-endian";
  const double sides[] = {box[0], box[2], box[1], box[3]};
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(io::from_bytes<double>(geometry, 8 + 8 * k, std::endian::little), sides[k]);
  EXPECT_EQ(geometry.substr(40), wkb_of(region.data()));
  EXPECT_FALSE(rows.next());
}

TEST(Gpkg, the_kind_of_geometry_is_said) {
  const auto kind_of = [](const RegionData& data) {
    const std::string bytes = io::format_region_data(data, kGpkg);
    io::Database database(bytes);
    io::Query query(database, "SELECT geometry_type_name FROM gpkg_geometry_columns");
    EXPECT_TRUE(query.next());
    return query.text(0);
  };
  RegionData two = triangle(0);
  two.parts.push_back(triangle(5).parts[0]);
  const Polyline line{{0, 0}, {1, 1}};
  EXPECT_EQ(kind_of(triangle(0)), "POLYGON");
  EXPECT_EQ(kind_of(two), "MULTIPOLYGON");
  EXPECT_EQ(kind_of({{}, {line}, {}}), "LINESTRING");
  EXPECT_EQ(kind_of({{}, {line, line}, {}}), "MULTILINESTRING");
  EXPECT_EQ(kind_of({{}, {}, {{1, 2}}}), "POINT");
  EXPECT_EQ(kind_of({{}, {}, {{1, 2}, {3, 4}}}), "MULTIPOINT");
  EXPECT_EQ(kind_of({triangle(0).parts, {line}, {}}), "GEOMETRYCOLLECTION");
  EXPECT_EQ(kind_of({}), "GEOMETRYCOLLECTION");
}

TEST(Gpkg, sums_with_tight_features_are_one_row_and_the_same_closed_set) {
  const Region slot =
      Region::create({{{{{0, 0}, {4, 0}, {4, 3}, {0, 3}}, {{{1, 1}, {1, 2}, {3, 2}, {3, 1}}}}}, {}, {}}).value();
  const PlanarSum sum = nfp(slot, shapes::rectangle(0, 0, 1, 1)).value();
  ASSERT_FALSE(sum.tight_segments.empty());
  const Region rounded = sum.rounded().value();
  EXPECT_EQ(read_one(format_sum(sum, rounded, kGpkg), kGpkg),
            read_one(format_sum(sum, rounded, RegionFormat::wkt), RegionFormat::wkt));
}

TEST(Gpkg, a_compressed_file_is_read_and_written) {
  const Folder folder("gpkg");
  const Region region = shapes::grate(3, 2, 0.5, 5);
  ASSERT_TRUE(write_file(folder / "a.gpkg.gz", format_region(region, kGpkg)).ok());
  EXPECT_EQ(read_region_data(folder / "a.gpkg.gz").value(), region.data());
  EXPECT_EQ(region_format("a.gpkg.gz#region").value(), kGpkg);
}

}  // namespace
}  // namespace dymsum::io_test::gpkg
