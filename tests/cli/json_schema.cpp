#include "json_schema.h"

#include <algorithm>
#include <regex>
#include <stdexcept>

namespace dymsum::cli_test {
namespace {

using Json = nlohmann::json;

bool has_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  throw std::runtime_error("unknown type " + type);
}

class Validator {
 public:
  explicit Validator(const Json& root) : root_(root) {}

  /// Appends what is wrong; `seen` collects the properties that some schema speaks of.
  void check(const Json& schema, const Json& value, const std::string& at, std::set<std::string>& seen) {
    for (const auto& [keyword, rule] : schema.items()) {
      if (keyword == "$ref") check(root_["$defs"].at(rule.get<std::string>().substr(8)), value, at, seen);
      else if (keyword == "allOf")
        for (const Json& each : rule) check(each, value, at, seen);
      else if (keyword == "anyOf") any_of(rule, value, at, seen);
      else if (keyword == "type") type(rule, value, at);
      else if (keyword == "const") expect(value == rule, at, "is " + value.dump() + ", not " + rule.dump());
      else if (keyword == "enum")
        expect(std::find(rule.begin(), rule.end(), value) != rule.end(), at, value.dump() + " is not allowed");
      else if (keyword == "pattern")
        expect(!value.is_string() || std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>())),
               at, "does not match");
      else if (keyword == "minimum") expect(!value.is_number() || value >= rule, at, "is too small");
      else if (keyword == "minItems") expect(!value.is_array() || value.size() >= rule, at, "has too few items");
      else if (keyword == "maxItems") expect(!value.is_array() || value.size() <= rule, at, "has too many items");
      else if (keyword == "items") items(rule, value, at);
      else if (keyword == "required") required(rule, value, at);
      else if (keyword == "properties") properties(rule, value, at, seen);
      else if (keyword != "additionalProperties" && keyword != "unevaluatedProperties")
        throw std::runtime_error("unknown keyword " + keyword);
    }
    rest(schema, value, at, seen);
  }

  std::vector<std::string> found;

 private:
  void expect(bool holds, const std::string& at, const std::string& what) {
    if (!holds) found.push_back(at + ": " + what);
  }
  void type(const Json& rule, const Json& value, const std::string& at) {
    const bool fits = rule.is_string()
                          ? has_type(value, rule)
                          : std::any_of(rule.begin(), rule.end(), [&](const Json& t) { return has_type(value, t); });
    expect(fits, at, value.dump().substr(0, 60) + " is no " + rule.dump());
  }
  void any_of(const Json& rules, const Json& value, const std::string& at, std::set<std::string>& seen) {
    for (const Json& rule : rules) {
      Validator other(root_);
      std::set<std::string> more;
      other.check(rule, value, at, more);
      if (!other.found.empty()) continue;
      seen.insert(more.begin(), more.end());
      return;
    }
    expect(false, at, value.dump().substr(0, 60) + " is none of those allowed");
  }
  void items(const Json& rule, const Json& value, const std::string& at) {
    std::set<std::string> seen;
    for (std::size_t i = 0; value.is_array() && i < value.size(); ++i, seen.clear())
      check(rule, value[i], at + "/" + std::to_string(i), seen);
  }
  void required(const Json& rule, const Json& value, const std::string& at) {
    for (const Json& key : rule)
      expect(!value.is_object() || value.contains(key.get<std::string>()), at, "lacks " + key.dump());
  }
  void properties(const Json& rule, const Json& value, const std::string& at, std::set<std::string>& seen) {
    for (const auto& [key, each] : rule.items()) {
      if (!value.is_object() || !value.contains(key)) continue;
      seen.insert(key);
      std::set<std::string> inner;
      check(each, value[key], at + "/" + key, inner);
    }
  }
  /// Properties that nothing speaks of: in this schema object, or in all that apply.
  void rest(const Json& schema, const Json& value, const std::string& at, std::set<std::string>& seen) {
    for (const char* keyword : {"additionalProperties", "unevaluatedProperties"}) {
      if (!schema.contains(keyword) || !value.is_object()) continue;
      for (const auto& [key, each] : value.items()) {
        const bool named = schema.contains("properties") && schema["properties"].contains(key);
        if (named || (keyword[0] == 'u' && seen.contains(key))) continue;
        expect(!schema[keyword].is_boolean(), at + "/" + key, "is not in the schema");
        std::set<std::string> inner;
        if (schema[keyword].is_object()) check(schema[keyword], each, at + "/" + key, inner);
      }
    }
  }

  const Json& root_;
};

}  // namespace

std::vector<std::string> violations(const Json& schema, const std::string& name, const Json& value) {
  Validator validator(schema);
  std::set<std::string> seen;
  validator.check(schema["$defs"].at(name), value, "", seen);
  return validator.found;
}

}  // namespace dymsum::cli_test
