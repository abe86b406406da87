#include "core/protocol/reception_watch.hpp"

#include <algorithm>

namespace lockstep {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kBetweenLooks_ms = 500;
constexpr std::int64_t kBeyondLease_ms = 2000;
constexpr std::int64_t kPeerAbsence_ms = 6000;
constexpr int kDiscardingLooks = 3;  // in a row; DDS discards a sample that is sent again now and then
constexpr int kLongestPause = 2;     // times peer_silence_
constexpr int kMostDoublings = 5;    // of peer_absence_; a process may wait for others all night

/// Keeps the time since which a condition holds; empty while it does not hold.
void keep(std::optional<Tick>& since, bool holds, Tick now) {
    if (!holds) { since.reset(); }
    if (holds && !since) { since = now; }
}

bool lasts(const std::optional<Tick>& since, Tick now, Ticks time) { return since && now - *since >= time; }

}  // namespace

std::string_view text_of(ReopenReason reason) {
    switch (reason) {
        case ReopenReason::InterfaceChanged: return "the interface has changed";
        case ReopenReason::MemoryReplaced: return "the shared memory of states was replaced";
        case ReopenReason::PeerSilent: return "a peer is present, but none of its messages are received";
        case ReopenReason::SamplesDiscarded: return "DDS discards all samples of a topic";
        case ReopenReason::PeerMissing: return "no message of a peer was received for a long time";
        case ReopenReason::NotReceivedByPeers: return "the peers report that they do not receive this process";
    }
    return "";
}

ReceptionWatch::ReceptionWatch(Ticks lease, std::int64_t tick_ns)
    : between_looks_{kBetweenLooks_ms * kMillisecond_ns / tick_ns},
      peer_silence_(lease + Ticks{kBeyondLease_ms * kMillisecond_ns / tick_ns}),
      peer_absence_{kPeerAbsence_ms * kMillisecond_ns / tick_ns} {}

void ReceptionWatch::forget() {
    silent_since_.reset();
    missing_since_.reset();
    unreceived_since_.reset();
    topics_.clear();
}

bool ReceptionWatch::discards_all(std::span<const TopicReception> topics) {
    topics_.resize(topics.size());
    bool found = false;
    for (std::size_t i = 0; i < topics.size(); ++i) {
        Topic& topic = topics_[i];
        const bool discards = topics[i].received == topic.last.received && topics[i].discarded > topic.last.discarded;
        topic = {topics[i], discards ? topic.discarding + 1 : 0};
        found = found || topic.discarding >= kDiscardingLooks;
    }
    return found;
}

std::optional<ReopenReason> ReceptionWatch::reason(Tick now, const Reception& reception) {
    keep(silent_since_, reception.is_peer_silent, now);
    keep(missing_since_, reception.is_peer_missing, now);
    keep(unreceived_since_, reception.is_unreceived, now);
    const bool discards = discards_all(reception.topics);
    const bool has_all = !reception.is_peer_missing && !reception.is_peer_silent && !reception.is_unreceived;
    if (has_all && !discards) { reopened_ = 0; }
    if (reception.change) { return reception.change; }
    if (lasts(silent_since_, now, peer_silence_)) { return ReopenReason::PeerSilent; }
    if (discards) { return ReopenReason::SamplesDiscarded; }
    if (lasts(unreceived_since_, now, peer_silence_)) { return ReopenReason::NotReceivedByPeers; }
    if (lasts(missing_since_, now, peer_absence_)) { return ReopenReason::PeerMissing; }
    return std::nullopt;
}

/// The time between two reopenings. Others need time to find the new participant, and a reopening that does not help
/// must not be repeated all the time.
Ticks ReceptionWatch::pause(ReopenReason reason) const {
    if (reason == ReopenReason::PeerMissing) {
        return peer_absence_ * (1 << std::clamp(reopened_ - 1, 0, kMostDoublings));
    }
    return peer_silence_ * std::clamp(reopened_, 1, kLongestPause);
}

std::optional<ReopenReason> ReceptionWatch::look(Tick now, const Reception& reception) {
    const bool has_run = now - looked_ < between_looks_ * 2;
    looked_ = now;
    if (!has_run) { forget(); }  // messages missed in its own stall say nothing of its peers
    const auto found = reason(now, reception);
    if (!found || !reception.may_reopen) { return std::nullopt; }
    if (reopened_at_ && now - *reopened_at_ < pause(*found)) { return std::nullopt; }
    forget();
    ++reopened_;
    reopened_at_ = now;
    return found;
}

}  // namespace lockstep
