#include "clients/web/machine/task.hpp"

#include "clients/session/control/store_values.hpp"
#include "clients/web/machine/session_lease.hpp"
#include "core/coordinator/path/coordination.hpp"
#include "core/protocol/needs_lease.hpp"

namespace lockstep::web {
namespace {

Problem refused_by(const Reply& reply) { return refused(reply.fault, reply.text); }

Outcome outcome_of(const Reply& reply) {
    if (reply.status == ReplyStatus::Refused) { return std::unexpected(refused_by(reply)); }
    return Accepted{.job = reply.job == 0 ? std::nullopt : std::optional(reply.job)};
}

bool begins_job(CommandKind kind) { return kind == CommandKind::Home || kind == CommandKind::Run; }

}  // namespace

bool Task::end(Outcome&& outcome) {
    done_(std::move(outcome));
    return true;
}

bool LeaseTask::poll(Session& session) {
    if (!begun_) { begun_ = session.owner().running_time(); }
    const HeldLease* lease = session.writer();
    const bool is_writer = lease != nullptr && lease->writer.id == session.lease().writer().id;
    if (is_writer == takes_ && !session.is_silent()) { return end(Accepted{}); }
    return session.owner().running_time() - *begun_ > CommandTracker::kPatience &&
           end(std::unexpected(unanswered(silence_of(session))));
}

CommandTask::CommandTask(const Command& command, Done done)
    : Task(needs_lease(command) ? Lease::Needed : Lease::NotNeeded, std::move(done)), tracker_(command) {}

bool CommandTask::poll(Session& session) {
    const CommandStep step = session.follow(tracker_);
    if (!is_over(step)) { return false; }
    if (step == CommandStep::GaveUp) { return end(std::unexpected(unanswered(silence_of(session)))); }
    Outcome outcome = outcome_of(*tracker_.reply());
    if (outcome && !begins_job(tracker_.command().kind)) { outcome->job.reset(); }
    return end(std::move(outcome));
}

bool RunTask::poll(Session& session) {
    if (command_) { return command_->poll(session); }
    if (id_ == 0) {
        id_ = session.upload().open(program_.head, program_.values, std::move(program_.feed)).program();
        return false;
    }
    const ProgramSender& sender = *session.upload().sender();
    if (sender.refusal()) { return end(std::unexpected(refused_by(*sender.refusal()))); }
    const bool is_planned_whole = coordination_of(session.config()).plans_whole;
    if (is_planned_whole ? sender.is_done() : sender.parts_taken() > 0) {
        const auto done = [this](Outcome&& outcome) {
            if (outcome && outcome->job) { begun_(*outcome->job); }
            end(std::move(outcome));
        };
        command_ = std::make_unique<CommandTask>(Command{.kind = CommandKind::Run, .program = id_}, done);
        return false;
    }
    return is_upload_overdue(session) && end(std::unexpected(unanswered(silence_of(session))));
}

bool ValuesTask::begin(Session& session) {
    const auto before = session.values().newest();
    if (!before) {
        return end(std::unexpected(unanswered("the coordinator has not reported the machine's offsets and tools yet")));
    }
    const auto wanted = change_(before->values);
    if (!wanted) { return end(std::unexpected(wanted.error())); }
    if (*wanted == before->values) { return end(Accepted{}); }
    const gcode::ProgramValues edit{.revision = before->revision, .after = *wanted, .at_once = true};
    session.upload().open(edit_of(session.config()).head(), edit).end();
    revision_ = before->revision + 1;
    sent_ = session.owner().running_time();
    return false;
}

bool ValuesTask::poll(Session& session) {
    if (!sent_) { return begin(session); }
    const ProgramSender& sender = *session.upload().sender();
    if (sender.refusal()) { return end(std::unexpected(refused_by(*sender.refusal()))); }
    if (sender.is_done() && session.values().is_kept(revision_)) { return end(Accepted{}); }
    if (!sender.is_done()) {
        return is_upload_overdue(session) && end(std::unexpected(unanswered(silence_of(session))));
    }
    return session.owner().running_time() - *sent_ > kDiskPatience &&
           end(std::unexpected(unanswered(
               "the coordinator has not reported that the change is on its disk; its log names the reason")));
}

}  // namespace lockstep::web
