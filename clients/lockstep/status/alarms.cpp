#include "clients/lockstep/status/alarms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clients/session/inputs/input_report.hpp"
#include "clients/session/record_loss.hpp"
#include "clients/text/format.hpp"

#include "clients/session/reports.hpp"

namespace lockstep {
namespace {

constexpr double kStepSlack_us = 2;  // the remaining error when a frame is mapped to another clock

std::string sentence(const proto::FaultReport& fault) {
    return fmt::format("{}{} ({}): {}; {}", fault_place(fault), fault.name(), fault.number(), fault.cause(),
                       fault.remedy());
}

std::string refusals(const proto::HealthReport& health) {
    std::string text;
    const auto add = [&](std::uint64_t count, const char* what) {
        if (count > 0) { text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what); }
    };
    add(health.refused_frames(), "frames refused");
    add(health.refused_commands(), "commands refused");
    add(health.refused_messages(), "messages refused");
    add(health.refused_orders(), "orders refused by the device");
    add(health.lost_captures(), "steps without their time");
    return text;
}

void add_health_alarms(const proto::AxisStatus& axis, const SlackScale& scale, std::vector<std::string>& alarms) {
    const proto::HealthReport& health = axis.health();
    const std::string who = process_label(axis) + ": ";
    const double slack_ms = health.setpoint_slack_ms().min();
    if (health.has_setpoint_slack_ms() && slack_ms < scale.deadline_ms) {
        alarms.push_back(
            fmt::format("{}a setpoint arrived {} ms before its start, but the deadline is {} ms before: find out what "
                        "stalls the coordinator",
                        who, fixed(slack_ms, 0), fixed(scale.deadline_ms, 0)));
    }
    const proto::Spread& late = health.step_lateness_us();
    const double furthest_us = std::max(std::abs(late.min()), std::abs(late.max()));
    if (furthest_us > health.clock_error_us() + kStepSlack_us) {
        alarms.push_back(
            fmt::format("{}a step was {} us before or after its commanded time", who, fixed(furthest_us, 0)));
    }
    if (const std::string refused = refusals(health); !refused.empty()) {
        alarms.push_back(fmt::format("{}since it started: {}; see the axis's log", who, refused));
    }
}

}  // namespace

std::vector<std::string> alarms_of(const proto::StatusReport& status, const SlackScale& scale) {
    std::vector<std::string> alarms;
    const auto add = [&](const std::string& alarm) {
        if (std::ranges::find(alarms, alarm) == alarms.end()) { alarms.push_back(alarm); }
    };
    if (status.has_fault()) { add(sentence(status.fault())); }
    for (const proto::AxisStatus* const axis : rows_of(status)) {
        if (axis->has_fault()) { add(sentence(axis->fault())); }
    }
    for (const proto::InputStatus& input : status.inputs()) {
        const auto row = std::ranges::find(kInputUses, input.use(), &InputUseRow::name);
        if (!input.closed() || row == kInputUses.end() || !row->holds()) { continue; }
        const FaultText& refusal = *find_fault(row->refusal);
        add(fmt::format("{}: {} is closed; {}, then: lockstep resume", refusal.cause, label_of(input),
                        refusal.by_hand));
    }
    for (const proto::AxisStatus* const row : process_rows(status)) {
        if (!row->present()) {
            add("no messages are received from " + process_label(*row) +
                "; check that its process runs: lockstep status");
        }
    }
    if (status.has_fault() && status.has_incidents()) {
        add("the events before it: lockstep analyze --incident " + status.incidents().directory());
    }
    for (const proto::AxisStatus* const axis : rows_of(status)) {
        if (axis->has_health()) { add_health_alarms(*axis, scale, alarms); }
    }
    if (const std::string lost = record_loss_text(status); !lost.empty()) { add(lost); }
    return alarms;
}

}  // namespace lockstep
