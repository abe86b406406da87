// The machine's state as numbered events. Each event is the difference to the state before, and is made once for all
// viewers. A viewer is only a place in this log, without a queue.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace lockstep::web {

class EventLog {
public:
    static constexpr std::size_t kKept = 100;  // ten seconds of ten events

    /// `run` distinguishes the events of this process from those of others.
    explicit EventLog(std::string run) : run_(std::move(run)) {}

    /// Adds an event if the state has changed.
    void publish(const nlohmann::json& state);

    /// The next event that a viewer needs; nullopt if it needs the whole state.
    using Place = std::optional<std::uint64_t>;
    /// The place after the event with this id; nullopt if its successors are not kept any more.
    Place place_after(std::string_view id) const;
    /// Appends the next event to `text`. Returns false if there is none yet.
    bool read(Place& place, std::string& text) const;
    /// True if the next events are not kept any more.
    bool is_behind(const Place& place) const;

private:
    std::string id_text(std::uint64_t number) const;

    std::string run_;
    mutable std::mutex mutex_;
    nlohmann::json state_;                              // null: nothing was published yet
    mutable std::shared_ptr<const std::string> whole_;  // state_ as an event, made when it is first needed
    std::deque<std::string> deltas_;                    // the last ones; the newest has number newest_
    std::uint64_t newest_ = 0;
};

}  // namespace lockstep::web
