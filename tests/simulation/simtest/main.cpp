// lockstep-simtest: whole machines in virtual time, drawn from seeds, judged step by step.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>

#include "tests/simulation/simtest/report.hpp"

namespace {

using namespace lockstep::simtest;

constexpr std::uint64_t kTwiceEvery = 16;  // runs, one of which is played twice

Tally run_all(const Options& options) {
    Tally tally;
    const auto began = std::chrono::steady_clock::now();
    for (std::uint64_t n = 0; n < options.runs; ++n) {
        const std::uint64_t seed = options.seed + n;
        const bool twice = options.runs == 1 || n % kTwiceEvery == 0;
        const Verdict verdict = run_seed(seed, options.network(), options.axes, twice);
        tally.add(verdict);
        if (options.verbose || !verdict.violations.empty()) { print_run(seed, verdict, options); }
    }
    tally.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return tally;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app{"Runs random machines, programs, networks and interrupts in virtual time and judges every step."};
    app.add_option("--seed", options.seed, "the first seed");
    app.add_option("--runs", options.runs, "how many, with seeds that follow each other");
    app.add_option("--axes", options.axes, "of every machine; drawn, 1 to 6, if not given")->check(CLI::Range(1, 32));
    app.add_option("--faults", options.faults, "none, all, or of delay, reorder, duplicate, loss")
        ->delimiter(',')
        ->check(CLI::IsMember({"none", "delay", "reorder", "duplicate", "loss", "all"}));
    app.add_flag("--json", options.json, "the figures as JSON");
    app.add_flag("--verbose", options.verbose, "a line for every run");
    CLI11_PARSE(app, argc, argv);
    const Tally tally = run_all(options);
    print_tally(tally, options);
    return tally.failed == 0 ? 0 : 1;
}
