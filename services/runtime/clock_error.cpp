#include "services/runtime/clock_error.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/parse_number.hpp"

namespace lockstep {
namespace {

using std::chrono::nanoseconds;

constexpr double kMost = 1e6;  // seconds or ppm

nanoseconds nanoseconds_of(double seconds) { return nanoseconds{std::llround(seconds * 1e9)}; }

std::optional<double> number(std::string_view text) {
    const auto value = parse_number<double>(text);
    return value && std::abs(*value) <= kMost ? value : std::nullopt;
}

/// Reads one part, such as ppm=50. Returns false if it cannot be read.
bool read_part(std::string_view part, ClockError& error) {
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos) { return false; }
    const std::string_view key = part.substr(0, equals);
    std::string_view value = part.substr(equals + 1);
    if (key == "step") {
        const std::size_t at = value.find('@');
        const auto when = at == std::string_view::npos ? std::nullopt : number(value.substr(at + 1));
        if (!when || *when < 0) { return false; }
        error.step_at_s = *when;
        value = value.substr(0, at);
    }
    const auto read = number(value);
    if (!read || (key != "offset" && key != "ppm" && key != "step")) { return false; }
    (key == "offset" ? error.offset_s : key == "ppm" ? error.ppm : error.step_s) = *read;
    return true;
}

}  // namespace

nanoseconds ClockError::applied(nanoseconds time, nanoseconds since) const {
    const double since_s = static_cast<double>(since.count()) * 1e-9;
    const double step = step_s != 0 && since_s >= step_at_s ? step_s : 0;
    return time + nanoseconds_of(offset_s + since_s * ppm * 1e-6 + step);
}

std::expected<ClockError, std::string> parse_clock_error(std::string_view text) {
    ClockError error;
    while (!text.empty()) {
        const std::string_view part = text.substr(0, text.find(','));
        if (!read_part(part, error)) {
            return std::unexpected(
                "\"" + std::string(part) +
                "\" is not valid; it must be offset=SECONDS, ppm=N or step=SECONDS@SECONDS, each at most 1e6");
        }
        text.remove_prefix(std::min(part.size() + 1, text.size()));
    }
    return error;
}

}  // namespace lockstep
