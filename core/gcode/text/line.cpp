#include "core/gcode/text/line.hpp"

#include <algorithm>
#include <cstdint>

namespace lockstep::gcode {
namespace {

enum class CharacterKind : std::uint8_t { Kept, Blank, Small, Comment, End, Control, Foreign };

constexpr CharacterKind kind_of(unsigned char c) {
    if (c == ' ' || c == '\t') { return CharacterKind::Blank; }
    if (c < ' ' || c == 0x7F) { return CharacterKind::Control; }
    if (c > '~') { return CharacterKind::Foreign; }
    if (c >= 'a' && c <= 'z') { return CharacterKind::Small; }
    if (c == '(') { return CharacterKind::Comment; }
    return c == ';' ? CharacterKind::End : CharacterKind::Kept;
}

constexpr std::array<CharacterKind, 256> kKinds = [] {
    std::array<CharacterKind, 256> kinds{};
    for (std::size_t c = 0; c < kinds.size(); ++c) { kinds[c] = kind_of(static_cast<unsigned char>(c)); }
    return kinds;
}();

constexpr CharacterKind kind(char c) { return kKinds[static_cast<unsigned char>(c)]; }

std::string control_message(char c) { return shown(c) + " is a control byte, not text; remove it"; }

}  // namespace

std::string shown(char c) {
    if (c >= ' ' && c <= '~') { return std::string("'") + c + "'"; }
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(c);
    return std::string("the byte 0x") + kDigits[byte / 16] + kDigits[byte % 16];
}

GcodeError Line::raw_error(std::size_t place, std::string message) const {
    return {number_, static_cast<int>(place) + 1, std::move(message)};
}

std::optional<GcodeError> Line::read(std::string_view raw, int number) {
    raw_ = raw;
    number_ = number;
    size_ = 0;
    if (raw.size() > kMaxLineLength) {
        return raw_error(kMaxLineLength, "the line has " + std::to_string(raw.size()) + " characters, more than " +
                                             std::to_string(kMaxLineLength) + "; split it");
    }
    for (std::size_t i = 0; i < raw.size(); ++i) {
        const char c = raw[i];
        switch (kind(c)) {
            case CharacterKind::Kept: kept_[size_++] = c; break;
            case CharacterKind::Small: kept_[size_++] = static_cast<char>(c - 'a' + 'A'); break;
            case CharacterKind::Blank: break;
            case CharacterKind::Comment:
                if (auto error = keep_comment(i)) { return error; }
                break;
            case CharacterKind::End: {
                const auto control = std::ranges::find(raw.substr(i), CharacterKind::Control, kind);
                if (control == raw.end()) { return std::nullopt; }
                return raw_error(static_cast<std::size_t>(control - raw.begin()), control_message(*control));
            }
            case CharacterKind::Control: return raw_error(i, control_message(c));
            case CharacterKind::Foreign:
                return raw_error(i, shown(c) + " is not G-code; outside comments a program is printable ASCII");
        }
    }
    return std::nullopt;
}

/// `from` is the place of the comment's '(', and is set to that of its ')'.
std::optional<GcodeError> Line::keep_comment(std::size_t& from) {
    const std::size_t begin = from;
    for (std::size_t i = begin; i < raw_.size(); ++i) {
        const char c = raw_[i];
        if (kind(c) == CharacterKind::Control) { return raw_error(i, control_message(c)); }
        if (c == '(' && i > begin) { return raw_error(i, "a comment is inside a comment; remove one ("); }
        kept_[size_++] = c;
        if (c == ')') {
            from = i;
            return std::nullopt;
        }
    }
    return raw_error(begin, "the comment is not closed; write ) before the line's end");
}

std::size_t Line::end_of_comment(std::size_t place) const { return std::min(text().find(')', place), size_ - 1) + 1; }

int Line::checksum() const {
    unsigned char sum = 0;
    for (const char c : raw().substr(0, raw_.rfind('*'))) { sum ^= static_cast<unsigned char>(c); }
    return sum;
}

GcodeError Line::error(std::size_t place, std::string message) const {
    std::size_t kept = 0;
    bool in_comment = false;
    for (std::size_t i = 0; i < raw_.size(); ++i) {
        in_comment = in_comment || raw_[i] == '(';
        if (!in_comment && kind(raw_[i]) == CharacterKind::Blank) { continue; }
        in_comment = in_comment && raw_[i] != ')';
        if (kept++ == place) { return raw_error(i, std::move(message)); }
    }
    return raw_error(raw_.size(), std::move(message));
}

}  // namespace lockstep::gcode
