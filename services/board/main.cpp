// lockstep-board: the command line.
#include "services/arguments/argument_parser.hpp"
#include "services/board/board_service.hpp"

int main(int argc, char** argv) {
    lockstep::ArgumentParser parser(
        "Holds the link to a board that drives motors, and offers their registers to the processes of these motors, "
        "until SIGTERM or SIGINT.");
    lockstep::BoardOptions options;
    parser.add_option("--machine", options.machine_file, "the machine's configuration file").required();
    parser.add_option("--board", options.board, "the board's name in that file; its block has a link").required();
    parser.add_option("--log", options.log_file, "the file for log lines; default: standard error");
    parser.footer(
        "Example: lockstep-board --machine machine.textproto --board pico1\n"
        "Exit codes: 0 ended as asked, 1 failed, 2 wrong usage or configuration");
    parser.action([&] { return lockstep::serve_board(options); });
    return parser.run(argc, argv);
}
