#include "verdict.h"

#include <cstdlib>
#include <exception>
#include <string_view>

#include "check_sum.h"
#include "exact_shape.h"
#include "membership.h"
#include "pair_text.h"
#include "reference_sum.h"
#include "shrink.h"

namespace dymsum::oracles {
namespace {

constexpr Semantics kSemantics[] = {Semantics::closed, Semantics::open, Semantics::regular};
constexpr std::string_view kSemanticsNames[] = {"closed", "open", "regular"};
constexpr Engine kEngines[] = {Engine::fast, Engine::brute, Engine::winding};
constexpr std::string_view kEngineNames[] = {"fast", "brute", "winding"};

SumOptions options(Engine engine, Semantics semantics) {
  SumOptions out;
  out.engine = engine;
  out.semantics = semantics;
  return out;
}

std::string check_semantics(const Region& p, const Region& q, std::size_t index) {
  const Semantics semantics = kSemantics[index];
  const std::string title = std::string(kSemanticsNames[index]) + " sum, engine ";
  const Result<PlanarSum> fast = minkowski_sum(p, q, options(kEngines[0], semantics));
  if (!fast.ok()) return title + "fast: " + fast.error().to_string();
  if (std::string wrong = check_sum(p, q, semantics, *fast); !wrong.empty()) return title + "fast: " + wrong;
  for (std::size_t e = 1; e < 3; ++e) {
    const Result<PlanarSum> other = minkowski_sum(p, q, options(kEngines[e], semantics));
    const std::string name = title + std::string(kEngineNames[e]) + ": ";
    if (!other.ok()) return name + other.error().to_string();
    if (std::string wrong = check_sum(p, q, semantics, *other); !wrong.empty()) return name + wrong;
    if (!(*other == *fast)) return name + "right, but not equal to the fast engine's";
  }
  return "";
}

std::string check_contains(const Region& p, const Region& q) {
  const auto a = bounds(p), b = bounds(q);
  const Membership<Big> member(p.data(), q.data());
  const bool thin_pair = has_thin_pair(p.data(), q.data());
  for (int i = 0; i <= 3; ++i)
    for (int j = 0; j <= 3; ++j) {
      const Point z{a[0] + b[0] + (a[2] + b[2] - a[0] - b[0]) * i / 3,
                    a[1] + b[1] + (a[3] + b[3] - a[1] - b[1]) * j / 3};
      const Pt<Big> exact{from_double<Big>(z.x), from_double<Big>(z.y)};
      if (contains(p, q, z, Semantics::closed) != member.meets(exact)) return "contains (closed) is wrong";
      if (contains(p, q, z, Semantics::open) != member.overlaps(exact)) return "contains (open) is wrong";
      if (!thin_pair && contains(p, q, z, Semantics::regular) != member.meets(exact))
        return "contains (regular) is wrong";
    }
  return "";
}

std::string check_difference(const Region& p, const Region& q) {
  const Result<PlanarSum> fit = nfp(p, q);
  if (!fit.ok()) return "nfp: " + fit.error().to_string();
  if (std::string wrong = check_nfp(p, q, *fit); !wrong.empty()) return "nfp: " + wrong;
  if (!p.polylines().empty() || !p.points().empty()) return "";
  for (std::size_t e = 0; e < 3; ++e) {
    const Result<PlanarSum> inner = erode(p, q, options(kEngines[e], Semantics::closed));
    const std::string name = "erode, engine " + std::string(kEngineNames[e]) + ": ";
    if (!inner.ok()) return name + inner.error().to_string();
    if (std::string wrong = check_erode(p, q, *inner); !wrong.empty()) return name + wrong;
  }
  return "";
}

std::string judge(const Region& p, const Region& q) {
  const std::size_t count =
      has_thin_pair(p.data(), q.data()) ? 3 : 2;  // otherwise regular is closed without its features
  for (std::size_t i = 0; i < count; ++i)
    if (std::string wrong = check_semantics(p, q, i); !wrong.empty()) return wrong;
  if (count == 2) {
    const Result<PlanarSum> closed = minkowski_sum(p, q),
                            regular = minkowski_sum(p, q, options(Engine::fast, Semantics::regular));
    PlanarSum bare = *closed;
    bare.tight_points.clear();
    bare.tight_segments.clear();
    if (!(bare == *regular)) return "regular sum: not the parts of the closed one";
  }
  if (std::string wrong = check_contains(p, q); !wrong.empty()) return wrong;
  return check_difference(p, q);
}

}  // namespace

std::string verdict(const RegionData& p, const RegionData& q) {
  const Result<Region> first = Region::create(p), second = Region::create(q);
  if (!first.ok()) return "invalid operand: p: " + first.error().to_string();
  if (!second.ok()) return "invalid operand: q: " + second.error().to_string();
  if (first->empty() || second->empty()) return "invalid operand: empty";
  try {
    return judge(*first, *second);
  } catch (const std::exception& error) {
    return std::string("exception: ") + error.what();
  }
}

std::string failure_report(const RegionData& p, const RegionData& q, const std::string& wrong) {
  const Pair small = shrink({p, q}, [](const RegionData& a, const RegionData& b) {
    const std::string text = verdict(a, b);
    return !text.empty() && !refused(text);
  });
  return "# " + wrong + "\n# shrunk: " + verdict(small.p, small.q) + "\n" + to_text(small.p, small.q) +
         "# before shrinking:\n# p " + to_wkt(p) + "\n# q " + to_wkt(q) + "\n";
}

std::uint64_t setting(const char* name, std::uint64_t fallback) {
  const char* text = std::getenv(name);
  return text == nullptr || *text == '\0' ? fallback : std::strtoull(text, nullptr, 10);
}

}  // namespace dymsum::oracles
