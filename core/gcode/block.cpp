#include "core/gcode/block.hpp"

#include <array>
#include <cmath>
#include <variant>

#include "core/number_text.hpp"
#include "core/program.hpp"

namespace lockstep {
namespace {

using gcode::Distance;
using gcode::Immediate;
using gcode::Motion;
using gcode::Stop;
using gcode::Units;

/// The alternative is the modal group.
using Meaning = std::variant<Motion, Immediate, Units, Distance, Stop>;
constexpr std::array<std::string_view, 5> kGroupNames{"motion", "non-modal", "units", "distance mode", "stop"};

struct Code {
    char letter;
    int tenths;  // G92.1 is 921
    Meaning meaning;
};

constexpr std::array kCodes{
    Code{'G', 0, Motion::Rapid},
    Code{'G', 10, Motion::Feed},
    Code{'G', 40, Immediate::Dwell},
    Code{'G', 280, Immediate::Park},
    Code{'G', 920, Immediate::SetOffset},
    Code{'G', 921, Immediate::ClearOffset},
    Code{'G', 200, Units::Inches},
    Code{'G', 210, Units::Millimetres},
    Code{'G', 900, Distance::Absolute},
    Code{'G', 910, Distance::Relative},
    Code{'M', 0, Stop::Pause},
    Code{'M', 10, Stop::OptionalPause},
    Code{'M', 20, Stop::End},
    Code{'M', 300, Stop::End},
};
constexpr std::string_view kCodesText = "G0 G1 G4 G20 G21 G28 G90 G91 G92 G92.1 M0 M1 M2 M30";

constexpr std::string_view kUsualAxisLetters = "XYZABCUVW";

const Code* find_code(const GcodeWord& word) {
    const double tenths = word.value * 10;
    for (const Code& code : kCodes) {
        if (code.letter == word.letter && std::abs(tenths - code.tenths) < 1e-6) { return &code; }
    }
    return nullptr;
}

std::string spaced(std::string_view letters) {
    std::string text;
    for (const char letter : letters) { text += (text.empty() ? "" : " ") + std::string(1, letter); }
    return text.empty() ? "none that a letter calls" : text;
}

/// Goes through a line's words once; the first thing wrong stays.
class BlockReader {
public:
    BlockReader(std::string_view axis_letters, int line) : axis_letters_(axis_letters), line_(line) {}

    std::expected<GcodeBlock, GcodeError> read(const std::vector<GcodeWord>& words) {
        for (const GcodeWord& word : words) {
            take(word);
            is_first_ = false;
        }
        check_together();
        if (error_) { return std::unexpected(*error_); }
        return block_;
    }

private:
    void fail(const GcodeWord& word, const std::string& what) {
        if (!error_) { error_ = GcodeError{line_, word.column, word.text + what}; }
    }

    void take(const GcodeWord& word) {
        if (word.letter == 'G' || word.letter == 'M') { return take_code(word); }
        auto& before = seen_[static_cast<std::size_t>(word.letter - 'A')];
        if (before) { return fail(word, " repeats " + before->text + "; a block has each word once"); }
        before = word;
        switch (word.letter) {
            case 'N': return take_line_number(word);
            case 'F': return take_feed(word);
            case 'P': return;  // with G4, see check_together
            default: return take_axis(word);
        }
    }

    void take_code(const GcodeWord& word) {
        const Code* code = find_code(word);
        if (code == nullptr) { return fail(word, " is not a code known here; known are " + std::string(kCodesText)); }
        auto& before = groups_[code->meaning.index()];
        if (before) {
            return fail(word, " after " + before->text + ": a block has one " +
                                  std::string(kGroupNames[code->meaning.index()]) + " word; use two lines");
        }
        before = word;
        std::visit([this](auto meaning) { set(meaning); }, code->meaning);
    }

    void set(Motion meaning) { block_.motion = meaning; }
    void set(Immediate meaning) { block_.immediate = meaning; }
    void set(Units meaning) { block_.units = meaning; }
    void set(Distance meaning) { block_.distance = meaning; }
    void set(Stop meaning) { block_.stop = meaning; }

    void take_line_number(const GcodeWord& word) {
        if (!is_first_) { fail(word, " is a line number and must come first in its block"); }
        if (word.value < 0 || word.value != std::floor(word.value)) {
            fail(word, " is not a line number; it is a whole number from 0");
        }
    }

    void take_feed(const GcodeWord& word) {
        if (!(word.value > 0)) { return fail(word, " is no feed; F is per minute and above 0"); }
        block_.feed = word;
    }

    void take_axis(const GcodeWord& word) {
        if (axis_letters_.find(word.letter) != std::string_view::npos) { return block_.axes.push_back(word); }
        if (kUsualAxisLetters.find(word.letter) != std::string_view::npos) {
            return fail(word, std::string(": this machine has no axis ") + word.letter + "; its axes are " +
                                  spaced(axis_letters_));
        }
        fail(word, " is not a word known here; known are G M F P N and the axes " + spaced(axis_letters_));
    }

    const std::optional<GcodeWord>& seen(char letter) const { return seen_[static_cast<std::size_t>(letter - 'A')]; }

    void check_together() {
        const auto& immediate = groups_[Meaning(Immediate::Dwell).index()];
        const auto& motion = groups_[Meaning(Motion::Rapid).index()];
        check_dwell(immediate);
        const bool takes_axes = block_.immediate == Immediate::Park || block_.immediate == Immediate::SetOffset;
        if (takes_axes && motion) {
            fail(*motion, " and " + immediate->text + " both use the block's axis words; use two lines");
        }
        if (block_.immediate == Immediate::SetOffset && block_.axes.empty()) {
            fail(*immediate, " sets no axis; write the axes and what they now read, or G92.1 to clear");
        }
    }

    void check_dwell(const std::optional<GcodeWord>& immediate) {
        const auto& seconds = seen('P');
        if (block_.immediate != Immediate::Dwell) {
            if (seconds) { fail(*seconds, " belongs to G4 alone"); }
            return;
        }
        if (!seconds) { return fail(*immediate, " does not say how long; write P and the seconds"); }
        if (seconds->value < 0 || seconds->value > kMaxDwell_s) {
            return fail(*seconds, " s is no dwell; it goes from 0 to " + number_text(kMaxDwell_s) + " s");
        }
        block_.dwell_seconds = seconds->value;
    }

    std::string_view axis_letters_;
    int line_;
    bool is_first_ = true;
    GcodeBlock block_;
    std::optional<GcodeError> error_;
    std::array<std::optional<GcodeWord>, 26> seen_;
    std::array<std::optional<GcodeWord>, std::variant_size_v<Meaning>> groups_;
};

}  // namespace

std::expected<GcodeBlock, GcodeError> read_gcode_block(const std::vector<GcodeWord>& words,
                                                       std::string_view axis_letters, int line) {
    return BlockReader(axis_letters, line).read(words);
}

}  // namespace lockstep
