#include <new>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "plain.h"

namespace dymsum::web {
namespace {

bool is_there(const std::string& text) { return !text.empty(); }
template <class T>
bool is_there(const std::optional<T>& value) {
  return value.has_value();
}

val evidence_data(const Evidence& evidence) {
  val data = val::object();
  names::for_each_field(evidence, [&](std::string_view name, const auto& value) {
    if (is_there(value)) data.set(camel_case(name), plain(value));
  });
  return data;
}

val data_of(std::string_view code, const std::string& reason, const std::string& message, const val& evidence) {
  val data = val::object();
  data.set("code", std::string(code));
  data.set("reason", reason);
  data.set("message", message);
  data.set("evidence", evidence);
  return data;
}

val failure_with(const val& data) { return val::module_property("Failure").new_(data); }

val plain_failure(std::string_view code, const std::string& message) {
  return failure_with(data_of(code, message, message, val::object()));
}

}  // namespace

val error_data(const Error& error) {
  return data_of(name(error.code), error.message, error.to_string(), evidence_data(error.evidence));
}

val failure(const Error& error) { return failure_with(error_data(error)); }

val failure_of_current() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return plain_failure("out_of_memory", "out of memory: the operands, or what comes of them, are too large");
  } catch (const std::invalid_argument& error) {
    return plain_failure("invalid_argument", error.what());
  } catch (const std::out_of_range& error) {
    return plain_failure("invalid_argument", error.what());
  } catch (const std::exception& error) {
    return plain_failure("defect", error.what());
  }
}

}  // namespace dymsum::web
