// What the tests of the command line begin with: a folder to run in, reports, and the shapes that several of them use.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "process.h"

namespace dymsum::cli_test {

using Json = nlohmann::json;

inline constexpr const char* kSquare = "POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))\n";
inline constexpr const char* kFrame = "POLYGON ((0 0, 5 0, 5 5, 0 5, 0 0), (1 1, 1 4, 4 4, 4 1, 1 1))\n";
/// A peg, and a slot that is exactly as wide as the peg is long.
inline constexpr const char* kPeg = "POLYGON ((0 0, 2 0, 2 1, 0 1, 0 0))\n";
inline constexpr const char* kSlot = "POLYGON ((0 0, 4 0, 4 4, 3 4, 3 1, 1 1, 1 4, 0 4, 0 0))\n";
/// A ring that crosses itself.
inline constexpr const char* kBow = "POLYGON ((0 0, 2 2, 2 0, 0 2, 0 0))\n";
/// A cube of half side 1, a tetrahedron, and one without its last face.
inline constexpr const char* kCube =
    "OFF\n8 6 0\n-1 -1 -1\n1 -1 -1\n1 1 -1\n-1 1 -1\n-1 -1 1\n1 -1 1\n1 1 1\n-1 1 1\n"
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
inline constexpr const char* kTetrahedron =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
inline constexpr const char* kOpen = "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n";

class CliTest : public testing::Test {
 protected:
  /// The object that a command prints; null where it prints nothing.
  Json json(const std::string& command, int code = 0) const {
    const Outcome outcome = work.run(command);
    EXPECT_EQ(outcome.code, code) << command << "\n" << outcome.err;
    return outcome.out.empty() ? Json() : Json::parse(outcome.out);
  }
  /// How often a file holds a text.
  std::size_t count(const std::string& file, const std::string& what) const {
    const std::string text = work.read(file);
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
    return n;
  }
  /// Wrong usage, which the message names, and which prints nothing else.
  void refused(const std::string& command, const std::string& named) const {
    const Outcome outcome = work.run(command + " </dev/null");
    EXPECT_EQ(outcome.code, 1) << command << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(named), std::string::npos) << command << "\n" << outcome.err;
    EXPECT_EQ(outcome.out, "") << command;
  }
  /// Every command is wrong usage, and says why.
  void all_refused(const std::vector<std::string>& commands) const {
    for (const std::string& command : commands) refused(command, "dymsum: ");
  }
  Workplace work;
};

}  // namespace dymsum::cli_test
