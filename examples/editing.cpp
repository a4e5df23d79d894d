// A plate with a slot, edited while a part is placed on it: steps, a refused one, undo, a recording that is made again.
#include <dymsum/dymsum.h>
#include <array>
#include <iostream>

int main() {
  using namespace dymsum;
  using enum MovingOperand;
  EditableSum sum = EditableSum::create(shapes::pockets(2, 3), shapes::rectangle(0, 0, 0.25, 0.25)).value();
  EditRecording recording = begin_recording(sum, {});
  const auto make = [&](const char* line) {
    for (const ScriptStep& step : parse_script(line).value()) {
      if (const auto changes = make_step(sum, step); !changes) {
        std::cout << line << ": " << changes.error().to_string() << "\n";
        return;
      }
      record_step(recording, step, sum);
      std::cout << line << ": area " << sum.sum().area_exact().to_string() << ", " << sum.sum().hole_count()
                << " holes\n";
    }
  };
  std::cout << "at first: area " << sum.sum().area_exact().to_string() << ", " << sum.sum().hole_count() << " holes\n";
  make("p move 0 -1/2 -1/4");
  make("p move 0 1 2");
  make("p extrude 1 2 1 0");
  make("undo");
  make("p remove-hole 0 0");
  const auto both = std::array{Edit::move(p, 0, {0, 0}), Edit::insert(q, 0, {0.125, -0.5})};  // one step
  std::cout << (sum.edit(both) ? "both" : "neither") << ": area " << sum.sum().area_exact().to_string() << "\n";
  record_step(recording, {ScriptAction::edit, {both.begin(), both.end()}, 0}, sum);

  const EditRecording read = parse_recording(format_recording(recording)).value();
  std::cout << read.steps.size() << " steps made again: " << (replay(read)->differs ? "another sum" : "the same sums")
            << "\n";
}
