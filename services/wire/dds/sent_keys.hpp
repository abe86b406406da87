// Makes DDS Security drop the keys that it sent to participants that have left.
//
// Cyclone DDS sends keys to each participant that joins, by one writer, and keeps all of them until every participant
// has acknowledged as many. But a participant acknowledges only what was sent to itself, and that is nothing after its
// own keys. So some 6 KB for each client that came and went would stay in every process for ever. A new reader that
// matches a writer of each peer makes both sides send keys again; what is older is then acknowledged, and dropped.
#pragma once

#include <dds/dds.h>

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <thread>

#include "services/wire/dds/entity.hpp"

namespace lockstep {

class SentKeys {
public:
    /// Of a participant with security. The handles outlive it.
    SentKeys(dds_entity_t participant, dds_entity_t subscriber);

private:
    void serve(const std::stop_token& stop);
    std::size_t departures();
    void exchange_again(const std::stop_token& stop);
    /// False: it must stop.
    bool sleep(const std::stop_token& stop, std::chrono::seconds time);

    dds_entity_t subscriber_;
    Entity axes_;  // topics that every process of a machine may read, and every service writes one of
    Entity coordinators_;
    Entity participants_;  // participants that join and leave
    std::mutex mutex_;
    std::condition_variable_any woken_;
    std::jthread thread_;  // ends first
};

}  // namespace lockstep
