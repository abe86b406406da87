// A terminal's other screen, for as long as the object lives: what stood there before comes back, however it ends.
#pragma once

#include <termios.h>

#include <cstddef>
#include <optional>
#include <string>

namespace lockstep {

/// Keys are not echoed meanwhile. Ctrl-C is a signal as ever: see StopSignal.
class Screen {
public:
    Screen();
    ~Screen();
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    /// The whole screen anew, without flicker. Lines that are too long are cut off by the terminal.
    void draw(const std::string& text);
    /// Whether this key was pressed since the last call.
    bool pressed(char key);

private:
    std::optional<termios> keyboard_before_;  // nothing: standard input is no terminal
};

/// What draw() writes on a screen of so many rows: where they are too few, the last one says so. Pure.
std::string redrawn(const std::string& text, std::size_t rows);

}  // namespace lockstep
