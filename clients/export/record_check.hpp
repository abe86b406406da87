// Checks whether the exported log has the complete record, from the message numbers and from the marks of the recording
// processes.
#pragma once

#include <map>
#include <utility>

#include "clients/analysis/record_state.hpp"
#include "services/record/reading/log_step.hpp"
#include "services/record/reading/number_set.hpp"
#include "services/record/reading/record_end.hpp"

namespace lockstep::exporting {

class RecordCheck {
public:
    void saw(RecordKind kind, const auto& message) {
        if (!analysis::is_message_number(message.sequence)) { return; }
        if constexpr (requires { message.axis; }) {
            saw(kind, {message.machine, message.axis, message.incarnation}, message.sequence);
        } else {
            saw(kind, {message.machine, "", message.coordinator}, message.sequence);
        }
    }
    void take(const analysis::RecordedMark& mark) { end_.take(mark); }
    /// The text of the recorded machine's file, which names its motors; empty in most messages.
    void take_machine(const std::string& config);
    /// Call once, at the end.
    analysis::RecordState finish();

private:
    void saw(RecordKind kind, const analysis::RecordingProcess& process, std::int64_t sequence);

    std::map<std::pair<analysis::RecordingProcess, RecordKind>, analysis::NumberSet> seen_;
    analysis::RecordEndCheck end_;
    analysis::MotorLabels labels_;
    std::string config_;
};

}  // namespace lockstep::exporting
