#include "tests/simulation/simtest/run/report.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstdio>

namespace lockstep::simtest {
namespace {

std::string joined(const std::vector<std::string>& words, const std::string& separator = ",") {
    std::string text;
    for (const std::string& word : words) { text += (text.empty() ? "" : separator) + word; }
    return text;
}

std::string place(const Violation& v) {
    std::string text;
    if (v.axis) { text += " axis " + std::to_string(*v.axis + 1); }
    if (v.tick) { text += " tick " + std::to_string(*v.tick); }
    if (v.step) { text += " step " + std::to_string(*v.step); }
    return text;
}

void write_coverage(std::FILE* to, const Coverage& coverage) {
    const char* between_groups = "";
    for (const auto& [group, counts] : coverage.groups()) {
        std::fprintf(to, "%s\"%s\": {", between_groups, group.c_str());
        between_groups = ", ";
        const char* between = "";
        for (const auto& [name, times] : counts) {
            std::fprintf(to, "%s\"%s\": %" PRIu64, between, name.c_str(), times);
            between = ", ";
        }
        std::fprintf(to, "}");
    }
}

void print_json(const Tally& t) {
    std::printf("{\"runs\": %" PRIu64 ", \"failed\": %" PRIu64 ", \"faulted\": %" PRIu64 ", \"parted\": %" PRIu64
                ", \"steps\": %" PRIu64 ", \"simulatedHours\": %.6f, \"wallSeconds\": %.3f, \"coverage\": {",
                t.runs, t.failed, t.faulted, t.parted, t.steps, t.simulated_s / 3600, t.wall_s);
    write_coverage(stdout, t.coverage);
    std::printf("}}\n");
}

void print_coverage(const Coverage& coverage) {
    for (const auto& [group, counts] : coverage.groups()) {
        std::vector<std::string> never;
        for (const auto& [name, times] : counts) {
            if (times == 0) { never.push_back(name); }
        }
        const bool some = !never.empty() && never.size() < counts.size();
        std::printf("  %-17s %2zu of %2zu%s%s\n", group.c_str(), counts.size() - never.size(), counts.size(),
                    some ? ", never: " : "", some ? joined(never, ", ").c_str() : "");
    }
}

void print_text(const Tally& t) {
    const double hours = t.simulated_s / 3600;
    std::printf("%" PRIu64 " runs, %" PRIu64 " failed, %" PRIu64 " in Fault, %" PRIu64 " epochs parted; %" PRIu64
                " steps checked; %.3f hours in %.1f s: %.4f hours a second, %.1f runs a second\n",
                t.runs, t.failed, t.faulted, t.parted, t.steps, hours, t.wall_s, hours / t.wall_s,
                static_cast<double>(t.runs) / t.wall_s);
    if (t.runs > 1) { print_coverage(t.coverage); }
}

}  // namespace

FaultKinds Options::kinds() const {
    const auto has = [this](const char* name) { return std::ranges::find(faults, name) != faults.end(); };
    if (has("all")) { return FaultKinds::all(); }
    FaultKinds kinds;
    for (const NamedKind& named : kFaultKinds) { kinds.*named.kind = has(named.name); }
    return kinds;
}

void Tally::add(const RunResult& result) {
    ++runs;
    failed += result.violations.empty() ? 0 : 1;
    faulted += result.fault == FaultCode::None ? 0 : 1;
    parted += result.parted;
    steps += result.steps;
    coverage.add(result.coverage);
    simulated_s += result.simulated_s;
}

void print_run(std::uint64_t seed, const RunResult& result, const Options& options) {
    const bool faulted = result.fault != FaultCode::None;
    const std::string fault = faulted ? ", was in Fault: " + std::string(name_of(result.fault)) : "";
    std::FILE* to = options.json ? stderr : stdout;
    std::fprintf(to, "seed %" PRIu64 ": %" PRIu64 " steps in %.3f s, hash %016" PRIx64 ", published %016" PRIx64 "%s\n",
                 seed, result.steps, result.simulated_s, result.hash, result.published, fault.c_str());
    constexpr std::size_t kMostPrinted = 8;
    for (std::size_t n = 0; n < std::min(kMostPrinted, result.violations.size()); ++n) {
        const Violation& v = result.violations[n];
        std::fprintf(to, "  VIOLATED %s:%s: %s\n", v.rule.c_str(), place(v).c_str(), v.text.c_str());
    }
    if (result.violations.size() > kMostPrinted) {
        std::fprintf(to, "  ... and %zu more\n", result.violations.size() - kMostPrinted);
    }
    if (result.violations.empty()) { return; }
    std::string machine;
    if (options.machine.axes) { machine += " --axes " + std::to_string(*options.machine.axes); }
    for (const MachineKind::Flag& flag : kMachineFlags) {
        if (options.machine.*flag.kind) { machine += std::string(" ") + flag.name; }
    }
    std::fprintf(to, "  replay: lockstep-simtest --seed %" PRIu64 " --runs 1 --faults %s%s --trace\n", seed,
                 joined(options.faults).c_str(), machine.c_str());
}

void print_tally(const Tally& t, const Options& options) { options.json ? print_json(t) : print_text(t); }

bool save_coverage(const Coverage& coverage, const std::string& path) {
    std::FILE* file = std::fopen(path.c_str(), "w");
    if (file == nullptr) { return false; }
    std::fprintf(file, "{");
    write_coverage(file, coverage);
    std::fprintf(file, "}\n");
    return std::fclose(file) == 0;
}

}  // namespace lockstep::simtest
