#include "clients/web/state/event_log.hpp"

#include <fmt/format.h>

#include "clients/web/http/json_text.hpp"
#include "clients/web/state/merge_patch.hpp"
#include "core/parse_number.hpp"

namespace lockstep::web {

std::string EventLog::id_text(std::uint64_t number) const { return fmt::format("id: {}-{}\n", run_, number); }

void EventLog::publish(const nlohmann::json& state) {
    const std::lock_guard lock(mutex_);
    if (!state_.is_null()) {
        const nlohmann::json patch = merge_patch(state_, state);
        if (patch.empty()) { return; }
        deltas_.push_back("event: delta\n" + id_text(newest_ + 1) + "data: " + dumped(patch) + "\n\n");
        if (deltas_.size() > kKept) { deltas_.pop_front(); }
    }
    ++newest_;
    state_ = state;
    whole_.reset();
}

EventLog::Place EventLog::place_after(std::string_view id) const {
    const std::lock_guard lock(mutex_);
    const std::string begin = run_ + "-";
    if (!id.starts_with(begin)) { return std::nullopt; }
    const auto number = parse_number<std::uint64_t>(id.substr(begin.size()));
    const bool is_kept = number && *number <= newest_ && newest_ - *number <= deltas_.size();
    return is_kept ? Place(*number + 1) : std::nullopt;
}

bool EventLog::is_behind(const Place& place) const {
    const std::lock_guard lock(mutex_);
    return place && *place <= newest_ && newest_ - *place >= deltas_.size();
}

bool EventLog::read(Place& place, std::string& text) const {
    const std::lock_guard lock(mutex_);
    if (state_.is_null() || (place && (*place > newest_ || newest_ - *place >= deltas_.size()))) { return false; }
    if (!place) {
        if (!whole_) {
            whole_ = std::make_shared<const std::string>("event: state\n" + id_text(newest_) +
                                                         "data: " + dumped(state_) + "\n\n");
        }
        text += *whole_;
        place = newest_ + 1;
        return true;
    }
    text += deltas_[deltas_.size() - 1 - static_cast<std::size_t>(newest_ - *place)];
    ++*place;
    return true;
}

}  // namespace lockstep::web
