// ProgramBuilder: probing moves.
#include <algorithm>

#include "core/gcode/program_builder.hpp"

namespace lockstep::gcode {
namespace {

/// "probe 0 (plate), probe 1 (tool-setter)"
std::string probes_text(std::span<const InputConfig> inputs) {
    std::string text;
    for (const InputConfig& input : inputs) {
        if (input.use != InputUse::Probe) { continue; }
        text += (text.empty() ? "P" : ", P") + std::to_string(input.number.value_or(0)) + " (" + input.name + ")";
    }
    return text;
}

}  // namespace

/// Without a number, the only probe. Null with an error.
const InputConfig* ProgramBuilder::probe_numbered(std::optional<int> number) {
    const std::vector<InputConfig>& inputs = setup_.inputs;
    const auto only = std::ranges::find(inputs, InputUse::Probe, &InputConfig::use);
    if (only == inputs.end()) {
        fail("a probing move needs a probe; write input { use: PROBE } in the machine's file");
        return nullptr;
    }
    if (!number && has_several_probes(inputs)) {
        fail("the machine has several probes; choose one: " + probes_text(inputs));
        return nullptr;
    }
    const InputConfig* const input = number ? input_numbered(inputs, InputUse::Probe, *number) : &*only;
    if (input == nullptr) {
        fail("probe " + std::to_string(*number) + " is not configured; the machine has " + probes_text(inputs));
    }
    return input;
}

/// The touch is taken to be at the end of the move, until go_on_behind() gives it.
void ProgramBuilder::probe(const Probing& probing) {
    const InputConfig* const input = probe_numbered(probing.probe);
    if (input == nullptr) { return; }
    if (setup_.switches.heights) {
        return fail(
            "a program that follows a height map cannot probe; run it without the map, or remove the probing move");
    }
    probed_from_ = position_;
    std::vector<double> to = position_;
    for (std::size_t i = 0; i < to.size(); ++i) {
        if (!places_[i] || probing.target[*places_[i]] == at_[*places_[i]]) { continue; }
        to[i] = within_travel(i, probing.target[*places_[i]]);
    }
    ProgramMove move = move_to(to, probing.feed, {});
    move.mode = PathMode::ExactStop;
    move.is_feed_fixed = true;  // it was checked how far it goes on behind the touch
    await_speed(move);
    append(Probe{.input = input->number.value_or(0), .opens = probing.opens, .must_touch = probing.must_touch});
    append(std::move(move));
    at_ = probing.target;
    position_ = std::move(to);
    if (setup_.awaits_touches) { return; }
    note("probe",
         "the place of a touch is known only to the running machine; here each probing move touches at its end");
    is_behind_probe_ = true;
}

Touch ProgramBuilder::go_on_behind(const ProbeTouch& touch) {
    Touch result{.touched = touch.touched, .at = at_, .rest = at_};
    for (std::size_t i = 0; i < position_.size(); ++i) {
        if (position_[i] == probed_from_[i]) { continue; }
        position_[i] = touch.rest_mm[i];
        if (!places_[i]) { continue; }
        result.at[*places_[i]] = touch.places_mm[i];
        result.rest[*places_[i]] = touch.rest_mm[i];
    }
    at_ = result.rest;
    program_.start_mm = position_;
    return result;
}

}  // namespace lockstep::gcode
