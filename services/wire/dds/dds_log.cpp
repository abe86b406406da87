#include "services/wire/dds/dds_log.hpp"

#include <dds/dds.h>
#include <dds/ddsrt/log.h>

#include <algorithm>
#include <cctype>
#include <mutex>

#include "services/runtime/clock.hpp"
#include "services/wire/dds/cut_text.hpp"
#include "services/wire/dds/newcomers.hpp"

namespace lockstep {
namespace {

struct Ear {
    std::mutex mutex;
    std::function<void(const std::string&)> say;
    RepeatFilter filter;
    Newcomers newcomers;
    std::string last;
    bool joined = false;
};

/// Never destroyed: threads of DDS may outlive main.
Ear& the_ear() {
    static auto* const ear = new Ear;
    return *ear;
}

/// One line of a log: names in certificates, and packets, are whatever their maker wrote.
std::string one_line(std::string text) {
    constexpr std::size_t kMaxLength = 400;
    text = cut_text(text, kMaxLength);
    while (text.ends_with('\n') || text.ends_with(' ')) { text.pop_back(); }
    std::ranges::replace_if(
        text, [](unsigned char c) { return c < 0x20 || c > 0x7e; }, '?');
    return text;
}

/// Its lock is held.
void pass_on(Ear& ear, const std::string& message) {
    ear.last = message;
    const auto text = ear.filter.pass(monotonic_now(), message);
    if (text && ear.say) { ear.say(*text); }
}

void on_message(void*, const dds_log_data_t* data) {
    if ((data->priority & (DDS_LC_FATAL | DDS_LC_ERROR | DDS_LC_WARNING)) == 0) { return; }
    Ear& ear = the_ear();
    const std::lock_guard lock(ear.mutex);
    const std::string message = one_line(data->message);
    if (!ear.joined && message.ends_with("not allowed")) { return; }
    pass_on(ear, message);
}

void on_trace(void*, const dds_log_data_t* data) {
    if ((data->priority & DDS_LC_DISCOVERY) == 0) { return; }
    Ear& ear = the_ear();
    const std::lock_guard lock(ear.mutex);
    if (const auto news = ear.newcomers.hear(monotonic_now(), data->message)) { pass_on(ear, *news); }
}

/// Its beginning, without what may be a part of an identity: DDS quotes damaged packets behind it.
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
    if (!is_new && now - kind.said < kPeriod) {
        ++kind.held_back;
        return std::nullopt;
    }
    const std::string more = kind.held_back == 0 ? "" : " (and " + std::to_string(kind.held_back) + " more like it)";
    kind = {now, 0};
    return message + more;
}

void hear_dds(std::function<void(const std::string&)> say) {
    {
        Ear& ear = the_ear();
        const std::lock_guard lock(ear.mutex);
        ear.say = std::move(say);
    }
    dds_set_log_sink(on_message, nullptr);
}

void watch_newcomers() { dds_set_trace_sink(on_trace, nullptr); }

std::vector<std::string> unproved_newcomers(std::chrono::nanoseconds now) {
    const std::lock_guard lock(the_ear().mutex);
    return the_ear().newcomers.unproved(now);
}

void tell(const std::string& text) {
    const std::lock_guard lock(the_ear().mutex);
    pass_on(the_ear(), text);
}

std::string dds_said_last() {
    const std::lock_guard lock(the_ear().mutex);
    return the_ear().last;
}

void note_joined() {
    const std::lock_guard lock(the_ear().mutex);
    the_ear().joined = true;
}

}  // namespace lockstep
