// The same messages in another order, as networks and loggers deliver them. They say the same.
#include <algorithm>
#include <random>

#include "tests/records/alterations/alterations.hpp"
#include "tests/records/alterations/places.hpp"

namespace lockstep::records {
namespace {

bool shuffle_within(Record& record, std::size_t length) {
    std::mt19937_64 random(5);
    for (std::size_t at = 0; at + length <= record.size(); at += length) {
        for (std::size_t i = length - 1; i > 0; --i) { std::swap(record[at + i], record[at + random() % (i + 1)]); }
    }
    return true;
}

/// The messages of the coordinator, or those of axis X, come later into the log than those of other processes. Each
/// process's messages keep their order.
bool delay(Record& record, bool of_coordinator, std::int64_t us) {
    std::vector<std::pair<std::int64_t, Message>> timed;
    std::int64_t newest = 0;
    for (Message& message : record) {
        newest = std::max(newest, message.utime);
        const bool is_of_x = message.channel.find("_X_") != std::string::npos;
        const bool is_late = of_coordinator ? !is_of_x && message.channel.find("_Y_") == std::string::npos : is_of_x;
        timed.emplace_back(newest + (is_late ? us : 0), std::move(message));
    }
    std::ranges::stable_sort(timed, {}, [](const auto& entry) { return entry.first; });
    record.clear();
    for (auto& [utime, message] : timed) { record.push_back(std::move(message)); }
    return true;
}

Alteration delayed(const std::string& name, bool of_coordinator, std::int64_t us, const Expected& expected) {
    return {name, [=](Record& r) { return delay(r, of_coordinator, us); }, expected, kNoMotion};
}

}  // namespace

std::vector<Alteration> order_alterations() {
    // Reversed, all is there, but no tool that reads the log once can put it in order.
    const Expected reversed{kSaysUnknown | kSaysBad | kSaysRefused, kSaysDoubtful | kSaysUnknown | kSaysBad,
                            kSaysGood | kSaysUnknown | kSaysBad, kSaysUnknown | kSaysBad | kSaysRefused};
    // A tool may give up messages that come a second late, but it then knows that it lacks them.
    const Expected too_late{kSaysGood | kSaysUnknown, kSaysGood | kSaysDoubtful | kSaysUnknown, kSaysGood,
                            kSaysGood | kSaysUnknown};
    return {
        {"shuffled_within_eight", [](Record& r) { return shuffle_within(r, 8); }, kValid, kNoMotion},
        {"shuffled_within_three", [](Record& r) { return shuffle_within(r, 3); }, kValid, kNoMotion},
        {"sorted_by_time",
         [](Record& r) {
             std::ranges::stable_sort(r, {}, &Message::utime);
             return true;
         },
         kValid, kNoMotion},
        delayed("axis_x_a_tenth_of_a_second_late", false, 100'000, kValid),
        delayed("coordinator_a_tenth_of_a_second_late", true, 100'000, kValid),
        delayed("axis_x_a_second_late", false, 1'000'000, too_late),
        delayed("coordinator_a_second_late", true, 1'000'000, too_late),
        {"every_message_twice",
         [](Record& r) {
             Record twice;
             for (const Message& message : r) { twice.insert(twice.end(), 2, message); }
             r = std::move(twice);
             return true;
         },
         kValid, Altered{.motion = false, .must_be_mentioned = true}},
        {"reversed",
         [](Record& r) {
             std::ranges::reverse(r);
             return true;
         },
         reversed, kNoMotion},
    };
}

}  // namespace lockstep::records
