// Every verb with every option, for every kind of operand and output (tests/corpus/options.txt): an option is used, or
// wrong usage that names it, and never ignored.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cli_fixture.h"
#include "served.h"

namespace dymsum::cli_test {
namespace {

struct Section {
  std::string verb, kind, arguments;
  std::vector<std::pair<std::string, std::string>> cases;  ///< used, same or refused, and an option with its value
  friend std::ostream& operator<<(std::ostream& out, const Section& s) { return out << s.verb << " " << s.kind; }
};

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

std::vector<Section> read_table() {
  std::vector<Section> sections;
  std::ifstream in(DYMSUM_CORPUS_DIR "/options.txt");
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::string first, rest;
    std::getline(words >> first, rest);
    if (first != "used" && first != "same" && first != "refused") {
      const std::size_t colon = rest.find(':');
      sections.push_back({first, trimmed(rest.substr(0, colon)), trimmed(rest.substr(colon + 1)), {}});
      continue;
    }
    std::istringstream cases(rest);
    for (std::string one; std::getline(cases, one, '|');) sections.back().cases.emplace_back(first, trimmed(one));
  }
  return sections;
}

/// The options that a verb's help names, by their longest names, without --help.
std::set<std::string> options_of(const std::string& help) {
  std::set<std::string> options;
  std::istringstream lines(help);
  const std::regex option("^  (-[a-z],)?(--?[a-z-]+)");
  for (std::string line; std::getline(lines, line);)
    if (std::smatch found; std::regex_search(line, found, option) && found[2] != "--help") options.insert(found[2]);
  return options;
}

constexpr const char* kParts = R"({"items":[{"allowed_orientations":[0,180],)"
                               R"("shape":{"type":"simple_polygon","data":[[0,0],[3,0],[3,1],[0,2]]}}]})";
constexpr const char* kLayout =
    R"({"items":[{"id":0,"shape":{"type":"simple_polygon","data":[[0,0],[3,0],[3,1],[0,2]]}}],"strip_height":2,)"
    R"("solution":{"strip_width":3,"layout":{"placed_items":)"
    R"([{"item_id":0,"transformation":{"rotation":0,"translation":[0,0]}}]}}})";

std::string first_word(const std::string& text) { return text.substr(0, text.find(' ')); }

class OptionTable : public testing::TestWithParam<Section> {
 protected:
  /// A run in a folder of its own, so that what it writes is its own.
  static std::pair<Outcome, std::string> run(const std::string& command) {
    Workplace work;
    for (const auto& [file, text] : std::map<std::string, std::string>{
             {"peg.wkt", kPeg},
             {"slot.wkt", kSlot},
             {"hook.wkt",  // its pocket turns round a corner
              "POLYGON ((0 0, 6 0, 6 4, 2 4, 2 3, 5 3, 5 1, 1 1, 1 4, 0 4, 0 0))\n"},
             {"frame.wkt", "POLYGON ((0 0, 3 0, 3 2, 4 2, 4 4, 0 4, 0 0))\n"},
             {"small.wkt", "POLYGON ((0 0, 1 0, 1 2, 0 2, 0 0))\n"},
             {"turned.wkt", "POLYGON ((2 1, 0 1, 0 0, 2 0, 2 1))\n"},
             {"cube.off", kCube},
             {"wedge.off", kTetrahedron},
             {"double.off",
              "OFF\n8 6 0\n-2 -2 -2\n2 -2 -2\n2 2 -2\n-2 2 -2\n-2 -2 2\n2 -2 2\n2 2 2\n"
              "-2 2 2\n4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n"},
             {"parts.json", kParts},
             {"layout.json", kLayout},
             {"copies.txt", "1 0 0\n3/2 9 0\n"},
             {"poses.txt", "1,6,0\n1,9,0\n"},
             {"places.txt", "3,3\n"},
             {"tolerances.txt", "+0.25/0\n0.125  # the narrow side\n0\n+0.5/-0.25\n"},
             {"moves.txt", "0.25,0,0\n9,9,9\n"},
             {"heights.txt", "1/3,9,9\n"},
             {"edits.txt", "q move 0 0.125 0\nundo\n"},
             {"solid_edits.txt", "p extrude 0 by 0 0 -0.125\nundo\n"},
             {"session.json", session()},
             {"slot.obstacle", obstacle()},
             {"slot.family", family()},
             {"viewer.html", kViewer}})
      work.write(file, text);
    const Outcome outcome = work.run("DYMSUM_VIEWER=viewer.html " + command + " < peg.wkt");
    std::string seen = outcome.out + outcome.err;
    for (const char* file : {"out.wkt", "out.svg", "out.off", "out.json", "out.html", "out.glb", "out.poly",
                             "out.obstacle", "out.family", "out.jsonl", "out.wkb", "out.csv", "more.svg", "more.json"})
      if (work.exists(file)) seen += file + work.read(file);
    return {outcome, without_times(seen)};
  }
  static std::string made_by(const std::string& command, const std::string& file) {
    Workplace work;
    work.write("peg.wkt", kPeg);
    work.write("slot.wkt", kSlot);
    EXPECT_EQ(work.run(command + " -o " + file).code, 0);
    return work.read(file);
  }
  static std::string obstacle() {
    static const std::string text = made_by("dymsum cspace peg.wkt slot.wkt", "slot.obstacle");
    return text;
  }
  static std::string family() {
    static const std::string text = made_by("dymsum family peg.wkt slot.wkt --scale 1/2:2", "slot.family");
    return text;
  }
  static std::string session() {
    static const std::string text = [] {
      Workplace work;
      work.write("peg.wkt", kPeg);
      work.write("slot.wkt", kSlot);
      work.write("edits.txt", "undo\n");
      EXPECT_EQ(work.run("dymsum edit peg.wkt slot.wkt edits.txt --keep-going --record session.json").code, 4);
      return work.read("session.json");
    }();
    return text;
  }
  static std::string help_of(const std::string& verb) { return Workplace().run("dymsum " + verb + " --help").out; }
  static std::string without_times(const std::string& text) {
    static const std::regex words("[0-9.e+-]+ ms"), key("\"([a-z_]*_ms|median|min)\": [0-9.e+-]+"),
        stages("\"stages\": \\{[^}]*\\}"), counters("\"peak_bytes\": [0-9]+");
    std::string out = std::regex_replace(text, stages, "");
    for (const std::regex* one : {&words, &key, &counters}) out = std::regex_replace(out, *one, "");
    return out;
  }
};

TEST_P(OptionTable, EveryOptionIsUsedOrRefused) {
  const Section& section = GetParam();
  const std::string base = "dymsum " + section.verb + " " + section.arguments;
  const auto [plain, result] = run(base);
  ASSERT_EQ(plain.code, 0) << base << "\n" << plain.err;
  std::set<std::string> covered;
  std::istringstream words(section.arguments);
  for (std::string word; words >> word;) covered.insert(word);
  for (const auto& [what, option] : section.cases) {
    const std::string command = base + " " + option;
    covered.insert(first_word(option));
    const auto [outcome, changed] = run(command);
    if (what == "refused") {
      EXPECT_EQ(outcome.code, 1) << command << "\n" << outcome.err;
      const bool named = outcome.err.find(first_word(option)) != std::string::npos ||
                         (option.starts_with("-o ") && outcome.err.find(option.substr(3)) != std::string::npos);
      EXPECT_TRUE(named) << command << "\n" << outcome.err;
      continue;
    }
    EXPECT_NE(outcome.code, 1) << command << "\n" << outcome.err;
    if (what == "used") EXPECT_NE(changed, result) << command << " changes nothing";
    else EXPECT_EQ(changed, result) << command;
  }
  for (const std::string& option : options_of(help_of(section.verb)))
    EXPECT_TRUE(covered.contains(option)) << section.verb << " " << section.kind << " has no case for " << option;
}

INSTANTIATE_TEST_SUITE_P(Verbs, OptionTable, testing::ValuesIn(read_table()), [](const auto& info) {
  return std::regex_replace(info.param.verb + "_" + info.param.kind, std::regex("-"), "_");
});

}  // namespace
}  // namespace dymsum::cli_test
