#include "clients/session/refusal.hpp"

#include "clients/session/reports.hpp"

namespace lockstep {

ExitCode say_refusal(const Reply& reply, Voice& voice) {
    proto::CommandReport report;
    report.set_accepted(false);
    *report.mutable_fault() = fault_report(static_cast<FaultCode>(reply.fault), "");
    report.set_text(reply.text);
    voice.report(report);
    if (!voice.json()) { voice.warn("refused: " + reply.text + "\n" + fault_text(report.fault())); }
    return kExitFailed;
}

}  // namespace lockstep
