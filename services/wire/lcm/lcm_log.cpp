#include "services/wire/lcm/lcm_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "services/wire/lcm/lcm_decode.hpp"

namespace lockstep {
namespace {

constexpr std::array<std::uint8_t, 4> kSync{0xED, 0xA1, 0xDA, 0x01};
constexpr std::size_t kHeaderBytes = 28;
constexpr int kMaxCandidates = 64;  // sync words examined within one event; limits the work for a hostile file

bool starts_with_sync(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= kSync.size() && std::ranges::equal(bytes.first(kSync.size()), kSync);
}

bool is_printable(std::uint8_t byte) { return byte >= 0x20 && byte < 0x7F; }

template <typename Number>
void append(std::string& out, Number value) {
    for (int shift = 8 * (static_cast<int>(sizeof value) - 1); shift >= 0; shift -= 8) {
        out += static_cast<char>(value >> shift & 0xFF);
    }
}

}  // namespace

std::uint64_t LogReader::Header::event_bytes() const {
    return kHeaderBytes + channel_bytes + std::uint64_t{data_bytes};
}

std::expected<LogReader, std::string> LogReader::open(const std::filesystem::path& path) {
    auto file = FileWindow::open(path);
    if (!file) { return std::unexpected(file.error()); }
    return LogReader(std::move(*file));
}

/// Returns the header if its sync word, its lengths and its channel's name show that an event may begin here.
std::optional<LogReader::Header> LogReader::header_at(std::uint64_t offset) {
    const auto bytes = file_.view(offset, kHeaderBytes + kMaxChannelBytes);
    if (bytes.size() < kHeaderBytes || !starts_with_sync(bytes)) { return std::nullopt; }
    const Header header{.number = static_cast<std::int64_t>(detail::big_endian(bytes.subspan(4, 8))),
                        .utime = static_cast<std::int64_t>(detail::big_endian(bytes.subspan(12, 8))),
                        .channel_bytes = static_cast<std::uint32_t>(detail::big_endian(bytes.subspan(20, 4))),
                        .data_bytes = static_cast<std::uint32_t>(detail::big_endian(bytes.subspan(24, 4)))};
    const std::size_t channel_most = std::min<std::size_t>(kMaxChannelBytes, bytes.size() - kHeaderBytes);
    if (header.channel_bytes < 1 || header.channel_bytes > channel_most) { return std::nullopt; }
    if (header.data_bytes > kMaxDataBytes) { return std::nullopt; }
    if (!std::ranges::all_of(bytes.subspan(kHeaderBytes, header.channel_bytes), is_printable)) { return std::nullopt; }
    return header;
}

/// Whether a complete event begins here, followed by another event or the end of the file.
bool LogReader::begins_event(std::uint64_t offset) {
    const auto header = header_at(offset);
    if (!header) { return false; }
    const std::uint64_t end = offset + header->event_bytes();
    return end == file_.size() || (end < file_.size() && starts_with_sync(file_.view(end, kSync.size())));
}

/// Returns the first offset in [from, to) with the sync word.
std::optional<std::uint64_t> LogReader::find_sync(std::uint64_t from, std::uint64_t to) {
    while (from + kSync.size() <= to) {
        const auto bytes =
            file_.view(from, static_cast<std::size_t>(std::min<std::uint64_t>(FileWindow::kWindowBytes, to - from)));
        if (bytes.size() < kSync.size()) { break; }
        const auto found = std::ranges::search(bytes, kSync);
        if (!found.empty()) { return from + static_cast<std::uint64_t>(found.begin() - bytes.begin()); }
        from += bytes.size() - (kSync.size() - 1);  // a sync word may extend over two windows
    }
    return std::nullopt;
}

/// Whether this event's lengths are wrong, so that it contains later events.
bool LogReader::hides_another(std::uint64_t offset, std::uint64_t end) {
    for (int i = 0; i < kMaxCandidates; ++i) {
        const auto candidate = find_sync(offset + 1, end);
        if (!candidate) { return false; }
        if (begins_event(*candidate)) { return true; }
        offset = *candidate;
    }
    return false;
}

/// Moves to the next offset that looks like an event, or to the end, and notes the bytes skipped.
void LogReader::skip_damage(LogDamage::Kind kind) {
    std::uint64_t to = at_;
    do { to = find_sync(to + 1, file_.size()).value_or(file_.size()); } while (to < file_.size() && !header_at(to));
    if (to == file_.size() && kind == LogDamage::Kind::WrongLength) { kind = LogDamage::Kind::CutOff; }
    if (damages_.size() < kMaxDamages) { damages_.push_back({at_, to - at_, kind}); }
    ++damaged_stretches_;
    damaged_bytes_ += to - at_;
    at_ = to;
}

LogEvent LogReader::read_event(std::uint64_t offset, const Header& header) {
    const auto bytes = file_.view(offset, static_cast<std::size_t>(header.event_bytes()));
    if (bytes.size() < header.event_bytes()) { return {}; }  // reading failed: next() reports it
    const auto channel = bytes.subspan(kHeaderBytes, header.channel_bytes);
    return {.offset = offset,
            .bytes = header.event_bytes(),
            .number = header.number,
            .utime = header.utime,
            .channel = {reinterpret_cast<const char*>(channel.data()), channel.size()},
            .data = bytes.subspan(kHeaderBytes + header.channel_bytes)};
}

std::expected<std::optional<LogEvent>, std::string> LogReader::next() {
    while (at_ < file_.size() && !file_.failed()) {
        const auto header = header_at(at_);
        const std::uint64_t end = header ? at_ + header->event_bytes() : 0;
        const bool whole = header && end <= file_.size();
        if (!whole || (!begins_event(at_) && hides_another(at_, end))) {
            skip_damage(header ? LogDamage::Kind::WrongLength : LogDamage::Kind::NoEvent);
            continue;
        }
        const LogEvent event = read_event(at_, *header);
        at_ = end;
        if (!file_.failed()) { return event; }
    }
    if (file_.failed()) { return std::unexpected(fmt::format("the log cannot be read near byte {}", at_)); }
    return std::nullopt;
}

std::expected<LogWriter, std::string> LogWriter::open(const std::filesystem::path& path) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    if (!file) { return std::unexpected("cannot write " + path.string() + ": " + std::strerror(errno)); }
    return LogWriter(std::move(file));
}

std::uint64_t LogWriter::event_bytes(std::string_view channel, std::span<const std::uint8_t> data) {
    return kHeaderBytes + channel.size() + data.size();
}

bool LogWriter::write(std::string_view channel, std::int64_t utime, std::span<const std::uint8_t> data) {
    std::string header(reinterpret_cast<const char*>(kSync.data()), kSync.size());
    append(header, number_++);
    append(header, utime);
    append(header, static_cast<std::uint32_t>(channel.size()));
    append(header, static_cast<std::uint32_t>(data.size()));
    file_ << header << channel;
    file_.write(reinterpret_cast<const char*>(data.data()), static_cast<std::streamsize>(data.size()));
    return static_cast<bool>(file_);
}

}  // namespace lockstep
