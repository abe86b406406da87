#include "clients/session/status_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "clients/session/inputs/input_report.hpp"
#include "clients/session/outputs/output_report.hpp"
#include "clients/session/record_loss.hpp"
#include "clients/session/reports.hpp"
#include "clients/text/format.hpp"
#include "services/documents/values/values_trouble.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kBarWidth = 30;

int percent(const proto::StatusReport& status) { return static_cast<int>(std::floor(status.progress() * 100)); }

/// The known values of the job in motion, each part after a separator.
std::string job_parts(const proto::StatusReport& status, const std::string& separator) {
    std::string text;
    if (status.has_line()) { text += fmt::format("{}line {}", separator, status.line()); }
    if (status.waits_for_program()) { text += separator + "waits for more of the program"; }
    if (status.has_remaining_s()) { text += separator + duration_text(status.remaining_s()) + " left"; }
    return text;
}

std::string headline(const proto::StatusReport& status) {
    std::string text = status.machine() + ": " + (status.phase().empty() ? "unknown" : status.phase());
    if (status.has_job()) { text += fmt::format(", job {}", status.job()); }
    if (status.has_progress()) { text += fmt::format(", {} %", percent(status)); }
    return wrapped(text + job_parts(status, ", ") + " (" + age_text(status) + ")", 80, "  ") + "\n";
}

std::string row(const std::string& name, const std::string& position, const std::string& velocity,
                const std::string& state, const std::string& homed) {
    return fmt::format("{:<16} {:>14} {:>14}   {:<12} {}\n", name, position, velocity, state, homed);
}

std::string axis_row(const proto::AxisStatus& axis) {
    if (axis.board()) { return row(axis.name(), "board", "", axis.present() ? axis.state() : "not received", ""); }
    if (!axis.has_position_mm()) { return row(label_of(axis), "-", "-", "not received", "-"); }
    return row(label_of(axis), fixed(axis.position_mm(), 4), fixed(axis.velocity_mm_s(), 3),
               axis.present() ? axis.state() : "not received", axis.homed() ? "yes" : "no");
}

/// The maximum clock error of each axis with its own clock; empty if there is none.
std::string clock_line(const proto::StatusReport& status) {
    std::string text;
    for (const proto::AxisStatus* const axis : rows_of(status)) {
        if (!axis->has_clock_error_us()) { continue; }
        text += (text.empty() ? "clock error at most: " : ", ") + axis->name() + " " +
                fixed(axis->clock_error_us(), 0) + " us";
    }
    return text.empty() ? text : wrapped(text, 80, "  ") + "\n";
}

/// The steps that each motor has lost and made up; empty if there is none.
std::string corrected_line(const proto::StatusReport& status) {
    std::string text;
    for (const proto::AxisStatus* const axis : rows_of(status)) {
        if (!axis->has_corrected_steps()) { continue; }
        text +=
            fmt::format("{}{} {}", text.empty() ? "lost steps made up: " : ", ", axis->name(), axis->corrected_steps());
    }
    return text.empty() ? text : wrapped(text, 80, "  ") + "\n";
}

/// The reason why axes are not homed, if it is not obvious.
std::string unproved_lines(const proto::StatusReport& status) {
    std::string text;
    for (const proto::AxisStatus* const axis : rows_of(status)) {
        if (!axis->has_unproved() || axis->unproved().number() == static_cast<unsigned>(FaultCode::PositionNotKept)) {
            continue;
        }
        const proto::FaultReport& why = axis->unproved();
        const std::string what = axis->board() ? "board " + axis->name() + ", " : axis->name() + " is not homed, ";
        text += wrapped(what + why.name() + ": " + why.cause() + "; " + why.remedy(), 80, "  ") + "\n";
    }
    return text;
}

/// Returns "label: coordinator 2, X 1" for the processes with a count above 0, or an empty text if there is none.
/// `of_axis` returns an axis's count.
template <typename OfAxis>
std::string count_line(const std::string& label, std::uint64_t coordinator, const proto::StatusReport& status,
                       OfAxis of_axis) {
    std::string text;
    const auto add = [&](const std::string& process, std::uint64_t count) {
        if (count > 0) { text += fmt::format("{}{} {}", text.empty() ? label + ": " : ", ", process, count); }
    };
    add("coordinator", coordinator);
    for (const proto::AxisStatus* const axis : rows_of(status)) { add(axis->name(), of_axis(axis->health())); }
    return text.empty() ? text : wrapped(text, 80, "  ") + "\n";
}

std::string process_lines(const proto::StatusReport& status) {
    using Health = proto::HealthReport;
    return count_line("DDS participant opened again, times since the start", status.participant_reopened(), status,
                      [](const Health& health) { return health.participant_reopened(); }) +
           count_line("log lines that could not be written", status.lost_log_lines(), status,
                      [](const Health& health) { return health.lost_log_lines(); });
}

/// Why the job waits, and what may be done in the pause. Empty without a pause.
std::string pause_lines(const proto::StatusReport& status) {
    if (!status.has_pause()) { return ""; }
    const proto::PauseReport& pause = status.pause();
    std::string text = wrapped("paused: " + paused_text(pause), 80, "  ") + "\n";
    if (pause.has_way_back()) { text += wrapped("axes were moved; way back: " + pause.way_back(), 80, "  ") + "\n"; }
    return text + "in the pause: lockstep jog, lockstep touch; continue: lockstep resume; end the job: lockstep stop\n";
}

/// Empty while every client may give commands.
std::string writer_line(const proto::StatusReport& status) {
    const std::string writer = writer_text(status);
    if (writer.empty()) { return ""; }
    const std::string held =
        fmt::format(", for {}, since {}", duration_text(status.writer().held_s()), status.writer().since());
    return wrapped("writer: " + writer + held, 80, "  ") + "\n";
}

