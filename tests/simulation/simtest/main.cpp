// lockstep-simtest: whole machines in virtual time, drawn from seeds; every step is checked.
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "services/arguments/argument_parser.hpp"
#include "tests/simulation/simtest/run/report.hpp"

namespace {

using namespace lockstep::simtest;

constexpr std::uint64_t kTwiceEvery = 16;  // one of this number of seeds is played twice

constexpr const char* kKinds =
    R"(Kinds of faults:
  delay      messages take up to a slot:             lockstep-simtest --faults delay --runs 1000
  reorder    later messages overtake earlier ones:   lockstep-simtest --faults reorder,delay
  duplicate  messages come twice:                    lockstep-simtest --faults duplicate
  loss       messages are lost, up to one in 20:     lockstep-simtest --faults loss
  freeze     a process's loop stalls for a while, its device continues:
                                                     lockstep-simtest --faults freeze --axes 3
  crash      a process ends, and another takes its place later:
                                                     lockstep-simtest --faults crash
  partition  a link is cut, or a process from all others, both ways or one:
                                                     lockstep-simtest --faults partition
  corrupt    messages are altered on their way:      lockstep-simtest --faults corrupt
  stall      a process stalls between a loop's decisions and their execution:
                                                     lockstep-simtest --faults stall
  clock      boards have their own clocks, seconds and 100 ppm apart, which may be set:
                                                     lockstep-simtest --faults clock
  override   no fault: feed and rapid are turned while jobs run:
                                                     lockstep-simtest --faults override,loss
  standby    a second coordinator stands by, and takeovers go wrong:
                                                     lockstep-simtest --faults standby --axes 2
  limit      a switch is stuck, a slide is pushed, a device loses a frame:
                                                     lockstep-simtest --faults limit --axes 3
  device     an axis's device dies, stops for a while, or is overwritten:
                                                     lockstep-simtest --faults device --axes 3
  stream     no fault: programs are sent while they run, in parts that come in time or late:
                                                     lockstep-simtest --faults stream,override
  curve      no fault: programs have arcs, path modes, fixed feeds and events:
                                                     lockstep-simtest --faults curve,override
  mixed      each run has about half of the other named kinds:
                                                     lockstep-simtest --faults mixed,loss,clock

Everything follows from the seed. A run that fails prints the command that replays it:
  lockstep-simtest --seed 93 --runs 1 --faults freeze --trace)";

std::vector<std::string> names_of_faults() {
    std::vector<std::string> names{"none", "all"};
    for (const NamedKind& named : kFaultKinds) { names.emplace_back(named.name); }
    return names;
}

Tally run_all(const Options& options) {
    Tally tally;
    const auto began = std::chrono::steady_clock::now();
    for (std::uint64_t n = 0; n < options.runs; ++n) {
        const std::uint64_t seed = options.seed + n;
        const bool twice = seed % kTwiceEvery == 0;
        const RunResult result = run_seed(seed, {options.kinds(), options.machine, twice, options.trace});
        tally.add(result);
        if (options.verbose || !result.violations.empty()) { print_run(seed, result, options); }
    }
    tally.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return tally;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    lockstep::ArgumentParser parser(
        "Runs random machines, programs, networks and interrupts in virtual time and checks every step.");
    parser.add_option("--seed", options.seed, "the first seed");
    parser.add_option("--runs", options.runs, "the number of runs, with consecutive seeds");
    parser.add_option("--axes", options.machine.axes, "axes of every machine; without it 1 to 6, drawn")
        .in_range(1, 32);
    for (const MachineKind::Flag& flag : kMachineFlags) {
        parser.add_flag(flag.name, options.machine.*flag.kind, flag.help);
    }
    parser
        .add_option("--faults", options.faults,
                    "none, all (half of the kinds in each run), or a list of the kinds below")
        .separated_by_commas()
        .one_of(names_of_faults());
    parser.footer(kKinds);
    parser.add_option("--coverage", options.coverage, "write the coverage of the runs to this file, as JSON");
    parser.add_flag("--json", options.json, "print the figures as JSON");
    parser.add_flag("--trace", options.trace, "print a line for each event of a run");
    parser.add_flag("--verbose", options.verbose, "print a line for every run");
    parser.action([&] {
        std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // a failed run is printed at once, also into a file
        const Tally tally = run_all(options);
        print_tally(tally, options);
        if (!options.coverage.empty() && !save_coverage(tally.coverage, options.coverage)) {
            std::fprintf(stderr, "%s: cannot be written; name a file in a folder that exists\n",
                         options.coverage.c_str());
            return 2;
        }
        return tally.failed == 0 ? 0 : 1;
    });
    return parser.run(argc, argv);
}
