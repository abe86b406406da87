// A motion program: what a G-code file becomes and what a coordinator plans. Everything modal is resolved.
#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <string>
#include <variant>
#include <vector>

namespace lockstep {

inline constexpr std::size_t kMaxProgramBlocks = 1'000'000;
inline constexpr double kMaxFeed_mm_s = 1e6;
inline constexpr double kMaxPlace_mm = 1e6;  // either way
inline constexpr double kMaxDwell_s = 86'400;

/// A straight move to an absolute place in machine coordinates, one number per axis of the program.
struct LinearMove {
    std::vector<double> target_mm;
    double feed_mm_s = 0;  // along the path; unused when rapid
    bool rapid = false;    // as fast as the axes' limits allow
};

struct Dwell {
    double seconds = 0;
};

/// Rest until a person says to go on (M0).
struct Pause {};

/// Come to rest, and go on by itself: a sender that has no more for now ends what it has sent with it.
struct Settle {};

struct Block {
    std::int32_t line = 0;  // in the G-code file, from 1; 0 where there is none
    std::variant<LinearMove, Dwell, Pause, Settle> action;
};

struct ProgramHead {
    std::string name;
    std::vector<std::string> axes;
    std::vector<double> start_mm;  // where the machine stood when the program was made; refused from elsewhere
};

/// A program that is known as a whole.
struct Program {
    std::string name;
    std::vector<std::string> axes;
    std::vector<double> start_mm;
    std::vector<Block> blocks;

    ProgramHead head() const { return {name, axes, start_mm}; }
};

/// What is left of a program from the first block of `line` or behind it, for axes that stand at `at_mm`: they first
/// go, as fast as they can and straight, to where that block begins. Error: there is no such block; the last there is.
std::expected<Program, std::string> program_from(const Program& program, std::int32_t line, std::vector<double> at_mm);

}  // namespace lockstep
