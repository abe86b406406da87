// The command line of a program: its options, its verbs and its help. The library CLI11 reads it. CLI11 is all headers.
// They take longer to compile than most programs, so only argument_parser.cpp includes them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lockstep {

/// A word of the command line: an option with a value, a flag, or a word at a fixed position. Copies of an Argument are
/// the same argument. Every function returns its argument, so that calls can be chained.
class Argument {
public:
    explicit Argument(CLI::Option& option) : option_(&option) {}

    Argument required() const;
    /// Shows the variable's present value in the help as the default.
    Argument with_default() const;
    Argument in_range(int least, int most) const;
    Argument in_range(double least, double most) const;
    Argument one_of(const std::vector<std::string>& words) const;
    /// `error_of` returns what is wrong with a word; nothing if it is right.
    Argument checked_by(const std::function<std::string(const std::string& word)>& error_of) const;
    /// A list may also have commas between its words.
    Argument separated_by_commas() const;
    Argument needs(Argument other) const;
    Argument excludes(Argument other) const;

private:
    CLI::Option* option_;
};

struct ParserState;

/// A verb of the command line, such as `run` in `lockstep run FILE`. It has arguments, an action, and verbs of its own.
/// The program itself is one, too. Copies of a Verb are the same verb. The variables that receive the values of its
/// arguments must live until the action ends.
class Verb {
public:
    /// A list of verbs contains only the first line of `help`, which should have at most 70 characters. The verb's own
    /// help contains all of it.
    Verb add_verb(const std::string& name, const std::string& help) const;
    /// The same verb. Verbs that are added to the result are listed under `heading`, which begins with "Verbs".
    Verb under(const std::string& heading) const;
    /// Adds options of which exactly one must be given.
    Verb add_choice(const std::string& name, const std::string& help) const;
    /// `name`: "--name" for an option, "name" for a word at a fixed position. Value: see the end of
    /// argument_parser.cpp.
    template <class Value>
    Argument add_option(const std::string& name, Value& value, const std::string& help) const;
    Argument add_flag(const std::string& name, bool& value, const std::string& help) const;
    /// The text at the end of the help.
    void footer(const std::string& text) const;
    /// Sets the function that runs if this is the last verb of the command line. It returns the program's exit code.
    /// Without an action, one of the verb's own verbs must follow; a verb that has none needs an action.
    void action(std::function<int()> run) const;

protected:
    Verb(CLI::App& app, ParserState& state, std::string heading = "Verbs")
        : app_(&app), state_(&state), heading_(std::move(heading)) {}

    CLI::App* app_;
    ParserState* state_;
    std::string heading_;
};

class ArgumentParser : public Verb {
public:
    static constexpr int kWrongUsage = 2;  // exit code

    /// `name`: the program's name in its help; by default as it was called.
    explicit ArgumentParser(const std::string& description, const std::string& name = "");
    ~ArgumentParser();
    ArgumentParser(ArgumentParser&&) = delete;

    /// Adds --version.
    void version(const std::string& text) const;
    /// Reads the command line and runs the action of its last verb. Returns the action's exit code, 0 after --help and
    /// --version, or kWrongUsage with the error on standard error.
    int run(int argc, const char* const* argv);
    /// The same, except that `on_error` reports an error and returns the exit code. The error names the help to read.
    int run(int argc, const char* const* argv, const std::function<int(const std::string& error)>& on_error);

private:
    explicit ArgumentParser(std::unique_ptr<ParserState> state);

    std::unique_ptr<ParserState> owned_;
};

}  // namespace lockstep
