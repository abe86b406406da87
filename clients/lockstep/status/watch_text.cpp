#include "clients/lockstep/status/watch_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clients/lockstep/status/alarms.hpp"
#include "clients/session/inputs/input_report.hpp"
#include "clients/session/outputs/output_report.hpp"
#include "clients/session/status_text.hpp"
#include "clients/text/colour.hpp"
#include "clients/text/format.hpp"
#include "core/axis_unit.hpp"

#include "clients/session/reports.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kColumns = 80;
constexpr std::size_t kBarWidth = 13;

std::string painted(const std::string& text, std::string_view colour, Ink ink) {
    return ink == Ink::Plain ? text : lockstep::painted(text, colour);
}

std::string padded(const std::string& text, int width) { return fmt::format("{:>{}}", text, width); }

std::string cut(const std::string& text, std::size_t width) {
    return text.size() <= width ? text : text.substr(0, width - 1) + "~";
}

/// Left-aligned and right-aligned text in one line.
std::string spread(const std::string& left, const std::string& right) {
    const std::size_t gap = left.size() + right.size() < kColumns ? kColumns - left.size() - right.size() : 1;
    return left + std::string(gap, ' ') + right;
}

std::size_t cells(double part, double whole) {
    return static_cast<std::size_t>(std::lround(std::clamp(part / whole, 0.0, 1.0) * kBarWidth));
}

std::string slack_bar(const proto::HealthReport& health, const SlackScale& scale, Ink ink) {
    const bool known = health.has_setpoint_slack_ms();
    const double slack_ms = health.setpoint_slack_ms().min();
    const std::size_t filled = known ? cells(slack_ms, scale.ahead_ms) : 0;
    std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
    bar[std::min(cells(scale.deadline_ms, scale.ahead_ms), kBarWidth - 1)] = '|';
    const bool near = slack_ms < (scale.deadline_ms + scale.ahead_ms) / 2;
    const std::string_view colour = !known ? kFaint : slack_ms < scale.deadline_ms ? kBad : near ? kWarning : kGood;
    return "[" + painted(bar, colour, ink) + "]" + padded(known ? fixed(slack_ms, 0) : "-", 5);
}

/// The lateness furthest from 0; positive if late.
std::string lateness(const proto::HealthReport& health) {
    if (!health.has_step_lateness_us()) { return "-"; }
    const proto::Spread& late = health.step_lateness_us();
    return fixed(std::abs(late.min()) > std::abs(late.max()) ? late.min() : late.max(), 0);
}

std::string_view colour_of(const proto::AxisStatus& axis) {
    if (axis.has_fault() || axis.state() == "Fault") { return kBad; }
    return axis.at_rest() ? kFaint : kGood;
}

std::string axis_row(const proto::AxisStatus& axis, const SlackScale& scale, Ink ink) {
    const std::string name = fmt::format("{:<10}", cut(label_of(axis), 10));
    if (!axis.present()) { return name + painted("   not received", kBad, ink); }
    const std::string state = fmt::format("{:<10}", axis.state());
    const std::string place = axis.board() ? "board" : axis.homed() ? fixed(axis.position_mm(), 4) : "not homed";
    const std::string speed = axis.board() ? "" : fixed(axis.velocity_mm_s(), 2);
    std::string row = name + padded(place, 12) + padded(speed, 9) + "  " + painted(state, colour_of(axis), ink);
    if (!axis.has_health()) { return row; }
    return row + " " + slack_bar(axis.health(), scale, ink) + padded(lateness(axis.health()), 8) +
           padded(fixed(axis.health().loop_p99_us(), 0), 8);
}

std::string place_text(const proto::AxisStatus& axis) {
    if (!axis.present()) { return "not received"; }
    if (axis.board()) { return axis.state(); }
    return axis.homed() ? fixed(axis.position_mm(), 3) + " " +
                              std::string(unit_of(axis.has_axis() ? axis.axis() : axis.name())) + " " + axis.state()
                        : "not homed";
}

