// The messages of a record in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "services/record/record_sink.hpp"
#include "services/wire/lcm/lcm_decode.hpp"

namespace lockstep::records {

struct Message {
    std::string channel;
    std::int64_t utime = 0;  // microseconds of machine time
    std::vector<std::uint8_t> data;
};

/// In the order of the log.
using Record = std::vector<Message>;

/// Keeps everything that is written to it.
class MemorySink final : public RecordSink {
public:
    void write(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) override {
        record.push_back({channel, utime, {bytes.begin(), bytes.end()}});
    }
    Record record;
};

/// Throws std::runtime_error if the file cannot be written or read.
void write_record(const Record& record, const std::filesystem::path& path);
Record read_record(const std::filesystem::path& path);

/// A folder of this process for logs.
std::filesystem::path record_folder();

inline bool is_on(const Message& message, std::string_view ending) { return message.channel.ends_with(ending); }

/// The channel endings of the types.
template <typename Type>
inline constexpr std::string_view kEnding;
template <>
inline constexpr std::string_view kEnding<step_batch_t> = "_STEPS";
template <>
inline constexpr std::string_view kEnding<run_t> = "_RUN";
template <>
inline constexpr std::string_view kEnding<job_t> = "_JOB";
template <>
inline constexpr std::string_view kEnding<program_event_t> = "_EVENTS";
template <>
inline constexpr std::string_view kEnding<channel_event_t> = "_CHANNELS";
template <>
inline constexpr std::string_view kEnding<program_part_t> = "_PROGRAM";
template <>
inline constexpr std::string_view kEnding<record_mark2_t> = "_MARK";
template <>
inline constexpr std::string_view kEnding<axis_position_t> = "_POSITION";
template <>
inline constexpr std::string_view kEnding<axis_health_t> = "_HEALTH";

template <typename Type>
std::vector<std::uint8_t> encoded(const Type& message) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    return bytes;
}

/// The message as this type; nullopt if its channel carries another type.
template <typename Type>
std::optional<Type> decoded(const Message& message) {
    if (!is_on(message, kEnding<Type>)) { return std::nullopt; }
    auto result = decode_lcm<Type>(message.data);
    return result ? std::optional(std::move(*result)) : std::nullopt;
}

/// Changes every message of the type for which `change` returns true. Returns their number.
template <typename Type, typename Change>
std::size_t change_each(Record& record, Change&& change) {
    std::size_t changed = 0;
    for (Message& message : record) {
        auto content = decoded<Type>(message);
        if (!content || !change(*content)) { continue; }
        message.data = encoded(*content);
        ++changed;
    }
    return changed;
}

/// Leaves out every message of the type for which `unwanted` returns true. Returns their number.
template <typename Type, typename Unwanted>
std::size_t leave_out(Record& record, Unwanted&& unwanted) {
    return std::erase_if(record, [&](const Message& message) {
        const auto content = decoded<Type>(message);
        return content && unwanted(*content);
    });
}

/// The places of the type's messages for which `wanted` returns true.
template <typename Type, typename Wanted>
std::vector<std::size_t> places_of(const Record& record, Wanted&& wanted) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < record.size(); ++i) {
        const auto content = decoded<Type>(record[i]);
        if (content && wanted(*content)) { places.push_back(i); }
    }
    return places;
}

}  // namespace lockstep::records
