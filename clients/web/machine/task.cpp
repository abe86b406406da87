#include "clients/web/machine/task.hpp"

#include "clients/session/control/store_values.hpp"
#include "core/protocol/needs_lease.hpp"

namespace lockstep::web {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kPatience = 3s;
constexpr nanoseconds kPlanPatience = 60s;  // a coordinator that plans a large program answers late
constexpr nanoseconds kDiskPatience = 15s;
constexpr nanoseconds kRepeatAfter = 250ms;
constexpr nanoseconds kRepeatStopAfter = 20ms;  // for an emergency stop

Problem refused_by(const Reply& reply) { return refused(reply.fault, reply.text); }

Outcome outcome_of(const Reply& reply) {
    if (reply.status == ReplyStatus::Refused) { return std::unexpected(refused_by(reply)); }
    return Accepted{.job = reply.job == 0 ? std::nullopt : std::optional(reply.job)};
}

bool begins_job(CommandKind kind) { return kind == CommandKind::Home || kind == CommandKind::Run; }

}  // namespace

std::string silence_of(const Session& session) { return session.silent().errors.front().message; }

bool Task::end(Outcome&& outcome) {
    done_(std::move(outcome));
    return true;
}

bool LeaseTask::poll(Session& session, nanoseconds now) {
    if (!begun_) { begun_ = now; }
    const HeldLease* lease = session.writer();
    const bool is_writer = lease != nullptr && lease->writer.id == session.writer_id();
    if (is_writer == takes_ && !session.is_silent()) { return end(Accepted{}); }
    return now - *begun_ > kPatience && end(std::unexpected(unanswered(silence_of(session))));
}

CommandTask::CommandTask(const Command& command, Done done)
    : Task(needs_lease(command) ? Lease::Needed : Lease::NotNeeded, std::move(done)), command_(command) {}

bool CommandTask::poll(Session& session, nanoseconds now) {
    if (!begun_) {
        session.begin(command_);
        begun_ = repeated_ = now;
        return false;
    }
    if (const Reply* reply = session.reply_to(command_)) {
        Outcome outcome = outcome_of(*reply);
        if (outcome && !begins_job(command_.kind)) { outcome->job.reset(); }
        return end(std::move(outcome));
    }
    if (now - *begun_ > (command_.program == 0 ? kPatience : kPlanPatience)) {
        return end(std::unexpected(unanswered(silence_of(session))));
    }
    const bool is_stop = command_.kind == CommandKind::EmergencyStop;
    if (now - repeated_ >= (is_stop ? kRepeatStopAfter : kRepeatAfter)) {
        session.repeat(command_);
        repeated_ = now;
    }
    return false;
}

bool RunTask::poll(Session& session, nanoseconds now) {
    if (command_) { return command_->poll(session, now); }
    if (!sent_) {
        id_ = session.begin_stream(program_.head, program_.values, std::move(program_.feed));
        sent_ = now;
        return false;
    }
    const ProgramSender& sender = *session.sender();
    if (sender.refusal()) { return end(std::unexpected(refused_by(*sender.refusal()))); }
    const bool is_planned_whole = session.config().coordination == StepMethod::Lai;
    if (is_planned_whole ? sender.is_done() : sender.parts_taken() > 0) {
        const auto done = [this](Outcome&& outcome) {
            if (outcome && outcome->job) { begun_(*outcome->job); }
            end(std::move(outcome));
        };
        command_ = std::make_unique<CommandTask>(Command{.kind = CommandKind::Run, .program = id_}, done);
        return false;
    }
    if (now - *sent_ <= (is_planned_whole ? kPlanPatience : kPatience)) { return false; }
    return end(std::unexpected(unanswered(silence_of(session))));
}

bool ValuesTask::begin(Session& session, nanoseconds now) {
    const auto before = session.newest_values();
    if (!before) {
        return end(std::unexpected(unanswered("the coordinator has not reported the machine's offsets and tools yet")));
    }
    const auto wanted = change_(before->values);
    if (!wanted) { return end(std::unexpected(wanted.error())); }
    if (*wanted == before->values) { return end(Accepted{}); }
    const gcode::ProgramValues edit{.revision = before->revision, .after = *wanted, .at_once = true};
    (void)session.begin_stream(edit_of(session.config()).head(), edit, [](ProgramSender& sender) { sender.end(); });
    revision_ = before->revision + 1;
    sent_ = now;
    return false;
}

bool ValuesTask::poll(Session& session, nanoseconds now) {
    if (!sent_) { return begin(session, now); }
    const ProgramSender& sender = *session.sender();
    if (sender.refusal()) { return end(std::unexpected(refused_by(*sender.refusal()))); }
    if (sender.is_done() && session.is_kept(revision_)) { return end(Accepted{}); }
    if (now - *sent_ <= (sender.is_done() ? kDiskPatience : kPatience)) { return false; }
    return end(std::unexpected(unanswered(
        sender.is_done() ? "the coordinator has not reported that the change is on its disk; its log names the reason"
                         : silence_of(session))));
}

}  // namespace lockstep::web
