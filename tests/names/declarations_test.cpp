// index.d.ts declares what the lists of names and fields say: enumerators, fields and their types.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "names/enumerations.h"
#include "names/records.h"

namespace dymsum::names {
namespace {

/// The declarations without comments, blanks made single.
const std::string& declarations() {
  static const std::string text = [] {
    std::ifstream file(DYMSUM_SOURCE_DIR "/web/package/index.d.ts");
    std::string all{std::istreambuf_iterator<char>(file), {}};
    for (const auto& [begin, end] : {std::pair("/*", "*/"), std::pair("//", "\n")})
      for (std::size_t at = all.find(begin); at != std::string::npos; at = all.find(begin))
        all.erase(at, all.find(end, at) + std::string_view(end).size() - at);
    return std::regex_replace(all, std::regex("\\s+"), " ");
  }();
  return text;
}

using Properties = std::map<std::string, std::string>;

/// "a: T; b: U;" as properties: types may have braces of their own.
Properties properties_in(const std::string& body) {
  Properties made;
  std::string one;
  int depth = 0;
  for (const char c : body) {
    depth += (c == '{') - (c == '}');
    if (c != ';' || depth > 0) {
      one += c;
      continue;
    }
    const std::size_t colon = one.find(':'), begin = one.find_first_not_of(' ');
    made[one.substr(begin, colon - begin)] = one.substr(colon + 2);
    one.clear();
  }
  return made;
}

Properties interface_named(const std::string& name) {
  std::size_t head = declarations().find("export interface " + name + " ");
  if (head == std::string::npos) return {};
  head = declarations().find('{', head) + 1;
  const std::string rest = declarations().substr(head);
  std::size_t end = 0;
  for (int depth = 1; depth > 0; ++end) depth += (rest[end] == '{') - (rest[end] == '}');
  return properties_in(rest.substr(0, end - 1));
}

std::string camel_case(std::string_view name) {
  std::string made;
  for (std::size_t k = 0; k < name.size(); ++k)
    if (name[k] != '_') made += k > 0 && name[k - 1] == '_' ? static_cast<char>(std::toupper(name[k])) : name[k];
  return made;
}

std::string union_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : " | '") + name + "'";
  return text;
}

template <class T>
const char* interface_of() {
  const char* found = nullptr;
  const auto look = [&]<class Record>(const Listing<Record>& listing) {
    if (std::is_same_v<Record, T>) found = listing.interface;
  };
  std::apply([&](const auto&... listings) { (look(listings), ...); }, kRecords);
  return found;
}

template <class T>
struct TypeText;

/// The type of a value in TypeScript.
template <class T>
std::string type_of(const T& value) {
  if constexpr (std::is_same_v<T, bool>) return "boolean";
  else if constexpr (std::is_arithmetic_v<T>) return "number";
  else if constexpr (std::is_enum_v<T>) return union_of({names_of<T>().begin(), names_of<T>().end()});
  else if constexpr (std::is_convertible_v<T, std::string_view>) return "string";
  else if constexpr (std::is_same_v<T, Rational>) return "ExactText";
  else return TypeText<T>::of(value);
}

template <class T>
struct TypeText<std::optional<T>> {
  static std::string of(const std::optional<T>&) { return type_of(T{}) + " | null"; }
};
template <class T>
struct TypeText<std::vector<T>> {
  static std::string of(const std::vector<T>&) { return type_of(T{}) + "[]"; }
};
template <class T, std::size_t n>
struct TypeText<std::array<T, n>> {
  static std::string of(const std::array<T, n>&) { return type_of(T{}) + "[]"; }
};
template <class T>
Properties fields_of() {
  Properties made;
  const T record{};
  for_each_field(record, [&](std::string_view name, const auto& value) { made[camel_case(name)] = type_of(value); });
  return made;
}
template <class T>
struct TypeText {
  static std::string of(const T& record) {
    if (const char* name = interface_of<T>()) return name;
    std::string text;
    for_each_field(record, [&](std::string_view name, const auto& value) {
      text += (text.empty() ? "{ " : "; ") + camel_case(name) + ": " + type_of(value);
    });
    return text + " }";
  }
};

/// What the package has otherwise: besides the fields, or with null for Patch::kNone.
const std::map<std::string, Properties> kOtherwise = {
    {"PlanarTouch", {{"approx", "Point"}, {"dimension", "0 | 1"}}},
    {"PlanarWay", {{"approx", "Point"}}},
    {"SolidTouch", {{"approx", "Point3"}, {"dimension", "0 | 1 | 2"}}},
    {"SolidWay", {{"approx", "Point3"}}},
    {"ScaleRange", {{"trap", "ExactText | null"}}},
    {"SolidScaleRange", {{"trap", "ExactText | null"}}},
    {"Patch", {{"rotating", "boolean"}}},
    {"Clearance", {{"patch", "number | null"}, {"contact", "Contact | null"}}},
    {"FreeAngles", {{"beginPatch", "number | null"}, {"endPatch", "number | null"}}},
    {"BridgeContact", {{"at", ""}, {"x", "number"}, {"y", "number"}}}};

template <class Record>
void expect_declared(const Listing<Record>& listing) {
  if (listing.interface == nullptr) return;
  Properties expected = fields_of<Record>();
  if (const auto other = kOtherwise.find(listing.interface); other != kOtherwise.end())
    for (const auto& [name, type] : other->second) expected[name] = type;
  std::erase_if(expected, [](const auto& property) { return property.second.empty(); });
  EXPECT_EQ(interface_named(listing.interface), expected) << listing.interface;
}

TEST(Declarations, HaveTheFieldsOfRecords) {
  std::apply([](const auto&... listings) { (expect_declared(listings), ...); }, kRecords);
  EXPECT_EQ(interface_named("Plan")["work"], type_of(PlanWork{}));
}

TEST(Declarations, HaveTheFieldsOfEvidence) {
  std::set<std::string> declared, listed;
  for (const auto& [name, type] : interface_named("Evidence")) declared.insert(name);
  for (const auto& [name, type] : fields_of<Evidence>()) listed.insert(name + "?");
  EXPECT_EQ(declared, listed);
}

/// The names of an enumeration, less some and with others.
std::string changed(const char* name, const std::set<std::string>& less, const std::vector<std::string>& more = {}) {
  for (auto [declared, enumerators] : enumerations()) {
    if (declared != name) continue;
    std::erase_if(enumerators, [&](const std::string& one) { return less.contains(one); });
    enumerators.insert(enumerators.end(), more.begin(), more.end());
    return union_of(enumerators);
  }
  return "";
}

TEST(Declarations, HaveTheNamesOfEnumerators) {
  std::set<std::string> known{changed("ErrorCode", {}, {"invalid_argument", "defect"}),
                              changed("MeshFormat", {"three_mf"}), changed("RegionFormat", {"gpkg"}),
                              changed("EventKind", {"normal_on_arc", "edge_and_facets"})};  // of a scaling operand
  for (const auto& [name, enumerators] : enumerations())
    if (name != "ErrorCode" && name != "MeshFormat" && name != "RegionFormat") known.insert(union_of(enumerators));
  const std::regex text("'\\w+'( \\| '\\w+')+");
  std::size_t unions = 0;
  for (std::sregex_iterator at(declarations().begin(), declarations().end(), text), end; at != end; ++at, ++unions)
    EXPECT_TRUE(known.contains(at->str())) << at->str();
  EXPECT_GT(unions, 40U);
}

}  // namespace
}  // namespace dymsum::names
