#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "core/coordinator/path/coordination.hpp"
#include "core/hardware/output_change.hpp"
#include "core/kinematics/motors.hpp"
#include "services/documents/machine_rules.hpp"
#include "services/documents/names.hpp"
#include "services/documents/problem_list.hpp"
#include "services/documents/rules/owner_rules.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kMostOutputs = 64;
constexpr double kMostFullScale = 1e6;
constexpr double kMostPulse_us = 1e6;
constexpr double kLeastWait_s = 0.001;
constexpr double kMostSpinUp_s = 3600;
constexpr double kLeastPwmTicks = 4;
constexpr double kMostSilence_ms = 3'600'000;

/// Checks one output after another, so that a second use of a channel or a word is found.
class OutputRules {
public:
    explicit OutputRules(const MachineConfig& machine) : machine_(machine) {}

    void check(const OutputConfig& output, const std::string& at) {
        check_name(output, at);
        check_channel(output, at);
        check_use(output, at);
        if (output.pwm) { check_pwm(*output.pwm, output.use, at + "pwm."); }
        if (output.makes_pulses()) { check_pulses(output, at); }
        check_spin_up(output, at);
        check_simulated_spindle(output, at + "simulated_spin_up_s");
        problems_.require(output.makes_pulses() || output.pulse_us == 0, at + "pulse_us",
                          fmt::format("output {} is on or off; remove pulse_us, or use PLACES", output.name));
    }
    void check_silence() {
        const ProtocolTiming& timing = machine_.timing;
        const double stall_ms = static_cast<double>(timing.slot_us) / 1000 * (timing.stall_slots + 1);
        const double silence = machine_.output_silence_ms;
        problems_.require(silence > stall_ms && silence <= kMostSilence_ms, "output_silence_ms",
                          fmt::format("output_silence_ms is {}; it must be above {}, for which a process may stall, up "
                                      "to {}",
                                      number_text(silence), number_text(stall_ms), number_text(kMostSilence_ms)));
    }
    ProblemList& problems() { return problems_; }

private:
    void check_name(const OutputConfig& output, const std::string& at) {
        problems_.require(is_axis_name(output.name), at + "name",
                          fmt::format("the name of an output is \"{}\"; it must be a letter, then letters, digits and "
                                      "_, at most {}",
                                      output.name, kMaxAxisName));
        const bool is_new = std::ranges::none_of(names_, [&](auto& name) { return same_name(name, output.name); });
        problems_.require(is_new, at + "name",
                          fmt::format("two outputs have the name {}; give each its own", output.name));
        names_.push_back(output.name);
    }

    void check_channel(const OutputConfig& output, const std::string& at) {
        const DeviceOwner owner{output.motor, output.at_board};
        check_owner(machine_, owner, at, problems_);
        const std::size_t most = output.is_analog() ? kMostAnalogOutputs : kMostDigitalOutputs;
        problems_.require_range(at + "channel", output.channel, 0, static_cast<double>(most) - 1);
        problems_.require(channels_.emplace(output.motor, output.is_analog(), output.channel).second, at + "channel",
                          fmt::format("{} output {} of {} is given twice; use another channel",
                                      output.is_analog() ? "analog" : "digital", output.channel, owner.text()));
    }

    void check_use(const OutputConfig& output, const std::string& at) {
        const OutputUseRow& use = row_of(output.use);
        problems_.require(
            use.may_be_analog || !output.pwm, at + "use",
            fmt::format("output {} is switched on and off; remove pwm, or use NUMBER or SPINDLE", output.name));
        problems_.require(!output.inverted || !output.pwm, at + "inverted",
                          fmt::format("output {} has pwm, and its pulses cannot be inverted; remove inverted, and "
                                      "invert them where they are used",
                                      output.name));
        const std::int32_t most = output.is_analog() ? kMostAnalogNumbers : kMostDigitalNumbers;
        if (use.has_number) { problems_.require_range(at + "number", output.number, 0, most - 1); }
        const auto word = std::tuple(output.use, output.is_analog(), use.has_number ? output.number : 0);
        problems_.require(
            words_.insert(word).second, at + "use",
            fmt::format("output {} has the words of another output; give it another use or number", output.name));
    }

