#include "arrays.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "options.h"

namespace dymsum::web {
namespace {

template <class T>
std::vector<T> plain_numbers(const val& array) {
  if (array.isUndefined() || array.isNull()) return {};
  const double length = array["length"].as<double>();
  if (!(length >= 0 && length <= 0x1p28)) throw Thrown{{ErrorCode::malformed, "this is no list of numbers", {}}};
  const auto n = static_cast<std::size_t>(length);
  const bool nested = n > 0 && array[0].typeOf().as<std::string>() == "object";
  return emscripten::convertJSArrayToNumberVector<T>(nested ? array.call<val>("flat") : array);
}

}  // namespace

std::vector<double> numbers_in(const val& array) { return plain_numbers<double>(array); }

std::uint32_t index_in(double number) {
  if (!(number >= 0 && number < 0x1p32 - 1 && number == std::floor(number)))
    throw Thrown{{ErrorCode::bad_index, "an index is an integer from 0 on", {}}};
  return static_cast<std::uint32_t>(number);
}
std::vector<std::uint32_t> indices_in(const val& array) {
  std::vector<std::uint32_t> indices;
  for (const double number : plain_numbers<double>(array)) indices.push_back(index_in(number));
  return indices;
}

void check_finite(std::initializer_list<double> coordinates) {
  for (const double x : coordinates)
    if (!std::isfinite(x)) throw Thrown{{ErrorCode::not_finite, "a place has finite numbers as coordinates", {}}};
}

std::size_t bits_in(const val& bits) {
  const double most = is_none(bits) ? 0x1p20 : bits.as<double>();
  if (!(most >= 0)) throw std::invalid_argument("a number of bits is not negative");
  return static_cast<std::size_t>(std::min(most, 0x1p31));
}

Ring points_in(const val& coordinates) {
  const std::vector<double> numbers = numbers_in(coordinates);
  if (numbers.size() % 2 != 0)
    throw Thrown{{ErrorCode::malformed, "coordinates are x, y after x, y: an odd number of them", {}}};
  Ring ring(numbers.size() / 2);
  for (std::size_t k = 0; k < ring.size(); ++k) ring[k] = {numbers[2 * k], numbers[2 * k + 1]};
  return ring;
}

Point point_in(const val& at) {
  const Point position{at["x"].as<double>(), at["y"].as<double>()};
  check_finite({position.x, position.y});
  return position;
}
Point3 point3_in(const val& at) {
  const Point3 position{at["x"].as<double>(), at["y"].as<double>(), at["z"].as<double>()};
  check_finite({position.x, position.y, position.z});
  return position;
}

}  // namespace dymsum::web
