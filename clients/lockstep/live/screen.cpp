#include "clients/lockstep/live/screen.hpp"

#include <unistd.h>

#include <iostream>

namespace lockstep {
namespace {

constexpr const char* kEnter = "\x1b[?1049h\x1b[?25l\x1b[?7l";  // the other screen, no cursor, long lines cut
constexpr const char* kLeave = "\x1b[?7h\x1b[?25h\x1b[?1049l";

}  // namespace

Screen::Screen() {
    termios keyboard{};
    if (tcgetattr(STDIN_FILENO, &keyboard) == 0) {
        keyboard_before_ = keyboard;
        keyboard.c_lflag &= ~static_cast<tcflag_t>(ECHO | ICANON);
        keyboard.c_cc[VMIN] = 0;  // reading never waits
        keyboard.c_cc[VTIME] = 0;
        (void)tcsetattr(STDIN_FILENO, TCSANOW, &keyboard);
    }
    std::cout << kEnter << std::flush;
}

Screen::~Screen() {
    std::cout << kLeave << std::flush;
    if (keyboard_before_) { (void)tcsetattr(STDIN_FILENO, TCSANOW, &*keyboard_before_); }
}

void Screen::draw(const std::string& text) { std::cout << redrawn(text) << std::flush; }

bool Screen::pressed(char key) {
    bool found = false;
    char read_key = 0;
    while (keyboard_before_ && read(STDIN_FILENO, &read_key, 1) == 1) { found = found || read_key == key; }
    return found;
}

std::string redrawn(const std::string& text) {
    std::string out = "\x1b[H";
    for (const char c : text) { out += c == '\n' ? std::string("\x1b[K\r\n") : std::string(1, c); }
    return out + "\x1b[J";
}

}  // namespace lockstep
