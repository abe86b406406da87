#include "services/documents/timing_edit.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "idl/proto/machine.pb.h"
#include "services/documents/machine_file.hpp"
#include "services/documents/text_source.hpp"

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

/// Where a place is in the text. Protobuf counts a tab as up to the next column that is a multiple of 8.
std::size_t offset_of(std::string_view text, const TextSource::Place& place) {
    constexpr int kTab = 8;
    std::size_t at = 0;
    for (int line = 1; line < place.line; ++line) { at = text.find('\n', at) + 1; }
    for (int column = 0; column < place.column - 1; ++at) { column += text[at] == '\t' ? kTab - column % kTab : 1; }
    return at;
}

/// The place of a key of the machine, if the text has it.
class Keys {
public:
    explicit Keys(std::string_view text) : text_(text) {
        proto::Machine machine;
        (void)source_.parse(text, machine);
    }
    std::size_t find(const std::string& path) const {
        const TextSource::Place place = source_.place_of(*proto::Machine::descriptor(), path);
        return place.is_of_key ? offset_of(text_, place) : std::string_view::npos;
    }

private:
    std::string_view text_;
    TextSource source_;
};

/// Replaces the number behind a key of the block, or adds the key at the block's beginning.
void set(std::string& text, const KeyAndValue& key) {
    const std::string name(key.first);
    const std::string value = std::to_string(key.second);
    const Keys keys(text);
    if (const std::size_t at = keys.find("timing." + name); at != std::string::npos) {
        const std::size_t begin = text.find_first_of("0123456789-+", at + name.size());
        const std::size_t end = text.find_first_not_of("0123456789abcdefxABCDEFX-+", begin);
        text.replace(begin, end - begin, value);
        return;
    }
    const std::size_t open = text.find_first_of("{<", keys.find("timing"));
    text.insert(open + 1, " " + name + ": " + value);
}

bool has_slots(const ProtocolTiming& is, const ProtocolTiming& asked) { return keys_of(is) == keys_of(asked); }

}  // namespace

std::string slots_text(const ProtocolTiming& timing) {
    std::string text = "timing {";
    for (const auto& [key, value] : keys_of(timing)) { text += " " + std::string(key) + ": " + std::to_string(value); }
    return text + " }";
}

std::expected<std::string, Diagnostics> with_slots(std::string_view text, const ProtocolTiming& timing) {
    const auto before = parse_machine(text);
    if (!before) { return std::unexpected(before.error()); }
    std::string edited(text);
    if (Keys(edited).find("timing") == std::string::npos) {
        edited += std::string(edited.ends_with('\n') ? "" : "\n") + slots_text(timing) + "\n";
    }
    for (const KeyAndValue& key : keys_of(timing)) { set(edited, key); }
    const bool has_limit = Keys(edited).find("timing.clock_error_limit_us") != std::string::npos;
    if (has_limit && before->timing.clock_error_limit_us > timing.most_clock_error_us()) {
        set(edited, {"clock_error_limit_us", timing.most_clock_error_us()});
    }
    const auto after = parse_machine(edited);
    if (!after) { return std::unexpected(after.error()); }
    if (has_slots(after->timing, timing)) { return edited; }
    return std::unexpected(Diagnostics{
        {.message =
             "the timing cannot be written: a comment stands between a key of `timing` and its value; move it"}});
}

}  // namespace lockstep
