// Checks a sample from the wire before core uses it. The first failed check gives the refusal's text.
//
// The checks prevent overflow in core's arithmetic for any content of a sample. Magnitudes of up to 2^62 leave room for
// sums, and pieces of less than 2^31 ticks keep a piece's displacement within 128 bits. The checks do not decide
// whether a motion is allowed; the axis checks that itself.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace lockstep {

class Checks {
public:
    /// `message` names the type of message in the refusal's text.
    explicit Checks(const char* message) : message_(message) {}

    bool passed() const { return !refusal_; }
    const std::string& refusal() const { return *refusal_; }

    template <typename Number>
    void within(const char* field, Number value, Number least, Number most) {
        if (!(value >= least && value <= most)) { refuse(field, std::to_string(value)); }
    }
    /// An instant, a slot or a count of steps.
    void far(const char* field, std::int64_t value) { within(field, value, -kFarthest, kFarthest); }
    /// A velocity or acceleration: any value except the one that cannot be negated.
    void rate(const char* field, std::int64_t value) { within(field, value, -kFastest, kFastest); }
    void same(const char* field, std::size_t count, std::size_t expected) { within(field, count, expected, expected); }
    void finite(const char* field, double value) {
        if (!std::isfinite(value)) { refuse(field, "not finite"); }
    }

    /// UTF-8 without the control characters of ASCII and those from U+0080 to U+009F.
    void printable(const char* field, std::string_view text) {
        bool is_behind_c2 = false;
        for (const char character : text) {
            const auto byte = static_cast<unsigned char>(character);
            if (byte < 0x20 || byte == 0x7F || (is_behind_c2 && byte < 0xA0)) { refuse(field, "not printable"); }
            is_behind_c2 = byte == 0xC2;
        }
    }

    /// Returns core's enumerator for a value on the wire. Both enumerations have the same order, from 0 to `last`.
    template <typename Enum, typename WireEnum>
    Enum choice(const char* field, const WireEnum& value, Enum last) {
        static_assert(sizeof value == sizeof(std::uint32_t));
        std::uint32_t number = 0;
        std::memcpy(&number, &value, sizeof number);  // reading it as an enumeration would be undefined
        within(field, number, std::uint32_t{0}, static_cast<std::uint32_t>(last));
        return static_cast<Enum>(std::min(number, static_cast<std::uint32_t>(last)));
    }

private:
    static constexpr std::int64_t kFarthest = std::int64_t{1} << 62;
    static constexpr std::int64_t kFastest = std::numeric_limits<std::int64_t>::max();

    void refuse(const char* field, const std::string& value) {
        if (!refusal_) { refusal_ = fmt::format("{}: {} is {}, out of range", message_, field, value); }
    }

    const char* message_;
    std::optional<std::string> refusal_;
};

/// The longest piece or frame: 35 minutes at 1 us.
inline constexpr std::int64_t kMaxWireTicks = std::numeric_limits<std::int32_t>::max();

}  // namespace lockstep
