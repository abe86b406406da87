#include "services/wire/dds/sent_keys.hpp"

#include <array>
#include <chrono>

#include "services/runtime/real_time.hpp"
#include "services/runtime/sleep.hpp"
#include "services/wire/dds/topics.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kDepartures = 16;  // after this many departures keys are exchanged again
constexpr auto kPeriod = 1s;             // between two checks for departures
constexpr auto kExchange = 2s;           // many times the duration of the exchange

Entity topic(dds_entity_t participant, const TopicSpec& spec) {
    return Entity(dds_create_topic(participant, spec.type, spec.name, nullptr, nullptr));
}

}  // namespace

SentKeys::SentKeys(dds_entity_t participant, dds_entity_t subscriber)
    : subscriber_(subscriber),
      axes_(topic(participant, Topic<AxisState>::kSpec)),
      coordinators_(topic(participant, Topic<MachineState>::kSpec)),
      participants_(dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, nullptr)),
      thread_([this](const std::stop_token& stop) { serve(stop); }) {}

void SentKeys::serve(const std::stop_token& stop) {
    leave_real_time();
    std::size_t departed = 0;
    while (sleep_unless(stop, kPeriod)) {
        departed += departures();
        if (departed < kDepartures) { continue; }
        departed = 0;
        exchange_again(stop);
    }
}

/// Returns the number of participants that left since the last call.
std::size_t SentKeys::departures() {
    std::size_t count = 0;
    std::array<void*, 1> sample{};
    dds_sample_info_t info{};
    while (dds_take(participants_.handle(), sample.data(), &info, 1, 1) == 1) {
        count += info.instance_state == DDS_IST_ALIVE ? 0 : 1;
        (void)dds_return_loan(participants_.handle(), sample.data(), 1);
    }
    return count;
}

void SentKeys::exchange_again(const std::stop_token& stop) {
    const Entity from_axes(dds_create_reader(subscriber_, axes_.handle(), nullptr, nullptr));
    const Entity from_coordinators(dds_create_reader(subscriber_, coordinators_.handle(), nullptr, nullptr));
    (void)sleep_unless(stop, kExchange);
}

}  // namespace lockstep
