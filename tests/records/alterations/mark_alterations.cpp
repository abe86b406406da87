// Marks, by which processes say how many messages they have published.
#include "tests/records/alterations/alterations.hpp"
#include "tests/records/alterations/places.hpp"

namespace lockstep::records {
namespace {

/// Without marks nobody knows whether the end is there; what is there is as planned.
constexpr Expected kOpen{kSaysGood, kSaysGood, kSaysGood, kSaysGood};
constexpr Expected kEndMissing{kSaysUnknown, kSaysDoubtful | kSaysUnknown, kSaysUnknown, kSaysGood | kSaysUnknown};

bool raise_last(Record& record, std::int64_t record_mark2_t::*counted, const std::string& process) {
    const auto places = places_of<record_mark2_t>(
        record, [&](const record_mark2_t& mark) { return mark.process == process && mark.witness == process; });
    if (places.empty()) { return false; }
    return change_at<record_mark2_t>(record, places.back(), [&](record_mark2_t& mark) { mark.*counted += 3; });
}

/// As the versions before record_mark2_t wrote it, without a count of changes of inputs and outputs.
record_mark_t earlier(const record_mark2_t& mark) {
    record_mark_t message{};
    message.utime = mark.utime;
    message.machine = mark.machine;
    message.witness = mark.witness;
    message.process = mark.process;
    message.incarnation = mark.incarnation;
    message.ended = mark.ended;
    message.steps = mark.steps;
    message.runs = mark.runs;
    message.positions = mark.positions;
    message.figures = mark.figures;
    message.job_events = mark.job_events;
    message.program_parts = mark.program_parts;
    return message;
}

bool make_earlier(Record& record) {
    for (Message& message : record) {
        if (const auto mark = decoded<record_mark2_t>(message)) { message.data = encoded(earlier(*mark)); }
    }
    return true;
}

}  // namespace

std::vector<Alteration> mark_alterations() {
    std::vector<Alteration> all;
    const auto drop = [&](std::string name, std::function<bool(const record_mark2_t&)> unwanted) {
        all.push_back(
            {std::move(name), [=](Record& r) { return leave_out<record_mark2_t>(r, unwanted) > 0; }, kOpen, kNoMotion});
    };
    drop("marks_all_dropped", [](const record_mark2_t&) { return true; });
    drop("marks_of_x_dropped", [](const record_mark2_t& mark) { return mark.process == "X"; });
    drop("marks_of_the_end_dropped", [](const record_mark2_t& mark) { return mark.ended != 0; });
    all.push_back({"marks_of_an_earlier_version", make_earlier, kOpen, kNoMotion});
    const auto raise = [&](std::string name, std::int64_t record_mark2_t::*counted, std::string process) {
        all.push_back({std::move(name), [=](Record& r) { return raise_last(r, counted, process); }, kEndMissing});
    };
    raise("mark_counts_more_steps", &record_mark2_t::steps, "X");
    raise("mark_counts_more_runs", &record_mark2_t::runs, "Y");
    raise("mark_counts_more_changes", &record_mark2_t::channel_events, "X");
    raise("mark_counts_more_job_messages", &record_mark2_t::job_events, "");
    all.push_back({"mark_of_an_unknown_axis",
                   [](Record& r) {
                       const auto place = places_of<record_mark2_t>(r, [](const auto& m) { return m.process == "X"; });
                       return repeat_at(r, place.back()) &&
                              change_at<record_mark2_t>(r, place.back(), [](record_mark2_t& mark) {
                                  mark.process = "Q";
                                  mark.incarnation += 77;
                              });
                   },
                   kEndMissing});
    all.push_back(
        {"mark_twice",
         [](Record& r) { return repeat_at(r, places_of<record_mark2_t>(r, [](const auto&) { return true; }).front()); },
         kValid, kNoMotion});
    return all;
}

}  // namespace lockstep::records
