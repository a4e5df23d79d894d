// dymsum_bench_cspace: questions to configuration-space obstacles, against the sampled penetration depth of the thesis.
#include <cstring>
#include <iostream>

#include "cspace/queries.h"

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
  if (argc > 2 || (argc == 2 && !quick)) {
    std::cerr << "dymsum_bench_cspace [--quick]\n  --quick  a tenth of the questions\n";
    return 2;
  }
  dymsum::bench::QueryTables tables(std::cout, quick ? 100 : 1000, quick ? 1000 : 10000);
  tables.heading();
  for (const dymsum::bench::QueryPair& pair : dymsum::bench::depth_pairs()) tables.row(pair);
  return 0;
}
