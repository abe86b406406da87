#include "clients/web/state/event_stream.hpp"

#include <algorithm>
#include <utility>

namespace lockstep::web {

EventStream::EventStream(const EventLog& log, EventLog::Place place, const std::string& name, Clock clock,
                         std::function<void()> ended)
    : log_(log),
      place_(place),
      clock_(clock),
      ended_(std::move(ended)),
      text_("retry: 1000\nevent: stream\ndata: {\"stream\":\"" + name + "\"}\n\n"),
      last_(clock()) {}

std::optional<std::size_t> EventStream::read(std::span<char> into) {
    if (sent_ == text_.size()) {
        text_.clear();
        sent_ = 0;
        const auto now = clock_();
        if (!log_.read(place_, text_) && now - last_ >= kKeepAlive) { text_ = ":\n\n"; }
        if (!text_.empty()) { last_ = now; }
    }
    const std::size_t bytes = std::min(into.size(), text_.size() - sent_);
    std::copy_n(text_.data() + sent_, bytes, into.data());
    sent_ += bytes;
    return bytes;
}

void EventStream::end() {
    if (const auto ended = std::exchange(ended_, {})) { ended(); }
}

}  // namespace lockstep::web
