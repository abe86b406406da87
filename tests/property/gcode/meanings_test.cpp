// Random lines and programs, right and wrong ones, mean what meanings.txt has recorded: their motions, events, values
// and messages. To write the file: LOCKSTEP_WRITE_HASHES=1 build/bin/property_gcode
// --gtest_filter='GcodeMeanings.Stay*'
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "core/gcode/flow/o_word.hpp"
#include "core/gcode/modal_state.hpp"
#include "core/gcode/session/gcode_session.hpp"
#include "core/gcode/text_lines.hpp"
#include "tests/property/gcode/any_program.hpp"
#include "tests/property/recorded_hashes.hpp"

namespace lockstep {
namespace {

constexpr const char* kFile = "tests/property/gcode/meanings.txt";
constexpr std::uint32_t kSessions = 1'500;
constexpr std::uint32_t kTexts = 1'500;
constexpr int kLinesOfSession = 24;

/// Numbers to a millionth, so that another compiler's last bit changes nothing.
class Text {
public:
    Text& operator<<(double value) {
        text_ << ' ';
        if (std::abs(value) < 1e12) {
            text_ << std::llround(value * 1e6);
        } else {
            text_ << std::setprecision(6) << value;
        }
        return *this;
    }
    Text& operator<<(const std::string& text) {
        text_ << ' ' << text;
        return *this;
    }
    Text& operator<<(const char* text) { return *this << std::string(text); }
    Text& operator<<(bool value) { return *this << (value ? 1.0 : 0.0); }
    Text& operator<<(std::int64_t value) { return *this << static_cast<double>(value); }
    Text& operator<<(const std::vector<double>& values) {
        for (const double value : values) { *this << value; }
        return *this;
    }
    Text& operator<<(const gcode::Point& values) { return *this << std::vector<double>(values.begin(), values.end()); }
    void end_line() { text_ << '\n'; }
    std::string take() const { return text_.str(); }

private:
    std::ostringstream text_;
};

void add(Text& text, const ProgramMove& move) {
    text << "move" << move.target_mm << move.feed_mm_s << move.rapid << static_cast<std::int64_t>(move.mode)
         << move.tolerance_mm << move.is_feed_fixed;
    if (!move.arc) { return; }
    const ArcShape& arc = *move.arc;
    text << "arc" << static_cast<std::int64_t>(arc.first) << static_cast<std::int64_t>(arc.second)
         << arc.centre_first_mm << arc.centre_second_mm << arc.is_clockwise << std::int64_t{arc.turns};
}
void add(Text& text, const Dwell& dwell) { text << "dwell" << dwell.seconds; }
void add(Text& text, const Pause& pause) {
    text << "pause" << static_cast<std::int64_t>(pause.reason) << std::int64_t{pause.tool} << pause.text;
}
void add(Text& text, const Settle&) { text << "settle"; }
void add(Text& text, const Probe& probe) {
    text << "probe" << std::int64_t{probe.input} << probe.opens << probe.must_touch;
}
void add(Text& text, const ProgramEvent& event) {
    text << "event" << static_cast<std::int64_t>(event.kind) << std::int64_t{event.index} << event.value;
}

void add(Text& text, const std::vector<Block>& blocks) {
    for (const Block& block : blocks) {
        text << std::int64_t{block.line.value_or(-1)};
        std::visit([&](const auto& action) { add(text, action); }, block.action);
        text.end_line();
    }
}

void add(Text& text, const std::vector<GcodeNote>& notes) {
    for (const GcodeNote& note : notes) { text << std::int64_t{note.line} << note.text; }
}

void add(Text& text, const gcode::KeptValues& values) {
    for (const auto& system : values.systems) { text << system.origin << system.rotation; }
    text << values.g92 << values.g92_applies << values.home.has_value() << values.home.value_or(gcode::Point{})
         << values.second_home.has_value() << values.second_home.value_or(gcode::Point{});
    for (const auto& [number, tool] : values.tools) {
        text << std::int64_t{number} << std::int64_t{tool.pocket} << tool.offset << tool.diameter << tool.front_angle
             << tool.back_angle << std::int64_t{tool.orientation};
    }
    text.end_line();
}

void add(Text& text, const GcodeError& error) {
    text << "error" << std::int64_t{error.line} << std::int64_t{error.column} << error.message << error.repeats;
    text.end_line();
}

void add(Text& text, const gcode::OWord& word) {
    text << "O" << word.written << static_cast<std::int64_t>(word.keyword) << (word.label ? *word.label : "unknown");
}

gcode::KeptValues values_with_tools() {
    gcode::KeptValues values;
    values.systems[1] = {.origin = {10, 5, 2}, .rotation = 30};
    values.tools[1] = {.pocket = 1, .offset = {0, 0, 2}, .diameter = 3};
    values.tools[2] = {
        .pocket = 2, .offset = {1, 0, 5}, .diameter = 6, .front_angle = 20, .back_angle = 80, .orientation = 2};
    return values;
}

struct Reader {
    MachineConfig machine;
    GcodeSetup setup;
};

Reader reader(std::vector<std::string> axes, double least_mm, double most_mm) {
    Reader reader{.machine = {.name = "any"},
                  .setup = {.program_name = "any", .axes = {}, .values = values_with_tools()}};
    for (const std::string& name : axes) {
        reader.machine.axes.push_back(
            {.name = name, .steps_per_mm = 100, .position_min_mm = least_mm, .position_max_mm = most_mm});
        reader.setup.axes.push_back(
            {.name = name, .min_mm = least_mm, .max_mm = most_mm, .park_mm = 5, .start_mm = 80});
    }
    reader.setup.limits = {.repeated_lines = 300, .idle_lines = 100, .kept_lines = 60};
    return reader;
}

/// Machines that differ in what the language may use.
Reader any_reader(std::uint32_t seed) {
    switch (seed % 4) {
        case 0: {
            Reader mill = reader({"X", "Y", "Z"}, -1000, 1000);
            mill.setup.unassigned = {WordRule::Ignore, WordRule::Ignore, WordRule::Ignore, WordRule::Ignore,
                                     ToolChange::GoOn};
            return mill;
        }
        case 1: {
            Reader all = reader({"X", "Y", "Z", "A", "B", "C", "U", "V", "W"}, -500, 500);
            all.setup.switches = {.pause_at_m1 = true, .skip_deletable = false, .ignore_unassigned = true};
            return all;
        }
        case 2: {
            Reader narrow = reader({"X", "Y", "feeder"}, 0, 100);
            narrow.setup.curves_as_chords = true;
            narrow.setup.chord_tolerance_mm = 0.05;
            return narrow;
        }
        default: {
            Reader plain = reader({"X", "Y", "Z"}, -200, 200);
            plain.setup.unassigned.coolant = WordRule::Refuse;
            plain.setup.unassigned.spindle = WordRule::Ignore;
            return plain;
        }
    }
}

ProgramDevices devices(int number) {
    using Spindle = SpindleDirection;
    constexpr std::array kSpindles{Spindle::Stopped, Spindle::Forward, Spindle::Reverse};
    const auto n = static_cast<std::size_t>(number);
    return {.spindle = kSpindles[n % kSpindles.size()],
            .spindle_rpm = 100.0 * number,
            .mist = n % 2 == 1,
            .flood = n % 4 < 2};
}

/// Lines given one by one. A wrong line changes nothing.
std::string meaning_of_lines(GcodeSession& session, const Reader& used, AnyProgram& random, int lines) {
    SessionStart at{.place_mm = std::vector<double>(used.setup.axes.size(), 80), .values = used.setup.values};
    Text text;
    for (int k = 0; k < lines; ++k) {
        const std::string line = k == 0 ? "F600" : random.line();
        text << line;
        text.end_line();
        if (const auto word = gcode::find_o_word(line)) { add(text, *word); }
        if (k % 5 == 4) { session.set_devices(devices(k)); }
        auto read = session.read(line, at);
        if (!read) {
            add(text, read.error());
            continue;
        }
        add(text, read->blocks);
        add(text, read->notes);
        add(text, read->values);
        text << read->changes_values << read->ends_program << read->message << read->place_mm;
        at = {read->place_mm, read->values};
        session.commit(*read);
        if (read->ends_program) { session.end_program(); }
        text << session.offsets(at.values).origin;
        for (const std::string& word : active_words(session.state())) { text << word; }
        text.end_line();
    }
    return text.take();
}

std::string meaning_of_session(std::uint32_t seed) {
    const Reader used = any_reader(seed);
    GcodeSession session(used.setup, used.machine, seed % 3 == 0 ? 0 : gcode::kNoMotion);
    AnyProgram random(seed);
    return meaning_of_lines(session, used, random, kLinesOfSession);
}

/// A whole text, with all its errors.
std::string meaning_of_text(std::uint32_t seed) {
    const Reader used = any_reader(seed);
    const std::string program = AnyProgram(seed).text();
    Text text;
    text << program;
    gcode::for_each_line(program, [&](std::string_view line, int) {
        if (const auto word = gcode::find_o_word(line)) { add(text, *word); }
        return true;
    });
    if (const auto read = read_gcode(program, used.setup)) {
        add(text, read->program.blocks);
        add(text, read->notes);
        add(text, read->values);
    } else {
        for (const GcodeError& error : read.error()) { add(text, error); }
    }
    const ModalState modal = modal_state_at(program, used.setup, 6);
    text << modal.inches << modal.relative << modal.feed_mm_min.value_or(-1) << modal.offset_mm;
    return text.take();
}

std::string meaning_of(std::uint32_t number) {
    return number < kSessions ? meaning_of_session(number) : meaning_of_text(number);
}

TEST(GcodeMeanings, StayAsRecorded) { expect_recorded(kFile, kSessions + kTexts, meaning_of); }

/// Whatever came before, a session that was reset reads lines as a new one does.
TEST(GcodeSessions, AreAsNewAfterAReset) {
    for (std::uint32_t seed = 0; seed < 400; ++seed) {
        const Reader used = any_reader(seed);
        const int first_motion = seed % 3 == 0 ? 0 : gcode::kNoMotion;
        GcodeSession session(used.setup, used.machine, first_motion);
        AnyProgram random(seed);
        meaning_of_lines(session, used, random, kLinesOfSession);
        session.reset();
        GcodeSession fresh(used.setup, used.machine, first_motion);
        AnyProgram same = random;
        ASSERT_EQ(meaning_of_lines(session, used, random, 6), meaning_of_lines(fresh, used, same, 6)) << seed;
    }
}

TEST(GcodeMeanings, AreOftenErrorsAndMoreOftenNot) {
    std::size_t right = 0;
    std::size_t wrong = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        std::istringstream lines(meaning_of_session(seed));
        for (std::string line; std::getline(lines, line);) {
            wrong += line.find("error ") != std::string::npos ? 1U : 0U;
            right += line.find("move ") != std::string::npos ? 1U : 0U;
        }
    }
    EXPECT_GT(wrong, 300U);
    EXPECT_GT(right, wrong);
}

}  // namespace
}  // namespace lockstep
