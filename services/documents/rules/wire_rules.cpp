#include "services/documents/rules/wire_rules.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/enumeration.hpp"
#include "core/number_text.hpp"
#include "services/documents/names.hpp"
#include "services/documents/rules/owner_rules.hpp"

namespace lockstep {
namespace {

/// Inputs of one wire must have these values in common.
class SameSwitch {
public:
    SameSwitch(const InputConfig& input, const InputConfig& first, std::string at, ProblemList& problems)
        : input_(input), first_(first), at_(std::move(at)), problems_(problems) {}

    template <typename Value>
    void require(std::string_view name, Value InputConfig::*member) {
        const std::string key = at_ + std::string(name);
        problems_.require(
            input_.*member == first_.*member, key,
            fmt::format("{} is {}, but input {} of the same wire has {}; a wire has one switch, so give its inputs the "
                        "same {}, or remove wire",
                        key, text_of(input_.*member), first_.name, text_of(first_.*member), name));
    }

private:
    static std::string text_of(double value) { return number_text(value); }
    static std::string text_of(bool value) { return value ? "true" : "false"; }
    static std::string text_of(const std::optional<int>& value) { return value ? std::to_string(*value) : "none"; }
    static std::string text_of(TouchInMotion value) {
        return std::string(pick_name({"NOTHING", "HOLD", "FAULT"}, value));
    }

    const InputConfig& input_;
    const InputConfig& first_;
    std::string at_;
    ProblemList& problems_;
};

}  // namespace

void check_wire(const MachineConfig& machine, std::size_t number, const std::string& at, ProblemList& problems) {
    const InputConfig& input = machine.inputs[number];
    if (input.wire.empty()) { return; }
    const std::string key = at + "wire";
    problems.require(is_axis_name(input.wire), key,
                     fmt::format("{} is \"{}\"; it must be a letter, then letters, digits and _, at most {} characters",
                                 key, input.wire, kMaxAxisName));
    problems.require(input.use == InputUse::Probe, key,
                     fmt::format("{} is given, but the input is no probe; remove it, or set use: PROBE", key));
    if (input.use != InputUse::Probe) { return; }
    const auto of_wire = [&](const InputConfig& one) { return one.use == InputUse::Probe && one.wire == input.wire; };
    problems.require(std::ranges::count_if(machine.inputs, of_wire) > 1, key,
                     fmt::format("{} is {}, which no other input has; give it also to the inputs of the other devices "
                                 "that see the switch, or remove it",
                                 key, input.wire));
    const auto begin = machine.inputs.begin(), here = begin + static_cast<std::ptrdiff_t>(number);
    const auto first = std::find_if(begin, here, of_wire);
    if (first == here) { return; }
    const auto twin = std::find_if(first, here, [&](const InputConfig& one) {
        return of_wire(one) && one.motor == input.motor && one.at_board == input.at_board;
    });
    problems.require(
        twin == here, key,
        fmt::format("{} is {}, which input {} of {} has already; a device sees a wire by one input, so "
                    "remove one of them",
                    key, input.wire, twin == here ? "" : twin->name, DeviceOwner{input.motor, input.at_board}.text()));
    SameSwitch same(input, *first, at, problems);
    same.require("number", &InputConfig::number);
    same.require("active_low", &InputConfig::active_low);
    same.require("debounce_ms", &InputConfig::debounce_ms);
    same.require("max_overshoot_mm", &InputConfig::max_overshoot_mm);
    same.require("at_touch_in_motion", &InputConfig::at_touch_in_motion);
    same.require("simulated_bounce_ms", &InputConfig::simulated_bounce_ms);
}

}  // namespace lockstep
