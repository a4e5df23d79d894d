#include "plain.h"

namespace dymsum::web {

std::string camel_case(std::string_view name) {
  std::string made;
  for (std::size_t k = 0; k < name.size(); ++k)
    if (name[k] != '_') made += k > 0 && name[k - 1] == '_' ? static_cast<char>(name[k] - 'a' + 'A') : name[k];
  return made;
}

}  // namespace dymsum::web
