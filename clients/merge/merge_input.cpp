#include "clients/merge/merge_input.hpp"

#include <algorithm>
#include <utility>

namespace lockstep::merge {
namespace {

std::uint64_t memory_of(const HeldMessage& message) {
    constexpr std::uint64_t kNodeBytes = 160;  // the message itself, and its place in the set
    return kNodeBytes + message.id.channel.size() + message.data.size();
}

}  // namespace

std::expected<MergeInput, std::string> MergeInput::open(const std::filesystem::path& path) {
    MergeInput input(path);
    if (const auto found = input.find_beginning(); !found) { return std::unexpected(found.error()); }
    return input;
}

std::expected<void, std::string> MergeInput::find_beginning() {
    auto reader = LogReader::open(path_);
    if (!reader) { return std::unexpected(reader.error()); }
    std::error_code error;
    file_bytes_ = std::filesystem::file_size(path_, error);
    while (!begins_utime_) {
        const auto event = reader->next();
        if (!event) { return std::unexpected(path_.string() + ": " + event.error()); }
        if (!*event) { return {}; }
        const auto id = identify(**event);
        if (id && *id) { begins_utime_ = (*id)->utime; }
    }
    latest_utime_ = newest_utime_ = *begins_utime_;
    return {};
}

std::expected<void, std::string> MergeInput::fill(std::int64_t window_us, std::uint64_t most_bytes) {
    if (has_ended_) { return {}; }
    if (!reader_) {
        auto reader = LogReader::open(path_);
        if (!reader) { return std::unexpected(reader.error()); }
        reader_.emplace(std::move(*reader));
    }
    const auto is_full = [&] {
        return !held_.empty() && (newest_utime_ - held_.begin()->id.utime > window_us || bytes_held_ > most_bytes);
    };
    while (!is_full()) {
        const auto event = reader_->next();
        if (!event) { return std::unexpected(path_.string() + ": " + event.error()); }
        if (!*event) {
            end();
            return {};
        }
        hold(**event);
    }
    return {};
}

void MergeInput::hold(const LogEvent& event) {
    bytes_read_ = event.offset + event.bytes;
    auto id = identify(event);
    if (!id) { return analysis::note_damage(damages_, {event.offset, event.bytes}, id.error()); }
    HeldMessage message{.id = *id ? std::move(**id) : MessageId{latest_utime_, std::string(event.channel), {}},
                        .arrival = messages_++,
                        .is_foreign = !*id,
                        .data = {event.data.begin(), event.data.end()}};
    latest_utime_ = message.id.utime;
    newest_utime_ = std::max(newest_utime_, latest_utime_);
    bytes_held_ += memory_of(message);
    held_.insert(std::move(message));
}

void MergeInput::end() {
    analysis::report_damages(*reader_, [this](analysis::LogPlace place, std::string what) {
        analysis::note_damage(damages_, place, std::move(what));
    });
    has_ended_ = true;
    bytes_read_ = file_bytes_;
    reader_.reset();
}

HeldMessage MergeInput::take() {
    HeldMessage message = std::move(held_.extract(held_.begin()).value());
    bytes_held_ -= memory_of(message);
    return message;
}

}  // namespace lockstep::merge
