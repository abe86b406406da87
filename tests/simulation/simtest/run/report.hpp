// What the program is asked, and what it says.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/simulation/simtest/run/run.hpp"

namespace lockstep::simtest {

struct Options {
    std::uint64_t seed = 1;
    std::uint64_t runs = 100;
    MachineKind machine;
    std::vector<std::string> faults{"none"};
    bool json = false;
    std::string coverage;  // the file to write it into; empty: none
    bool verbose = false;
    bool trace = false;

    FaultKinds kinds() const;
};

struct Tally {
    std::uint64_t runs = 0;
    std::uint64_t failed = 0;
    std::uint64_t faulted = 0;  // were in Fault at some time, for what went wrong on purpose
    std::uint64_t parted = 0;   // epochs of which not all axes ran the same frames: one more or less, and it was said
    std::uint64_t steps = 0;
    double simulated_s = 0;
    double wall_s = 0;
    Coverage coverage;

    void add(const Verdict& verdict);
};

/// What was violated and where, and the command line that replays it.
void print_run(std::uint64_t seed, const Verdict& verdict, const Options& options);
/// As JSON. False: the file cannot be written.
[[nodiscard]] bool save_coverage(const Coverage& coverage, const std::string& path);
void print_tally(const Tally& tally, const Options& options);

}  // namespace lockstep::simtest