    void check_pwm(const PwmConfig& pwm, OutputUse use, const std::string& at) {
        problems_.require_range(at + "hz", pwm.hz, 1, machine_.ticks_per_second() / kLeastPwmTicks);
        problems_.require(pwm.full_scale > 0 && pwm.full_scale <= kMostFullScale, at + "full_scale",
                          fmt::format("full_scale is {}; it must be above 0, up to {}", number_text(pwm.full_scale),
                                      number_text(kMostFullScale)));
        problems_.require(!pwm.follows_speed || use == OutputUse::Spindle, at + "follows_speed",
                          "follows_speed needs use: SPINDLE, because M4 begins it");
    }

    /// A feed can wait for an input that programs read.
    void check_spin_up(const OutputConfig& output, const std::string& at) {
        const bool has_speed = output.use == OutputUse::Spindle && !(output.pwm && output.pwm->follows_speed);
        problems_.require(
            has_speed || (output.at_speed.empty() && output.spin_up_s == 0), at + "spin_up_s",
            fmt::format("output {} is no spindle that comes to a speed; remove spin_up_s and at_speed", output.name));
        problems_.require_range(at + "spin_up_s", output.spin_up_s, output.at_speed.empty() ? 0 : kLeastWait_s,
                                kMostSpinUp_s);
        const auto is_it = [&](const InputConfig& input) {
            return input.name == output.at_speed && input.use == InputUse::Program && input.number;
        };
        problems_.require(output.at_speed.empty() || std::ranges::any_of(machine_.inputs, is_it), at + "at_speed",
                          fmt::format("at_speed is \"{}\"; it must be the name of an input with use: PROGRAM and a "
                                      "number",
                                      output.at_speed));
    }

    /// The simulated device knows its own inputs only.
    void check_simulated_spindle(const OutputConfig& output, const std::string& key) {
        problems_.require_range(key, output.simulated_spin_up_s, 0, kMostSpinUp_s);
        const auto input = std::ranges::find(machine_.inputs, output.at_speed, &InputConfig::name);
        const bool is_there = input != machine_.inputs.end() && input->motor == output.motor;
        problems_.require(
            output.simulated_spin_up_s == 0 || is_there, key,
            fmt::format("output {} has a simulated spindle, which closes the input at_speed; name an input "
                        "of the same device there, or remove simulated_spin_up_s",
                        output.name));
    }

    void check_pulses(const OutputConfig& output, const std::string& at) {
        const double tick_us = static_cast<double>(machine_.tick_ns) / 1000;
        problems_.require_range(at + "pulse_us", output.pulse_us, tick_us, kMostPulse_us);
        problems_.require(counters_.insert(output.motor).second, at + "use",
                          fmt::format("the device of motor {} can make pulses at places of one output; use another "
                                      "motor's device for {}",
                                      output.motor, output.name));
        const auto motor = motor_named(machine_, output.motor);
        problems_.require(
            !motor || motors_of(machine_)[*motor].moves_one_axis, at + "motor",
            fmt::format("output {} makes pulses at places of an axis, and {} {}; use a motor that moves one "
                        "axis alone",
                        output.name, DeviceOwner{output.motor, output.at_board}.text(),
                        output.at_board ? "makes no steps" : "moves several"));
    }

    const MachineConfig& machine_;
    ProblemList problems_;
    std::set<std::string> counters_;  // motors whose devices make pulses at places
    std::vector<std::string> names_;
    std::set<std::tuple<std::string, bool, int>> channels_;
    std::set<std::tuple<OutputUse, bool, std::int32_t>> words_;
};

}  // namespace

std::vector<Problem> output_problems(const MachineConfig& machine) {
    OutputRules rules(machine);
    rules.problems().require(
        machine.outputs.size() <= kMostOutputs, "output",
        fmt::format("the machine has {} outputs; it can have {}", machine.outputs.size(), kMostOutputs));
    for (std::size_t k = 0; k < machine.outputs.size(); ++k) {
        rules.check(machine.outputs[k], fmt::format("output[{}].", k));
    }
    rules.problems().require(machine.outputs.empty() || coordination_of(machine).switches_outputs, "output",
                             "outputs need coordination: RANADE, because LAI cannot slow a path for their changes");
    rules.check_silence();
    return rules.problems().take();
}

}  // namespace lockstep
