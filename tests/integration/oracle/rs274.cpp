#include "tests/integration/oracle/rs274.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "core/gcode/interpreter.hpp"
#include "core/gcode/text_lines.hpp"
#include "tests/temporary_directory.hpp"

namespace lockstep::oracle {
namespace {

namespace fs = std::filesystem;

constexpr double kMillimetresPerInch = 25.4;
constexpr std::int64_t kRepeatedLines = 100'000;  // some random programs never end

class Folder : public TemporaryDirectory {
public:
    std::string file(const char* name) const { return (path() / name).string(); }
};

std::string text_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

void write(const std::string& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

/// rs274 by itself is an inch machine: its files are in inches.
std::string tool_table() {
    std::ostringstream text;
    text.precision(17);
    for (const auto& [number, tool] : tools()) {
        text << "T" << number << " P" << tool.pocket << " Z" << tool.offset[2] / kMillimetresPerInch << " D"
             << tool.diameter / kMillimetresPerInch << " ;\n";
    }
    return text.str();
}

/// Converts a parameter to mm: the first three and the last three of nine coordinates are lengths.
double in_mm(int parameter, double value) {
    const int place = parameter >= 5221 ? (parameter - 5221) % 20 : (parameter - 5161) % 20;
    const bool is_g92 = parameter >= 5211 && parameter <= 5219;
    const int axis = is_g92 ? parameter - 5211 : place;
    const bool is_length = axis < 9 && (axis < 3 || axis >= 6) && parameter != 5210 && parameter != 5220;
    return is_length ? value * kMillimetresPerInch : value;
}

/// #5161 to #5390: its file has a number and a value in each line.
std::map<int, double> kept_parameters(const std::string& text) {
    std::map<int, double> kept;
    std::istringstream lines(text);
    int number = 0;
    double value = 0;
    while (lines >> number >> value) {
        if (number >= gcode::kHomeParameter && number <= 5390) { kept[number] = in_mm(number, value); }
    }
    return kept;
}

/// Reads the first line of rs274's error message, and the line of the program that it is about.
void read_complaint(const std::string& text, Reading& reading) {
    std::istringstream lines(text);
    std::string line;
    while (std::getline(lines, line)) {
        if (line == "executing" || line.empty()) { continue; }
        if (reading.message.empty()) {
            reading.message = line;
        } else {
            reading.refused = line;
        }
    }
}

}  // namespace

bool is_rs274_installed() { return fs::exists("/usr/bin/rs274"); }

std::map<int, gcode::Tool> tools() {
    gcode::State state;
    state.tools[1] = {.pocket = 1, .offset = {0, 0, 2.5}, .diameter = 3};
    state.tools[2] = {.pocket = 2, .offset = {0, 0, 5.25}, .diameter = 1};
    state.tools[3] = {.pocket = 3, .offset = {0, 0, -1}, .diameter = 0.5};
    return state.tools;
}

Reading read_with_rs274(const std::string& text, const std::string& folder) {
    const Folder directory;
    write(directory.file("program.ngc"), text);
    write(directory.file("tool.tbl"), tool_table());
    write(directory.file("parameters.var"), "");
    // rs274 keeps its tools in a file of the home directory.
    const std::string command = "cd '" + folder + "' && D=" + directory.file("") +
                                " && HOME=$D timeout 5 /usr/bin/rs274 -g -t $D/tool.tbl -v $D/parameters.var "
                                "$D/program.ngc </dev/null >$D/output 2>$D/errors";
    Reading reading;
    const int status = std::system(command.c_str());
    reading.taken = status == 0;
    reading.calls = without_rests(calls_of_output(text_of(directory.file("output"))));
    constexpr int kTimedOut = 124;
    reading.ended = WEXITSTATUS(status) != kTimedOut;
    reading.kept = kept_parameters(text_of(directory.file("parameters.var")));
    if (!reading.taken) { read_complaint(text_of(directory.file("errors")), reading); }
    return reading;
}

std::vector<std::vector<Call>> motions_with_all_digits(const std::vector<std::string>& texts) {
    const Folder directory;
    const auto file = [&](std::size_t i, const char* ending) {
        return directory.file((std::to_string(i) + ending).c_str());
    };
    for (std::size_t i = 0; i < texts.size(); ++i) { write(file(i, ".ngc"), texts[i]); }
    const std::string command =
        "/usr/bin/python3 tests/integration/oracle/exact_calls.py " + directory.file("") + " >/dev/null 2>&1";
    const int status = std::system(command.c_str());
    std::vector<std::vector<Call>> motions;
    for (std::size_t i = 0; i < texts.size() && status == 0; ++i) {
        motions.push_back(without_rests(calls_of_exact_output(text_of(file(i, ".calls")))));
    }
    return motions;
}

Reading read_with_ours(const std::string& text, const std::string& folder) {
    gcode::State state;
    state.tools = tools();
    CallList list;
    gcode::Interpreter interpreter({.axes = "XYZABC",
                                    .skip_deletable = false,
                                    .limits = {.repeated_lines = kRepeatedLines},
                                    .program = text,
                                    .find_subroutine = [&](std::string_view name) -> std::optional<std::string> {
                                        const std::string file = folder + "/" + std::string(name) + ".ngc";
                                        return fs::exists(file) ? std::optional(text_of(file)) : std::nullopt;
                                    }},
                                   std::move(state),
                                   [&](const gcode::Action& action, int line) { list.take(action, line); });
    Reading reading{.calls = {}, .taken = true, .message = {}, .refused = {}, .line = 0, .ended = true, .kept = {}};
    gcode::for_each_line(text, [&](std::string_view line, int number) {
        const auto done = interpreter.take(line, number);
        if (!done) {
            reading.taken = false;
            reading.message = done.error().message;
            reading.line = done.error().line;
        }
        return reading.taken && !interpreter.ended();
    });
    reading.calls = without_rests(list.calls());
    const std::vector<double>& numbered = interpreter.state().parameters.numbered;
    for (int i = gcode::kHomeParameter; i <= 5390; ++i) { reading.kept[i] = numbered[static_cast<std::size_t>(i)]; }
    return reading;
}

}  // namespace lockstep::oracle
