#include "arrays.h"

namespace dymsum::web {
namespace {

template <class T>
std::vector<T> plain_numbers(const val& array) {
  if (array.isUndefined() || array.isNull()) return {};
  const auto n = array["length"].as<std::size_t>();
  const bool nested = n > 0 && array[0].typeOf().as<std::string>() == "object";
  return emscripten::convertJSArrayToNumberVector<T>(nested ? array.call<val>("flat") : array);
}

}  // namespace

std::vector<double> numbers_in(const val& array) { return plain_numbers<double>(array); }
std::vector<std::uint32_t> indices_in(const val& array) { return plain_numbers<std::uint32_t>(array); }

Ring points_in(const val& coordinates) {
  const std::vector<double> numbers = numbers_in(coordinates);
  if (numbers.size() % 2 != 0)
    throw Thrown{{ErrorCode::malformed, "coordinates are x, y after x, y: an odd number of them", {}}};
  Ring ring(numbers.size() / 2);
  for (std::size_t k = 0; k < ring.size(); ++k) ring[k] = {numbers[2 * k], numbers[2 * k + 1]};
  return ring;
}

val point(Point at) {
  val v = val::object();
  v.set("x", at.x);
  v.set("y", at.y);
  return v;
}

val point(const Point3& at) {
  val v = point(Point{at.x, at.y});
  v.set("z", at.z);
  return v;
}

Point point_in(const val& at) { return {at["x"].as<double>(), at["y"].as<double>()}; }
Point3 point3_in(const val& at) { return {at["x"].as<double>(), at["y"].as<double>(), at["z"].as<double>()}; }

}  // namespace dymsum::web