/// A directory is not broken over lines, so that it can be copied.
std::string incidents_text(const proto::Incidents& incidents) {
    return fmt::format("{} incident files, the newest {}\nread them: lockstep analyze --incident {}\n",
                       incidents.files(), incidents.newest(), incidents.directory());
}

}  // namespace

std::string age_text(const proto::StatusReport& status) {
    if (!status.has_age_ms()) { return "no coordinator received"; }
    const double age_ms = status.age_ms();
    const std::string age = age_ms < 1000 ? fixed(age_ms, 0) + " ms" : duration_text(age_ms / 1000);
    return fmt::format("received {} ago{}", age, (status.standby() ? ", a standby is ready" : ""));
}

std::string status_text(const proto::StatusReport& status) {
    std::string text =
        headline(status) + pause_lines(status) + row("axis", "position mm", "velocity mm/s", "state", "homed");
    for (const proto::AxisStatus* const axis : rows_of(status)) { text += axis_row(*axis); }
    if (const std::string turned = overrides_text(status); !turned.empty()) { text += "overrides: " + turned + "\n"; }
    if (const std::string on = devices_text(status); !on.empty()) {
        text += wrapped("devices: " + on, 80, "  ") + "\n";
    }
    if (const std::string closed = closed_inputs_text(status); !closed.empty()) {
        text += wrapped("closed inputs: " + closed, 80, "  ") + "\n";
    }
    if (const std::string outputs = outputs_text(status); !outputs.empty()) {
        text += wrapped("outputs: " + outputs, 80, "  ") + "\n";
    }
    text += writer_line(status);
    text += clock_line(status) + corrected_line(status) + unproved_lines(status);
    std::set<std::string> printed;
    const auto add_fault = [&](const proto::FaultReport& fault) {
        if (const std::string one = fault_text(fault) + "\n"; printed.insert(one).second) { text += one; }
    };
    if (status.has_fault()) { add_fault(status.fault()); }
    if (status.has_ended_early()) {
        text += fmt::format("the last job ended near line {}\n{}\n", status.line(), fault_text(status.ended_early()));
    }
    for (const proto::AxisStatus* const axis : rows_of(status)) {
        if (axis->has_fault()) { add_fault(axis->fault()); }
    }
    if (const std::string lost = record_loss_text(status); !lost.empty()) { text += wrapped(lost, 80, "  ") + "\n"; }
    if (status.unsaved_values()) {
        text += wrapped(std::string(kUnsavedValues) + "; " + kUnsavedValuesRemedy, 80, "  ") + "\n";
    }
    text += process_lines(status);
    if (status.has_incidents()) { text += incidents_text(status.incidents()); }
    return text;
}

std::string writer_text(const proto::StatusReport& status) {
    if (!status.has_writer()) { return ""; }
    return status.writer().name() + " on " + status.writer().host();
}

std::string overrides_text(const proto::StatusReport& status) {
    const bool as_programmed = status.feed_override_percent() == 100 && status.rapid_override_percent() == 100;
    if (!status.has_feed_override_percent() || as_programmed) { return ""; }
    return fmt::format("feed {} %, rapid {} %", status.feed_override_percent(), status.rapid_override_percent());
}

std::string paused_text(const proto::PauseReport& pause) {
    if (!pause.has_wait_left_s()) { return pause.text(); }
    return fmt::format("{} ({:.1f} s left)", pause.text(), pause.wait_left_s());
}

std::string devices_text(const proto::StatusReport& status) {
    const proto::DevicesReport& devices = status.devices();
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (devices.has_spindle()) {
        add(fmt::format("spindle {} {} rpm", devices.spindle().direction(), fixed(devices.spindle().rpm(), 0)));
    }
    if (devices.mist()) { add("mist"); }
    if (devices.flood()) { add("flood"); }
    if (devices.has_tool()) { add(fmt::format("tool {}", devices.tool())); }
    if (devices.outputs_size() > 0) { add(devices.outputs_size() == 1 ? "output" : "outputs"); }
    for (const std::uint32_t output : devices.outputs()) { text += fmt::format(" {}", output); }
    return text;
}

std::string progress_bar(const proto::StatusReport& status) {
    const auto filled = static_cast<std::size_t>(std::clamp(status.progress(), 0.0, 1.0) * kBarWidth);
    const std::string bar = "[" + std::string(filled, '#') + std::string(kBarWidth - filled, ' ') + "] ";
    const std::string phase = status.phase() == "Running" ? "" : "  " + status.phase();
    return bar + fmt::format("{:3} %", percent(status)) + job_parts(status, "  ") + phase;
}

std::string progress_text(const proto::StatusReport& status) {
    const std::string done = status.has_progress() ? fmt::format(": {} %", percent(status)) : "";
    return status.phase() + done + job_parts(status, ", ");
}

std::string unhomed_text(const proto::StatusReport& status) {
    std::string names;
    for (const proto::AxisStatus* const axis : rows_of(status)) {
        if (!axis->board() && !axis->homed()) { names += (names.empty() ? "" : ", ") + axis->name(); }
    }
    return names.empty() ? names : "not homed: " + names + "; home: lockstep home";
}

std::string places_text(const proto::RunReport& report) {
    std::string text;
    for (const proto::FinalPosition& place : report.final_positions()) {
        text += (text.empty() ? "" : "  ") + axis_label(place.name()) + " " + fixed(place.position_mm(), 4);
    }
    return text;
}

}  // namespace lockstep
