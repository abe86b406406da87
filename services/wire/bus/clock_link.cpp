#include "services/wire/bus/clock_link.hpp"

#include <chrono>
#include <utility>

namespace lockstep {
namespace {

constexpr std::chrono::milliseconds kServerNap{100};  // then it checks whether to stop
constexpr std::chrono::milliseconds kClientNap{10};   // then it also checks whether to ask again

}  // namespace

ClockServer::ClockServer(Participant& participant, ReadClock machine_time)
    : machine_time_(std::move(machine_time)),
      replies_(participant),
      requests_(participant, [this] { arrivals_.notify(); }),
      thread_([this](const std::stop_token& stop) { serve(stop); }) {}

void ClockServer::serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        if (!arrivals_.wait_for(kServerNap)) { continue; }
        requests_.take([&](ClockRequest&& request) {
            const Tick received = machine_time_();  // a request may come behind the one that woke this thread
            (void)replies_.write({request, received, machine_time_()});
        });
    }
}

ClockClient::ClockClient(Participant& participant, ClockAsker asker, ReadClock own_clock)
    : asker_(std::move(asker)),
      own_clock_(std::move(own_clock)),
      requests_(participant),
      replies_(participant, [this] { arrivals_.notify(); }),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void ClockClient::run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        if (const auto request = asker_.ask(own_clock_())) { (void)requests_.write(*request); }
        if (!arrivals_.wait_for(kClientNap)) { continue; }
        replies_.take([&](ClockReply&& reply) {  // its time is read when it is here for certain
            if (const auto exchange = asker_.receive(reply, own_clock_())) { new_.push_back(*exchange); }
        });
        const std::scoped_lock lock(mutex_);
        exchanges_.insert(exchanges_.end(), new_.begin(), new_.end());
        new_.clear();
    }
}

void ClockClient::take(std::vector<ClockExchange>& exchanges) {
    exchanges.clear();
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock) { std::swap(exchanges, exchanges_); }
}

}  // namespace lockstep
