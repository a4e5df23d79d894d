#include "dymsum/rational.h"

#include "exact/big.h"

namespace dymsum {

double Rational::to_double() const { return exact::round_to_double(exact::exact_value(*this)); }

}  // namespace dymsum
