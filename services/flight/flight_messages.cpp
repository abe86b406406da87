#include "services/flight/flight_messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/kinematics/motors.hpp"
#include "services/wire/lcm/lcm_decode.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep {
namespace {

std::string name_in(const MachineConfig& machine, FlightPeer peer) {
    switch (peer.kind) {
        case FlightPeer::Kind::None: return "";
        case FlightPeer::Kind::Coordinator: return flight_process("");
        case FlightPeer::Kind::Axis: break;
    }
    return peer.axis < motor_count(machine) ? flight_process(motor_name(machine, MotorIndex{peer.axis})) : "";
}

std::optional<FlightPeer> peer_in(const MachineConfig& machine, const std::string& name) {
    if (name.empty()) { return FlightPeer{}; }
    if (name == flight_process("")) { return kFlightCoordinator; }
    for (const MotorIndex m : motor_indices(motor_count(machine))) {
        if (name == flight_process(motor_name(machine, m))) { return flight_axis(m); }
    }
    return std::nullopt;
}

Ticks ticks_of(double us, std::int64_t tick_ns) {
    constexpr double kMost = 1e15;  // more than any real duration
    const double ticks = us * 1000 / static_cast<double>(tick_ns);
    return {std::llround(std::isfinite(ticks) ? std::clamp(ticks, -kMost, kMost) : 0)};
}

}  // namespace

flight_head_t to_lcm(const FlightSource& source, const IncidentMark& mark) {
    flight_head_t out{};
    out.utime = utime_of(mark.tick, source.tick_ns);
    out.version = kFlightVersion;
    out.machine = source.machine;
    out.process = source.process;
    out.incarnation = static_cast<std::int64_t>(source.incarnation);
    out.tick_ns = source.tick_ns;
    out.tick = mark.tick.value;
    out.reason = name_of(mark.reason);
    out.wall_us = mark.wall_us;
    out.config = source.config;
    return out;
}

flight_event_t to_lcm(const FlightSource& source, const MachineConfig& machine, const NumberedEvent& numbered) {
    const FlightEvent& event = numbered.event;
    flight_event_t out{};
    out.utime = utime_of(event.tick, source.tick_ns);
    out.machine = source.machine;
    out.process = source.process;
    out.incarnation = static_cast<std::int64_t>(source.incarnation);
    out.sequence = static_cast<std::int64_t>(numbered.number);
    out.tick = event.tick.value;
    out.what = name_of(event.kind);
    out.about = name_in(machine, event.about);
    out.detail = event.detail;
    out.fault = event.fault == FaultCode::None ? "" : name_of(event.fault);
    out.epoch = static_cast<std::int64_t>(event.epoch);
    out.frame = static_cast<std::int64_t>(event.frame);
    out.count = event.count;
    out.amount = event.amount;
    out.lasts_us = machine.microseconds(event.lasts);
    return out;
}

flight_note_t to_lcm(const FlightSource& source, const IncidentMark& mark, const std::string& text) {
    flight_note_t out{};
    out.utime = utime_of(mark.tick, source.tick_ns);
    out.machine = source.machine;
    out.process = source.process;
    out.incarnation = static_cast<std::int64_t>(source.incarnation);
    out.text = text;
    return out;
}

std::expected<FlightHead, std::string> from_lcm(const flight_head_t& message) {
    const auto reason = incident_reason(message.reason);
    if (message.version != kFlightVersion || !reason || message.tick_ns < 1) {
        return std::unexpected(fmt::format("the head has version {}, reason \"{}\"; this command reads version {}",
                                           message.version, message.reason, kFlightVersion));
    }
    if (message.process.contains('/') || message.machine.contains('/')) {
        return std::unexpected("the head names a process that is neither a coordinator nor an axis");
    }
    FlightHead head;
    head.source = {.machine = message.machine,
                   .process = message.process,
                   .incarnation = static_cast<Identity>(message.incarnation),
                   .tick_ns = message.tick_ns,
                   .config = message.config,
                   .directory = {}};
    head.mark = {*reason, {message.tick}, message.wall_us};
    return head;
}

std::expected<NumberedEvent, std::string> from_lcm(const flight_event_t& message, const MachineConfig& machine) {
    const auto kind = flight_kind(message.what);
    const auto about = peer_in(machine, message.about);
    const FaultText* fault = find_fault(message.fault);
    if (!kind) { return std::unexpected("an event has an unknown kind: \"" + message.what + "\""); }
    if (!about) {
        return std::unexpected("an event names axis \"" + message.about + "\", which the machine does not have");
    }
    if (fault == nullptr && !message.fault.empty()) {
        return std::unexpected("an event has an unknown fault: \"" + message.fault + "\"");
    }
    if (message.detail < 0 || message.detail > std::numeric_limits<std::uint8_t>::max()) {
        return std::unexpected(fmt::format("an event has the detail {}; it must be from 0 to 255", message.detail));
    }
    NumberedEvent out{.number = static_cast<std::uint64_t>(message.sequence), .event = {}};
    out.event.tick = {message.tick};
    out.event.kind = *kind;
    out.event.about = *about;
    out.event.detail = static_cast<std::uint8_t>(message.detail);
    out.event.fault = fault == nullptr ? FaultCode::None : fault->code;
    out.event.epoch = static_cast<Epoch>(message.epoch);
    out.event.frame = static_cast<FrameNumber>(message.frame);
    out.event.count = message.count;
    out.event.amount = message.amount;
    out.event.lasts = ticks_of(message.lasts_us, machine.tick_ns);
    return out;
}

/// The encoding is a head as in a file, then the number of files kept and their directory.
std::vector<std::uint8_t> encode_source(const FlightSource& source) {
    const flight_head_t head = to_lcm(source, {});
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(head.getEncodedSize()));
    head.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    const std::string rest = fmt::format("\n{} {}", source.files, source.directory.string());
    bytes.insert(bytes.end(), rest.begin(), rest.end());
    return bytes;
}

std::expected<FlightSource, std::string> decode_source(std::span<const std::uint8_t> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::size_t head_bytes = std::min(text.rfind('\n'), text.size());
    const auto message = decode_lcm<flight_head_t>(bytes.first(head_bytes));
    if (!message || head_bytes == text.size()) { return std::unexpected("the process it belongs to cannot be read"); }
    auto head = from_lcm(*message);
    if (!head) { return std::unexpected(head.error()); }
    const std::string rest(text.substr(head_bytes + 1));
    const std::size_t space = std::min(rest.find(' '), rest.size());
    head->source.files = std::max(1, std::atoi(rest.substr(0, space).c_str()));
    head->source.directory = rest.substr(std::min(space + 1, rest.size()));
    return std::move(head->source);
}

}  // namespace lockstep
