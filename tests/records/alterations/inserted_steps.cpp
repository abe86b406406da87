// Further messages of steps with correct numbers of their own: steps that the machine has not made.
#include "tests/records/alterations/alterations.hpp"
#include "tests/records/alterations/places.hpp"

namespace lockstep::records {
namespace {

using Steps = step_batch_t;

/// The numbers are right, but the ticks or positions do not follow. A merge cannot call that complete.
constexpr Expected kInserted{kSaysBad, kSaysBad | kSaysUnknown, kSaysUnknown | kSaysBad, kSaysBad};

struct InsertedChange {
    const char* name;
    void (*change)(Steps&);
};

void make_single(Steps& steps) {
    steps.position_before = 99'999;
    steps.count = 1;
    steps.delta_ticks.resize(1);
    steps.direction.resize(1);
}

const InsertedChange kInsertedInsertions[]{
    {"same_steps_again", [](Steps&) {}},
    {"same_steps_reversed",
     [](Steps& steps) {
         for (auto& direction : steps.direction) { direction = static_cast<std::int8_t>(-direction); }
     }},
    {"same_steps_fifty_ticks_later", [](Steps& steps) { steps.first_tick += 50; }},
    {"same_steps_half_a_second_earlier", [](Steps& steps) { steps.first_tick -= 500'000; }},
    {"one_step_at_a_far_position", make_single},
    {"one_step_a_minute_earlier",
     [](Steps& steps) {
         make_single(steps);
         steps.first_tick -= 60'000'000;
     }},
};

}  // namespace

std::vector<Alteration> inserted_steps() {
    std::vector<Alteration> all;
    for (const std::string motion : kMotions) {
        for (const InsertedChange& change : kInsertedInsertions) {
            const auto alter = [=](Record& record) {
                const auto place = steps_in(record, motion);
                if (!place) { return false; }
                Steps more = *decoded<Steps>(record[*place]);
                change.change(more);
                insert_steps(record, *place, std::move(more));
                return true;
            };
            all.push_back({"inserted_" + std::string(change.name) + "_" + name_of_motion(motion), alter, kInserted,
                           Altered{.motion = true, .must_be_mentioned = true}, Needs{.all_motions = motion != "run"}});
        }
    }
    return all;
}

}  // namespace lockstep::records
