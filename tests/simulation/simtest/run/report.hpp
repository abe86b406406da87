// The program's options and its report.
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
    std::string coverage;  // the file for the coverage; empty: none
    bool verbose = false;
    bool trace = false;

    FaultKinds kinds() const;
};

struct Tally {
    std::uint64_t runs = 0;
    std::uint64_t failed = 0;
    std::uint64_t faulted = 0;  // runs that were in Fault because of an injected fault
    std::uint64_t parted = 0;   // epochs in which an axis ran one frame more or less, as reported
    std::uint64_t steps = 0;
    double simulated_s = 0;
    double wall_s = 0;
    Coverage coverage;

    void add(const RunResult& result);
};

/// Prints the violations with their places, and the command line that replays the run.
void print_run(std::uint64_t seed, const RunResult& result, const Options& options);
/// Writes JSON. False: the file cannot be written.
[[nodiscard]] bool save_coverage(const Coverage& coverage, const std::string& path);
void print_tally(const Tally& tally, const Options& options);

}  // namespace lockstep::simtest
