#include "clients/session/refusal.hpp"

#include "clients/session/reports.hpp"

namespace lockstep {

ExitCode print_refusal(const Reply& reply, Output& output) {
    proto::CommandReport report;
    report.set_accepted(false);
    *report.mutable_fault() = fault_report(reply.fault, "");
    report.set_text(reply.text);
    output.report(report);
    if (!output.json()) { output.warn("refused: " + reply.text + "\n" + fault_text(report.fault())); }
    return kExitFailed;
}

ExitCode print_refusal(const std::string& title, const Reply& reply, proto::RunReport& report, Output& output) {
    report.set_outcome("refused");
    *report.mutable_fault() = fault_report(reply.fault, "");
    output.report(report);
    if (!output.json()) { output.warn(title + ": refused: " + reply.text + "\n" + fault_text(report.fault())); }
    return kExitFailed;
}

}  // namespace lockstep
