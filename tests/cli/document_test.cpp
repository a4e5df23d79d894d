// What README.md and the guide to meshes show is what happens: their programs are the examples, their outputs are the
// programs', their commands work.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "process.h"

namespace dymsum::cli_test {
namespace {

const std::filesystem::path kSource = DYMSUM_SOURCE_DIR;

/// The texts between ```KIND and ``` of a document.
std::vector<std::string> blocks(const std::string& kind, const std::string& document = "README.md") {
  const std::string text = read_text(kSource / document);
  std::vector<std::string> found;
  const std::string opening = "\n```" + kind + "\n";
  for (std::size_t at = text.find(opening); at != std::string::npos; at = text.find(opening, at)) {
    at += opening.size();
    found.push_back(text.substr(at, text.find("```", at) - at));
  }
  return found;
}

TEST(Readme, ProgramIsTheExampleAndPrintsWhatIsShown) {
  ASSERT_EQ(blocks("cpp").size(), 1U);
  ASSERT_EQ(blocks("text").size(), 1U);
  const std::string program = blocks("cpp").front();
  EXPECT_EQ(program, read_text(kSource / "examples/first_sum.cpp"));
  EXPECT_LE(std::count(program.begin(), program.end(), '\n'), 15);
  const Workplace work;
  const Outcome outcome = work.run("'" DYMSUM_EXAMPLES_DIR "/first_sum'");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, blocks("text").front());
}

TEST(Readme, EveryDymsumCommandWorksAndDrawsThePicture) {
  const Workplace work;
  ASSERT_EQ(work.run("'" DYMSUM_EXAMPLES_DIR "/demo_shapes' .").code, 0);
  std::size_t commands = 0;
  for (const std::string& block : blocks("console")) {
    std::istringstream lines(block);
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("$ dymsum ", 0) != 0) continue;
      ++commands;
      const Outcome outcome = work.run(line.substr(2));
      EXPECT_EQ(outcome.code, 0) << line << "\n" << outcome.err;
    }
  }
  EXPECT_GE(commands, 5U);
  EXPECT_TRUE(work.read("hero.svg") == read_text(kSource / "docs/figures/hero.svg")) << "draw the picture again";
}

TEST(Readme, EveryFileItNamesExists) {
  const std::string text = read_text(kSource / "README.md");
  std::size_t links = 0;
  for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at)) {
    at += 2;
    const std::string target = text.substr(at, text.find(')', at) - at);
    if (target.rfind("http", 0) == 0) continue;
    ++links;
    EXPECT_TRUE(std::filesystem::exists(kSource / target)) << target;
  }
  EXPECT_GE(links, 3U);
}

TEST(MeshGuide, ProgramAndCommandsDoWhatIsShown) {
  const std::string guide = "docs/guide/meshes.md";
  ASSERT_EQ(blocks("cpp", guide).size(), 1U);
  ASSERT_EQ(blocks("text", guide).size(), 1U);
  ASSERT_EQ(blocks("console", guide).size(), 1U);
  EXPECT_EQ(blocks("cpp", guide).front(), read_text(kSource / "examples/first_solid.cpp"));
  const Workplace work;
  const Outcome program = work.run("'" DYMSUM_EXAMPLES_DIR "/first_solid'");
  EXPECT_EQ(program.code, 0) << program.err;
  EXPECT_EQ(program.out, blocks("text", guide).front());
  std::istringstream lines(blocks("console", guide).front());
  std::string shown;
  for (std::string line; std::getline(lines, line);) {
    shown += line + "\n";
    if (line.rfind("$ ", 0) != 0) continue;
    const Outcome outcome = work.run(line.substr(2));
    EXPECT_EQ(outcome.code, 0) << line << "\n" << outcome.err;
    EXPECT_NE(blocks("console", guide).front().find(line + "\n" + outcome.out), std::string::npos) << outcome.out;
  }
  EXPECT_NE(shown.find("$ dymsum info"), std::string::npos);
  EXPECT_TRUE(work.exists("dented.glb"));
}

TEST(ConvexGuide, ProgramAndCommandsDoWhatIsShown) {
  const std::string guide = "docs/guide/convex.md";
  ASSERT_EQ(blocks("cpp", guide).size(), 1U);
  ASSERT_EQ(blocks("text", guide).size(), 1U);
  ASSERT_EQ(blocks("console", guide).size(), 1U);
  EXPECT_EQ(blocks("cpp", guide).front(), read_text(kSource / "examples/turning_solid.cpp"));
  const Workplace work;
  const Outcome program = work.run("'" DYMSUM_EXAMPLES_DIR "/turning_solid'");
  EXPECT_EQ(program.code, 0) << program.err;
  EXPECT_EQ(program.out, blocks("text", guide).front());
  EXPECT_EQ(work.run("'" DYMSUM_EXAMPLES_DIR "/demo_solids' .").code, 0);
  std::istringstream lines(blocks("console", guide).front());
  int commands = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("$ ", 0) != 0) continue;
    const Outcome outcome = work.run(line.substr(2));
    EXPECT_EQ(outcome.code, 0) << line << "\n" << outcome.err;
    ++commands;
  }
  EXPECT_EQ(commands, 6);
  EXPECT_TRUE(work.exists("turn.html") && work.exists("sum.glb"));
}

