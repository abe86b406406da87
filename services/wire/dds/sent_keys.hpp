// Makes DDS Security drop the keys that it sent to participants that have left.
//
// Cyclone DDS sends keys to each participant that joins, with one writer, and keeps each key until every participant
// has acknowledged this or a later one. But a participant acknowledges only keys sent to itself, and it receives none
// after its own. So about 6 KB for each client that came and left would stay in every process forever. A new reader
// that matches a writer of each peer makes both sides send keys again. Their acknowledgement covers the older keys,
// which DDS then drops.
#pragma once

#include <dds/dds.h>

#include <cstddef>
#include <thread>

#include "services/wire/dds/entity.hpp"

namespace lockstep {

class SentKeys {
public:
    /// For a participant with security. The handles must outlive this object.
    SentKeys(dds_entity_t participant, dds_entity_t subscriber);

private:
    void serve(const std::stop_token& stop);
    std::size_t departures();
    void exchange_again(const std::stop_token& stop);

    dds_entity_t subscriber_;
    Entity axes_;  // topics that every process may read; every service writes one of the two
    Entity coordinators_;
    Entity participants_;  // reports participants that join and leave
    std::jthread thread_;  // declared last, so that it ends first
};

}  // namespace lockstep
