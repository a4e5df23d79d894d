// What README.md and the guides show is what happens: their programs are the examples, the texts behind them what these
// print, their commands work and print what is shown.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "process.h"

namespace dymsum::cli_test {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = DYMSUM_SOURCE_DIR;

struct Block {
  std::string kind, text;
};

/// The blocks of a document, in order.
std::vector<Block> blocks(const std::string& document) {
  std::istringstream lines(read_text(kSource / document));
  std::vector<Block> found;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) found.push_back({line.substr(3), ""});
    } else if (inside) {
      found.back().text += line + "\n";
    }
  }
  return found;
}

/// README.md, CONTRIBUTING.md and everything in docs.
std::vector<std::string> documents() {
  std::vector<std::string> found = {"README.md", "CONTRIBUTING.md"};
  for (const auto& entry : fs::recursive_directory_iterator(kSource / "docs"))
    if (entry.path().extension() == ".md") found.push_back(fs::relative(entry.path(), kSource).generic_string());
  std::sort(found.begin(), found.end());
  return found;
}

/// The examples' texts and names.
std::map<std::string, std::string> examples() {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::directory_iterator(kSource / "examples"))
    if (entry.path().extension() == ".cpp") found[read_text(entry.path())] = entry.path().stem();
  return found;
}

std::string example(const std::string& name) { return "'" DYMSUM_EXAMPLES_DIR "/" + name + "'"; }

/// Times differ from run to run.
std::string without_times(const std::string& text) {
  static const std::regex kTime(R"([0-9.e+-]+ ms)");
  return std::regex_replace(text, kTime, "T ms");
}

/// A command of a document, and the output shown below it.
struct Command {
  std::string line, shown;
};

std::vector<Command> commands(const std::string& document) {
  std::vector<Command> found;
  for (const Block& block : blocks(document)) {
    if (block.kind != "console") continue;
    std::istringstream lines(block.text);
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("$ ")) found.push_back({line.substr(2), ""});
      else if (!found.empty()) found.back().shown += line + "\n";
    }
  }
  return found;
}

TEST(Documents, EveryProgramIsAnExampleAndPrintsWhatIsShown) {
  const std::map<std::string, std::string> names = examples();
  std::set<std::string> shown;
  for (const std::string& document : documents()) {
    const std::vector<Block> all = blocks(document);
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k].kind != "cpp") continue;
      ASSERT_TRUE(names.contains(all[k].text)) << document << ": a program that is no example\n" << all[k].text;
      const std::string name = names.at(all[k].text);
      shown.insert(name);
      const Workplace work;
      const Outcome outcome = work.run(example(name));
      EXPECT_EQ(outcome.code, 0) << name << "\n" << outcome.err;
      ASSERT_TRUE(k + 1 < all.size() && all[k + 1].kind == "text") << document << ": nothing behind " << name;
      EXPECT_EQ(outcome.out, all[k + 1].text) << document << ": " << name;
    }
  }
  for (const auto& [text, name] : names) {
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 60) << name;
    EXPECT_TRUE(name.starts_with("demo_") || shown.contains(name)) << name << " is shown nowhere";
  }
  EXPECT_GE(shown.size(), 8U);
}

TEST(Documents, EveryCommandWorksAndPrintsWhatIsShown) {
  static const std::regex kEntry(R"(\./run ([a-z]+).*)"), kOutput("-o ([a-z][^ ]*)");
  const Outcome help = Workplace().run("'" + (kSource / "run").string() + "' help");
  ASSERT_EQ(help.code, 0) << help.err;
  std::size_t run = 0, shown = 0, written = 0;
  for (const std::string& document : documents()) {
    const std::vector<Command> all = commands(document);
    if (all.empty()) continue;
    const Workplace work;
    work.write("places.txt", "1,6,0\n1,1,0\n");
    for (const char* program : {"demo_shapes' .", "demo_solids' .", "first_solid'"})
      ASSERT_EQ(work.run("'" DYMSUM_EXAMPLES_DIR "/" + std::string(program)).code, 0) << program;
    for (const Command& command : all) {
      std::smatch entry;
      if (std::regex_match(command.line, entry, kEntry)) {
        EXPECT_NE(help.out.find("./run " + entry[1].str() + " "), std::string::npos)
            << document << ": " << command.line;
        continue;
      }
      if (command.line.starts_with("cmake ")) continue;  // what builds this very test
      const Outcome outcome = work.run(command.line);
      EXPECT_EQ(outcome.code, 0) << document << ": " << command.line << "\n" << outcome.err;
      ++run;
      for (std::sregex_iterator at(command.line.begin(), command.line.end(), kOutput), end; at != end; ++at, ++written)
        EXPECT_TRUE(work.exists((*at)[1])) << document << ": " << command.line;
      if (command.shown.empty()) continue;
      ++shown;
      EXPECT_EQ(without_times(outcome.out), without_times(command.shown)) << document << ": " << command.line;
    }
    if (document == "README.md") {
      EXPECT_TRUE(work.read("hero.svg") == read_text(kSource / "docs/figures/hero.svg")) << "draw the picture again";
    }
  }
  EXPECT_GE(run, 55U);
  EXPECT_GE(shown, 9U);
  EXPECT_GE(written, 36U);
}

TEST(Documents, TheReadmeShowsWhatAForeignProjectDoes) {
  const std::string foreign =
      std::regex_replace(read_text(kSource / "tests/package/CMakeLists.txt"), std::regex("(dymsum) [0-9.]+ "), "$1 ");
  for (const Block& block : blocks("README.md")) {
    if (block.kind != "cmake") continue;
    std::istringstream lines(std::regex_replace(block.text, std::regex("my_program"), "foreign"));
    for (std::string line; std::getline(lines, line);) EXPECT_NE(foreign.find(line), std::string::npos) << line;
  }
}

TEST(DemoPrograms, HelpMakesNoFolder) {
  const Workplace work;
  for (const char* program : {"demo_shapes", "demo_solids"}) {
    const std::string path = example(program);
    const Outcome help = work.run(path + " --help"), wrong = work.run(path + " --all"), none = work.run(path);
    EXPECT_EQ(help.code, 0) << program;
    EXPECT_EQ(help.out, std::string("usage: ") + program + " FOLDER\n");
    EXPECT_EQ(wrong.code, 1) << program;
    EXPECT_EQ(none.code, 1) << program;
    EXPECT_EQ(work.file_count(), 0U) << program;
    EXPECT_EQ(work.run(path + " new/folder").code, 0) << program;
    EXPECT_GE(work.file_count(), 10U) << program;
    EXPECT_EQ(work.run("rm -r new").code, 0);
  }
}

}  // namespace
}  // namespace dymsum::cli_test
