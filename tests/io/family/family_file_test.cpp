// Families in files: what is read answers as what was written and is written as the same text, anything else is
// refused.
#include "dymsum/family_file.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "dymsum/region_io.h"
#include "dymsum/shapes.h"
#include "io/family/family_text.h"
#include "oracles/coordinate_kinds.h"

namespace dymsum {
namespace {

using FamilyText = nlohmann::json;

Scale scale_of(const char* text) { return Scale::parse(text).value(); }

Region plate_with_slot() {
  RegionData data;
  data.parts.push_back({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{1, 1}, {1, 2}, {3, 2}, {3, 1}}}});
  return Region::create(data).value();
}

ScalingFamily peg_in_plate() {
  FamilyOptions options;
  options.moving = MovingOperand::q;
  options.reflect_q = true;
  return ScalingFamily::create(plate_with_slot(), shapes::rectangle(0, 0, 1, 0.5), scale_of("1"), scale_of("4"),
                               options)
      .value();
}

/// Each at every event, beside it, and in the middle of every cell.
void expect_same_answers(const ScalingFamily& made, const ScalingFamily& read) {
  EXPECT_EQ(read.events(), made.events());
  EXPECT_EQ(read.low(), made.low());
  EXPECT_EQ(read.high(), made.high());
  EXPECT_EQ(read.ratio(), made.ratio());
  EXPECT_EQ(read.work().cells, made.work().cells);
  EXPECT_EQ(read.work().kept, made.work().kept);
  EXPECT_EQ(read.work().visible, made.work().visible);
  const Rational beside = Rational::parse("1e-40").value();
  Rational last = made.low().exact();
  std::vector<Rational> scales{last, made.high().exact()};
  for (const ScaleEvent& e : made.events()) {
    scales.insert(scales.end(), {e.parameter, e.parameter - beside, e.parameter + beside, (last + e.parameter) / 2});
    last = e.parameter;
  }
  for (const Rational& s : scales) {
    if (s < made.low().exact() || s > made.high().exact()) continue;
    const PlanarSum a = made.at(Scale::of(s).value()).value(), b = read.at(Scale::of(s).value()).value();
    EXPECT_TRUE(a == b) << s.to_string();
    EXPECT_EQ(a.at_error, b.at_error) << s.to_string();
    EXPECT_EQ(a.parts.empty(), b.parts.empty());
    for (std::size_t k = 0; k < a.parts.size(); ++k)
      for (std::size_t v = 0; v < a.parts[k].outer.vertices.size(); ++v)
        EXPECT_EQ(a.parts[k].outer.vertices[v].at, b.parts[k].outer.vertices[v].at);
  }
  EXPECT_EQ(made.lifetimes().ok(), read.lifetimes().ok());
  if (!made.lifetimes()) return;
  EXPECT_EQ(made.lifetimes().value(), read.lifetimes().value());
  EXPECT_TRUE(made.inner(made.low(), made.high()).value() == read.inner(made.low(), made.high()).value());
  EXPECT_TRUE(made.outer(made.low(), made.high()).value() == read.outer(made.low(), made.high()).value());
}

void expect_kept_in_a_file(const ScalingFamily& made) {
  const std::string text = format_family(made);
  const Result<ScalingFamily> read = parse_family(text, "memory");
  ASSERT_TRUE(read.ok()) << read.error().to_string();
  expect_same_answers(made, *read);
  EXPECT_EQ(format_family(*read), text);
}

TEST(FamilyFile, what_is_read_is_what_was_written) {
  expect_kept_in_a_file(peg_in_plate());
  const Region star = shapes::noisy_star(20, 0.7, 3), gear = shapes::gear(5, 0.25, 0.375, 0.03125);
  for (const CoordinateKind kind : kCoordinateKinds) {
    SCOPED_TRACE(name_of(kind));
    std::mt19937_64 noise(7);
    const Result<Region> p = Region::create(of_kind(star.data(), kind, noise)),
                         q = Region::create(of_kind(gear.data(), kind, noise));
    if (!p || !q) continue;
    FamilyOptions options;
    options.semantics = kind == kCoordinateKinds[0] ? Semantics::open : Semantics::closed;
    const Scale ratio = kind == kCoordinateKinds[1] ? scale_of("7/3") : Scale();
    expect_kept_in_a_file(ScalingFamily::create(*p, *q, scale_of("9/10"), scale_of("6/5"), ratio, options).value());
  }
}

TEST(FamilyFile, of_polylines_and_points_is_read) {
  const Region wire =
      Region::create({{}, {{{0, 0}, {1.5, 0.25}, {1, 1.25}}, {{-1, -0.5}, {-0.75, 1}}}, {{2, 2}, {-2, 1}}}).value();
  expect_kept_in_a_file(ScalingFamily::create(plate_with_slot(), wire, scale_of("1/2"), scale_of("2")).value());
  const ScalingFamily wires = ScalingFamily::create(wire, wire, scale_of("2/3"), scale_of("3/2")).value();
  expect_kept_in_a_file(wires);
  EXPECT_FALSE(wires.at(scale_of("4/5")).value().points.empty()) << "sums of two points are in the file";
}

TEST(FamilyFile, of_few_kept_cells_and_of_one_cell_is_read) {
  FamilyOptions options;
  options.structure_bytes = 1500;
  const Region star = shapes::star(5, 1, 2), other = shapes::star(4, 1, 2);
  const ScalingFamily few = ScalingFamily::create(star, other, scale_of("1/2"), scale_of("2"), options).value();
  EXPECT_GT(few.work().kept, 0u);
  EXPECT_LT(few.work().kept, few.work().cells);
  expect_kept_in_a_file(few);
  expect_kept_in_a_file(ScalingFamily::create(star, other, scale_of("1/3"), scale_of("1/3")).value());
  expect_kept_in_a_file(ScalingFamily::create(star, Region(), scale_of("1/3"), scale_of("2/3")).value());
}

