// A chunk of an MCAP file: records, with an index of the messages of each channel, so that a reader finds messages by
// time and by topic without reading all.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace lockstep::exporting {

/// Times are nanoseconds.
class McapChunk {
public:
    /// A chunk of this size is written. It limits the memory of writers and readers.
    static constexpr std::size_t kFullBytes = std::size_t{1} << 20;

    /// Adds a schema or a channel. It must come before its messages.
    void add(std::string_view record) { records_ += record; }
    void add_message(std::uint16_t channel, std::uint64_t time_ns, std::string_view record);
    bool is_empty() const { return records_.empty(); }
    bool is_full() const { return records_.size() >= kFullBytes; }
    /// The chunk's record and, behind it, the message index of each channel. The chunk is empty afterwards.
    std::string take();

private:
    std::string records_;
    std::map<std::uint16_t, std::string> index_;  // by channel: time and offset of each message
    std::uint64_t begin_ns_ = 0;
    std::uint64_t end_ns_ = 0;
};

/// Reads the chunks of a file again and calls `on_index` with the ChunkIndex record of each, so that a writer need not
/// keep them. The chunks, each with its message indexes, fill the file from byte `from` up to byte `to`. The error
/// names the file.
std::expected<void, std::string> index_chunks(const std::filesystem::path& path, std::uint64_t from, std::uint64_t to,
                                              const std::function<void(const std::string&)>& on_index);

}  // namespace lockstep::exporting
