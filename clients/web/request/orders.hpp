// What a client asks of the machine, read from the body of a command. Pure.
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

#include "clients/web/request/problem.hpp"
#include "core/machine.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep::web {

inline constexpr std::size_t kMaxLine_bytes = 1000;  // of mdi

struct JogOrder {
    std::vector<JogAxis> jogs;           // none: release
    std::string stream;                  // the page's event stream; empty: not named
    std::optional<std::uint64_t> press;  // rises within a client
};

struct RunOrder {
    std::optional<std::uint64_t> program;  // the id it must have
};

struct MdiOrder {
    std::string line;
};

/// By the letters of axes.
using Letters = std::map<char, double>;

struct TouchOrder {
    std::size_t system = 0;
    Letters places;  // what the axes read there where they stand now
};

struct OffsetOrder {
    std::size_t system = 0;
    Letters origin;  // the others stay
    std::optional<double> rotation_deg;
};

struct ToolOrder {
    int number = 0;
    bool removes = false;
    std::optional<int> pocket;
    Letters offset;  // the others stay
    std::optional<double> diameter;
};

/// Of the writer's lease.
struct LeaseOrder {
    bool takes = false;  // also from another writer; false: gives it back
};

using Order = std::variant<Command, JogOrder, RunOrder, MdiOrder, TouchOrder, OffsetOrder, ToolOrder, LeaseOrder>;

/// In the order of openapi.yaml.
const std::vector<std::string>& verbs();

/// Error: 404 for an unknown verb, 400 and 422 for the body.
std::expected<Order, Problem> read_order(std::string_view verb, std::string_view body, const MachineConfig& machine);

/// A command was accepted.
struct Accepted {
    std::optional<std::uint64_t> job;
    std::optional<bool> jogging;
};
using Outcome = std::expected<Accepted, Problem>;
using Done = std::function<void(Outcome&& outcome)>;

Json accepted_json(const Accepted& accepted);

}  // namespace lockstep::web
