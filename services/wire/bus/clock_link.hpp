// The two ends of a clock exchange over DDS. Each has a thread that sleeps until a message comes, so that what is
// measured is the network's delay and not how often a loop looks.
#pragma once

#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

#include "core/clock/clock_asker.hpp"
#include "services/wire/bus/bus.hpp"

namespace lockstep {

using ReadClock = std::function<Tick()>;

/// The coordinator's: answers at once, whatever its loop is doing. The participant outlives it.
class ClockServer {
public:
    ClockServer(Participant& participant, ReadClock machine_time);

private:
    void serve(const std::stop_token& stop);

    ReadClock machine_time_;
    Arrivals arrivals_;
    Writer<ClockReply> replies_;
    Reader<ClockRequest> requests_;
    std::jthread thread_;
};

/// An axis's: asks again and again, and keeps what it learns until it is taken. The participant outlives it.
class ClockClient {
public:
    ClockClient(Participant& participant, ClockAsker asker, ReadClock own_clock);

    /// The exchanges since the last call.
    std::vector<ClockExchange> take();

private:
    void run(const std::stop_token& stop);

    ClockAsker asker_;
    ReadClock own_clock_;
    std::mutex mutex_;
    std::vector<ClockExchange> exchanges_;
    Arrivals arrivals_;
    Writer<ClockRequest> requests_;
    Reader<ClockReply> replies_;
    std::jthread thread_;
};

}  // namespace lockstep
