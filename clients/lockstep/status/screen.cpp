#include "clients/lockstep/status/screen.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <sstream>

namespace lockstep {
namespace {

constexpr std::size_t kUsualRows = 24;
constexpr const char* kEnter = "\x1b[?1049h\x1b[?25l\x1b[?7l";  // alternate screen, no cursor, long lines cut off
constexpr const char* kLeave = "\x1b[?7h\x1b[?25h\x1b[?1049l";

}  // namespace

Screen::Screen() {
    termios keyboard{};
    if (tcgetattr(STDIN_FILENO, &keyboard) == 0) {
        keyboard_before_ = keyboard;
        keyboard.c_lflag &= ~static_cast<tcflag_t>(ECHO | ICANON);
        keyboard.c_cc[VMIN] = 0;  // reads never wait
        keyboard.c_cc[VTIME] = 0;
        (void)tcsetattr(STDIN_FILENO, TCSANOW, &keyboard);
    }
    std::cout << kEnter << std::flush;
}

Screen::~Screen() {
    std::cout << kLeave << std::flush;
    if (keyboard_before_) { (void)tcsetattr(STDIN_FILENO, TCSANOW, &*keyboard_before_); }
}

void Screen::draw(const std::string& text) {
    winsize size{};
    const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_row > 0;
    std::cout << redrawn(text, known ? size.ws_row : kUsualRows) << std::flush;
}

bool Screen::pressed(char key) { return typed().find(key) != std::string::npos; }

std::string Screen::typed() {
    std::string bytes;
    char byte = 0;
    while (keyboard_before_ && read(STDIN_FILENO, &byte, 1) == 1) { bytes += byte; }
    return bytes;
}

std::string redrawn(const std::string& text, std::size_t rows) {
    const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n'));
    std::istringstream rest(text);
    std::string out = "\x1b[H";
    std::string line;
    for (std::size_t row = 1; row <= rows && std::getline(rest, line); ++row) {
        const bool is_short = row == rows && lines > rows;
        if (is_short) { line = fmt::format("... {} more lines: make the window higher", lines - rows + 1); }
        out += (row == 1 ? "" : "\r\n") + line + "\x1b[K";
    }
    return out + "\x1b[J";
}

}  // namespace lockstep
