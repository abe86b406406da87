#include "services/wire/lcm/lcm_decode.hpp"

#include <algorithm>

namespace lockstep::detail {
namespace {

/// Walks over the bytes of a message, field by field. It stops at the first field that does not fit.
class Walk {
public:
    explicit Walk(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

    bool skip(std::uint64_t count) {
        fits_ = fits_ && count <= rest_.size();
        if (fits_) { rest_ = rest_.subspan(count); }
        return fits_;
    }
    /// Reads a number of elements, which must not be negative as a signed number.
    std::uint64_t count() {
        const auto field = rest_.first(std::min<std::size_t>(4, rest_.size()));
        const std::uint64_t value = big_endian(field);
        fits_ = skip(4) && value <= 0x7FFFFFFF;
        return fits_ ? value : 0;
    }
    /// Skips a string. Its length includes the zero byte at its end.
    void string() {
        const std::uint64_t length = count();
        fits_ = fits_ && length >= 1 && length <= rest_.size() && rest_[length - 1] == 0;
        skip(length);
    }
    bool ended() const { return fits_ && rest_.empty(); }

private:
    std::span<const std::uint8_t> rest_;
    bool fits_ = true;
};

}  // namespace

std::uint64_t big_endian(std::span<const std::uint8_t> bytes) {
    std::uint64_t value = 0;
    for (const std::uint8_t byte : bytes) { value = value << 8 | byte; }
    return value;
}

bool has_layout(std::span<const std::uint8_t> bytes, std::string_view layout) {
    Walk walk(bytes);
    std::uint64_t elements = 1;
    for (const char field : layout) {
        if (field == 's') {
            walk.string();
        } else if (field == 'n') {
            elements = walk.count();
        } else {
            walk.skip(elements * static_cast<std::uint64_t>(field - '0'));
        }
    }
    return walk.ended();
}

}  // namespace lockstep::detail
