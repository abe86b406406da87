#include "clients/scenario/model/output_rules.hpp"

#include <algorithm>

namespace lockstep::scenario {
namespace {

constexpr double kMostMs = 60'000;

void check_times(const Asked::OutputAfter& output, const std::string& path, Problems& problems) {
    problems.require(output.has_off_within_ms() != output.has_keeps_for_ms(), path,
                     "an output needs one expectation; set off_within_ms: 600 or keeps_for_ms: 2000");
    const auto check = [&](bool is_given, const char* key, double ms) {
        problems.require(
            !is_given || (ms > 0 && ms <= kMostMs), path + "." + key,
            fmt::format("{} is {}; it must be above 0, to {}", key, number_text(ms), number_text(kMostMs)));
    };
    check(output.has_off_within_ms(), "off_within_ms", output.off_within_ms());
    check(output.has_keeps_for_ms(), "keeps_for_ms", output.keeps_for_ms());
    const bool is_ordered = !output.has_off_not_before_ms() ||
                            (output.off_not_before_ms() >= 0 && output.off_not_before_ms() < output.off_within_ms());
    problems.require(is_ordered, path + ".off_not_before_ms",
                     fmt::format("off_not_before_ms is {}; it must be at least 0 and below off_within_ms",
                                 number_text(output.off_not_before_ms())));
}

/// A device that ends notes nothing.
void check_device(const Asked::Act& act, const OutputConfig& output, const std::string& path, bool has_own_process,
                  Problems& problems) {
    const bool ends_alone = act.kill() == "fpga-" + output.motor || act.restart() == "fpga-" + output.motor;
    const bool ends_too = !has_own_process && (act.kill() == "axis-" + output.motor ||  //
                                               act.restart() == "axis-" + output.motor);
    problems.require(
        !ends_alone, path,
        "the act ends the device of " + output.name + ", so nothing notes its changes; remove this output");
    problems.require(!ends_too, path,
                     "the device of " + output.name + " ends with its process; set separate_devices: true");
}

}  // namespace

void check_outputs(const Asked::During& during, const std::string& path, const Scenario& scenario, Problems& problems) {
    const auto& outputs = scenario.machine.outputs;
    std::vector<std::string> names;
    for (const OutputConfig& output : outputs) { names.push_back(output.name); }
    for (int i = 0; i < during.output_size(); ++i) {
        const std::string place = path + "." + nth("output", i);
        const Asked::OutputAfter& asked = during.output(i);
        problems.require_one_of(place + ".name", asked.name(), names, "output");
        check_times(asked, place, problems);
        const auto output = std::ranges::find(outputs, asked.name(), &OutputConfig::name);
        if (output == outputs.end()) { continue; }
        check_device(during.act(), *output, place, scenario.asked.separate_devices(), problems);
    }
}

}  // namespace lockstep::scenario
