// One block: the words of a line, sorted by meaning and checked individually (RS274/NGC, sections 3.4 to 3.6).
//
// A block contains the words of its line only. The interpreter applies the effects of earlier lines.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/gcode/codes.hpp"
#include "core/gcode/motion.hpp"
#include "core/gcode/text/reader.hpp"

namespace lockstep::gcode {

/// Greater numbers, positive or negative, are refused. So sums stay exact to far below a step.
inline constexpr double kMaxNumber = 1e6;
/// The greatest number of M codes in a block, as in LinuxCNC.
inline constexpr int kMaxMCodes = 4;

constexpr std::uint32_t letter_bit(char letter) { return std::uint32_t{1} << (letter - 'A'); }
inline constexpr std::uint32_t kAxisBits = [] {
    std::uint32_t bits = 0;
    for (const char letter : kAxisLetters) { bits |= letter_bit(letter); }
    return bits;
}();

struct Assignment {
    std::variant<int, std::string> parameter;
    double value = 0;
};

class LineWords {
public:
    static constexpr int kNoCode = -1;

    void clear();
    bool has(char letter) const { return (present_ & letter_bit(letter)) != 0; }
    double operator[](char letter) const { return values_[index(letter)]; }
    std::optional<double> find(char letter) const {
        return has(letter) ? std::optional((*this)[letter]) : std::nullopt;
    }
    std::size_t place(char letter) const { return places_[index(letter)]; }
    /// The code's number times ten, or kNoCode.
    int code(Group group) const { return codes_[static_cast<std::size_t>(group)]; }
    bool has(Group group) const { return code(group) != kNoCode; }
    std::size_t place(Group group) const { return code_places_[static_cast<std::size_t>(group)]; }
    bool has_axes() const { return (present_ & kAxisBits) != 0; }
    bool has_any(std::string_view letters) const;

    void set(char letter, double value, std::size_t place);
    void set(const Code& code, std::size_t place);

    int line = 0;                         // on which they stand
    std::vector<Assignment> assignments;  // carried out after the whole block has been read
    std::optional<std::size_t> comment;   // place of the last one; only this one can be a message
    std::optional<double> distance;       // @, polar
    std::optional<double> angle;          // ^, degrees

private:
    static constexpr std::size_t index(char letter) { return static_cast<std::size_t>(letter - 'A'); }

    std::uint32_t present_ = 0;
    std::array<double, 26> values_{};
    std::array<std::uint16_t, 26> places_{};
    std::array<std::int16_t, kGroups> codes_{};
    std::array<std::uint16_t, kGroups> code_places_{};
};

/// Skips comments before a /, block delete and line number. Returns false if the line must not be run.
bool skip_head(const Line& line, Reader& reader, bool skip_deletable);

/// Reads the rest of the line into a cleared block. `axes` are the letters of the machine's axes.
std::optional<GcodeError> read_block(Reader& reader, const Line& line, std::string_view axes, LineWords& block);

/// The word that begins at a place, as written, without blanks.
std::string word_text(const Line& line, std::size_t place);

}  // namespace lockstep::gcode