std::string title_row() { return "axis       position mm     mm/s  state      setpoint slack    ms late us loop us"; }

std::string job_row(const proto::StatusReport& status, Ink ink) {
    if (status.has_pause()) { return painted(cut("paused: " + paused_text(status.pause()), kColumns), kWarning, ink); }
    if (!status.has_progress()) { return painted("no job in motion", kFaint, ink); }
    return progress_bar(status);
}

std::string conditions_row(const proto::StatusReport& status, Ink ink) {
    const std::string overrides = overrides_text(status);
    const std::string writer = writer_text(status);
    return painted(writer.empty() ? overrides : spread(overrides, "writer: " + writer), kWarning, ink);
}

/// Empty if all inputs are open.
std::string inputs_row(const proto::StatusReport& status, Ink ink) {
    const std::string closed = closed_inputs_text(status);
    return closed.empty() ? "" : painted(cut("closed inputs: " + closed, kColumns), kWarning, ink) + "\n";
}

/// Empty if all outputs are off, as the program asks.
std::string outputs_row(const proto::StatusReport& status) {
    const std::string outputs = outputs_text(status);
    return outputs.empty() ? "" : cut("outputs: " + outputs, kColumns) + "\n";
}

/// Empty if all devices are off.
std::string devices_row(const proto::StatusReport& status, Ink ink) {
    const std::string devices = devices_text(status);
    return devices.empty() ? "" : painted(cut(devices, kColumns), kWarning, ink) + "\n";
}

}  // namespace

SlackScale slack_scale(const ProtocolTiming& timing) {
    const double slot_ms = static_cast<double>(timing.slot_us) * 1e-3;
    return {.ahead_ms = timing.send_ahead_slots * slot_ms, .deadline_ms = timing.check_slots() * slot_ms};
}

std::string watch_text(const proto::StatusReport& status, const SlackScale& scale, Ink ink) {
    const std::string phase = status.phase().empty() ? "unknown" : status.phase();
    const std::string job = status.has_job() ? fmt::format(", job {}", status.job()) : "";
    const std::string heading = spread(status.machine() + ": " + phase + job, age_text(status));
    std::string text = painted(heading, kBold, ink) + "\n" + job_row(status, ink) + "\n" + conditions_row(status, ink) +
                       "\n" + devices_row(status, ink) + inputs_row(status, ink) + outputs_row(status) +
                       painted(title_row(), kFaint, ink) + "\n";
    for (const proto::AxisStatus* const axis : rows_of(status)) { text += axis_row(*axis, scale, ink) + "\n"; }
    const auto alarms = alarms_of(status, scale);
    text += "\n" + (alarms.empty() ? painted("no alarms", kFaint, ink) + "\n" : "");
    for (const std::string& alarm : alarms) { text += painted(wrapped(alarm, kColumns, "  "), kBad, ink) + "\n"; }
    return text;
}

std::string watch_line(const proto::StatusReport& status, const SlackScale& scale) {
    std::string text = status.machine() + ": " + progress_text(status);
    for (const proto::AxisStatus* const axis : rows_of(status)) {
        text += "; " + axis->name() + " ";
        text += place_text(*axis);
        const auto& health = axis->health();
        if (health.has_setpoint_slack_ms()) { text += " slack " + fixed(health.setpoint_slack_ms().min(), 0) + " ms"; }
    }
    if (status.has_pause()) { text += "; paused: " + paused_text(status.pause()); }
    if (status.has_devices()) { text += "; " + devices_text(status); }
    if (const std::string closed = closed_inputs_text(status); !closed.empty()) {
        text += "; closed inputs: " + closed;
    }
    if (const std::string outputs = outputs_text(status); !outputs.empty()) { text += "; outputs: " + outputs; }
    if (status.has_writer()) { text += "; writer " + writer_text(status); }
    for (const std::string& alarm : alarms_of(status, scale)) { text += "; " + alarm; }
    return text;
}

}  // namespace lockstep
