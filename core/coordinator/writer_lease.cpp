#include "core/coordinator/writer_lease.hpp"

#include <algorithm>
#include <string>

#include "core/protocol/needs_lease.hpp"

namespace lockstep {
namespace {

std::string duration_text(std::int64_t seconds) {
    constexpr std::int64_t kMinute = 60;
    constexpr std::int64_t kHour = 60 * kMinute;
    if (seconds < 2 * kMinute) { return std::to_string(seconds) + " s"; }
    if (seconds < 2 * kHour) { return std::to_string(seconds / kMinute) + " min"; }
    return std::to_string(seconds / kHour) + " h";
}

std::string name_of(const LeaseHolder& writer) { return writer.name + " on " + writer.host; }

/// The same name on another host is another writer, which a person may not expect.
std::string hint_for(const LeaseHolder& writer, const LeaseHolder& holder) {
    if (writer.name != holder.name || writer.host == holder.host) { return ""; }
    return "; " + writer.name + " on " + writer.host +
           " is another writer; to be one writer on both hosts, set on each: " + "LOCKSTEP_WRITER=" + holder.name +
           "@" + holder.host;
}

}  // namespace

WriterLease::WriterLease(const MachineConfig& machine)
    : ticks_per_second_(machine.ticks_per_second()), silence_(kLeaseSilence_ms * 1000 / machine.timing.slot_us + 1) {
    members_.reserve(kMostMembers);
    silent_.reserve(kMostMembers);
}

CommandResult WriterLease::take(const Command& command, Tick now, Slot slot) {
    const LeaseHolder& writer = command.writer;
    if (writer.id == 0) { return refuse(FaultCode::BadProgram, "a lease needs a writer's identity"); }
    if (auto may = check_loser(command); !may) { return may; }
    const bool is_mine = held_ && held_->writer.id == writer.id;
    if (held_ && !is_mine && !command.takes_over) {
        return refuse(FaultCode::WriterHeld, text_of(*held_, now) + hint_for(writer, held_->writer));
    }
    if (!is_mine) { pass_to(writer, now); }
    note(command, slot);
    return {};
}

CommandResult WriterLease::check_loser(const Command& command) const {
    const Loser* loser = losers_.find(command.client);
    if (loser == nullptr || command.sequence > loser->sequence) { return {}; }
    return refuse(FaultCode::WriterHeld, loser->text);
}

void WriterLease::pass_to(const LeaseHolder& writer, Tick now) {
    for (const Member& member : members_) {
        if (!member.client) { continue; }
        losers_.note(*member.client, {member.sequence, name_of(writer) + " has taken over the machine"});
    }
    held_ = HeldLease{writer, now};
    members_.clear();
}

/// A new client replaces the one received longest ago.
void WriterLease::note(const Command& command, Slot slot) {
    const Identity client = command.client;
    std::erase_if(members_, [&](const Member& member) { return member.client == client || !member.client; });
    if (members_.size() == kMostMembers) { members_.erase(members_.begin()); }
    members_.push_back({client, slot, command.sequence});
}

void WriterLease::give(Identity client) {
    std::erase_if(members_, [&](const Member& member) { return member.client == client; });
    if (members_.empty()) { held_.reset(); }
}

CommandResult WriterLease::check(const Command& command, Tick now) const {
    return needs_lease(command) ? check(command.writer.id, now) : CommandResult{};
}

CommandResult WriterLease::check(std::uint64_t writer, Tick now) const {
    if (!held_ || held_->writer.id == writer) { return {}; }
    return refuse(FaultCode::WriterHeld, text_of(*held_, now));
}

std::string WriterLease::text_of(const HeldLease& lease, Tick now) const {
    const auto seconds = static_cast<std::int64_t>(static_cast<double>((now - lease.since).value) / ticks_per_second_);
    return name_of(lease.writer) + " has been the machine's writer for " +
           duration_text(std::max<std::int64_t>(0, seconds));
}

const std::vector<Identity>& WriterLease::tend(Slot slot, Slot missed) {
    silent_.clear();
    for (Member& member : members_) { member.received = std::min(slot, member.received + missed); }
    std::erase_if(members_, [&](const Member& member) {
        const bool is_silent = slot - member.received > silence_;
        if (is_silent && member.client) { silent_.push_back(*member.client); }
        return is_silent;
    });
    if (members_.empty()) { held_.reset(); }
    return silent_;
}

void WriterLease::adopt(const std::optional<HeldLease>& lease, Slot slot) {
    held_ = lease;
    members_.clear();
    if (held_) { members_.push_back({std::nullopt, slot, 0}); }
}

}  // namespace lockstep
