// Messages of jobs that are lost or are not those the coordinator published.
#include "tests/records/alterations/alterations.hpp"
#include "tests/records/alterations/places.hpp"

namespace lockstep::records {
namespace {

constexpr Expected kJobLost{kSaysUnknown, kSaysDoubtful | kSaysUnknown, kSaysUnknown, kReplayedAlike};
constexpr Expected kJobOtherPlan{kSaysBad, kSaysDoubtful | kSaysUnknown | kSaysBad, kSaysGood | kSaysUnknown | kSaysBad,
                                 kReplayedAlike};
constexpr Expected kJobOtherLabel{kSaysBad | kSaysUnknown, kSaysDoubtful | kSaysUnknown | kSaysBad,
                                  kSaysGood | kSaysUnknown | kSaysBad, kReplayedAlike};

std::optional<std::size_t> job_message(const Record& record, const std::string& kind, const std::string& event) {
    const auto places =
        places_of<job_t>(record, [&](const job_t& job) { return job.kind == kind && job.event == event; });
    return places.empty() ? std::nullopt : std::optional(places.front());
}

struct JobChange {
    const char* name;
    const char* event;
    void (*change)(job_t&);
    Expected expected;
    Needs needs;
};

const JobChange kJobChanges[]{
    {"start_tick_later", "epoch", [](job_t& job) { job.start_tick += 100; }, kJobOtherPlan, {}},
    {"epoch_one_more", "epoch", [](job_t& job) { ++job.epoch; }, kJobOtherLabel, {}},
    {"resume_block_one_more", "epoch", [](job_t& job) { ++job.resume_block; }, kJobOtherPlan, {}},
    {"resume_place_a_millimetre_on", "epoch", [](job_t& job) { ++job.resume_high; }, kJobOtherPlan, {}},
    {"feed_fifty_percent", "epoch", [](job_t& job) { job.feed_percent = 50; }, kJobOtherPlan, {}},
    {"start_count_one_more", "begun", [](job_t& job) { ++job.start_count[0]; }, kJobOtherLabel, {}},
    {"number_one_more", "begun", [](job_t& job) { job.job += 100; }, kJobOtherLabel, {}},
    {"event_unknown", "epoch", [](job_t& job) { job.event = "nothing"; }, kJobOtherLabel, {}},
    {"override_behind_another_frame",
     "override",
     [](job_t& job) { job.behind_frame += 2; },
     kJobOtherPlan,
     {.overrides = true}},
    {"override_of_another_feed",
     "override",
     [](job_t& job) { job.feed_percent = 190; },
     kJobOtherPlan,
     {.overrides = true}},
    {"outcome_failed",
     "ended",
     [](job_t& job) { job.outcome = "failed"; },
     {kSaysGood | kSaysBad | kSaysUnknown, kSaysDoubtful | kSaysBad, kSaysGood, kReplayedAlike},
     {}},
    {"outcome_empty",
     "ended",
     [](job_t& job) { job.outcome = ""; },
     {kSaysGood | kSaysBad | kSaysUnknown, kSaysDoubtful | kSaysUnknown | kSaysBad, kSaysGood, kReplayedAlike},
     {}},
};

void add_lost_message(const std::string& kind, const std::string& event, const Expected& expected, Needs needs,
                      std::vector<Alteration>& all) {
    all.push_back({"job_" + event + "_dropped_of_" + (kind == "run" ? "a_job" : "homing"),
                   [=](Record& r) { return erase_at(r, job_message(r, kind, event)); }, expected, Altered{}, needs});
}

}  // namespace

std::vector<Alteration> job_alterations() {
    std::vector<Alteration> all;
    for (const JobChange& change : kJobChanges) {
        all.push_back(
            {"job_" + std::string(change.name),
             [=](Record& r) { return change_at<job_t>(r, job_message(r, "run", change.event), change.change); },
             change.expected, Altered{}, change.needs});
    }
    for (const char* event : {"begun", "epoch", "ended"}) { add_lost_message("run", event, kJobLost, {}, all); }
    add_lost_message("run", "override", kJobLost, {.overrides = true}, all);
    // Homing has no plan: its steps are compared with its runs all the same.
    const Expected homing{kSaysGood | kSaysUnknown, kSaysDoubtful | kSaysUnknown, kSaysGood | kSaysUnknown,
                          kReplayedAlike};
    for (const char* event : {"begun", "ended"}) { add_lost_message("home", event, homing, {}, all); }
    all.push_back({"job_begun_twice",
                   [](Record& r) { return repeat_at(r, job_message(r, "run", "begun")); },
                   {kSaysGood, kSaysGood, kSaysGood, kReplayedAlike},
                   Altered{.motion = false, .must_be_mentioned = true}});
    all.push_back({"job_messages_all_dropped",
                   [](Record& r) { return leave_out<job_t>(r, [](const job_t&) { return true; }) > 0; },
                   {kSaysUnknown, kSaysUnknown, kSaysUnknown, kReplayedAlike}});
    return all;
}

}  // namespace lockstep::records
