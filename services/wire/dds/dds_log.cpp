#include "services/wire/dds/dds_log.hpp"

#include <dds/dds.h>
#include <dds/ddsrt/log.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <mutex>

#include "services/runtime/clock.hpp"
#include "services/wire/dds/cut_text.hpp"
#include "services/wire/dds/unauthenticated_peers.hpp"

namespace lockstep {
namespace {

struct DdsLog {
    std::mutex mutex;
    std::function<void(const std::string&)> to;
    RepeatFilter filter;
    UnauthenticatedPeers unauthenticated;
    std::string last;
    bool joined = false;
};

/// The log is never destroyed, because threads of DDS may outlive main().
DdsLog& dds_log() {
    static auto* const log = new DdsLog;
    return *log;
}

/// Makes one printable line. Names in certificates and packets may contain any bytes.
std::string one_line(std::string text) {
    constexpr std::size_t kMaxLength = 400;
    text = cut_text(text, kMaxLength);
    while (text.ends_with('\n') || text.ends_with(' ')) { text.pop_back(); }
    std::ranges::replace_if(
        text, [](unsigned char c) { return c < 0x20 || c > 0x7e; }, '?');
    return text;
}

/// The caller holds the log's lock.
void pass_on(DdsLog& log, const std::string& message) {
    log.last = message;
    const auto text = log.filter.pass(monotonic_now(), message);
    if (text && log.to) { log.to(*text); }
}

void on_message(void*, const dds_log_data_t* data) {
    if ((data->priority & (DDS_LC_FATAL | DDS_LC_ERROR | DDS_LC_WARNING)) == 0) { return; }
    DdsLog& log = dds_log();
    const std::lock_guard lock(log.mutex);
    const std::string message = one_line(data->message);
    if (!log.joined && message.ends_with("not allowed")) { return; }
    pass_on(log, message);
}

void on_trace(void*, const dds_log_data_t* data) {
    if ((data->priority & DDS_LC_DISCOVERY) == 0) { return; }
    DdsLog& log = dds_log();
    const std::lock_guard lock(log.mutex);
    if (const auto text = log.unauthenticated.note_line(monotonic_now(), data->message)) { pass_on(log, *text); }
}

/// Returns the beginning of a message without hexadecimal digits and colons, which may be parts of an identity. DDS
/// appends damaged packets to the message.
std::string kind_of(std::string message) {
    constexpr std::size_t kLength = 60;
    std::erase_if(message, [](unsigned char c) { return std::isxdigit(c) || c == ':'; });
    message.resize(std::min(message.size(), kLength));
    return message;
}

}  // namespace

std::optional<std::string> RepeatFilter::pass(std::chrono::nanoseconds now, const std::string& message) {
    if (kinds_.size() >= kMaxKinds) { kinds_.clear(); }
    const auto [entry, is_new] = kinds_.try_emplace(kind_of(message), now);
    Kind& kind = entry->second;
    if (!is_new && now - kind.reported < kPeriod) {
        ++kind.held_back;
        return std::nullopt;
    }
    const std::string more = kind.held_back == 0 ? "" : fmt::format(" (and {} more like it)", kind.held_back);
    kind = {now, 0};
    return message + more;
}

void forward_dds_log(std::function<void(const std::string&)> to) {
    {
        DdsLog& log = dds_log();
        const std::lock_guard lock(log.mutex);
        log.to = std::move(to);
    }
    dds_set_log_sink(on_message, nullptr);
}

void watch_unauthenticated_peers() { dds_set_trace_sink(on_trace, nullptr); }

std::vector<std::string> unauthenticated_peers(std::chrono::nanoseconds now) {
    const std::lock_guard lock(dds_log().mutex);
    return dds_log().unauthenticated.due(now);
}

void add_dds_message(const std::string& text) {
    const std::lock_guard lock(dds_log().mutex);
    pass_on(dds_log(), text);
}

std::string last_dds_message() {
    const std::lock_guard lock(dds_log().mutex);
    return dds_log().last;
}

void note_joined() {
    const std::lock_guard lock(dds_log().mutex);
    dds_log().joined = true;
}

}  // namespace lockstep
