#include "clients/lockstep/job/confirm.hpp"

#include <unistd.h>

#include <iostream>

namespace lockstep {

std::expected<void, Failure> confirm_motion(bool json, const Output& output, const std::string& without_terminal) {
    if (json || !output.is_terminal() || isatty(STDIN_FILENO) != 1) {
        return std::unexpected(bad_input(without_terminal));
    }
    std::cout << "begin? [y/N] " << std::flush;
    std::string answer;
    std::getline(std::cin, answer);
    if (answer == "y" || answer == "yes") { return {}; }
    return std::unexpected(failed("nothing was begun; to begin, answer y, or add --yes"));
}

}  // namespace lockstep
