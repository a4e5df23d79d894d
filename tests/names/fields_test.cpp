// A list of fields has every member of its record, in the order of the declaration.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "names/records.h"

namespace dymsum::names {
namespace {

template <class... Member>
std::vector<const void*> addresses(const Member&... members) {
  return {&members...};
}

/// Where the members of a record lie, by a structured binding: it has to name all of them.
template <std::size_t n, class Record>
std::vector<const void*> members_of(const Record& record) {
  if constexpr (n == 2) {
    const auto& [a, b] = record;
    return addresses(a, b);
  } else if constexpr (n == 3) {
    const auto& [a, b, c] = record;
    return addresses(a, b, c);
  } else if constexpr (n == 4) {
    const auto& [a, b, c, d] = record;
    return addresses(a, b, c, d);
  } else if constexpr (n == 5) {
    const auto& [a, b, c, d, e] = record;
    return addresses(a, b, c, d, e);
  } else if constexpr (n == 6) {
    const auto& [a, b, c, d, e, f] = record;
    return addresses(a, b, c, d, e, f);
  } else if constexpr (n == 7) {
    const auto& [a, b, c, d, e, f, g] = record;
    return addresses(a, b, c, d, e, f, g);
  } else if constexpr (n == 8) {
    const auto& [a, b, c, d, e, f, g, h] = record;
    return addresses(a, b, c, d, e, f, g, h);
  } else if constexpr (n == 9) {
    const auto& [a, b, c, d, e, f, g, h, i] = record;
    return addresses(a, b, c, d, e, f, g, h, i);
  } else if constexpr (n == 11) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k] = record;
    return addresses(a, b, c, d, e, f, g, h, i, j, k);
  } else if constexpr (n == 13) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = record;
    return addresses(a, b, c, d, e, f, g, h, i, j, k, l, m);
  } else if constexpr (n == 14) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o] = record;
    return addresses(a, b, c, d, e, f, g, h, i, j, k, l, m, o);
  } else if constexpr (n == 15) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p] = record;
    return addresses(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p);
  } else if constexpr (n == 16) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q] = record;
    return addresses(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q);
  } else {
    static_assert(n == 18);
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s] = record;
    return addresses(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s);
  }
}

template <class Record>
void expect_all_members(const Listing<Record>&) {
  const Record record{};
  std::vector<const void*> listed;
  std::vector<std::string> names;
  for_each_field(record, [&](std::string_view name, const auto& value) {
    listed.push_back(&value);
    names.emplace_back(name);
  });
  constexpr std::size_t n = std::tuple_size_v<std::remove_cvref_t<decltype(kFields<Record>)>>;
  EXPECT_EQ(listed, members_of<n>(record)) << testing::PrintToString(names);
}

TEST(Fields, AreAllMembersInTheirOrder) {
  std::apply([](const auto&... listings) { (expect_all_members(listings), ...); }, kRecords);
}

TEST(Fields, OfEveryListAreTested) {
  std::size_t lists = 0;
  const std::regex list("kFields<");
  for (const char* header : {"planar", "solid", "obstacle", "shape"}) {
    std::ifstream file(std::string(DYMSUM_SOURCE_DIR "/include/dymsum/") + header + "_fields.h");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    lists += static_cast<std::size_t>(std::distance(std::sregex_iterator(text.begin(), text.end(), list), {}));
  }
  EXPECT_EQ(lists, std::tuple_size_v<decltype(kRecords)>);
}

}  // namespace
}  // namespace dymsum::names
