// Scripts of edits, what is refused in them, and recordings: made again they give hash after hash what was recorded.
#include "dymsum/edit_script.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "dymsum/names.h"
#include "dymsum/shapes.h"
#include "oracles/random.h"

namespace dymsum {
namespace {

using Kind = EditKind;

Edit random_edit(oracles::Random& random, Kind kind) {
  const auto index = [&] { return static_cast<std::uint32_t>(random.below(1000)); };
  const auto coordinate = [&] { return std::ldexp(random.below(2000000) - 1e6, -random.below(60)); };
  const auto ring = [&] {
    Ring made;
    for (int k = 0, n = 1 + random.below(5); k < n; ++k) {
      const double x = coordinate();
      made.push_back({x, coordinate()});
    }
    return made;
  };
  const MovingOperand operand = random.chance(50) ? MovingOperand::p : MovingOperand::q;
  const double x = coordinate(), y = coordinate();
  const std::uint32_t a = index(), b = index();
  switch (kind) {
    case Kind::move:
      return Edit::move(operand, a, {x, y});
    case Kind::insert:
      return Edit::insert(operand, a, {x, y});
    case Kind::remove:
      return Edit::remove(operand, a);
    case Kind::extrude:
      return Edit::extrude(operand, a, b, {x, y});
    case Kind::invert:
      return Edit::invert(operand, a);
    case Kind::add_hole:
      return Edit::add_hole(operand, a, ring());
    case Kind::remove_hole:
      return Edit::remove_hole(operand, a, b);
    case Kind::add_part: {
      Part part{ring(), {}};
      for (int k = random.below(3); k > 0; --k) part.holes.push_back(ring());
      return Edit::add_part(operand, part);
    }
    default:
      return Edit::remove_part(operand, a);
  }
}

TEST(EditScript, every_edit_reads_back_as_it_was_written) {
  oracles::Random random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<ScriptStep> steps;
    for (std::size_t k = 0; k < names_of<Kind>().size(); ++k) {
      ScriptStep& step = steps.emplace_back();
      step.action = static_cast<ScriptAction>(random.below(3));
      if (step.action != ScriptAction::edit) continue;
      for (int n = 1 + random.below(3); n > 0; --n)
        step.edits.push_back(
            random_edit(random, static_cast<Kind>((k + static_cast<std::size_t>(n)) % names_of<Kind>().size())));
    }
    const std::string text = format_script(steps);
    std::vector<ScriptStep> read = parse_script(text).value();
    for (ScriptStep& step : read) {
      EXPECT_GT(step.line, 0);
      step.line = 0;
    }
    ASSERT_EQ(read, steps) << text;
  }
}

TEST(EditScript, steps_begin_on_their_lines) {
  const auto steps =
      parse_script("\n# a comment\n p move 3 1/4 -2.5 # moved\r\n{\np remove 1\nq invert 2\n}\nundo").value();
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(steps[0], (ScriptStep{ScriptAction::edit, {Edit::move(MovingOperand::p, 3, {0.25, -2.5})}, 3}));
  EXPECT_EQ(
      steps[1],
      (ScriptStep{ScriptAction::edit, {Edit::remove(MovingOperand::p, 1), Edit::invert(MovingOperand::q, 2)}, 4}));
  EXPECT_EQ(steps[2], (ScriptStep{ScriptAction::undo, {}, 8}));
  EXPECT_TRUE(parse_script("").value().empty());
}

TEST(EditScript, what_is_wrong_is_named_with_its_line) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"p move 1 1/10 2", "1/10 is no double; the nearest is 0.1"},
      {"p move 1 1/3e9 2", "a coordinate is expected, not '1/3e9'"},
      {"p move 1 1e999 2", "a coordinate is expected, not '1e999'"},
      {"p move 1 nan 2", "a coordinate is expected, not 'nan'"},
      {"p move 1 2x 2", "a coordinate is expected, not '2x'"},
      {"p move 1 2", "the line ends before a coordinate"},
      {"p move 1 2 3 4", "the line goes on after its edit with '4'"},
      {"p move -1 2 3", "the index of a vertex is expected, counted from 0, not '-1'"},
      {"p move 4294967295 2 3", "the index of a vertex is expected, counted from 0, not '4294967295'"},
      {"p", "the line ends before what is done"},
      {"p add_hole 0 1 1", "'add_hole' is no edit; there are move, insert,"},
      {"r move 1 2 3", "an edit begins with its operand, p or q, not 'r'"},
      {"p add-part", "a ring is the coordinates of its vertices"},
      {"p add-part 0 0 1 0 0 1 hole", "a ring is the coordinates of its vertices"},
      {"p add-hole 0 1 1 2", "the line ends before a coordinate"},
      {"undo 2", "the line goes on after its edit with '2'"},
      {"}", "} ends no step"},
      {"{\n}", "a step between { and } holds an edit at least"},
      {"{\nundo\n}", "a step between { and } holds edits alone"},
      {"{\n{\n", "a step between { and } holds edits alone"},
      {"p invert 1\n{\np invert 2", "the step that { begins has no }"}};
  for (const auto& [text, message] : wrong) {
    const auto steps = parse_script("redo\n" + text, "edits.txt");
    ASSERT_FALSE(steps.ok()) << text;
    EXPECT_EQ(steps.error().code, ErrorCode::malformed);
    EXPECT_EQ(steps.error().message.substr(0, message.size()), message) << text;
    EXPECT_EQ(steps.error().evidence.file, "edits.txt");
    const auto lines = 2 + std::count(text.begin(), text.end(), '\n');
    EXPECT_LE(*steps.error().evidence.line, lines) << text;
    EXPECT_GE(*steps.error().evidence.line, 2) << text;
  }
}

