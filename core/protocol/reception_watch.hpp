// Decides when a process opens its DDS participant again, because it receives nothing although there is something to
// receive.
//
// DDS numbers the samples of each writer, and takes none twice. A packet with a number far ahead, forged or damaged,
// makes it discard everything that follows from that writer, for as long as it knows that writer: the process is cut
// off from a peer for good. A participant that is opened again forgets what it believed of others, and is a new one to
// them. The same mends what an interface loses that goes away and comes back.
//
// Damaged packets can also leave a writer that sends nothing any more. The process itself does not notice: it receives
// all others. But they report whom they receive, so a process that none of them receives opens its participant again.
//
// Only a process at rest does so, and by itself: nothing is arranged between peers. Its identity, its position and its
// homing are not DDS's matter and stay.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/units.hpp"

namespace lockstep {

enum class ReopenReason : std::uint8_t {
    InterfaceChanged,   // it has another address, or is another one of the same name
    MemoryReplaced,     // the file of the states by memory is no longer the one that is open
    PeerSilent,         // a peer is there, by DDS or by what others receive, and nothing of it is received
    SamplesDiscarded,   // DDS discards every sample of a topic that comes
    PeerMissing,        // nothing of a peer was received for long; perhaps it does not run
    NotReceivedByPeers  // peers are received, and report that none of them receives this process
};
std::string_view text_of(ReopenReason reason);

/// Of one topic, since the participant was opened.
struct TopicReception {
    std::uint64_t received = 0;   // samples
    std::uint64_t discarded = 0;  // bytes that DDS did not deliver
};

/// What a process finds when it looks; nothing of it is remembered by the caller.
struct Reception {
    std::optional<ReopenReason> change;  // InterfaceChanged or MemoryReplaced
    bool is_peer_silent = false;         // since the last look: one that is known to be there
    bool is_peer_missing = false;        // since the last look: one without which nothing moves
    bool is_unreceived = false;          // since the last look: peers reported, none that it receives this process
    bool may_reopen = false;             // at rest
    std::span<const TopicReception> topics;
};

class ReceptionWatch {
public:
    /// lease: how long DDS takes a peer that has ended without a word for present. A tick is so many nanoseconds.
    ReceptionWatch(Ticks lease, std::int64_t tick_ns);

    /// Whether it is time to look again, by the process's own clock.
    bool is_due(Tick now) const { return now - looked_ >= between_looks_; }
    /// When it is due. Why the participant is to be opened again, now.
    std::optional<ReopenReason> look(Tick now, const Reception& reception);

private:
    struct Topic {
        TopicReception last;
        int discarding = 0;  // looks in a row
    };
    void forget();
    bool discards_all(std::span<const TopicReception> topics);
    std::optional<ReopenReason> reason(Tick now, const Reception& reception);
    Ticks pause(ReopenReason reason) const;

    Ticks between_looks_;
    Ticks peer_silence_;  // the least that counts
    Ticks peer_absence_;
    std::optional<Tick> silent_since_;
    std::optional<Tick> missing_since_;
    std::optional<Tick> unreceived_since_;
    std::vector<Topic> topics_;
    int reopened_ = 0;  // times in a row, without hearing all peers in between
    std::optional<Tick> reopened_at_;
    Tick looked_;
};

}  // namespace lockstep
