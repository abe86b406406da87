// Decides when a process opens its DDS participant again because it receives nothing although others publish.
//
// DDS numbers the samples of each writer and takes none twice. After a forged or damaged packet with a number far ahead
// it discards everything that follows from that writer, for as long as it knows the writer. The process is then cut off
// from that peer permanently. A participant that is opened again forgets the writers' numbers, and is a new participant
// to the others. Reopening also restores what is lost when an interface goes away and comes back.
//
// Damaged packets can also make a writer stop sending. Its own process does not notice, because it still receives all
// others. The others report which processes they receive, so a process that none of them receives opens its participant
// again.
//
// A process reopens only at rest, and decides alone, without an agreement between peers. It keeps its identity,
// position and homing, because DDS does not hold them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/units.hpp"

namespace lockstep {

enum class ReopenReason : std::uint8_t {
    InterfaceChanged,   // it has another address, or another interface has its name
    MemoryReplaced,     // the file of the shared states is no longer the one that is open
    PeerSilent,         // DDS or other processes show that a peer is present, but none of its messages are received
    SamplesDiscarded,   // DDS discards every sample of a topic
    PeerMissing,        // no message of a peer was received for a long time; it may not be running
    NotReceivedByPeers  // peers are received, and report that none of them receives this process
};
std::string_view text_of(ReopenReason reason);

/// Counts of one topic since the participant was opened.
struct TopicReception {
    std::uint64_t received = 0;   // samples
    std::uint64_t discarded = 0;  // bytes that DDS did not deliver
};

/// The observations of a process in one look. Each look is complete: the caller need not keep earlier ones.
struct Reception {
    std::optional<ReopenReason> change;  // InterfaceChanged or MemoryReplaced
    bool is_peer_silent = false;         // nothing came since the last look from a peer known to be there
    bool is_peer_missing = false;        // nothing came since the last look from a peer without which nothing moves
    bool is_unreceived = false;          // since the last look peers reported, and none reported receiving this process
    bool may_reopen = false;             // at rest
    std::span<const TopicReception> topics;
};

class ReceptionWatch {
public:
    /// `lease`: how long DDS still counts a crashed peer as present. `tick_ns`: nanoseconds in one tick.
    ReceptionWatch(Ticks lease, std::int64_t tick_ns);

    /// Whether it is time to look again, by the process's own clock.
    bool is_due(Tick now) const { return now - looked_ >= between_looks_; }
    /// Call it when a look is due. Returns why the participant must be opened again now, or nullopt if it need not.
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
    Ticks peer_silence_;  // the shortest silence that counts
    Ticks peer_absence_;
    std::optional<Tick> silent_since_;
    std::optional<Tick> missing_since_;
    std::optional<Tick> unreceived_since_;
    std::vector<Topic> topics_;
    int reopened_ = 0;  // times in a row, without receiving all peers in between
    std::optional<Tick> reopened_at_;
    Tick looked_;
};

}  // namespace lockstep
