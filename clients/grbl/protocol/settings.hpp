// grbl's numbered settings: those of the machine are read from its configuration, those of the reports belong to the
// connection.
#pragma once

#include <expected>
#include <optional>
#include <string>
#include <vector>

#include "clients/grbl/protocol/status_report.hpp"
#include "core/machine.hpp"

namespace lockstep::grbl {

struct Setting {
    int number = 0;
    std::string value;
    std::string source;  // the key of the machine's file that it comes from; empty: there is no such thing here
};

/// In the order of their numbers. Axes beyond the sixth have none.
std::vector<Setting> settings_of(const MachineConfig& machine, const ReportOptions& options);

/// $10 and $13 change `options`; any other setting may only be written as it is. Error: why not.
std::expected<void, std::string> write_setting(const MachineConfig& machine, int number, double value,
                                               ReportOptions& options);

}  // namespace lockstep::grbl
