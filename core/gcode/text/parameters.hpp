// The parameters of a program: numbered, #1 to #5601, and named, #<name>; those with _ are global.
//
// A subroutine has its own #1 to #30 and its own names without _.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lockstep::gcode {

inline constexpr int kMaxParameter = 5601;
inline constexpr std::size_t kArguments = 30;
using Arguments = std::array<double, kArguments>;

using NamedValues = std::map<std::string, double, std::less<>>;

/// Values of the interpreter that a program can read but not write, such as #5420 and #<_x>.
class SystemValues {
public:
    virtual ~SystemValues() = default;
    virtual std::optional<double> numbered(int number) const = 0;
    virtual std::optional<double> named(std::string_view name) const = 0;
};

/// The values that are part of a machine's state.
struct ParameterValues {
    std::vector<double> numbered = std::vector<double>(kMaxParameter + 1, 0.0);
    NamedValues global;
};

class Parameters {
public:
    Parameters(ParameterValues& values, const SystemValues& system, NamedValues local = {})
        : values_(values), system_(system), local_(std::move(local)) {}

    /// 1 to kMaxParameter.
    double numbered(int number) const;
    std::optional<double> named(std::string_view name) const;
    bool is_read_only(int number) const { return system_.numbered(number).has_value(); }
    bool is_read_only(std::string_view name) const { return system_.named(name).has_value(); }
    void set(int number, double value) { values_.numbered[static_cast<std::size_t>(number)] = value; }
    void set(std::string_view name, double value);
    /// The names without _ of the program or of the present call.
    const NamedValues& local() const { return local_; }

    /// Begins a call: the subroutine has its own #1 to #30, and no local names.
    void enter(const Arguments& arguments);
    /// Ends a call: restores the caller's.
    void leave();

private:
    struct Caller {
        Arguments arguments;
        NamedValues local;
    };

    ParameterValues& values_;
    const SystemValues& system_;
    NamedValues local_;
    std::vector<Caller> callers_;
};

}  // namespace lockstep::gcode
