#include "clients/session/record_loss.hpp"

#include <fmt/format.h>

#include "clients/session/reports.hpp"

namespace lockstep {

std::uint64_t lost_records(const proto::StatusReport& status) {
    std::uint64_t lost = status.lost_records();
    for (const proto::AxisStatus* const axis : rows_of(status)) { lost += axis->health().lost_records(); }
    return lost;
}

std::string record_loss_text(const proto::StatusReport& status) {
    std::string text;
    const auto add = [&](const std::string& process, std::uint64_t lost) {
        if (lost > 0) { text += fmt::format("{}{} {}", text.empty() ? "" : ", ", process, lost); }
    };
    add("coordinator", status.lost_records());
    for (const proto::AxisStatus* const axis : rows_of(status)) { add(axis->name(), axis->health().lost_records()); }
    if (text.empty()) { return text; }
    return "record: messages that could not be written or sent: " + text +
           "; check whether the disk of the record is full: the logs of these processes name it; lockstep log merge "
           "lists the missing messages";
}

}  // namespace lockstep
