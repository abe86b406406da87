// Single steps and messages of steps that are not those the machine made.
#include "tests/records/alterations/alterations.hpp"
#include "tests/records/alterations/places.hpp"

namespace lockstep::records {
namespace {

using Steps = step_batch_t;

void remove_step(Steps& steps) {
    steps.delta_ticks[3] += steps.delta_ticks[2];
    steps.delta_ticks.erase(steps.delta_ticks.begin() + 2);
    steps.direction.erase(steps.direction.begin() + 2);
    --steps.count;
}

void add_step(Steps& steps) {
    const std::int32_t half = steps.delta_ticks[2] / 2;
    steps.delta_ticks[2] -= half;
    steps.delta_ticks.insert(steps.delta_ticks.begin() + 2, half);
    steps.direction.insert(steps.direction.begin() + 2, steps.direction[2]);
    ++steps.count;
}

void reverse_all(Steps& steps) {
    for (auto& direction : steps.direction) { direction = static_cast<std::int8_t>(-direction); }
}

struct StepChange {
    const char* name;
    void (*change)(Steps&);
    Expected expected;
};

/// Of counts, directions and positions: each tool that compares must notice. A merge compares the positions only.
constexpr Expected kStepOtherCounts{kSaysBad, kSaysBad, kSaysGood | kSaysUnknown | kSaysBad, kSaysBad};
constexpr Expected kStepOtherTicks{kSaysBad, kSaysDoubtful | kSaysBad, kSaysGood | kSaysUnknown | kSaysBad, kSaysBad};
/// The message does not join its neighbours: its steps may be right, but something is missing or wrong.
constexpr Expected kStepOtherPosition{kSaysBad, kSaysUnknown | kSaysBad, kSaysGood | kSaysUnknown | kSaysBad, kSaysBad};
/// A value that cannot be: the message is as good as lost.
constexpr Expected kStepImpossible{kSaysBad | kSaysUnknown, kSaysDoubtful | kSaysUnknown, kSaysUnknown | kSaysBad,
                                   kSaysBad | kSaysUnknown};
/// The time of the steps is not known well enough.
constexpr Expected kStepOtherClock{kSaysBad | kSaysUnknown, kSaysDoubtful | kSaysUnknown | kSaysBad,
                                   kSaysGood | kSaysUnknown | kSaysBad, kSaysGood | kSaysBad | kSaysUnknown};
constexpr Expected kStepMislabelled{kSaysBad | kSaysUnknown, kSaysDoubtful | kSaysUnknown | kSaysBad,
                                    kSaysUnknown | kSaysBad, kSaysBad | kSaysUnknown};

const StepChange kStepChanges[]{
    {"step_a_tick_later",
     [](Steps& steps) {
         ++steps.delta_ticks[2];
         --steps.delta_ticks[3];
     },
     kStepOtherTicks},
    {"step_twenty_ticks_earlier",
     [](Steps& steps) {
         steps.delta_ticks[2] -= 20;
         steps.delta_ticks[3] += 20;
     },
     kStepOtherTicks},
    {"step_reversed", [](Steps& steps) { steps.direction[2] = static_cast<std::int8_t>(-steps.direction[2]); },
     kStepOtherCounts},
    {"step_removed", remove_step, kStepOtherCounts},
    {"step_added", add_step, kStepOtherCounts},
    {"last_step_of_message_removed",
     [](Steps& steps) {
         steps.delta_ticks.pop_back();
         steps.direction.pop_back();
         --steps.count;
     },
     kStepOtherCounts},
    {"message_fifty_ticks_later", [](Steps& steps) { steps.first_tick += 50; }, kStepOtherTicks},
    {"message_half_a_second_earlier", [](Steps& steps) { steps.first_tick -= 500'000; }, kStepOtherCounts},
    {"message_reversed", reverse_all, kStepOtherCounts},
    {"position_before_one_more", [](Steps& steps) { ++steps.position_before; }, kStepOtherPosition},
    {"position_before_far_away", [](Steps& steps) { steps.position_before = 99'999; }, kStepOtherPosition},
    {"ahead_five_milliseconds_more",
     [](Steps& steps) {
         steps.ahead_first += 5000;
         steps.ahead_last += 5000;
     },
     kStepOtherClock},
    {"clock_error_of_ten_seconds", [](Steps& steps) { steps.clock_error = 10'000'000; }, kStepOtherClock},
    {"of_another_process", [](Steps& steps) { steps.incarnation += 1'000'000; }, kStepMislabelled},
    {"named_axis_y", [](Steps& steps) { steps.axis = "Y"; }, kStepMislabelled},
    {"named_axis_q", [](Steps& steps) { steps.axis = "Q"; }, kStepMislabelled},
    {"direction_of_two", [](Steps& steps) { steps.direction[1] = 2; }, kStepImpossible},
    {"ticks_that_fall", [](Steps& steps) { steps.delta_ticks[2] = -5; }, kStepImpossible},
    {"first_tick_beyond_all_limits", [](Steps& steps) { steps.first_tick = std::int64_t{1} << 60; }, kStepImpossible},
    {"number_far_ahead",
     [](Steps& steps) { steps.sequence += 5000; },
     {kSaysBad | kSaysUnknown, kSaysDoubtful | kSaysUnknown | kSaysBad, kSaysUnknown | kSaysBad,
      kSaysBad | kSaysUnknown}},
};

Alteration lost_steps(std::string name, std::function<bool(Record&)> alter) {
    return {std::move(name), std::move(alter), kLost};
}

/// Splits the message into two with numbers of their own.
bool split(Record& record, const std::string& motion) {
    const auto place = steps_in(record, motion);
    if (!place) { return false; }
    Steps first = *decoded<Steps>(record[*place]);
    Steps second = first;
    first.count = 2;
    first.delta_ticks.resize(2);
    first.direction.resize(2);
    second.position_before += first.direction[0] + first.direction[1];
    second.first_tick += first.delta_ticks[0] + first.delta_ticks[1] + second.delta_ticks[2];
    second.delta_ticks.erase(second.delta_ticks.begin(), second.delta_ticks.begin() + 2);
    second.delta_ticks[0] = 0;
    second.direction.erase(second.direction.begin(), second.direction.begin() + 2);
    second.count -= 2;
    second.ahead_first = first.ahead_last = first.ahead_first;
    record[*place].data = encoded(first);
    insert_steps(record, *place, second);
    return true;
}

bool move_back(Record& record, const std::string& motion) {
    const auto place = steps_in(record, motion);
    if (!place || *place + 300 >= record.size()) { return false; }
    Message late = record[*place];
    record.erase(record.begin() + static_cast<std::ptrdiff_t>(*place));
    record.push_back(std::move(late));
    return true;
}

void add_whole_messages(const std::string& motion, std::vector<Alteration>& all) {
    const std::string where = "_" + name_of_motion(motion);
    all.push_back(lost_steps("steps_dropped" + where, [=](Record& r) { return erase_at(r, steps_in(r, motion)); }));
    all.push_back({"steps_twice" + where, [=](Record& r) { return repeat_at(r, steps_in(r, motion)); }, kValid,
                   Altered{.motion = false, .must_be_mentioned = true}, Needs{.all_motions = motion != "run"}});
    all.push_back({"steps_split_in_two" + where, [=](Record& r) { return split(r, motion); }, kValid,
                   Altered{.motion = false}, Needs{.shared_clock = true, .all_motions = motion != "run"}});
    if (motion == "own-move") { return; }  // the log ends soon after it
    all.push_back({"steps_at_the_end_of_the_log" + where,
                   [=](Record& r) { return move_back(r, motion); },
                   {kSaysGood | kSaysUnknown, kSaysGood | kSaysDoubtful | kSaysUnknown,
                    kSaysGood | kSaysUnknown | kSaysBad, kSaysGood | kSaysUnknown},
                   Altered{},
                   Needs{.all_motions = motion != "run"}});
}

}  // namespace

std::vector<Alteration> step_alterations() {
    std::vector<Alteration> all;
    for (const std::string motion : kMotions) {
        for (const StepChange& change : kStepChanges) {
            all.push_back({change.name + ("_" + name_of_motion(motion)),
                           [=](Record& r) { return change_at<Steps>(r, steps_in(r, motion), change.change); },
                           change.expected, Altered{}, clock_needs(change.name, motion)});
        }
        add_whole_messages(motion, all);
    }
    all.push_back(lost_steps("every_37th_message_dropped", [](Record& record) {
        std::size_t n = 0;
        return std::erase_if(record, [&](const Message&) { return ++n % 37 == 0; }) > 0;
    }));
    all.push_back(lost_steps("steps_of_x_dropped_after_homing", [](Record& record) {
        return leave_out<Steps>(record, [n = 0](const Steps& s) mutable { return s.axis == "X" && ++n > 200; }) > 0;
    }));
    all.push_back(lost_steps("last_steps_dropped", [](Record& record) {
        const auto all_x = places_of<Steps>(record, [](const Steps& s) { return s.axis == "X"; });
        return erase_at(record, all_x.back());
    }));
    return all;
}

}  // namespace lockstep::records
