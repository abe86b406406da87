// A terminal's alternate screen, while the object exists: the previous content returns, however it ends.
#pragma once

#include <termios.h>

#include <cstddef>
#include <optional>
#include <string>

namespace lockstep {

/// Keys are not echoed meanwhile. Ctrl-C still sends its signal: see StopSignal.
class Screen {
public:
    Screen();
    ~Screen();
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    /// Redraws the whole screen, without flicker. The terminal cuts off lines that are too long.
    void draw(const std::string& text);
    /// Whether this key was pressed since the last call.
    bool pressed(char key);
    /// What was typed since the last call, as bytes.
    std::string typed();

private:
    std::optional<termios> keyboard_before_;  // nothing: standard input is no terminal
};

/// The output of draw() on a screen of so many rows: if they are too few, the last row reports it. Pure.
std::string redrawn(const std::string& text, std::size_t rows);

}  // namespace lockstep
