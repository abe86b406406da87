// Shows a terminal's alternate screen while the object exists. The destructor restores the previous content.
#pragma once

#include <termios.h>

#include <cstddef>
#include <optional>
#include <string>

namespace lockstep {

/// Keys are not echoed in this time. Ctrl-C still sends its signal (see StopSignal).
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
    /// The bytes typed since the last call.
    std::string typed();

private:
    std::optional<termios> keyboard_before_;  // nullopt if standard input is no terminal
};

/// The output of draw() on a screen of `rows` rows. If they are too few, the last row says so. Pure.
std::string redrawn(const std::string& text, std::size_t rows);

}  // namespace lockstep
