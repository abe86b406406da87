#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "core/hardware/device_abilities.hpp"
#include "core/kinematics/motors.hpp"
#include "core/protocol/messages.hpp"
#include "services/documents/machine_rules.hpp"
#include "services/documents/names.hpp"
#include "services/documents/problem_list.hpp"
#include "services/documents/rules/limit_input_rules.hpp"
#include "services/documents/rules/owner_rules.hpp"
#include "services/documents/rules/wire_rules.hpp"

namespace lockstep {
namespace {

constexpr double kMaxDebounce_ms = 1000;
constexpr int kMaxProgramInput = 63;
constexpr double kLeastOvershoot_mm = 0.001;
constexpr double kMaxOvershoot_mm = 1000;

/// The greatest channel that the device may have. The process of a motor compares it with the device that it finds.
int last_channel(const MotorConfig& motor) {
    return static_cast<int>(motor.device.has_own_clock() ? kMostInputs : DeviceAbilities{}.inputs) - 1;
}

class InputRules {
public:
    explicit InputRules(const MachineConfig& machine) : machine_(machine), motors_(motors_of(machine)) {}

    std::vector<Problem> check() {
        for (std::size_t k = 0; k < machine_.inputs.size(); ++k) {
            check(machine_.inputs[k], {machine_.inputs.begin(), machine_.inputs.begin() + static_cast<long>(k)},
                  fmt::format("input[{}].", k));
        }
        return problems_.take();
    }

private:
    using Inputs = std::span<const InputConfig>;

    void check(const InputConfig& input, Inputs before, const std::string& at) {
        check_name(input, before, at + "name");
        problems_.require_range(at + "debounce_ms", input.debounce_ms, 0, kMaxDebounce_ms);
        problems_.require_range(at + "simulated_bounce_ms", input.simulated_bounce_ms, 0, kMaxDebounce_ms);
        check_number(input, before, at + "number");
        check_overshoot(input, at + "max_overshoot_mm");
        check_touch_in_motion(input, at + "at_touch_in_motion");
        check_owner(machine_, {input.motor, input.at_board}, at, problems_);
        check_wire(machine_, before.size(), at, problems_);
        const auto motor = std::ranges::find(motors_, input.motor, &MotorConfig::name);
        check_limit_input(machine_, input, motor == motors_.end() ? nullptr : &*motor, at, problems_);
        if (motor != motors_.end()) { check_channel(input, *motor, before, at + "channel"); }
    }

    void check_name(const InputConfig& input, Inputs before, const std::string& key) {
        problems_.require(
            is_axis_name(input.name), key,
            fmt::format("the input's name is \"{}\"; it must be a letter, then letters, digits and _, at most {} "
                        "characters",
                        input.name, kMaxAxisName));
        const auto is_same = [&](const auto& named) { return same_name(named.name, input.name); };
        problems_.require(std::ranges::none_of(machine_.axes, is_same) && std::ranges::none_of(motors_, is_same) &&
                              std::ranges::none_of(before, is_same),
                          key,
                          fmt::format("{} names an axis, a motor, a board or another input already; give this input "
                                      "another name",
                                      input.name));
    }

    void check_number(const InputConfig& input, Inputs before, const std::string& key) {
        const bool is_read = input.use == InputUse::Program;
        const bool is_probe = input.use == InputUse::Probe;
        problems_.require(
            is_read || is_probe || !input.number, key,
            fmt::format("{} is given, but only an input with use: PROGRAM or PROBE has a number; remove it", key));
        problems_.require(!is_read || input.number, key,
                          fmt::format("{} is missing; programs read an input with use: PROGRAM by its number", key));
        if (!input.number) { return; }
        problems_.require_range(key, *input.number, 0, kMaxProgramInput);
        const auto has_number = [&](const InputConfig& one) {
            return one.use == input.use && one.number == input.number;
        };
        if (is_probe) { return check_probe(input, std::ranges::count_if(before, has_number), key); }
        const auto other = std::ranges::find_if(before, has_number);
        problems_.require(other == before.end(), key,
                          fmt::format("{} is {}, which input {} has already; choose another", key, *input.number,
                                      other == before.end() ? "" : other->name));
    }

    /// `before`: so many inputs have the probe's number already.
    void check_probe(const InputConfig& input, std::ptrdiff_t before, const std::string& key) {
        constexpr auto kMost = static_cast<std::ptrdiff_t>(kMaxTouchInputs);
        problems_.require(before < kMost, key,
                          fmt::format("{} is {}, which {} inputs have already; a probe has at most {}, so choose "
                                      "another",
                                      key, *input.number, before, kMost));
    }

    void check_touch_in_motion(const InputConfig& input, const std::string& key) {
        problems_.require(input.use == InputUse::Probe || input.at_touch_in_motion == TouchInMotion::Nothing, key,
                          fmt::format("{} is given, but the input is no probe; remove it, or set use: PROBE", key));
    }

    void check_overshoot(const InputConfig& input, const std::string& key) {
        const bool ends_moves =
            input.use == InputUse::Probe || input.use == InputUse::Home || input.is_limit_by_message();
        problems_.require(
            ends_moves || input.max_overshoot_mm == InputConfig::kUsualOvershoot_mm, key,
            fmt::format("{} is given, but the input is no probe; remove it, or set use: PROBE or HOME, or for a limit "
                        "switch the axis at whose end it is",
                        key));
        problems_.require_range(key, input.max_overshoot_mm, kLeastOvershoot_mm, kMaxOvershoot_mm);
    }

    void check_channel(const InputConfig& input, const MotorConfig& motor, Inputs before, const std::string& key) {
        const bool is_switch = input.channel >= 0 && input.channel < kSwitchInputs &&
                               input.use == kSwitchUses[static_cast<std::size_t>(input.channel)];
        const int first = motor.is_board() ? 0 : is_switch ? input.channel : kSwitchInputs;
        const int last = last_channel(motor);
        const DeviceOwner owner{input.motor, input.at_board};
        const std::string switches = motor.is_board()
                                         ? ""
                                         : fmt::format(
                                               "inputs 0, 1 and 2 have the switches of {} (use: LIMIT_MIN, "
                                               "LIMIT_MAX and HOME), and ",
                                               owner.text());
        problems_.require(input.channel >= first && input.channel <= last, key,
                          fmt::format("{} is {}; it must be from {} to {}: {}its device has {} at most", key,
                                      input.channel, first, last, switches, last + 1));
        const auto other = std::ranges::find_if(
            before, [&](const InputConfig& one) { return one.motor == input.motor && one.channel == input.channel; });
        problems_.require(other == before.end(), key,
                          fmt::format("{} is {}, which input {} of {} has already; choose another", key, input.channel,
                                      other == before.end() ? "" : other->name, owner.text()));
    }

    const MachineConfig& machine_;
    std::vector<MotorConfig> motors_;
    ProblemList problems_;
};

}  // namespace

std::vector<Problem> input_problems(const MachineConfig& machine) { return InputRules(machine).check(); }

}  // namespace lockstep
