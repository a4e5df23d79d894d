// Scripts of edits of solids, and recordings that are made again.
#include "dymsum/solid_edit_script.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dymsum/solids.h"

namespace dymsum {
namespace {

constexpr const char* kScript =
    "p move 3 0.25 -1 2\n"
    "{\n"
    "  q extrude 0 4 2 by 0 0 -1.5\n"
    "  p invert 1 2\n"
    "  p insert-in-face 7 1 2 3\n"
    "  q insert-in-edge 0 1 0.5 0 0\n"
    "}\n"
    "undo\n"
    "p remove 5\n"
    "redo\n"
    "q add-shell 9 0 0 10 0 0 9 1 0 9 0 1 face 0 2 1 face 0 1 3 face 1 2 3 face 2 0 3\n"
    "p remove-shell 4\n";

TEST(SolidEditScript, every_edit_reads_back_as_it_was_written) {
  const std::vector<SolidScriptStep> steps = parse_solid_script(kScript).value();
  EXPECT_EQ(format_solid_script(steps), kScript);
  ASSERT_EQ(steps.size(), 7u);
  EXPECT_EQ(steps[1].line, 2);
  EXPECT_EQ(steps[1].edits[0], SolidEdit::extrude(MovingOperand::q, {0, 4, 2}, {0, 0, -1.5}));
  EXPECT_EQ(steps[5].edits[0].added.faces[3], (Face{2, 0, 3}));
}

TEST(SolidEditScript, what_is_wrong_is_named_with_its_line) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"p move 1 2 3", "the line ends before a coordinate"},
      {"p insert 1 2 3 4", "'insert' is no edit; there are move, extrude, invert, insert-in-face"},
      {"p extrude 1 2 3", "the line ends before the word by and a vector"},
      {"p extrude x by 1 2 3", "the index of a face is expected, counted from 0, not 'x'"},
      {"p add-shell 1 2 3", "a shell is the coordinates of its vertices, and its faces"},
      {"p add-shell 1 2 3 face 0 1.5", "the index of a vertex of the shell is expected"}};
  for (const auto& [text, message] : wrong) {
    const auto steps = parse_solid_script("redo\n" + text, "edits.txt");
    ASSERT_FALSE(steps.ok()) << text;
    EXPECT_EQ(steps.error().message.substr(0, message.size()), message);
    EXPECT_EQ(steps.error().evidence.line, 2);
  }
}

SolidEditRecording session() {
  SolidEditOptions options;
  options.reflect_q = true, options.semantics = Semantics::open;
  EditableSolidSum sum =
      EditableSolidSum::create(solids::tessellated_cube(2, 1), solids::box(0, 0, 0, 1, 1, 1), options).value();
  SolidEditRecording recording = begin_recording(sum, options);
  const auto steps = parse_solid_script(
      "p move 0 -1.5 -1 -1\nq extrude 0 by 0 0 -1\nundo\n{\np remove 3\np insert-in-face 0 0.1 0.2 0.3\n}\nundo\nredo\n"
      "q add-shell 9 0 0 10 0 0 9 1 0 9 0 1 face 0 2 1 face 0 1 3 face 1 2 3 face 2 0 3\n");
  for (const SolidScriptStep& step : *steps)
    if (make_step(sum, step)) record_step(recording, step, sum);
  return recording;
}

TEST(SolidEditRecording, is_made_again_hash_after_hash) {
  const SolidEditRecording made = session();
  EXPECT_GE(made.steps.size(), 4u);
  const std::string text = format_recording(made);
  const SolidEditRecording read = parse_solid_recording(text).value();
  EXPECT_EQ(format_recording(read), text);
  EXPECT_EQ(read.p.data(), made.p.data());
  EXPECT_EQ(replay(read).value().differs, std::nullopt);
  EXPECT_EQ(replay(read).value().steps, made.steps.size());
  for (std::size_t k = 0; k < made.hashes.size(); ++k) {
    SolidEditRecording other = made;
    other.hashes[k] ^= 1;
    EXPECT_EQ(replay(other).value().differs, std::optional(k));
  }
}

TEST(SolidEditRecording, what_was_changed_by_hand_is_refused) {
  const std::string text = format_recording(session());
  for (std::size_t at = 0; at < text.size(); at += 1 + text.size() / 100) {
    std::string other = text;
    other[at] = other[at] == '7' ? '8' : '7';
    if (other == text) continue;
    EXPECT_FALSE(parse_solid_recording(other).ok()) << at;
  }
  EXPECT_FALSE(parse_recording(text).ok());  // it is one of solids
  EXPECT_EQ(read_solid_recording("/absent/session.json").error().code, ErrorCode::cannot_open);
}

}  // namespace
}  // namespace dymsum
