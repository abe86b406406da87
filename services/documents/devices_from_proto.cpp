#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>

#include "core/device/link_name.hpp"
#include "services/documents/proto_reader.hpp"
#include "services/documents/proto_values.hpp"

namespace lockstep {
namespace {

/// "EMERGENCY_STOP, DOOR or HOME"
std::string choice_of(const google::protobuf::EnumDescriptor& values) {
    std::string text = values.value(0)->name();
    for (int i = 1; i < values.value_count(); ++i) {
        text += (i + 1 == values.value_count() ? " or " : ", ") + values.value(i)->name();
    }
    return text;
}

/// Whether the output keeps its level.
bool read_level(bool is_given, proto::OutputLevel level, bool preset, const std::string& key, ProtoReader& reader) {
    if (!is_given) { return preset; }
    if (!proto::OutputLevel_IsValid(level)) {
        reader.refuse(key, fmt::format("{} is {}; it must be KEEP or OFF", key, int{level}));
    }
    return level == proto::KEEP;
}

PwmConfig read_pwm(const proto::Pwm& message, const std::string& place, ProtoReader& reader) {
    PwmConfig pwm{.full_scale = message.has_full_scale() ? message.full_scale() : PwmConfig{}.full_scale,
                  .follows_speed = message.follows_speed()};
    reader.require(message.has_hz(), message.hz(), pwm.hz, place + ".hz");
    return pwm;
}

/// Which device has an output or an input: that of a motor, or a board.
template <typename Message, typename Config>
void read_owner(const Message& message, const std::string& place, Config& config, ProtoReader& reader) {
    config.at_board = message.has_board();
    config.motor = message.has_board() ? message.board() : message.motor();
    if (message.has_board() && message.has_motor()) {
        reader.refuse(place + ".board",
                      fmt::format("{0}.motor is \"{1}\" and {0}.board is \"{2}\"; keep the one whose device has it",
                                  place, message.motor(), message.board()));
    }
    if (message.has_board() || message.has_motor()) { return; }
    reader.refuse(
        place + ".motor",
        fmt::format("{0}.motor and {0}.board are missing; name the motor whose device has it, or the board", place));
}

OutputConfig read_output(const proto::Output& message, const std::string& place, ProtoReader& reader) {
    OutputConfig output{.channel = message.channel(),
                        .use = value_of<OutputUse>(message.use()),
                        .number = message.number(),
                        .inverted = message.inverted()};
    reader.require(message.has_name(), message.name(), output.name, place + ".name");
    read_owner(message, place, output, reader);
    if (!proto::OutputUse_IsValid(message.use())) {
        reader.refuse(place + ".use", fmt::format("{}.use is {}; it must be {}", place, int{message.use()},
                                                  choice_of(*proto::OutputUse_descriptor())));
    }
    if (output.makes_pulses()) {
        reader.require(message.has_pulse_us(), message.pulse_us(), output.pulse_us, place + ".pulse_us");
    } else {
        output.pulse_us = message.pulse_us();
    }
    constexpr double kUsualWait_s = 30;
    output.at_speed = message.at_speed();
    output.spin_up_s = message.has_spin_up_s() ? message.spin_up_s() : message.has_at_speed() ? kUsualWait_s : 0;
    output.simulated_spin_up_s = message.simulated_spin_up_s();
    if (message.has_pwm()) { output.pwm = read_pwm(message.pwm(), place + ".pwm", reader); }
    output.stays_at_interruption = read_level(message.has_at_interruption(), message.at_interruption(),
                                              output.stays_at_interruption, place + ".at_interruption", reader);
    output.stays_at_fault =
        read_level(message.has_at_fault(), message.at_fault(), output.stays_at_fault, place + ".at_fault", reader);
    output.stays_at_silence = read_level(message.has_at_silence(), message.at_silence(), output.stays_at_silence,
                                         place + ".at_silence", reader);
    return output;
}

/// Long enough for any stall that the machine bears.
double usual_silence_ms(const ProtocolTiming& timing) {
    const double stall_ms = static_cast<double>(timing.slot_us) / 1000 * (timing.stall_slots + 1);
    return std::max(MachineConfig{}.output_silence_ms, 5 * stall_ms);
}

InputConfig read_input(const proto::Input& message, const std::string& place, ProtoReader reader) {
    InputConfig input;
    reader.require(message.has_name(), message.name(), input.name, place + ".name");
    read_owner(message, place, input, reader);
    reader.require(message.has_channel(), message.channel(), input.channel, place + ".channel");
    reader.require(message.has_use(), value_of<InputUse>(message.use()), input.use, place + ".use");
    if (!proto::InputUse_IsValid(message.use())) {
        reader.refuse(place + ".use", fmt::format("{}.use is {}; it must be {}", place, int{message.use()},
                                                  choice_of(*proto::InputUse_descriptor())));
    }
    input.active_low = message.active_low();
    if (message.has_debounce_ms()) { input.debounce_ms = message.debounce_ms(); }
    if (input.use == InputUse::Probe) { input.number = 0; }
    if (message.has_number()) { input.number = message.number(); }
    if (message.has_max_overshoot_mm()) { input.max_overshoot_mm = message.max_overshoot_mm(); }
    input.axis = message.axis();
    input.wire = message.wire();
    input.simulated_bounce_ms = message.simulated_bounce_ms();
    input.at_touch_in_motion = value_of<TouchInMotion>(message.at_touch_in_motion());
    if (!proto::TouchInMotion_IsValid(message.at_touch_in_motion())) {
        const std::string key = place + ".at_touch_in_motion";
        reader.refuse(key, fmt::format("{} is {}; it must be {}", key, int{message.at_touch_in_motion()},
                                       choice_of(*proto::TouchInMotion_descriptor())));
    }
    return input;
}

BoardConfig read_board(const proto::Board& message, const std::string& place, ProtoReader reader) {
    BoardConfig board{.name = {}, .host = message.host(), .device = {}};
    reader.require(message.has_name(), message.name(), board.name, place + ".name");
    board.device = read_device(message.device(), place + ".device", reader);
    return board;
}

LinkName read_link(const proto::Board& message, const std::string& place, ProtoReader& reader) {
    auto link = read_link_name(message.link());
    if (link) { return std::move(*link); }
    reader.refuse(place + ".link", fmt::format("the link of board {} is \"{}\"; it must be {}, such as "
                                               "serial:/dev/ttyUSB0",
                                               message.name(), message.link(), kLinkNames));
    return {};
}

BoardLinkConfig read_board_link(const proto::Board& message, const std::string& place, ProtoReader reader) {
    BoardLinkConfig board{.name = {}, .link = read_link(message, place, reader)};
    reader.require(message.has_name(), message.name(), board.name, place + ".name");
    if (message.has_host() || message.has_device()) {
        reader.refuse(place + ".link", fmt::format("{0} has a link, so {0}.host and {0}.device have no meaning; remove "
                                                   "them: lockstep-board runs on the host of the board's motors",
                                                   place));
    }
    return board;
}

}  // namespace

DeviceName read_device(const std::string& text, const std::string& key, ProtoReader& reader) {
    if (text.empty()) { return {}; }
    auto device = read_device_name(text);
    if (device) { return std::move(*device); }
    reader.refuse(key, fmt::format("{} is \"{}\"; it must be {}, such as uio:/dev/uio0", key, text, kDeviceNames));
    return {};
}

void read_devices(const proto::Machine& message, MachineDraft& draft) {
    for (int k = 0; k < message.board_size(); ++k) {
        const std::string place = fmt::format("board[{}]", k);
        if (message.board(k).has_link()) {
            draft.machine.board_links.push_back(read_board_link(message.board(k), place, ProtoReader(draft.missing)));
        } else {
            draft.machine.boards.push_back(read_board(message.board(k), place, ProtoReader(draft.missing)));
        }
    }
    ProtoReader of_outputs(draft.missing);
    for (int k = 0; k < message.output_size(); ++k) {
        draft.machine.outputs.push_back(read_output(message.output(k), fmt::format("output[{}]", k), of_outputs));
    }
    draft.machine.output_silence_ms =
        message.has_output_silence_ms() ? message.output_silence_ms() : usual_silence_ms(draft.machine.timing);
    for (const proto::Input& input : message.input()) {
        const std::string place = fmt::format("input[{}]", draft.machine.inputs.size());
        draft.machine.inputs.push_back(read_input(input, place, ProtoReader(draft.missing)));
    }
}

}  // namespace lockstep
