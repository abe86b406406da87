#include "services/runtime/log.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/rotating_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

#include "services/runtime/background_sink.hpp"

namespace lockstep {
namespace {

/// Makes a field of spdlog's pattern. It doubles '%', which spdlog would read as the start of a flag.
std::string word(std::string_view text) {
    std::string out;
    for (char c : text) { out += c == '%' ? "%%" : std::string(1, c); }
    return out.empty() ? "-" : out;
}

std::expected<spdlog::sink_ptr, std::string> sink_for(const LogTarget& target) {
    if (!target.file) { return std::make_shared<spdlog::sinks::stderr_sink_mt>(); }
    if (!std::ofstream(*target.file, std::ios::app)) {  // spdlog would throw
        return std::unexpected("cannot write the log " + target.file->string() + ": " + std::strerror(errno));
    }
    return std::make_shared<spdlog::sinks::rotating_file_sink_mt>(target.file->string(), kLogFileBytes, kOlderLogFiles);
}

/// Null if the caller's thread writes the log itself.
std::shared_ptr<BackgroundSink>& background_sink() {
    static std::shared_ptr<BackgroundSink> sink;
    return sink;
}

}  // namespace

std::expected<void, std::string> open_log(const LogTarget& target) {
    auto sink = sink_for(target);
    if (!sink) { return std::unexpected(sink.error()); }
    background_sink() = target.in_background ? std::make_shared<BackgroundSink>(*sink) : nullptr;
    if (background_sink()) { *sink = background_sink(); }
    auto logger = std::make_shared<spdlog::logger>(target.service, *sink);
    logger->set_pattern("%Y-%m-%dT%H:%M:%S.%eZ %l " + word(target.service) + " " + word(target.axis) + " %v",
                        spdlog::pattern_time_type::utc);
    logger->flush_on(spdlog::level::info);
    spdlog::set_default_logger(std::move(logger));
    return {};
}

void drain_log(std::chrono::milliseconds most) {
    if (background_sink()) { background_sink()->drain(most); }
}

std::uint64_t lost_log_lines() { return background_sink() ? background_sink()->lost() : 0; }

void log_event(spdlog::level::level_enum level, FaultCode code, std::string_view message) {
    spdlog::log(level, "{} {}", code == FaultCode::None ? "-" : name_of(code), message);
}

}  // namespace lockstep
