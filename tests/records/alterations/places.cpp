#include "tests/records/alterations/places.hpp"

#include "tests/records/record_times.hpp"

namespace lockstep::records {
namespace {

std::optional<std::size_t> middle(const std::vector<std::size_t>& places) {
    return places.empty() ? std::nullopt : std::optional(places[places.size() / 2]);
}

/// The numbers from `from` on of a process rise by one.
template <typename Type>
void renumber(Record& record, const Type& from) {
    change_each<Type>(record, [&](Type& message) {
        const bool is_later =
            message.axis == from.axis && message.incarnation == from.incarnation && message.sequence >= from.sequence;
        message.sequence += is_later ? 1 : 0;
        return is_later;
    });
}

void count_one_more(Record& record, std::int64_t incarnation, std::int64_t utime,
                    std::int64_t record_mark2_t::*counted) {
    change_each<record_mark2_t>(record, [&](record_mark2_t& mark) {
        const bool is_later = mark.incarnation == incarnation && mark.utime >= utime;
        mark.*counted += is_later ? 1 : 0;
        return is_later;
    });
}

template <typename Type>
void insert(Record& record, std::size_t behind, Type message, std::int64_t record_mark2_t::*counted) {
    const std::int64_t utime = record[behind].utime;
    ++message.sequence;
    renumber(record, message);
    count_one_more(record, message.incarnation, utime, counted);
    record.insert(record.begin() + static_cast<std::ptrdiff_t>(behind) + 1,
                  {record[behind].channel, utime, encoded(message)});
}

}  // namespace

std::string name_of_motion(const std::string& motion) {
    return motion == "home" ? "in_homing" : motion == "run" ? "in_a_job" : "in_an_own_move";
}

std::optional<std::size_t> steps_in(const Record& record, const std::string& motion) {
    const RecordedSpan span = first_span(record, motion);
    return middle(places_of<step_batch_t>(record, [&](const step_batch_t& steps) {
        return steps.axis == "X" && steps.count >= 5 && span.contains(steps.utime);
    }));
}

std::optional<std::size_t> run_in(const Record& record, const std::string& motion) {
    const RecordedSpan span = first_span(record, motion);
    return middle(places_of<run_t>(record, [&](const run_t& run) {
        return run.axis == "X" && run.tail == 0 && run.pieces > 0 && run.velocity[0] != 0 && span.contains(run.utime) &&
               run.stop_count != run.start_count;
    }));
}

bool erase_at(Record& record, std::optional<std::size_t> place) {
    if (place) { record.erase(record.begin() + static_cast<std::ptrdiff_t>(*place)); }
    return place.has_value();
}

bool repeat_at(Record& record, std::optional<std::size_t> place) {
    if (place) { record.insert(record.begin() + static_cast<std::ptrdiff_t>(*place), Message(record[*place])); }
    return place.has_value();
}

void insert_steps(Record& record, std::size_t behind, step_batch_t message) {
    insert(record, behind, std::move(message), &record_mark2_t::steps);
}

void insert_run(Record& record, std::size_t behind, run_t message) {
    insert(record, behind, std::move(message), &record_mark2_t::runs);
}

}  // namespace lockstep::records
