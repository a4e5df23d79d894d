// One small text file per hard case (tests/corpus/commands): files, a shell command, and what it has to answer.
//   # comment
//   file NAME        the lines that follow, up to a line `end`
//   run COMMAND      in a folder that holds these files; several lines make one script
//   exit N           0 where this line is missing
//   json POINTER V   a value of the object on standard output, equal to the last bit; a size with `size POINTER N`
//   within POINTER V ERROR   a number at most ERROR from V: a number, or the pointer of the error that is stated
//   says TEXT, silent TEXT   a text that is, or is not, on standard output or standard error
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "process.h"

namespace dymsum::cli_test {
namespace {

using Json = nlohmann::json;

struct CommandCase {
  std::string name, script;
  std::vector<std::pair<std::string, std::string>> files, facts;
  int exit = 0;
  friend std::ostream& operator<<(std::ostream& out, const CommandCase& one) { return out << one.name; }
};

CommandCase read_case(const std::filesystem::path& path) {
  CommandCase one;
  one.name = path.stem().string();
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::string key, rest;
    std::getline(words >> key >> std::ws, rest);
    if (key == "run") one.script += rest + "\n";
    else if (key == "exit") one.exit = std::stoi(rest);
    else if (key != "file") one.facts.emplace_back(key, rest);
    else {
      std::string& text = one.files.emplace_back(rest, "").second;
      while (std::getline(in, line) && line != "end") text += line + "\n";
    }
  }
  return one;
}

std::vector<CommandCase> read_cases(const std::string& folder) {
  std::vector<CommandCase> all;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) all.push_back(read_case(entry.path()));
  std::sort(all.begin(), all.end(), [](const CommandCase& a, const CommandCase& b) { return a.name < b.name; });
  return all;
}

Json at(const Json& report, const std::string& pointer) { return report.at(Json::json_pointer(pointer)); }

void expect_within(const Json& report, std::istringstream words) {
  std::string pointer, error;
  double value = 0;
  ASSERT_TRUE(words >> pointer >> value >> error);
  const double allowed = error[0] == '/' ? at(report, error).get<double>() : std::stod(error);
  EXPECT_LE(std::abs(at(report, pointer).get<double>() - value), allowed) << at(report, pointer);
}

void expect_fact(const std::string& key, const std::string& fact, const Outcome& outcome) {
  const bool said = (outcome.out + outcome.err).find(fact) != std::string::npos;
  if (key == "says" || key == "silent") {
    EXPECT_EQ(said, key == "says") << outcome.out << outcome.err;
    return;
  }
  const Json report = Json::parse(outcome.out);
  const std::size_t space = std::min(fact.find(' '), fact.size() - 1);
  const std::string pointer = fact.substr(0, space), value = fact.substr(space + 1);
  if (key == "json") EXPECT_EQ(at(report, pointer), Json::parse(value));
  else if (key == "size") EXPECT_EQ(at(report, pointer).size(), std::stoul(value)) << at(report, pointer);
  else if (key == "within") expect_within(report, std::istringstream(fact));
  else ADD_FAILURE() << "unknown fact " << key;
}

class CommandCorpus : public testing::TestWithParam<CommandCase> {};

TEST_P(CommandCorpus, AnswersAsItsFileStates) {
  const CommandCase& one = GetParam();
  Workplace work;
  for (const auto& [file, text] : one.files) work.write(file, text);
  const Outcome outcome = work.run(one.script);
  ASSERT_EQ(outcome.code, one.exit) << outcome.out << outcome.err;
  ASSERT_FALSE(one.facts.empty());
  for (const auto& [key, fact] : one.facts) {
    SCOPED_TRACE(key + " " + fact);
    expect_fact(key, fact, outcome);
  }
}

INSTANTIATE_TEST_SUITE_P(Files, CommandCorpus, testing::ValuesIn(read_cases(DYMSUM_CORPUS_DIR "/commands")),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace dymsum::cli_test
