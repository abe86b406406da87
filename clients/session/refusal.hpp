// Reports that the coordinator has refused a command.
#pragma once

#include "clients/text/exit_code.hpp"
#include "clients/text/output.hpp"
#include "core/protocol/messages.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// Prints the reason and the remedy, or a CommandReport with both.
ExitCode print_refusal(const Reply& reply, Output& output);
/// The same for a job: `report` gets the refusal as its outcome. `title` names the job.
ExitCode print_refusal(const std::string& title, const Reply& reply, proto::RunReport& report, Output& output);

}  // namespace lockstep
