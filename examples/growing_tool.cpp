// A square tool grows before a plate with pockets: the sum follows the scale, and every pocket closes at an exact one.
#include <dymsum/dymsum.h>
#include <iostream>

int main() {
  using namespace dymsum;
  const Region tool = shapes::rectangle(0, 0, 1, 1), plate = shapes::pockets(3, 4);
  ScalingSum sum = ScalingSum::create(tool, plate).value();  // s tool (+) plate, at s = 1
  const auto events = sum.events(Scale::parse("0.3").value(), Scale::parse("2").value()).value();
  for (const ScaleEvent& event : events)
    if (event.topology) std::cout << "something opens or closes at s = " << event.parameter.to_string() << "\n";
  for (const char* text : {"0.4", "1/2", "0.51", "1.49", "3/2", "1.51"}) {
    const FrameChanges changes = sum.set(Scale::parse(text).value()).value();
    const PlanarSum& now = sum.sum();
    std::cout << "s = " << text << ": " << now.hole_count() << " holes, " << now.tight_points.size()
              << " tight points, area " << now.area_exact().to_string() << (changes.topology ? "; new topology" : "")
              << "\n";
  }
}
