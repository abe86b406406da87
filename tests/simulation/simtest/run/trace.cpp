#include "tests/simulation/simtest/run/trace.hpp"

#include <array>
#include <cinttypes>
#include <cstdio>

#include "tests/simulation/simtest/run/names.hpp"

namespace lockstep::simtest {
namespace {

std::string text_of(const AxisNotice& notice) {
    constexpr std::array kNames{"coordinator adopted",
                                "epoch begun",
                                "epoch ended",
                                "frame refused",
                                "vetoes",
                                "homing stage",
                                "homed",
                                "fault",
                                "reset",
                                "command refused",
                                "homed by the kept position",
                                "kept position unproved"};
    const auto kind = static_cast<std::size_t>(notice.kind);
    const std::string name = kind < kNames.size() ? kNames[kind] : "notice " + std::to_string(kind);
    return name + " " + std::to_string(notice.number) + " " + std::string(name_of(notice.fault));
}

std::string text_of(const CoordinatorNotice& notice) {
    constexpr std::array kNames{"phase",       "fault",   "axis seen",  "axis gone",    "interrupted",
                                "epoch begun", "claimed", "stood down", "job cut short"};
    const auto kind = static_cast<std::size_t>(notice.kind);
    const std::string name = kind < kNames.size() ? kNames[kind] : "notice " + std::to_string(kind);
    const bool phase = notice.kind == CoordinatorNotice::Kind::Phase && notice.number < kMachinePhaseNames.size();
    return name + " " + (phase ? std::string(kMachinePhaseNames[notice.number]) : std::to_string(notice.number)) + " " +
           std::string(name_of(notice.fault));
}

std::string text_of(const Reply& reply) {
    return "reply " + std::to_string(reply.sequence) +
           (reply.status == ReplyStatus::Accepted ? " accepted" : " refused ") + reply.text;
}

}  // namespace

std::string Trace::process(std::size_t number) const {
    if (number < motor_count(machine_)) { return motor_name(machine_, MotorIndex{number}); }
    return number == motor_count(machine_) ? "coordinator" : "standby";
}

void Trace::line(Tick now, const std::string& who, const std::string& what) const {
    std::printf("%12" PRId64 " slot %8" PRId64 " %-12s %s\n", now.value, now.value / machine_.slot_ticks().value,
                who.c_str(), what.c_str());
}

void Trace::on_axis(MotorIndex axis, Tick now, const AxisOutputs& out, AxisNode& /*node*/) {
    for (const AxisNotice& notice : out.notices) { line(now, process(axis), text_of(notice)); }
    for (const DeviceOrder& order : out.orders) {
        if (const auto* arm = std::get_if<device::Arm>(&order)) {
            line(now, process(axis), "arms " + std::to_string(arm->number));
        } else if (const auto* begin = std::get_if<device::BeginRun>(&order)) {
            line(now, process(axis), "begins run " + std::to_string(begin->run));
        } else if (std::holds_alternative<device::StopNow>(order)) {
            line(now, process(axis), "stops all pulses");
        }
    }
    for (const ExecutedTrack& track : out.tracks) {
        line(now, process(axis),
             std::string("has run the ") + (track.tail ? "tail" : "body") + " of frame " + std::to_string(track.frame) +
                 ", from tick " + std::to_string(track.start.value) + (track.cut ? ", cut short" : ""));
    }
}

void Trace::on_coordinator(std::size_t number, Tick now, const CoordinatorOutputs& out) {
    const std::string who = process(number);
    for (const CoordinatorNotice& notice : out.notices) { line(now, who, text_of(notice)); }
    for (const Reply& reply : out.replies) { line(now, who, text_of(reply)); }
    for (const Frame& frame : out.frames) {
        line(now, who,
             "sends frame " + std::to_string(frame.number) + " for tick " + std::to_string(frame.start.value));
    }
}

void Trace::on_fault(Tick now, const VirtualFault& fault, bool begins) {
    constexpr std::array kKinds{"freeze",        "crash",
                                "cut",           "clock set",
                                "switch stuck",  "push",
                                "damaged frame", "device stopped",
                                "device killed", "registers overwritten"};
    const std::string peer = fault.peer ? " from " + process(*fault.peer) : " from all";
    const std::string ways = std::string(fault.outgoing ? ", outgoing" : "") + (fault.incoming ? ", incoming" : "");
    line(now, process(fault.process),
         std::string("FAULT ") + kKinds[static_cast<std::size_t>(fault.kind)] + (begins ? " begins" : " ends") +
             (fault.in_loop ? " in a loop" : "") +
             (fault.set_by != Ticks{} ? " by " + std::to_string(fault.set_by.value) + " ticks" : "") +
             (fault.kind == VirtualFault::Kind::Cut ? peer + ways : ""));
}

}  // namespace lockstep::simtest
