// One viewer's stream of the event log.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "clients/web/http/message.hpp"
#include "clients/web/state/event_log.hpp"

namespace lockstep::web {

class EventStream : public ByteStream {
public:
    static constexpr std::chrono::seconds kKeepAlive{5};
    using Clock = std::chrono::nanoseconds (*)();

    /// `name` identifies the stream: a jog that names it ends with it. Calls `ended` once, at the stream's end.
    EventStream(const EventLog& log, EventLog::Place place, const std::string& name, Clock clock,
                std::function<void()> ended);

    std::optional<std::size_t> read(std::span<char> into) override;
    bool is_behind() const override { return log_.is_behind(place_); }
    void end() override;

private:
    const EventLog& log_;
    EventLog::Place place_;
    Clock clock_;
    std::function<void()> ended_;
    std::string text_;  // the part from sent_ on was not read yet
    std::size_t sent_ = 0;
    std::chrono::nanoseconds last_{};  // when it last had bytes to send
};

}  // namespace lockstep::web
