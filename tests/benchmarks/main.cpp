// lockstep-bench: every benchmark of the project. `--benchmark_filter=step` runs one layer's.
#include <benchmark/benchmark.h>

BENCHMARK_MAIN();
