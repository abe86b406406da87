// Marks, by which processes say how many messages they have published.
#include "tests/records/alterations/alterations.hpp"
#include "tests/records/alterations/places.hpp"

namespace lockstep::records {
namespace {

/// Without marks nobody knows whether the end is there; what is there is as planned.
constexpr Expected kOpen{kSaysGood, kSaysGood, kSaysGood, kSaysGood};
constexpr Expected kEndMissing{kSaysUnknown, kSaysDoubtful | kSaysUnknown, kSaysUnknown, kSaysGood | kSaysUnknown};

bool raise_last(Record& record, std::int64_t record_mark_t::*counted, const std::string& process) {
    const auto places = places_of<record_mark_t>(
        record, [&](const record_mark_t& mark) { return mark.process == process && mark.witness == process; });
    if (places.empty()) { return false; }
    return change_at<record_mark_t>(record, places.back(), [&](record_mark_t& mark) { mark.*counted += 3; });
}

}  // namespace

std::vector<Alteration> mark_alterations() {
    std::vector<Alteration> all;
    const auto drop = [&](std::string name, std::function<bool(const record_mark_t&)> unwanted) {
        all.push_back(
            {std::move(name), [=](Record& r) { return leave_out<record_mark_t>(r, unwanted) > 0; }, kOpen, kNoMotion});
    };
    drop("marks_all_dropped", [](const record_mark_t&) { return true; });
    drop("marks_of_x_dropped", [](const record_mark_t& mark) { return mark.process == "X"; });
    drop("marks_of_the_end_dropped", [](const record_mark_t& mark) { return mark.ended != 0; });
    const auto raise = [&](std::string name, std::int64_t record_mark_t::*counted, std::string process) {
        all.push_back({std::move(name), [=](Record& r) { return raise_last(r, counted, process); }, kEndMissing});
    };
    raise("mark_counts_more_steps", &record_mark_t::steps, "X");
    raise("mark_counts_more_runs", &record_mark_t::runs, "Y");
    raise("mark_counts_more_job_messages", &record_mark_t::job_events, "");
    all.push_back({"mark_of_an_unknown_axis",
                   [](Record& r) {
                       const auto place = places_of<record_mark_t>(r, [](const auto& m) { return m.process == "X"; });
                       return repeat_at(r, place.back()) &&
                              change_at<record_mark_t>(r, place.back(), [](record_mark_t& mark) {
                                  mark.process = "Q";
                                  mark.incarnation += 77;
                              });
                   },
                   kEndMissing});
    all.push_back(
        {"mark_twice",
         [](Record& r) { return repeat_at(r, places_of<record_mark_t>(r, [](const auto&) { return true; }).front()); },
         kValid, kNoMotion});
    return all;
}

}  // namespace lockstep::records
