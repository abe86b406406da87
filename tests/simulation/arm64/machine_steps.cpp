// Prints for some seeds the number of steps of a drawn machine and their hash.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "tests/simulation/simtest/run/play.hpp"

int main(int argc, char** argv) {
    using namespace lockstep::simtest;
    if (argc != 3) {
        std::fprintf(stderr, "usage: machine_steps FIRST_SEED RUNS\n");
        return 2;
    }
    const std::uint64_t first = std::strtoull(argv[1], nullptr, 10);
    const std::uint64_t runs = std::strtoull(argv[2], nullptr, 10);
    for (std::uint64_t seed = first; seed < first + runs; ++seed) {
        const Played played = play(draw_scenario(seed, FaultKinds::all(), {}));
        std::printf("seed %" PRIu64 ": %" PRIu64 " steps, hash %016" PRIx64 ", %zu violations\n", seed,
                    played.recording.steps(), played.recording.hash(), played.violations.size());
    }
    return 0;
}
