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

}  // namespace

std::vector<Alteration> order_alterations() {
    // Reversed, all is there, but no tool that reads the log once can put it in order.
    const Expected reversed{kUnknown | kBad | kRefused, kDoubtful | kUnknown | kBad, kGood | kUnknown | kBad,
                            kUnknown | kBad | kRefused};
    return {
        {"shuffled_within_eight", [](Record& r) { return shuffle_within(r, 8); }, kValid, kNoMotion},
        {"shuffled_within_three", [](Record& r) { return shuffle_within(r, 3); }, kValid, kNoMotion},
        {"sorted_by_time",
         [](Record& r) {
             std::ranges::stable_sort(r, {}, &Message::utime);
             return true;
         },
         kValid, kNoMotion},
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
