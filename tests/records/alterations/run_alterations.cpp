// Runs (frames, tails and own moves) that are not those the axis made.
#include "tests/records/alterations/alterations.hpp"
#include "tests/records/alterations/places.hpp"
#include "tests/records/record_times.hpp"

namespace lockstep::records {
namespace {

constexpr Verdicts kRunAnyMerge = kSaysGood | kSaysUnknown | kSaysBad;
/// The run does not make the recorded steps.
constexpr Expected kRunOtherMotion{kSaysBad, kSaysDoubtful | kSaysUnknown | kSaysBad, kRunAnyMerge,
                                   kSaysBad | kSaysUnknown};
/// The run makes the same steps, but is not the one of the plan.
constexpr Expected kRunOtherLabel{kSaysBad | kSaysUnknown, kSaysDoubtful | kSaysUnknown | kSaysBad, kRunAnyMerge,
                                  kSaysGood | kSaysBad | kSaysUnknown};
constexpr Expected kRunOtherClock{kSaysBad | kSaysUnknown, kSaysDoubtful | kSaysUnknown | kSaysBad, kRunAnyMerge,
                                  kSaysGood | kSaysBad | kSaysUnknown};

/// A replay does not know zeros.
constexpr Expected kOtherZero{kSaysBad, kSaysBad, kSaysGood, kSaysGood};

struct RunChange {
    const char* name;
    void (*change)(run_t&);
    Expected expected;
    bool only_in_jobs = false;  // the axis itself chooses it in its own moves
};

const RunChange kRunChanges[]{
    {"start_a_tick_later", [](run_t& run) { ++run.start_tick; }, kRunOtherMotion},
    {"start_a_second_earlier", [](run_t& run) { run.start_tick -= 1'000'000; }, kRunOtherMotion},
    {"start_count_one_more", [](run_t& run) { ++run.start_count; }, kRunOtherMotion},
    {"start_phase_half_a_step_more", [](run_t& run) { run.start_phase += std::int64_t{1} << 62; }, kRunOtherMotion},
    {"first_piece_longer", [](run_t& run) { run.ticks[0] += 100; }, kRunOtherMotion},
    {"first_piece_twice_as_fast", [](run_t& run) { run.velocity[0] *= 2; }, kRunOtherMotion},
    {"first_piece_backwards", [](run_t& run) { run.velocity[0] *= -1; }, kRunOtherMotion},
    {"first_piece_accelerates", [](run_t& run) { run.acceleration[0] += run.velocity[0] / run.ticks[0]; },
     kRunOtherMotion},
    {"stop_count_one_more", [](run_t& run) { ++run.stop_count; }, kRunOtherMotion},
    {"zero_count_one_more", [](run_t& run) { ++run.zero_count; }, kRunOtherLabel},
    {"cut_marked", [](run_t& run) { run.cut = run.cut == 0 ? 1 : 0; }, kRunOtherLabel},
    {"epoch_one_more", [](run_t& run) { ++run.epoch; }, kRunOtherLabel},
    {"frame_one_more", [](run_t& run) { ++run.frame; }, kRunOtherLabel, true},
    {"marked_as_tail", [](run_t& run) { run.tail = 1; }, kRunOtherLabel, true},
    {"ahead_five_milliseconds_more", [](run_t& run) { run.ahead += 5000; }, kRunOtherClock},
    {"clock_error_of_ten_seconds", [](run_t& run) { run.clock_error = 10'000'000; }, kRunOtherClock},
    {"of_another_process", [](run_t& run) { run.incarnation += 1'000'000; }, kRunOtherLabel},
    {"named_axis_y", [](run_t& run) { run.axis = "Y"; }, kRunOtherLabel},
    {"number_far_ahead", [](run_t& run) { run.sequence += 5000; }, kRunOtherLabel},
    {"without_pieces",
     [](run_t& run) {
         run.pieces = 0;
         run.ticks.clear();
         run.velocity.clear();
         run.acceleration.clear();
     },
     kRunOtherClock},
};

bool insert_changed(Record& record, const std::string& motion, const std::function<void(run_t&)>& change) {
    const auto place = run_in(record, motion);
    if (!place) { return false; }
    run_t more = *decoded<run_t>(record[*place]);
    change(more);
    insert_run(record, *place, std::move(more));
    return true;
}

void add_whole_runs(const std::string& motion, std::vector<Alteration>& all) {
    const std::string where = "_" + name_of_motion(motion);
    const Needs needs{.all_motions = motion != "run"};
    const Altered inserted{.motion = true, .must_be_mentioned = false};
    all.push_back(
        {"run_dropped" + where, [=](Record& r) { return erase_at(r, run_in(r, motion)); }, kLost, Altered{}, needs});
    all.push_back({"run_twice" + where, [=](Record& r) { return repeat_at(r, run_in(r, motion)); }, kValid,
                   Altered{.motion = false, .must_be_mentioned = true}, Needs{.all_motions = motion != "run"}});
    all.push_back({"inserted_same_run_again" + where,
                   [=](Record& r) { return insert_changed(r, motion, [](run_t&) {}); }, kRunOtherMotion, inserted,
                   needs});
    all.push_back(
        {"inserted_run_a_minute_earlier" + where,
         [=](Record& r) { return insert_changed(r, motion, [](run_t& run) { run.start_tick -= 60'000'000; }); },
         kRunOtherMotion, inserted, needs});
}

/// From the first own move on, axis X counts from a zero that is 20 steps away. Its runs, steps and positions agree.
bool move_zero_before_own_move(Record& record) {
    constexpr std::int64_t kSteps = 20;
    const std::int64_t from_us = first_span(record, "own-move").begin_us;
    const auto is_later = [=](const auto& message) { return message.axis == "X" && message.utime >= from_us; };
    change_each<step_batch_t>(record, [&](step_batch_t& steps) {
        steps.position_before -= is_later(steps) ? kSteps : 0;
        return is_later(steps);
    });
    change_each<axis_position_t>(record, [&](axis_position_t& position) {
        if (!is_later(position) || position.position_steps == 0) { return false; }
        const auto steps = static_cast<double>(position.position_steps);
        position.position_mm *= (steps - kSteps) / steps;
        position.position_steps -= kSteps;
        return true;
    });
    const auto move = [&](run_t& run) {
        if (!is_later(run)) { return false; }
        run.zero_count += kSteps;
        run.start_count -= kSteps;
        run.stop_count -= kSteps;
        return true;
    };
    return change_each<run_t>(record, move) > 0;
}

}  // namespace

std::vector<Alteration> run_alterations() {
    std::vector<Alteration> all;
    for (const std::string motion : kMotions) {
        for (const RunChange& change : kRunChanges) {
            if (change.only_in_jobs && motion != "run") { continue; }
            all.push_back({"run_" + std::string(change.name) + "_" + name_of_motion(motion),
                           [=](Record& r) { return change_at<run_t>(r, run_in(r, motion), change.change); },
                           change.expected, Altered{}, clock_needs(change.name, motion)});
        }
        add_whole_runs(motion, all);
    }
    all.push_back({"runs_of_y_dropped",
                   [](Record& r) { return leave_out<run_t>(r, [](const run_t& run) { return run.axis == "Y"; }) > 0; },
                   kLost});
    all.push_back({"last_run_dropped",
                   [](Record& r) {
                       return erase_at(r, places_of<run_t>(r, [](const run_t& run) { return run.axis == "X"; }).back());
                   },
                   kLost});
    all.push_back({"zero_moved_before_an_own_move", move_zero_before_own_move, kOtherZero, Altered{.motion = true},
                   Needs{.all_motions = true}});
    all.push_back({"run_retimed_otherwise",
                   [](Record& r) {
                       const auto retimed = places_of<run_t>(
                           r, [](const run_t& run) { return run.retimed > 0 && run.epoch != 0 && run.axis == "X"; });
                       if (retimed.empty()) { return false; }
                       return change_at<run_t>(r, retimed[retimed.size() / 2],
                                               [](run_t& run) { run.commanded_ticks[0] += 500; });
                   },
                   kRunOtherClock, Altered{}, Needs{.clocks = true}});
    return all;
}

}  // namespace lockstep::records
