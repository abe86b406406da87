// A client's orders to the machine, read from the bodies of commands. Pure.
#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "clients/web/request/measure_order.hpp"
#include "clients/web/request/problem.hpp"
#include "core/machine.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep::web {

inline constexpr std::size_t kMaxLine_bytes = 1000;  // of mdi

struct JogOrder {
    std::vector<JogAxis> jogs;           // empty to release
    std::string stream;                  // the page's event stream; empty if not named
    std::optional<std::uint64_t> press;  // rises within a client
    bool is_step = false;                // goes its whole distance, also without renewals
};

struct RunOrder {
    std::optional<std::uint64_t> program;  // the id that the loaded program must have
};

struct MdiOrder {
    std::string line;
};

/// Values by axis letter.
using Letters = std::map<char, double>;

struct TouchOrder {
    std::size_t system = 0;
    Letters places;  // what the axes read in that system at their present place
};

struct OffsetOrder {
    std::size_t system = 0;
    Letters origin;  // the other letters stay
    std::optional<double> rotation_deg;
};

struct ToolOrder {
    int number = 0;
    bool removes = false;
    std::optional<int> pocket;
    Letters offset;  // the other letters stay
    std::optional<double> diameter;
};

/// Takes the writer's lease, or gives it back.
struct LeaseOrder {
    bool takes = false;  // even from another writer; false gives it back
};

using Order = std::variant<Command, JogOrder, RunOrder, MdiOrder, TouchOrder, OffsetOrder, ToolOrder, LeaseOrder,
                           MeasureOrder, KeepOrder>;

/// In the order of openapi.yaml.
const std::vector<std::string>& verbs();

/// Fails with 404 for an unknown verb, with 400 or 422 for a wrong body.
std::expected<Order, Problem> read_order(std::string_view verb, std::string_view body, const MachineConfig& machine);

/// The answer to an accepted command.
struct Accepted {
    std::optional<std::uint64_t> job;
    std::optional<bool> jogging;
    std::optional<std::vector<std::string>> modes;  // of mdi, behind the line
};
using Outcome = std::expected<Accepted, Problem>;
using Done = std::function<void(Outcome&& outcome)>;

Json accepted_json(const Accepted& accepted);

}  // namespace lockstep::web
