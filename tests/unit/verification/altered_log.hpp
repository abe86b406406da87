// A log's events in memory: changed, left out, cut short, and written again.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "services/wire/lcm/lcm_decode.hpp"
#include "services/wire/lcm/lcm_log.hpp"

namespace lockstep::test {

class AlteredLog {
public:
    struct Event {
        std::string channel;
        std::int64_t utime = 0;
        std::vector<std::uint8_t> data;
    };

    explicit AlteredLog(const std::filesystem::path& log) {
        auto reader = LogReader::open(log).value();
        while (auto event = reader.next().value()) {
            events_.push_back({std::string(event->channel), event->utime, {event->data.begin(), event->data.end()}});
        }
    }

    /// Changes the messages of a channel for which `change` returns true. Returns their number.
    template <typename Message>
    int change(std::string_view suffix, const std::function<bool(Message&)>& change) {
        int changed = 0;
        for (Event& event : events_) {
            if (!event.channel.ends_with(suffix)) { continue; }
            auto message = decode_lcm<Message>(event.data).value();
            if (!change(message)) { continue; }
            event.data.resize(static_cast<std::size_t>(message.getEncodedSize()));
            message.encode(event.data.data(), 0, static_cast<int>(event.data.size()));
            ++changed;
        }
        return changed;
    }

    /// Leaves out the messages of a channel for which `unwanted` returns true. Returns their number.
    template <typename Message>
    std::size_t leave_out(std::string_view suffix, const std::function<bool(const Message&)>& unwanted) {
        return std::erase_if(events_, [&](const Event& event) {
            return event.channel.ends_with(suffix) && unwanted(decode_lcm<Message>(event.data).value());
        });
    }

    void cut_to(std::size_t events) { events_.resize(events); }
    std::vector<Event>& events() { return events_; }

    std::filesystem::path write(const std::filesystem::path& path) const {
        auto writer = LogWriter::open(path).value();
        for (const Event& event : events_) { (void)writer.write(event.channel, event.utime, event.data); }
        (void)writer.flush();
        return path;
    }

private:
    std::vector<Event> events_;
};

}  // namespace lockstep::test
