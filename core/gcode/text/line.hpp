// One line of a G-code text, prepared for reading: without blanks, letters as capitals, comments unchanged.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/gcode/text/error.hpp"

namespace lockstep::gcode {

inline constexpr std::size_t kMaxLineLength = 256;

class Line {
public:
    /// `raw` is the line without its end. It is copied, because an error may give a column in it after its body has
    /// ended.
    std::optional<GcodeError> read(std::string_view raw, int number);

    std::string_view text() const { return {kept_.data(), size_}; }
    std::string_view raw() const { return raw_; }
    /// Returns '\0' behind the end.
    char at(std::size_t place) const { return place < size_ ? kept_[place] : '\0'; }
    int number() const { return number_; }
    /// The exclusive or of all bytes before the last '*'.
    int checksum() const;
    GcodeError error(std::size_t place, std::string message) const;
    /// The place behind the ')' of the comment that begins at `place`.
    std::size_t end_of_comment(std::size_t place) const;

private:
    std::optional<GcodeError> keep_comment(std::size_t& from);
    GcodeError raw_error(std::size_t place, std::string message) const;

    std::string raw_;
    int number_ = 0;
    std::size_t size_ = 0;
    std::array<char, kMaxLineLength> kept_{};
};

/// The character as it can be shown: 'x', or the byte's number.
std::string shown(char c);
/// Digits and the decimal point: the characters of a number behind its sign.
constexpr bool is_of_number(char c) { return (c >= '0' && c <= '9') || c == '.'; }
constexpr bool is_letter(char c) { return c >= 'A' && c <= 'Z'; }

}  // namespace lockstep::gcode
