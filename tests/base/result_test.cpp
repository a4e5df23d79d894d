#include "dymsum/result.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace dymsum {
namespace {

TEST(Result, HoldsAValueOrAnError) {
  const Result<int> good = 7;
  ASSERT_TRUE(good.ok());
  EXPECT_EQ(*good, 7);
  const Result<int> bad = Error{ErrorCode::truncated, "the file ends early", {}};
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, ErrorCode::truncated);
  try {
    (void)bad.value();
    FAIL() << "value() of an error must throw";
  } catch (const std::logic_error& e) {
    EXPECT_NE(std::string(e.what()).find("the file ends early"), std::string::npos);
  }
}

TEST(Result, OfNothingIsDoneOrAnError) {
  const Result<void> done, failed = Error{ErrorCode::cannot_write, "the disk is full", {}};
  EXPECT_TRUE(done.ok());
  EXPECT_NO_THROW(done.value());
  EXPECT_THROW((void)done.error(), std::logic_error);
  EXPECT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().code, ErrorCode::cannot_write);
  EXPECT_THROW(failed.value(), std::logic_error);
}

TEST(Result, HasNoErrorBesideAValue) { EXPECT_THROW((void)Result<int>(1).error(), std::logic_error); }

TEST(ErrorCode, EveryCodeHasItsOwnName) {
  std::set<std::string_view> names;
  for (int i = 0; i <= static_cast<int>(ErrorCode::out_of_memory); ++i) names.insert(name(static_cast<ErrorCode>(i)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(ErrorCode::out_of_memory) + 1);
  EXPECT_EQ(name(ErrorCode::cannot_open), "cannot_open");
  EXPECT_EQ(name(ErrorCode::rounding_changed_topology), "rounding_changed_topology");
  EXPECT_EQ(name(ErrorCode::bad_scale), "bad_scale");
  EXPECT_THROW((void)name(static_cast<ErrorCode>(1000)), std::logic_error);
}

TEST(Error, TextNamesEveryPieceOfEvidence) {
  Error e{ErrorCode::self_crossing, "the ring crosses itself", {}};
  EXPECT_EQ(e.to_string(), "the ring crosses itself");
  e.evidence.ring = 1;
  e.evidence.vertex = 3;
  EXPECT_EQ(e.to_string(), "ring 1, vertex 3: the ring crosses itself");
  e.evidence.file = "a.poly";
  e.evidence.line = 12;
  EXPECT_EQ(e.to_string(), "a.poly:12: ring 1, vertex 3: the ring crosses itself");
  e.evidence.part = 0;
  e.evidence.other_part = 2;
  e.evidence.other_ring = 0;
  e.evidence.other_vertex = 9;
  e.evidence.x = 0.1;
  e.evidence.y = -2;
  EXPECT_EQ(e.to_string(),
            "a.poly:12: part 0, ring 1, vertex 3: the ring crosses itself (the other: part 2, ring 0, vertex 9) "
            "at (0.1, -2)");
}

TEST(Error, PartialEvidence) {
  Error in_file{ErrorCode::malformed, "bad number", {}}, on_line = in_file;
  Error at_x{ErrorCode::not_finite, "not finite", {}}, at_y = at_x;
  in_file.evidence.file = "x.wkt";
  EXPECT_EQ(in_file.to_string(), "x.wkt: bad number");
  on_line.evidence.line = 4;
  EXPECT_EQ(on_line.to_string(), "line 4: bad number");
  at_x.evidence.vertex = 2;
  at_x.evidence.x = 5e-324;
  EXPECT_EQ(at_x.to_string(), "vertex 2: not finite at x = 5e-324");
  at_y.evidence.y = 1e300;
  EXPECT_EQ(at_y.to_string(), "not finite at y = 1e+300");
}

}  // namespace
}  // namespace dymsum
