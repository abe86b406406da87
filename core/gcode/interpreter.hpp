// The modal state of a G-code program: takes blocks one by one and appends what they come to.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/gcode/block.hpp"
#include "core/gcode/gcode.hpp"
#include "core/gcode/modal_state.hpp"

namespace lockstep {

/// The capital letters that call the axes; axes of longer names have none and rest, but for a G28 of all.
std::string axis_letters(const GcodeSetup& setup);

class GcodeInterpreter {
public:
    explicit GcodeInterpreter(const GcodeSetup& setup);

    /// In RS274's order: feed and units, dwell, distance mode, G28 or G92, motion, stop.
    void execute(const GcodeBlock& block, int line);
    void report(GcodeError error) { errors_.push_back(std::move(error)); }

    ModalState modal_state() const;
    const Program& program() const { return program_; }
    const std::vector<GcodeError>& errors() const { return errors_; }

private:
    using Point = std::vector<double>;  // mm, machine coordinates, one per axis

    struct Feed {
        double linear_mm_s = 0;
        double rotary_deg_s = 0;
    };

    void set_feed(const GcodeWord& word, int line);
    void immediate(const GcodeBlock& block, int line);
    void park(const GcodeBlock& block, int line);
    void set_offsets(const GcodeBlock& block);
    void motion(const GcodeBlock& block, int line);
    void stop(gcode::Stop stop, int line);

    std::size_t axis_of(const GcodeWord& word) const;
    bool is_rotary(std::size_t axis) const;
    double to_mm(const GcodeWord& word) const;
    Point target_of(const GcodeBlock& block, int line);
    double within_travel(const GcodeWord& word, double mm, int line);
    double feed_along_path(const Point& target) const;
    void move_to(const Point& target, bool rapid, int line);
    void append(int line, decltype(Block::action) action);

    const GcodeSetup& setup_;
    Program program_;
    std::vector<GcodeError> errors_;
    Point position_;
    Point offset_;  // machine coordinate where the program's axis reads 0
    std::optional<gcode::Motion> motion_;
    gcode::Units units_ = gcode::Units::Millimetres;
    gcode::Distance distance_ = gcode::Distance::Absolute;
    std::optional<Feed> feed_;
    bool missing_feed_reported_ = false;  // once says it all
};

}  // namespace lockstep
