// Stores consecutive messages in one reused piece of memory. It allocates nothing while they fit into what was
// reserved, or has grown.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace lockstep {

class MessageBlock {
public:
    struct Message {
        std::string_view channel;
        std::int64_t utime = 0;
        std::span<const std::uint8_t> data;
    };

    /// Room for messages of this many bytes, of at least kSmallMessage_bytes each on average.
    void reserve(std::size_t bytes) {
        entries_.reserve(bytes / kSmallMessage_bytes);
        bytes_.reserve(bytes);
    }
    static constexpr std::size_t kSmallMessage_bytes = 64;

    void add(std::string_view channel, std::int64_t utime, std::span<const std::uint8_t> data) {
        entries_.push_back({utime, channel.size(), data.size()});
        bytes_.insert(bytes_.end(), channel.begin(), channel.end());
        bytes_.insert(bytes_.end(), data.begin(), data.end());
    }

    template <typename Use>
    void each(Use&& use) const {
        const std::uint8_t* at = bytes_.data();
        for (const Entry& entry : entries_) {
            const std::string_view channel(reinterpret_cast<const char*>(at), entry.channel_bytes);
            use(Message{channel, entry.utime, {at + entry.channel_bytes, entry.data_bytes}});
            at += entry.channel_bytes + entry.data_bytes;
        }
    }

    bool empty() const { return entries_.empty(); }
    std::size_t bytes() const { return bytes_.size() + entries_.size() * sizeof(Entry); }
    void clear() {
        entries_.clear();
        bytes_.clear();
    }

private:
    struct Entry {
        std::int64_t utime;
        std::size_t channel_bytes;
        std::size_t data_bytes;
    };

    std::vector<Entry> entries_;
    std::vector<std::uint8_t> bytes_;
};

}  // namespace lockstep
