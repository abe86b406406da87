#include "core/coordinator/reply.hpp"

#include "core/check.hpp"

namespace lockstep {

Reply reply_to(const Command& command, const CommandResult& result, std::uint64_t job) {
    if (result) { return {command.client, command.sequence, ReplyStatus::Accepted, FaultCode::None, job, {}}; }
    const Refusal& refusal = result.error();
    return {command.client, command.sequence, ReplyStatus::Refused, refusal.why, 0, refusal.text};
}

Reply reply_of_new_owner(const Command& command) {
    const FaultText& why = check_found(find_fault(FaultCode::CoordinatorChanged), "every fault has a text");
    return reply_to(command, refuse(why.code, std::string(why.cause) + "; " + remedy_text(why)), 0);
}

bool is_interrupt(CommandKind kind) {
    return kind == CommandKind::Hold || kind == CommandKind::Stop || kind == CommandKind::EmergencyStop ||
           kind == CommandKind::Reset;
}

}  // namespace lockstep