TEST(FamilyFile, compressed_is_read) {
  const std::string path = (std::filesystem::temp_directory_path() / "dymsum_family_test.family.gz").string();
  ASSERT_TRUE(write_file(path, format_family(peg_in_plate())).ok());
  const Result<ScalingFamily> read = read_family(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(read.ok()) << read.error().to_string();
  expect_same_answers(peg_in_plate(), *read);
  EXPECT_EQ(read_family("/no/such/file").error().code, ErrorCode::cannot_open);
}

TEST(FamilyFile, a_file_that_ends_too_early_or_was_changed_is_refused) {
  const std::string text = format_family(peg_in_plate());
  for (std::size_t n = 0; n + 2 < text.size(); n += n < 200 ? 1 : 97) {
    const Result<ScalingFamily> read = parse_family(std::string_view(text).substr(0, n), "cut.family");
    ASSERT_FALSE(read.ok()) << n;
    EXPECT_EQ(read.error().code, ErrorCode::truncated) << n << ": " << read.error().to_string();
    EXPECT_EQ(read.error().evidence.file, "cut.family");
  }
  for (std::size_t k = 0; k < text.size(); k += 7) {
    if (text[k] == '\n' || text[k] == ' ') continue;
    std::string changed = text;
    changed[k] = text[k] == '1' ? '2' : '1';
    EXPECT_FALSE(parse_family(changed, "changed").ok()) << k << " " << text.substr(k, 20);
  }
}

Result<ScalingFamily> with_entry(const char* at, const FamilyText& value) {
  static const FamilyText file = FamilyText::parse(format_family(peg_in_plate()));
  FamilyText other = file;
  other["content"][FamilyText::json_pointer(at)] = value;
  other["checksum"] = io::checksum(other["content"]);
  return parse_family(other.dump(), "f");
}

// Also where the checksum is that of the changed content.
TEST(FamilyFile, an_entry_that_cannot_be_one_is_refused) {
  EXPECT_TRUE(with_entry("/options/structure_bytes", 1000000).ok());
  const FamilyText none = FamilyText::array();
  const std::vector<std::pair<const char*, FamilyText>> changes = {
      {"/motion", "rotation"},
      {"/p", none},
      {"/p/0/0/0", nullptr},
      {"/low", "5/1"},
      {"/low", "2/2"},
      {"/low", 1},
      {"/high", "3/2"},
      {"/high", "0/1"},
      {"/ratio", "1/0"},
      {"/ratio", "1/99999999999999"},
      {"/options/moving", "r"},
      {"/options/reflect_q", 2},
      {"/options/structure_bytes", -1},
      {"/events", none},
      {"/events/0/0", "4/2"},
      {"/events/1", FamilyText::array({"2/1", 0, 1, 1})},
      {"/events/0/0", "99/1"},
      {"/events/0/1", 99},
      {"/events/0/2", 2},
      {"/names", none},
      {"/names/0", none},
      {"/names/0/0", 2},
      {"/names/0/1", 4000},
      {"/names/0/2", 4000},
      {"/names/0/6", 3},
      {"/names/0/7", 4000},
      {"/names/0", FamilyText::array({0, 0, 0, 0, 0, 1})},
      {"/cells", none},
      {"/cells/0", none},
      {"/cells/0/0", "x"},
      {"/cells/0/0", 0},
      {"/cells/0/1/0", none},
      {"/cells/0/1/0/0", none},
      {"/cells/0/1/0/0", FamilyText::array({1, 0, 0, 0, 1})},
      {"/cells/0/1/0/0/1", 1},
      {"/cells/0/1/0/0/3", 4000},
      {"/cells/1/1/0/0/2", 4000},
      {"/cells/0/2", none},
      {"/cells/0/2/0", 1},
      {"/cells/0/2", FamilyText::array({0, 0, 0, 0, 0})}};
  for (const auto& [at, value] : changes) {
    const Result<ScalingFamily> read = with_entry(at, value);
    ASSERT_FALSE(read.ok()) << at << " " << value;
    EXPECT_EQ(read.error().evidence.file, "f") << at;
  }
}

// Structures that are none give sums that are none, and nothing worse.
TEST(FamilyFile, forged_structures_end_no_program) {
  const FamilyText file = FamilyText::parse(format_family(peg_in_plate()));
  const std::size_t names = file["content"]["names"].size();
  std::mt19937_64 random(11);
  for (int round = 0; round < 200; ++round) {
    FamilyText ring = FamilyText::array({1, 0, 0});
    for (int k = 0; k < 3 + round % 9; ++k) ring.push_back(random() % names);
    const FamilyText parts = FamilyText::array({FamilyText::array({ring, ring}), FamilyText::array({ring})});
    const Result<ScalingFamily> read = with_entry("/cells/0/1", parts);
    if (!read) continue;  // what a later cell keeps of the ring may not be there
    for (const char* s : {"1", "3/2", "2", "3"}) EXPECT_TRUE(read->at(scale_of(s)).ok());
    EXPECT_TRUE(read->lifetimes().ok());
    static_cast<void>(read->inner(scale_of("1"), scale_of("3")));
  }
}

TEST(FamilyFile, other_texts_and_versions_are_refused) {
  EXPECT_EQ(parse_family("", "f").error().code, ErrorCode::truncated);
  EXPECT_EQ(parse_family(R"({"format":"dymsum obstacle","version":1})", "f").error().code, ErrorCode::malformed);
  EXPECT_NE(parse_family(R"({"format":"dymsum family","version":2})", "f").error().message.find("version 2"),
            std::string::npos);
}

}  // namespace
}  // namespace dymsum
