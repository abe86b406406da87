// The two ends of a clock exchange over DDS. Each end has a thread that sleeps until a message comes, so that the
// exchange measures the network's delay and not the loop's period.
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

/// The coordinator's end. It answers at once, independent of the loop. The participant must outlive it.
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

/// An axis's end. It asks repeatedly, and keeps the exchanges until take() is called. The participant must outlive it.
class ClockClient {
public:
    ClockClient(Participant& participant, ClockAsker asker, ReadClock own_clock);

    /// Replaces `exchanges` by those since the last call. Never waits: exchanges that the thread adds at this moment
    /// come with the next call.
    void take(std::vector<ClockExchange>& exchanges);

private:
    void run(const std::stop_token& stop);

    ClockAsker asker_;
    ReadClock own_clock_;
    std::mutex mutex_;  // guards exchanges_; the thread holds it only while it adds to them
    std::vector<ClockExchange> exchanges_;
    std::vector<ClockExchange> new_;  // used by the thread
    Arrivals arrivals_;
    Writer<ClockRequest> requests_;
    Reader<ClockReply> replies_;
    std::jthread thread_;
};

}  // namespace lockstep