TEST(CspaceGuide, ProgramAndCommandsDoWhatIsShown) {
  const std::string guide = "docs/guide/cspace.md";
  ASSERT_EQ(blocks("cpp", guide).size(), 1U);
  ASSERT_EQ(blocks("text", guide).size(), 1U);
  EXPECT_EQ(blocks("cpp", guide).front(), read_text(kSource / "examples/turning_robot.cpp"));
  const Workplace work;
  const Outcome program = work.run("'" DYMSUM_EXAMPLES_DIR "/turning_robot'");
  EXPECT_EQ(program.code, 0) << program.err;
  EXPECT_EQ(program.out, blocks("text", guide).front());
  EXPECT_EQ(work.run("'" DYMSUM_EXAMPLES_DIR "/demo_shapes' .").code, 0);
  work.write("places.txt", "1,6,0\n1,1,0\n");
  int commands = 0, shown = 0;
  for (const std::string& block : blocks("console", guide)) {
    const std::string line = block.substr(0, block.find('\n') + 1);
    ASSERT_EQ(line.substr(0, 9), "$ dymsum ");
    const Outcome outcome = work.run(line.substr(2));
    EXPECT_EQ(outcome.code, 0) << line << "\n" << outcome.err;
    ++commands;
    if (block == line) continue;  // what it prints has times in it
    ++shown;
    EXPECT_EQ(block, line + outcome.out);
  }
  EXPECT_EQ(commands, 9);
  EXPECT_EQ(shown, 4);
  EXPECT_TRUE(work.exists("obstacle.glb") && work.exists("slices.svg") && work.exists("turn.anim.svg"));
}

/// Times differ from run to run.
std::string without_times(const std::string& text) {
  static const std::regex kTime(R"([0-9.e+-]+ ms)");
  return std::regex_replace(text, kTime, "T ms");
}

/// Runs the commands of a block; where output is shown behind one, it is what the command prints.
void follow(const Workplace& work, const std::string& guide, const std::string& block) {
  std::istringstream lines(block);
  std::string command, shown;
  const auto run = [&] {
    if (command.empty() || command.starts_with("./run") || command.starts_with("cmake")) return;
    const Outcome outcome = work.run(command);
    EXPECT_EQ(outcome.code, 0) << guide << ": " << command << "\n" << outcome.err;
    EXPECT_TRUE(shown.empty() || without_times(shown) == without_times(outcome.out)) << guide << ": " << command << "\n"
                                                                                     << outcome.out;
  };
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("$ ")) {
      run();
      command = line.substr(2), shown.clear();
    } else {
      shown += line + "\n";
    }
  }
  run();
}

TEST(Guides, EveryCommandWorksAndEveryProgramIsAnExample) {
  std::vector<std::string> examples;
  for (const auto& entry : std::filesystem::directory_iterator(kSource / "examples"))
    if (entry.path().extension() == ".cpp") examples.push_back(read_text(entry.path()));
  std::size_t guides = 0, commands = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kSource / "docs/guide")) {
    if (entry.path().extension() != ".md") continue;
    const std::string guide = "docs/guide/" + entry.path().filename().string();
    ++guides;
    const Workplace work;
    work.write("places.txt", "1,6,0\n1,1,0\n");
    for (const char* program : {"demo_shapes' .", "demo_solids' .", "first_solid'"})
      ASSERT_EQ(work.run("'" DYMSUM_EXAMPLES_DIR "/" + std::string(program)).code, 0) << program;
    for (const std::string& block : blocks("console", guide)) {
      follow(work, guide, block);
      commands += static_cast<std::size_t>(std::count(block.begin(), block.end(), '$'));
    }
    for (const std::string& program : blocks("cpp", guide))
      EXPECT_NE(std::find(examples.begin(), examples.end(), program), examples.end())
          << guide << ": a program that is no example";
  }
  EXPECT_GE(guides, 7u);
  EXPECT_GE(commands, 15u);
}

TEST(DemoPrograms, HelpMakesNoFolder) {
  const Workplace work;
  for (const char* program : {"demo_shapes", "demo_solids"}) {
    const std::string path = std::string("'" DYMSUM_EXAMPLES_DIR "/") + program + "'";
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