/// A session of random steps of a star and a rectangle, some of which are refused and left out.
EditRecording random_session(std::uint64_t seed, const EditOptions& options) {
  oracles::Random random(seed);
  EditableSum sum = EditableSum::create(shapes::star(7, 1, 2), shapes::rectangle(0, 0, 1, 0.3), options).value();
  EditRecording recording = begin_recording(sum, options);
  while (recording.steps.size() < 12) {
    ScriptStep step;
    step.action = random.chance(15) ? ScriptAction::undo : random.chance(15) ? ScriptAction::redo : ScriptAction::edit;
    for (int n = step.action == ScriptAction::edit ? 1 + random.below(2) : 0; n > 0; --n) {
      const std::uint32_t v = static_cast<std::uint32_t>(random.below(static_cast<int>(sum.p().vertex_count())));
      const Point at{random.below(4096) / 1024.0 - 2, random.below(4096) / 1024.0 - 2};
      step.edits.push_back(random.chance(60) ? Edit::move(MovingOperand::p, v, at)
                                             : Edit::insert(MovingOperand::p, v, at));
    }
    if (make_step(sum, step)) record_step(recording, step, sum);
  }
  return recording;
}

TEST(EditRecording, is_made_again_hash_after_hash) {
  std::size_t undone = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    EditOptions options;
    options.reflect_q = seed % 2 == 0;
    options.semantics = static_cast<Semantics>(seed % 3);
    options.mode = static_cast<FrameMode>(seed % 3);
    options.undo_steps = 3;
    const EditRecording made = random_session(seed, options);
    for (const ScriptStep& step : made.steps) undone += step.action == ScriptAction::undo;
    const std::string text = format_recording(made);
    const EditRecording read = parse_recording(text, "session.json").value();
    EXPECT_EQ(format_recording(read), text);
    EXPECT_EQ(read.steps, made.steps);
    EXPECT_EQ(read.hashes, made.hashes);
    EXPECT_EQ(read.p.data(), made.p.data());
    EXPECT_EQ(read.undo_steps, 3u);
    const EditReplay again = replay(read).value();
    EXPECT_EQ(again.differs, std::nullopt);
    EXPECT_EQ(again.steps, made.steps.size());
  }
  EXPECT_GT(undone, 5u);
}

TEST(EditRecording, the_first_step_that_differs_is_named) {
  const EditRecording made = random_session(3, {});
  for (std::size_t k = 0; k < made.hashes.size(); ++k) {
    EditRecording other = made;
    other.hashes[k] ^= 1;
    if (k + 2 < made.hashes.size()) other.hashes.back() ^= 1;
    const EditReplay again = replay(parse_recording(format_recording(other)).value()).value();
    EXPECT_EQ(again.differs, std::optional(k));
    EXPECT_FALSE(again.refused);
  }
  EditRecording refused = made;
  refused.steps[4] = {ScriptAction::edit, {Edit::remove(MovingOperand::q, 99)}, 0};
  const EditReplay again = replay(refused).value();
  EXPECT_EQ(again.differs, std::optional<std::size_t>(5));
  EXPECT_EQ(again.steps, 4u);
  ASSERT_TRUE(again.refused);
  EXPECT_EQ(again.refused->code, ErrorCode::out_of_range);
}

TEST(EditRecording, what_was_changed_by_hand_is_refused) {
  const std::string text = format_recording(random_session(5, {}));
  for (std::size_t at = 0; at < text.size(); at += 1 + text.size() / 200) {
    std::string other = text;
    other[at] = other[at] == '7' ? '8' : '7';
    if (other == text) continue;
    const auto read = parse_recording(other, "session.json");
    ASSERT_FALSE(read.ok()) << at;
    EXPECT_EQ(read.error().evidence.file, "session.json");
  }
  EXPECT_EQ(parse_recording(text.substr(0, text.size() / 2)).error().code, ErrorCode::truncated);
  EXPECT_EQ(read_recording("/absent/session.json").error().code, ErrorCode::cannot_open);
}

TEST(EditRecording, progress_stops_it) {
  const EditRecording made = random_session(3, {});
  int queries = 0;
  const auto stopped = replay(made, [&](std::string_view, double) { return ++queries < 4; });
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
}

TEST(EditRecording, begins_with_nothing_to_undo) {
  EditableSum sum = EditableSum::create(shapes::star(5, 1, 2), shapes::rectangle(0, 0, 1, 1)).value();
  ASSERT_TRUE(sum.edit(Edit::move(MovingOperand::q, 2, {1.5, 1})));
  EXPECT_THROW(begin_recording(sum, {}), std::invalid_argument);
  EditRecording empty;
  EXPECT_THROW(static_cast<void>(format_recording(empty)), std::invalid_argument);
}

}  // namespace
}  // namespace dymsum
