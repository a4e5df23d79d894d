// A peg whose size has a tolerance, before a plate with pockets: one family holds the sums of all its sizes.
#include <dymsum/dymsum.h>
#include <iostream>

int main() {
  using namespace dymsum;
  const auto scale = [](const char* text) { return Scale::parse(text).value(); };
  FamilyOptions options;
  options.moving = MovingOperand::q;
  options.reflect_q = true;  // plate (+) -s peg: where a peg of size s hits the plate
  const ScalingFamily family =
      ScalingFamily::create(shapes::pockets(3, 4), shapes::rectangle(0, 0, 1, 1), scale("1/4"), scale("2"), options)
          .value();
  for (const ScaleEvent& event : family.changes(family.low(), family.high(), EventChange::topology))
    std::cout << "something opens or closes at s = " << event.parameter.to_string() << "\n";
  for (const char* s : {"2/5", "1/2", "4/3"})
    std::cout << "s = " << s << ": area " << family.at(scale(s)).value().area_exact().to_string() << "\n";
  for (const Lifetime& life : family.lifetimes().value())
    if (life.feature == FamilyFeature::hole)
      std::cout << "a hole lives in cells " << life.first_cell << " to " << life.last_cell << "\n";
  const PlanarSum some = family.outer(scale("9/10"), scale("11/10")).value();
  const PlanarSum all = family.inner(scale("9/10"), scale("11/10")).value();
  std::cout << "hit by a peg of some size from 9/10 to 11/10: area " << some.area_exact().to_string() << "\n"
            << "hit by pegs of all these sizes: area " << all.area_exact().to_string() << "\n";
  const ScalingFamily again = parse_family(format_family(family), "memory").value();
  std::cout << (again.at(scale("4/3")).value() == family.at(scale("4/3")).value() ? "the same" : "another")
            << " sum after writing and reading\n";
}
