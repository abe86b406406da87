#include "services/documents/edit/timing_edit.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <utility>

#include "services/documents/edit/key_edit.hpp"
#include "services/documents/machine_file.hpp"

namespace lockstep {
namespace {

using KeyAndValue = std::pair<std::string_view, std::int64_t>;

std::array<KeyAndValue, 6> keys_of(const ProtocolTiming& t) {
    return {{{"slot_us", t.slot_us},
             {"stall_slots", t.stall_slots},
             {"late_check_slots", t.late_check_slots},
             {"freshness_slots", t.freshness_slots},
             {"send_ahead_slots", t.send_ahead_slots},
             {"frame_slots", t.frame_slots}}};
}

bool has_slots(const ProtocolTiming& is, const ProtocolTiming& asked) { return keys_of(is) == keys_of(asked); }

}  // namespace

std::string slots_text(const ProtocolTiming& timing) {
    std::string text = "timing {";
    for (const auto& [key, value] : keys_of(timing)) { text += fmt::format(" {}: {}", key, value); }
    return text + " }";
}

std::expected<std::string, Diagnostics> with_slots(std::string_view text, const ProtocolTiming& timing) {
    const auto before = parse_machine(text);
    if (!before) { return std::unexpected(before.error()); }
    std::string edited(text);
    if (!has_key(edited, "timing")) {
        edited += std::string(edited.ends_with('\n') ? "" : "\n") + slots_text(timing) + "\n";
    }
    bool is_written = true;
    const auto set = [&](std::string_view key, std::int64_t value) {
        is_written = set_key(edited, "timing." + std::string(key), std::to_string(value)) && is_written;
    };
    for (const auto& [key, value] : keys_of(timing)) { set(key, value); }
    if (has_key(edited, "timing.clock_error_limit_us") &&
        before->timing.clock_error_limit_us > timing.most_clock_error_us()) {
        set("clock_error_limit_us", timing.most_clock_error_us());
    }
    const auto after = parse_machine(edited);
    if (!after) { return std::unexpected(after.error()); }
    if (is_written && has_slots(after->timing, timing)) { return edited; }
    return std::unexpected(Diagnostics{
        {.message = "the timing cannot be written: a comment is between a key of `timing` and its value; move it"}});
}

}  // namespace lockstep
